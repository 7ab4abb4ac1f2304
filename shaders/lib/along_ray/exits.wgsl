// Walls that a ray passes through unseen. Without a near-plane cap, a ray that begins inside a solid shows nothing of the solid until it
// enters something: the exit wall is skipped. It shows its back face, unlike any wall first met by a ray from outside.

#define_import_path cutaway::exits

#import cutaway::frame::frame

fn is_passed(front: bool) -> bool {
    return !front && frame.near_cap == 0u;
}
