//! The walk over the cells of a relief, as a frame runs it: the list of crossings of every pixel against the clip-surface in f64.
//!
//! Wherever the ray enters and leaves the box beyond doubt, the list must begin on the side where it enters and have the
//! parity that leads to the side where it leaves; its crossings lie on the clip-surface, in order; and no change of side that
//! close sampling meets is missing.

use std::sync::Arc;

use cutaway::Model;
use cutaway::generate::shapes;
use cutaway::gpu::{ClockSet, Program};
use cutaway::plan::{Capacities, pack};
use cutaway::scene::{Camera, ClipSurface, Cut, OffsetMap, Prepared, Scene, Wrap};
use cutaway::strategies::{self, Strategy};
use glam::{DVec2, DVec3};

use crate::common::scenes::orbit;
use crate::plans::words::{GPU, Random};

const SEED: u64 = 0x3a1c;
const SIZE: [u32; 2] = [64, 48];
/// Steps along each ray.
const SAMPLES: usize = 600;

fn scene(wrap: Wrap, heights: impl Fn(&mut Random, usize) -> f32, amplitude: f64) -> Scene {
    let random = &mut Random(SEED);
    let heights = (0..64).map(|i| heights(random, i)).collect();
    let surface = ClipSurface {
        relief: Some(Arc::new(
            OffsetMap::new([8, 8], heights).expect("finite heights"),
        )),
        wrap,
        scale: DVec3::new(1.0, 1.0, amplitude),
        ..ClipSurface::plane(DVec3::new(0.0, 0.0, 0.0625), DVec3::Z)
    };
    Scene {
        parts: shapes::shape("cube").unwrap_or_else(|e| panic!("{e}")),
        cuts: vec![Cut::new("c", vec![surface])],
        ..Scene::default()
    }
}

fn kept_height(prepared: &Prepared, p: DVec3) -> f64 {
    let s = &prepared.surfaces[0];
    let d = p - s.origin;
    let t = DVec2::new(d.dot(s.frame.u_hat), d.dot(s.frame.v_hat)) * DVec2::from(s.map_per_unit);
    let map = s.relief.as_ref().expect("a relief");
    d.dot(s.frame.normal) + map.sample(s.wrap, t).0 * s.height_scale
}

/// Faults of the lists of one view, and how many crossings and overflows there were. `judge` holds the clip-surface that the
/// lists are judged by.
fn faults(scene: &Scene, judge: &Prepared, camera: &Camera) -> (Vec<String>, usize, usize) {
    let model = Model::new(scene);
    let view = model.prepared.view_of(camera, SIZE);
    let capacities = Capacities {
        crossings: Some(Capacities::MOST_CROSSINGS),
        ..Capacities::UNKNOWN
    };
    let plan = strategies::plan(&model, &view, Strategy::RAYCAST_MASK, &capacities)
        .unwrap_or_else(|e| panic!("{e}"));
    let mut program = Program::default();
    let run = |program: &mut Program| -> cutaway::Result<[Vec<u32>; 2]> {
        program.load(&GPU, plan)?;
        program.run(&GPU, ClockSet::ALL)?;
        Ok([
            program.words(&GPU, "crossing_heads")?,
            program.words(&GPU, "crossing_z")?,
        ])
    };
    let [heads, z] = run(&mut program).unwrap_or_else(|e| panic!("{e}"));

    let bounds = model.prepared.parts[0].bounds;
    let frame = pack::frame(&view, &bounds);
    let s = &judge.surfaces[0];
    // How fast the height can change along a ray of a direction no longer than 2: the plane's part and the map's.
    let size = s.relief.as_ref().expect("a relief").size().map(f64::from);
    let per_unit = s.map_per_unit[0].abs() * size[0] + s.map_per_unit[1].abs() * size[1];
    let steepness = 2.0 + 4.0 * per_unit * s.height_scale.abs();
    // Crossings are moved by 2^-20 of their depth, at most 8 here, and as much again is left to f32.
    let doubt = 2.0 * 8.0 / f64::from(1 << 20) * steepness;

    let (mut faults, mut crossings, mut overflows) = (Vec::new(), 0, 0);
    let pixels = (SIZE[0] * SIZE[1]) as usize;
    for pixel in 0..pixels {
        let at = DVec2::new(
            (pixel as u32 % SIZE[0]) as f64 + 0.5,
            (pixel as u32 / SIZE[0]) as f64 + 0.5,
        );
        let (origin, direction) = view.ray(at);
        let Some([enter, leave]) = interval(&frame, origin, direction) else {
            continue;
        };
        let [head, sides] = [heads[2 * pixel], heads[2 * pixel + 1]];
        let count = (head & 0xffff) as usize;
        crossings += count;
        if head >> 31 == 1 {
            overflows += 1;
            continue;
        }
        let height = |depth: f64| kept_height(judge, origin + depth * direction);
        let mut fault = |what: String| faults.push(format!("pixel {at}: {what}"));
        let (first, last) = (height(enter), height(leave));
        let begins_removed = sides & 1 == 1;
        if first.abs() > doubt && (first < 0.0) != begins_removed {
            fault(format!(
                "begins removed: {begins_removed}, at height {first}"
            ));
        }
        let ends_removed = begins_removed ^ (count % 2 == 1);
        if last.abs() > doubt && (last < 0.0) != ends_removed {
            fault(format!(
                "ends removed: {ends_removed} after {count} crossings, at height {last}"
            ));
        }
        let depths: Vec<f64> = (0..count)
            .map(|i| view.depth_from_buffer(f64::from(f32::from_bits(z[i * pixels + pixel]))))
            .collect();
        if depths.iter().any(|d| d.is_nan()) || !depths.is_sorted() {
            fault(format!("{depths:?} are out of order"));
        }
        if let Some(d) = depths.iter().find(|d| height(**d).abs() > doubt) {
            fault(format!("{d} is at height {}", height(*d)));
        }
        let mut side = begins_removed;
        let mut sampled = 0;
        for i in 0..=SAMPLES {
            let h = height(enter + (leave - enter) * i as f64 / SAMPLES as f64);
            if h.abs() > doubt && (h < 0.0) != side {
                side = !side;
                sampled += 1;
            }
        }
        if sampled > count {
            fault(format!(
                "{count} crossings, but samples change side {sampled} times"
            ));
        }
    }
    (faults, crossings, overflows)
}

/// Where a ray is inside the box of the frame, beyond the near plane; `None` where it is hardly.
fn interval(frame: &pack::Frame, origin: DVec3, direction: DVec3) -> Option<[f64; 2]> {
    let (mut enter, mut leave) = (f64::from(frame.near), f64::INFINITY);
    for axis in 0..3 {
        let [low, high] = [frame.box_min[axis], frame.box_max[axis]].map(f64::from);
        let (a, b) = (
            (low - origin[axis]) / direction[axis],
            (high - origin[axis]) / direction[axis],
        );
        if direction[axis].abs() < 1e-12 {
            if origin[axis] < low + 1e-6 || origin[axis] > high - 1e-6 {
                return None;
            }
            continue;
        }
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    (leave > enter + 1e-4).then_some([enter, leave])
}

/// Aslant, grazing, parallel to N, parallel to U and V inside the slab, and along the diagonal of the texels.
fn cameras() -> Vec<Camera> {
    let mut all = Vec::new();
    for orthographic in [false, true] {
        for (azimuth, elevation) in [
            (35.0, 25.0),
            (80.0, 3.0),
            (0.0, 0.0),
            (90.0, 0.0),
            (0.0, 90.0),
            (90.0, 45.0),
            (215.0, -10.0),
        ] {
            all.push(orbit(azimuth, elevation, orthographic));
        }
    }
    all
}

#[test]
fn the_list_of_a_ray_agrees_with_the_surface() {
    let noise = |random: &mut Random, _: usize| random.signed();
    let checker = |_: &mut Random, i: usize| ((i + i / 8) % 2) as f32;
    let ramp = |_: &mut Random, i: usize| (i % 8) as f32 / 8.0;
    let mut met = 0;
    for (what, scene) in [
        ("noise", scene(Wrap::Repeat, noise, 0.2)),
        ("mirrored noise", scene(Wrap::Mirror, noise, 0.2)),
        ("clamped noise", scene(Wrap::Clamp, noise, -0.3)),
        ("checkers", scene(Wrap::Repeat, checker, 0.4)),
        ("a ramp", scene(Wrap::Repeat, ramp, 0.5)),
    ] {
        let judge = Prepared::new(&scene);
        for camera in cameras() {
            let (found, crossings, overflows) = faults(&scene, &judge, &camera);
            assert!(
                found.is_empty(),
                "{what}, {:?}: {} faults: {:#?}",
                camera.viewpoint,
                found.len(),
                &found[..found.len().min(5)]
            );
            assert_eq!(overflows, 0, "{what}, {:?}: overflows", camera.viewpoint);
            met += crossings;
        }
    }
    assert!(met > 50_000, "only {met} crossings");
}

#[test]
fn a_surface_that_moved_is_noticed() {
    let noise = |random: &mut Random, _: usize| random.signed();
    let scene_here = scene(Wrap::Repeat, noise, 0.2);
    // Judged by the map mirrored, and by heights of the other sign.
    for judge in [
        scene(Wrap::Mirror, noise, 0.2),
        scene(Wrap::Repeat, noise, -0.2),
    ] {
        let judge = Prepared::new(&judge);
        let (found, ..) = faults(&scene_here, &judge, &orbit(35.0, 25.0, false));
        assert!(found.len() > 300, "only {} faults", found.len());
    }
}
