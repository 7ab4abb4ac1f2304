// Walls that a ray passes unseen. Without a cap at the near plane a ray that begins inside a solid shows nothing of the solid before
// entering something: the wall by which it leaves is passed. It shows its back, as no wall does that a ray from outside meets first.

#define_import_path cutaway::exits

#import cutaway::frame::frame

fn is_passed(front: bool) -> bool {
    return !front && frame.near_cap == 0u;
}
