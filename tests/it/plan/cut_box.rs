//! The box around the cut solids, outside of which no crossing is looked for.

use cutaway::plan::pack::frame;
use cutaway::scene::{Bounds, Prepared};
use glam::{DVec2, DVec3, Vec4};

use crate::common::scenes;

/// Regression: at the silhouette of the whole model fixed functions covered samples whose rays missed the box, and so found no crossing
/// before them: what was removed there stayed. By 1/16 px at 160 x 120, by 1/256 px at 64 x 48.
#[test]
fn rays_beside_a_solid_by_what_rasterisers_move_it_meet_the_box() {
    let solid = Bounds {
        min: DVec3::splat(-0.5),
        max: DVec3::splat(0.5),
    };
    let prepared = Prepared::new(&scenes::sectioned("cube", &[]));
    for size_px in [[64, 48], [160, 120], [2400, 1800]] {
        for orthographic in [false, true] {
            let camera = scenes::orbit(30.0, 20.0, orthographic);
            let view = prepared.view_of(&camera, size_px);
            let packed = frame(&view, &solid);
            let [min, max] = [packed.box_min, packed.box_max].map(|v| Vec4::from(v).truncate());
            for corner in solid.corners() {
                let (at, depth) = view.project(corner);
                for (x, y) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
                    let (origin, direction) = view.ray(at + DVec2::new(x, y) / 32.0);
                    let beside = (origin + direction * depth).as_vec3();
                    let is_within = beside.cmpgt(min).all() && beside.cmplt(max).all();
                    assert!(is_within, "{size_px:?}: {beside} in {min} to {max}");
                }
            }
        }
    }
}
