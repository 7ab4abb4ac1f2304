// The slab of a clip-surface: the heights over its plane between which the surface lies.

#define_import_path cutaway::slab

#import cutaway::cuts::cut_table

// Heights over the plane below which a point is removed and above which it is kept, whatever the offset map holds. A margin of a few ulp
// lets a walk begin and end where that is certain. `start` is the height over the plane at the start of the ray.
fn slab_beside(surface: u32, start: f32) -> vec2<f32> {
    let slab = cut_table.surfaces[surface].slab;
    let margin = 1e-6 * (abs(slab.x) + abs(slab.y) + abs(start) * 0.25);
    return vec2<f32>(-slab.y - margin, -slab.x + margin);
}
