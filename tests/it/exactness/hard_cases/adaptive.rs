//! Case 34: `adaptive` along a camera's way of 1,000 frames. The triangles of every frame are made on the CPU, from the errors that the
//! device measured and the tables that the frame would upload (`tests/it/exactness/adaptive.rs` holds the device to the same triangles); every
//! 25th frame is drawn, and along every ray the list must have the parity that the two ends of the ray imply.

use cutaway::passes::{ActiveCuts, Model};
use cutaway::plan::Capacities;
use cutaway::plan::pack::frame;
use cutaway::scene::{Camera, Scene, View, Wrap};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{self, Strategy};
use glam::{DVec2, DVec3, Vec4};

use crate::common::{Question, meshes, scenes, session, strategy};
use crate::exactness::hard_cases::refined::{Sheet, cracks, row_of};

const FRAMES: u32 = 1000;
const DRAWN: usize = 25;
const SIZE: [u32; 2] = [72, 54];

fn scene() -> Scene {
    let hills = scenes::map([96, 80], |x, y| {
        let (x, y) = (x as f32, y as f32);
        (x * 0.13).sin() * (y * 0.11).cos() + 0.2 * (x * 0.9 + y * 0.7).sin()
    });
    let surface = scenes::mapped(
        DVec3::new(0.0, 0.02, 0.0),
        DVec3::new(-0.2, -1.0, -0.3),
        hills,
        (1.0, 0.08),
        Wrap::Mirror,
    );
    scenes::scene(
        "hills",
        meshes::shape("torus?segments=40&sides=20"),
        vec![surface],
    )
}

/// From far above down to the relief, along it, and away.
fn camera(frame: u32) -> Camera {
    let t = f64::from(frame) / f64::from(FRAMES);
    let angle = t * 5.0;
    let distance = 0.35 + 3.0 * (t - 0.6).powi(2) * 2.0;
    let height = 0.06 + 1.5 * (t - 0.55).abs();
    let from = DVec3::new(angle.cos() * distance, height, angle.sin() * distance);
    let to = DVec3::new(0.1 * (3.0 * angle).sin(), 0.0, 0.1);
    scenes::looking(from, to, 50.0)
}

/// Rays of a drawn frame on which the list has the wrong parity, and how many rays were asked.
fn wrong_rays(
    session: &Session,
    strategy: &Strategy,
    model: &Model,
    view: &View,
    planted: Option<usize>,
) -> (usize, usize) {
    let mut heads = session.words(strategy, "crossing_heads").expect("heads");
    if let Some(pixel) = planted {
        heads[2 * pixel] ^= 1;
    }
    let surface = &model.prepared.surfaces[0];
    let map = surface.relief.as_ref().expect("a relief");
    let kept_height = |point: DVec3| {
        let from = point - surface.origin;
        let at = DVec2::new(
            from.dot(surface.frame.u_hat) * surface.map_per_unit[0],
            from.dot(surface.frame.v_hat) * surface.map_per_unit[1],
        );
        from.dot(surface.frame.normal) + map.sample(surface.wrap, at).0 * surface.height_scale
    };
    let active_cuts = ActiveCuts::new(&model.prepared, view).expect("a plain scene");
    let packed = frame(view, &active_cuts.cut_box);
    let [min, max] = [packed.box_min, packed.box_max].map(|v| Vec4::from(v).truncate().as_dvec3());
    let (mut wrong, mut asked) = (0, 0);
    for pixel in 0..(view.size_px[0] * view.size_px[1]) as usize {
        let (x, y) = (
            pixel as u32 % view.size_px[0],
            pixel as u32 / view.size_px[0],
        );
        let (origin, ray) = view.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        let (low, high) = ((min - origin) / ray, (max - origin) / ray);
        let enter = low.min(high).max_element().max(view.near);
        let leave = low.max(high).min_element();
        if enter >= leave {
            continue;
        }
        let ends = [enter, leave].map(|depth| kept_height(origin + ray * depth));
        // The sheet may be off by TAU pixels, and which end of the box it leaves by with it.
        if ends.iter().any(|h| h.abs() < 2.0 * view.pixel_size(leave)) {
            continue;
        }
        asked += 1;
        let (count, sides) = (heads[2 * pixel] & 0xffff, heads[2 * pixel + 1]);
        let kept = [sides & 1 == 0, (sides + count) & 1 == 0];
        wrong += usize::from(kept != ends.map(|h| h > 0.0));
    }
    (wrong, asked)
}

#[test]
fn case_34_no_crack_along_a_cameras_way() {
    let model = Model::new(&scene());
    let strategy = strategy("adaptive:0.5+mask");
    let mut session = session();
    let mut sheet: Option<Sheet> = None;
    let mut planted_in = 0;
    let (mut asked_in_all, mut widest) = (0, 0);
    for frame in 0..FRAMES {
        let view = model.prepared.view_of(&camera(frame), SIZE);
        if (frame as usize).is_multiple_of(DRAWN) {
            let drawn = session.draw(&model, &view, strategy).expect("a frame");
            assert_eq!(drawn.outcome, Outcome::Complete, "frame {frame}");
            let (wrong, asked) = wrong_rays(&session, &strategy, &model, &view, None);
            assert!(wrong == 0, "frame {frame}: {wrong} of {asked} rays");
            asked_in_all += asked;
            let layers = session.layers(strategy).expect("layers");
            let exact = Question::through(&scene(), &camera(frame), SIZE);
            let c = exact.compare(&layers);
            assert_eq!(
                [c.crack_px, c.odd_parity_px],
                [0, 0],
                "frame {frame}: cracks, pixels in doubt"
            );
        }
        let plan = strategies::plan(&model, &view, strategy, &Capacities::UNKNOWN)
            .unwrap_or_else(|e| panic!("{e}"));
        let sheet = sheet.get_or_insert_with(|| Sheet::of(&session, &strategy, 0));
        sheet.domain = row_of(&plan, "domains", 0);
        sheet.refinement = row_of(&plan, "refinements", 0);
        let triangles = sheet.triangles();
        let legs = triangles
            .iter()
            .map(|[c, a, _]| (c[0] - a[0]).abs().max((c[1] - a[1]).abs()));
        let (least, most) = legs.fold((i32::MAX, 1), |(l, m), leg| (l.min(leg), m.max(leg)));
        widest = widest.max(most / least.min(most));
        let faults = cracks(sheet, triangles);
        assert!(
            faults.is_empty(),
            "frame {frame}: {} cracks: {}",
            faults.len(),
            faults[0]
        );

        // The control: errors of which a half of those of squares do not bound what comes of them.
        if frame.is_multiple_of(50) {
            let mut planted = sheet.clone();
            let [width, height] = planted.texels();
            for y in (1..height).step_by(2) {
                for x in (1..width).step_by(4) {
                    let at = planted.vertex_at([x, y]);
                    planted.errors[at] = 0.0;
                }
            }
            let triangles = planted.triangles();
            planted_in += usize::from(!cracks(&planted, triangles).is_empty());
        }
    }
    assert!(asked_in_all > 10_000, "{asked_in_all} rays");
    assert!(widest >= 16, "sides differ by {widest}");
    assert!(
        planted_in >= 10,
        "errors that are not nested crack {planted_in} of 20 frames"
    );
}

#[test]
fn case_34_a_list_of_the_wrong_parity_is_noticed() {
    let model = Model::new(&scene());
    let strategy = strategy("adaptive:0.5+mask");
    let view = model.prepared.view_of(&camera(0), SIZE);
    let mut session = session();
    let _ = session
        .draw(&model, &view, strategy)
        .expect("a frame")
        .outcome;
    let noticed = (0..(SIZE[0] * SIZE[1]) as usize)
        .step_by(97)
        .filter(|pixel| wrong_rays(&session, &strategy, &model, &view, Some(*pixel)).0 > 0);
    assert!(noticed.count() > 3, "a planted crossing");
}
