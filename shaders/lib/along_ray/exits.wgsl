// Exit walls, which are invisible. Without a near-plane cap, a ray that begins inside a solid shows nothing of the solid until the ray
// enters a solid: the wall through which it leaves is skipped. That wall shows its back face, unlike the first wall of a ray from outside.

#define_import_path cutaway::exits

#import cutaway::frame::frame

fn is_passed(front: bool) -> bool {
    return !front && frame.near_cap == 0u;
}
