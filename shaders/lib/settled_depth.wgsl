// Depth of fragments whose triangles are settled, in a frame with a list of crossings.
//
// Depth of a face in a clip-surface, or just beside it, is that of the surface but for rounding. So no depth orders its fragments
// against the crossing: they are moved in front of it or behind, if they are not there. All else about them goes by the
// depth they have then: every decision of a pixel still compares the same numbers.

#define_import_path cutaway::settled_depth

#import cutaway::crossings::{crossing_heads, listed, surface_at, z_at}
#import cutaway::settled::{beside, of_doubled, settled}

// Depth-buffer value of a fragment of a group, which rasterising found at `z`.
fn settled_z(found: f32, pixel: u32, group: u32, front: bool) -> f32 {
    let z = of_doubled(found, group, front);
    let surfaces = settled.groups[group].surfaces;
    let removed = settled.groups[group].removed;
    let head = crossing_heads[pixel];
    let count = listed(head.x);
    var sides = head.y;
    var moved = z;
    for (var i = 0u; i < count; i++) {
        let surface = 1u << surface_at(i, pixel);
        if (surfaces & surface) != 0u {
            let crossing = z_at(i, pixel);
            let is_before = (sides & surface) == (removed & surface);
            moved = beside(moved, crossing, is_before);
        }
        sides ^= surface;
    }
    return moved;
}
