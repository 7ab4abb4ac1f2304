//! The reference with cutters, against closed forms and against the same region said otherwise.

use std::f64::consts::PI;

use cutaway::layers::Kind;
use cutaway::scene::{Camera, ClipSurface, Cut, Prepared, Scene, View};
use cutaway_lab::exact::{Exact, evaluate};
use glam::{DAffine3, DQuat, DVec3};

use super::common::meshes::{block, moved, shape};
use super::common::{class_of, scenes as cameras};
use super::scenes::{bitten, cutter, shaped, solid};

const SIZE: [u32; 2] = [256, 256];

fn seen(scene: &Scene, camera: &Camera) -> (Prepared, View, Exact) {
    let prepared = Prepared::new(scene);
    let view = prepared.view_of(camera, SIZE);
    let exact = evaluate(&prepared, &view);
    (prepared, view, exact)
}

/// Parallel rays down z on a square of two units.
fn from_above() -> Camera {
    cameras::parallel(DVec3::Z * 5.0, DVec3::ZERO, 2.0)
}

/// What has gone from before what is seen, by the depths of two pictures of one view, in world units.
fn volume_between(whole: &Scene, cut: &Scene) -> f64 {
    let camera = from_above();
    let (_, _, before) = seen(whole, &camera);
    let (prepared, view, after) = seen(cut, &camera);
    let pixel = view.pixel_size(1.0) / prepared.scale;
    let pairs = before.layers.pixels.iter().zip(&after.layers.pixels);
    pairs
        .filter(|(b, a)| b.kind != Kind::Background && a.kind != Kind::Background)
        .map(|(b, a)| (a.depth - b.depth) / prepared.scale * pixel * pixel)
        .sum()
}

fn close(found: f64, wanted: f64, share: f64) {
    assert!(
        (found / wanted - 1.0).abs() < share,
        "{found} instead of {wanted}"
    );
}

fn cube() -> cutaway::scene::Mesh {
    block(DVec3::splat(-0.5), DVec3::splat(0.5))
}

#[test]
fn a_box_bites_its_own_volume_off_a_cube() {
    // From the upper face of the cube 0.25 deep, over whole pixels, and beyond the cube at one side.
    let bite = block(
        DVec3::new(-0.3125, 0.125, 0.25),
        DVec3::new(0.3125, 0.7, 0.9),
    );
    let scene = solid("cube minus box", cube(), vec![cutter(bite)]);
    let removed = volume_between(&solid("cube", cube(), Vec::new()), &scene);
    close(removed, 0.625 * 0.375 * 0.25, 1e-6);
    let (_, _, exact) = seen(&scene, &from_above());
    let floor = (exact.layers.pixels.iter()).find(|p| p.kind == Kind::Cap);
    let floor = floor.expect("the floor of the bite");
    assert_eq!(floor.normal.to_array(), [0.0, 0.0, 1.0], "it looks up");
    assert_eq!(floor.clip_surface, 0, "it is the cutter's");
}

#[test]
fn two_balls_share_the_lens_of_the_closed_form() {
    let ball = shape("sphere?subdivisions=5&radius=0.5");
    let whole = solid("ball", ball.clone(), Vec::new());
    for apart in [0.3, 0.5, 0.7] {
        let other = moved(&ball, DAffine3::from_translation(DVec3::Z * apart));
        let bitten = solid("ball minus ball", ball.clone(), vec![cutter(other)]);
        let (r, d) = (0.5, apart);
        let lens = PI * (4.0 * r + d) * (2.0 * r - d).powi(2) / 12.0;
        close(volume_between(&whole, &bitten), lens, 0.01);
    }
}

#[test]
fn what_is_kept_inside_is_the_lens_itself() {
    let ball = shape("sphere?subdivisions=5&radius=0.5");
    let other = cutter(moved(&ball, DAffine3::from_translation(DVec3::Z * 0.5))).flipped();
    let scene = solid("ball and ball", ball, vec![other]);
    let (prepared, view, exact) = seen(&scene, &from_above());
    // The lens shows the cutter's lower half from below and the ball's upper half from above, over a circle.
    let circle = PI * (0.25 - 0.0625);
    let pixel = view.pixel_size(1.0) / prepared.scale;
    close(exact.covered_px() as f64 * pixel * pixel, circle, 0.01);
    assert_eq!(
        exact.layers.count(Kind::Cap),
        0,
        "from above it is the ball's own"
    );
    let below = cameras::parallel(DVec3::Z * -5.0, DVec3::ZERO, 2.0);
    let (_, _, exact) = seen(&scene, &below);
    close(
        exact.layers.count(Kind::Cap) as f64 * pixel * pixel,
        circle,
        0.01,
    );
}

#[test]
fn a_void_inside_is_seen_from_inside_alone() {
    let void = block(DVec3::splat(-0.3), DVec3::splat(0.3));
    let scene = solid("hollow cube", cube(), vec![cutter(void)]);
    for orthographic in [false, true] {
        let outside = cameras::orbit(30.0, 20.0, orthographic);
        let (_, _, hollow) = seen(&scene, &outside);
        let (_, _, whole) = seen(&solid("cube", cube(), Vec::new()), &outside);
        assert_eq!(
            hollow.layers.pixels, whole.layers.pixels,
            "nothing of a void is seen from outside"
        );
    }
    let mut inside = cameras::looking(DVec3::ZERO, DVec3::X, 60.0);
    inside.near = Some(0.01);
    let (prepared, _, exact) = seen(&scene, &inside);
    assert_eq!(
        exact.layers.count(Kind::Cap),
        exact.layers.pixels.len(),
        "its walls are all there is"
    );
    let ahead = &exact.layers.pixels[128 * 256 + 128];
    close(f64::from(ahead.depth as f32) / prepared.scale, 0.3, 1e-6);
    assert_eq!(ahead.normal.to_array(), [-1.0, 0.0, 0.0], "towards the eye");
}

/// A box as six planes: what is behind all of them is removed.
fn planes_of_box(by: DAffine3, min: DVec3, max: DVec3) -> Vec<ClipSurface> {
    let sides = DVec3::AXES
        .into_iter()
        .flat_map(|axis| [(axis * max.dot(axis), axis), (axis * min.dot(axis), -axis)]);
    sides
        .map(|(at, out)| ClipSurface::plane(by.transform_point3(at), by.transform_vector3(out)))
        .collect()
}

#[test]
fn a_box_cuts_as_its_six_planes_do() {
    let parts = || {
        let mut parts = super::common::meshes::parts("shells?subdivisions=3");
        parts.truncate(2);
        parts
    };
    let bounds = bitten("shells", parts(), Vec::new()).bounds();
    let (min, max) = (bounds.size() * -0.1, bounds.size() * 0.45);
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.3, 0.2);
    let place = DAffine3::from_rotation_translation(turn, bounds.centre());
    let mesh = moved(&block(min, max), place);
    let by_mesh = bitten("box", parts(), vec![cutter(mesh)]);
    let mut by_planes = bitten("planes", parts(), Vec::new());
    by_planes.cuts = vec![Cut::new("planes", planes_of_box(place, min, max))];
    for (azimuth, orthographic) in [(30.0, false), (30.0, true), (75.0, false)] {
        let camera = cameras::orbit(azimuth, 35.0, orthographic);
        let (_, _, mesh) = seen(&by_mesh, &camera);
        let (_, _, planes) = seen(&by_planes, &camera);
        let decided = |i: &usize| !mesh.undecided[*i] && !planes.undecided[*i];
        let differing = (0..mesh.layers.pixels.len()).filter(decided).filter(|i| {
            let [a, b] = [&mesh, &planes].map(|e| &e.layers.pixels[*i]);
            let [(kind, part, _), (of_planes, part_of_planes, _)] = [a, b].map(class_of);
            (kind, part) != (of_planes, part_of_planes)
                || (kind != Kind::Background && (a.depth - b.depth).abs() > 1e-6)
                || a.normal.angle_between(b.normal) > 1e-3
        });
        assert_eq!(differing.count(), 0, "seen from {azimuth}°");
        let caps = mesh.layers.count(Kind::Cap);
        assert!(caps > 2000, "only {caps} pixels of caps: it asks little");
        let undecided = mesh.undecided_px() as f64;
        let few = 1e-3 * mesh.covered_px() as f64 + 30.0;
        assert!(undecided <= few, "{undecided} undecided");
    }
}

#[test]
fn a_cutter_that_shares_a_face_leaves_nothing_without_thickness() {
    // The cutter's floor, or a wall of it, lies in a face of the cube, differently divided into triangles.
    let divided = shape("cube?divisions=5");
    let bitten = |min: DVec3, max: DVec3| {
        let place = DAffine3::from_translation((min + max) * 0.5) * DAffine3::from_scale(max - min);
        solid("shared", cube(), vec![cutter(moved(&divided, place))])
    };
    let whole = solid("cube", cube(), Vec::new());
    let (half, quarter) = (DVec3::splat(0.5), DVec3::new(0.25, 0.25, 0.5));
    let pocket = DVec3::new(-0.25, -0.25, 0.0);
    for (what, scene, same) in [
        (
            "on the whole top",
            bitten(DVec3::new(-0.5, -0.5, 0.5), half + DVec3::Z * 0.5),
            whole.clone(),
        ),
        (
            "on the middle of the top",
            bitten(DVec3::new(-0.25, -0.25, 0.5), quarter + DVec3::Z * 0.25),
            whole,
        ),
        (
            "a flush pocket",
            bitten(pocket, quarter),
            bitten(pocket, quarter + DVec3::Z * 0.25),
        ),
        (
            "all of it",
            bitten(-half, half),
            solid(
                "gone",
                cube(),
                vec![cutter(moved(
                    &divided,
                    DAffine3::from_scale(DVec3::splat(2.0)),
                ))],
            ),
        ),
    ] {
        for camera in [from_above(), cameras::orbit(30.0, 40.0, false)] {
            let [(_, _, exact), (_, _, wanted)] = [&scene, &same].map(|s| seen(s, &camera));
            let differing = (0..exact.undecided.len())
                .filter(|i| !exact.undecided[*i] && !wanted.undecided[*i])
                .filter(|i| {
                    let [a, b] = [&exact, &wanted].map(|e| &e.layers.pixels[*i]);
                    let far = a.kind != Kind::Background && (a.depth - b.depth).abs() > 1e-9;
                    class_of(a) != class_of(b) || far
                })
                .count();
            assert_eq!(differing, 0, "{what}");
        }
    }
}

#[test]
fn outlines_of_the_cutter_are_where_a_sample_may_be_undecided() {
    // The wall of a tube seen along it falls on a column of samples: without its outlines the reference would call them decided.
    let column = 0.5 - 0.5 / 128.0 + 1e-6;
    let bite = block(DVec3::new(-0.2, -0.2, -0.6), DVec3::new(column, 0.2, -0.3));
    let scene = solid(
        "slot",
        block(DVec3::splat(-0.9), DVec3::splat(0.9)),
        vec![cutter(bite)],
    );
    let (_, _, exact) = seen(&scene, &from_above());
    let along = (0..exact.undecided.len())
        .filter(|i| exact.undecided[*i])
        .filter(|i| !exact.odd_parity[*i])
        .count();
    assert!(
        along == 0,
        "{along} samples beside a hidden slot are undecided"
    );
    let open = block(DVec3::new(-0.2, -0.2, -0.6), DVec3::new(column, 0.2, 1.0));
    let scene = solid(
        "slot",
        block(DVec3::splat(-0.9), DVec3::splat(0.9)),
        vec![cutter(open)],
    );
    let (_, _, exact) = seen(&scene, &from_above());
    let along = exact.undecided_px();
    assert!((40..80).contains(&along), "{along} samples along the wall");
}

#[test]
fn a_flipped_cutter_and_its_own_complement_leave_nothing() {
    let ball = shaped("sphere?subdivisions=4", 0.4, DVec3::new(0.1, 0.2, 0.3));
    let both = solid("nothing", cube(), vec![ball.clone(), ball.flipped()]);
    let (_, _, exact) = seen(&both, &cameras::orbit(30.0, 20.0, false));
    let decided = (0..exact.undecided.len()).filter(|i| !exact.undecided[*i]);
    let left = decided.filter(|i| exact.layers.pixels[*i].kind != Kind::Background);
    // Of the sheet between the two, of no thickness, nothing is known.
    assert_eq!(left.count(), 0, "a point is inside or outside");
}
