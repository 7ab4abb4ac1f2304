//! The box around the cut solids, outside of which no crossing is looked for.

use cutaway::plan::Contents;
use cutaway::plan::pack::frame;
use cutaway::scene::{Bounds, Precision, Prepared, View};
use cutaway::strategies::{DrawOptions, Method, Rasteriser};
use glam::{DVec2, DVec3, Vec4};

use super::*;
use crate::common::scenes;

/// Regression: at the silhouette of the whole model fixed functions covered samples whose rays missed the box, and so found no crossing
/// before them: what was removed there stayed.
#[test]
fn rays_beside_a_solid_by_what_rasterisers_move_it_meet_the_box() {
    let solid = Bounds {
        min: DVec3::splat(-0.5),
        max: DVec3::splat(0.5),
    };
    let prepared = Prepared::new(&scenes::sectioned("cube", &[]));
    let [usual, coarse] = [8, 4].map(|sub_pixel_bits| Precision {
        sub_pixel_bits,
        slopes_in_f32: true,
    });
    let pictures = [
        ([64, 48], coarse),
        ([96, 72], usual),
        ([240, 180], coarse),
        ([2400, 1800], coarse),
        ([2400, 1800], usual),
    ];
    for (size_px, precision) in pictures {
        for orthographic in [false, true] {
            let camera = scenes::orbit(30.0, 20.0, orthographic);
            let view = View {
                precision,
                ..prepared.view_of(&camera, size_px)
            };
            // Half a step along each axis.
            let off_px = 0.5 / f64::from(1 << precision.sub_pixel_bits);
            let packed = frame(&view, &solid);
            let [min, max] = [packed.box_min, packed.box_max].map(|v| Vec4::from(v).truncate());
            for corner in solid.corners() {
                let (at, depth) = view.project(corner);
                for (x, y) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
                    let (origin, direction) = view.ray(at + DVec2::new(x, y) * off_px);
                    let beside = (origin + direction * depth).as_vec3();
                    let is_within = beside.cmpgt(min).all() && beside.cmplt(max).all();
                    assert!(is_within, "{size_px:?}: {beside} in {min} to {max}");
                }
            }
        }
    }
}

#[test]
fn the_sub_pixel_bits_of_a_session_reach_the_frame() {
    let model = Model::new(&scenes::sectioned("cube", &["z=0"]));
    let view = model.prepared.view([64, 48]);
    let uploaded = |sub_pixel_bits: Option<u32>, by: Rasteriser| {
        let options = DrawOptions {
            sub_pixel_bits,
            ..DrawOptions::by(by)
        };
        let method = Method::new(Strategy::RAYCAST_MASK, options);
        let plan = strategies::plan(&model, &view, method, &Capacities::UNKNOWN);
        let plan = plan.unwrap_or_else(|e| panic!("{e}"));
        let frame = plan.resources.iter().find(|r| r.name == "frame");
        let contents = frame.and_then(|r| r.contents.as_ref());
        contents.map(Contents::bytes).expect("it is uploaded")
    };
    // The compute rasteriser has bits of its own, but tessellations and cutters are drawn by the adapter beside it too.
    for by in [Rasteriser::Hardware, Rasteriser::Compute] {
        assert_ne!(uploaded(Some(4), by), uploaded(Some(8), by), "{by}");
        assert_eq!(uploaded(None, by), uploaded(Some(8), by), "{by}");
    }
}
