//! Plane cuts of solids whose sections are known.

use std::f64::consts::PI;

use cutaway::layers::Kind;
use cutaway::scene::ClipSurface;
use glam::{DVec3, Vec3, dvec3};

use crate::exactness::exact::solids::{
    ball, cuboid, frame, inside_out, joined, odd, orbit, parallel, scene, sound, unit_cube,
};

const FRONT: DVec3 = DVec3::new(0.0, 0.0, 4.0);

fn below(z: f64) -> ClipSurface {
    ClipSurface::plane(DVec3::Z * z, DVec3::NEG_Z)
}

fn above(z: f64) -> ClipSurface {
    ClipSurface::plane(DVec3::Z * z, DVec3::Z)
}

#[test]
fn a_halved_cube_shows_a_unit_square() {
    let camera = parallel(FRONT, DVec3::ZERO, 2.0);
    let exact = sound(
        &scene(vec![unit_cube()], vec![vec![below(0.0)]], camera),
        [64, 64],
    );
    assert_eq!(exact.layers.count(Kind::Cap), 32 * 32, "1 of 2 x 2 units");
    assert_eq!(exact.layers.count(Kind::Surface), 0, "the rest is empty");
    let cap = exact.layers.at(20, 40);
    assert_eq!(cap.normal, Vec3::Z, "out of the kept half");
    // The ball around the cube has radius 0.87: scene space is as large as world space.
    assert!((cap.depth - 4.0).abs() < 1e-12, "depth {}", cap.depth);
    let whole = sound(&scene(vec![unit_cube()], vec![], camera), [64, 64]);
    assert_eq!(
        whole.layers.count(Kind::Cap),
        0,
        "nothing removed, nothing capped"
    );
    assert_eq!(whole.layers.count(Kind::Surface), 32 * 32, "a face of 1");
}

#[test]
fn in_perspective_the_section_lands_where_it_projects() {
    let mut camera = crate::exactness::exact::solids::eye(FRONT, DVec3::ZERO, 40.0);
    camera.near = Some(0.1);
    let exact = sound(
        &scene(vec![unit_cube()], vec![vec![below(0.0)]], camera),
        [200, 200],
    );
    // At depth 4 the picture is 8 tan(20 deg) high; the cap hides the smaller rest behind it.
    let side = 200.0 / (8.0 * 20f64.to_radians().tan());
    let width = (0..200)
        .filter(|x| exact.layers.at(*x, 100).kind == Kind::Cap)
        .count();
    assert!(
        (width as f64 - side).abs() <= 1.0,
        "{width} px wide, not {side}"
    );
    let area = exact.layers.count(Kind::Cap);
    assert_eq!(area, width * width, "the section is a square");
}

#[test]
fn a_section_of_a_ball_has_the_area_of_its_polygon() {
    // The section between two rings is a regular polygon; its deficit against the disc falls with the square of n.
    let (height, size) = (2.25, 720);
    let mut deficits = Vec::new();
    for n in [8, 16, 32] {
        let z = 0.3;
        let exact = sound(
            &scene(
                vec![ball(1.0, n, n)],
                vec![vec![below(z)]],
                parallel(FRONT, DVec3::ZERO, height),
            ),
            [size, size],
        );
        let step = PI / f64::from(n);
        let ring = (z.acos() / step).floor();
        let share = ((ring * step).cos() - z) / ((ring * step).cos() - ((ring + 1.0) * step).cos());
        let r = (ring * step).sin() * (1.0 - share) + ((ring + 1.0) * step).sin() * share;
        let expected = 0.5 * f64::from(n) * (2.0 * step).sin() * r * r;
        let px = height / f64::from(size);
        let area = exact.layers.count(Kind::Cap) as f64 * px * px;
        // Boundary pixels round either way; a random walk over them leaves far less than one in eight.
        let slack = 2.0 * PI * px / 8.0;
        assert!(
            (area - expected).abs() < slack,
            "n = {n}: {area}, not {expected}"
        );
        deficits.push(PI * (1.0 - z * z) - area);
    }
    for pair in deficits.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.0..5.2).contains(&ratio), "deficits {deficits:?}");
    }
}

#[test]
fn planes_through_edges_vertices_and_diagonals_leave_no_hole() {
    let normals = [
        dvec3(1.0, 0.0, 1.0),
        dvec3(1.0, 1.0, 1.0),
        dvec3(0.0, 1.0, 0.0),
        dvec3(1.0, -2.0, 0.5),
    ];
    for normal in normals {
        for point in [DVec3::splat(0.5), dvec3(0.5, -0.5, 0.5), DVec3::ZERO] {
            for camera in [
                orbit(30.0, 20.0),
                orbit(-140.0, -35.0),
                orbit(45.0, 0.0),
                parallel(FRONT, DVec3::ZERO, 2.0),
            ] {
                for n in [normal, -normal] {
                    let cut = vec![vec![ClipSurface::plane(point, n)]];
                    sound(&scene(vec![unit_cube()], cut, camera), [65, 65]);
                }
            }
        }
    }
    // Through the diagonal, seen along the normal: a rectangle of 1 by the square root of 2.
    let n = dvec3(1.0, 0.0, 1.0).normalize();
    let exact = sound(
        &scene(
            vec![unit_cube()],
            vec![vec![ClipSurface::plane(DVec3::ZERO, -n)]],
            parallel(n * 4.0, DVec3::ZERO, 2.0),
        ),
        [256, 256],
    );
    let area = exact.layers.count(Kind::Cap) as f64 * (2.0f64 / 256.0).powi(2);
    assert!(
        (area - 2f64.sqrt()).abs() < 2.0 * 2.0 / 256.0,
        "area {area}"
    );
}

#[test]
fn a_plane_in_a_face_shows_what_lies_on_its_kept_side() {
    let back = -FRONT;
    // (kept half-space, eye, what the face's 32 x 32 pixels show)
    for (surface, eye, expected) in [
        (above(-0.5), FRONT, Kind::Surface),
        (above(-0.5), back, Kind::Surface),
        (below(0.5), FRONT, Kind::Surface),
        // Only the face itself would be left, a sheet without thickness.
        (above(0.5), FRONT, Kind::Background),
        (above(0.5), back, Kind::Background),
        (below(-0.5), FRONT, Kind::Background),
    ] {
        let camera = parallel(eye, DVec3::ZERO, 2.0);
        let exact = sound(
            &scene(vec![unit_cube()], vec![vec![surface.clone()]], camera),
            [64, 64],
        );
        let covered = if expected == Kind::Background {
            0
        } else {
            32 * 32
        };
        assert_eq!(
            exact.covered_px(),
            covered,
            "{:?} seen from {eye}",
            surface.origin
        );
        assert_eq!(
            exact.layers.count(expected),
            if covered > 0 { covered } else { 64 * 64 },
            "{:?} seen from {eye}: speckle",
            surface.origin
        );
        assert_eq!(exact.undecided_px(), 0, "coincidence is decided");
    }
    // A hair to either side flips it as a whole.
    let hair = 1e-6;
    for (z, expected) in [(0.5 - hair, 32 * 32), (0.5 + hair, 0)] {
        let camera = parallel(FRONT, DVec3::ZERO, 2.0);
        let exact = frame(
            &scene(vec![unit_cube()], vec![vec![above(z)]], camera),
            [64, 64],
        );
        assert_eq!(exact.covered_px(), expected, "plane at {z}");
    }
}

#[test]
fn crossing_planes_remove_what_both_or_either_removes() {
    let camera = parallel(FRONT, DVec3::ZERO, 2.0);
    let left = ClipSurface::plane(DVec3::ZERO, DVec3::NEG_X);
    let both = vec![vec![below(0.0), left.clone()]];
    let exact = sound(&scene(vec![unit_cube()], both, camera), [64, 64]);
    let at = |x: u32| {
        let l = exact.layers.at(x, 32);
        (l.kind, l.clip_surface)
    };
    assert_eq!(
        at(20),
        (Kind::Surface, 0),
        "x < 0 is outside the intersection"
    );
    assert_eq!(at(40), (Kind::Cap, 0), "x > 0 is cut at z = 0");
    assert_eq!(
        exact.layers.count(Kind::Cap),
        16 * 32,
        "half of the section"
    );

    let either = vec![vec![below(0.0)], vec![left]];
    let exact = sound(&scene(vec![unit_cube()], either, camera), [64, 64]);
    assert_eq!(exact.layers.at(20, 32).kind, Kind::Cap, "x < 0 keeps z < 0");
    assert_eq!(exact.covered_px(), 16 * 32, "x > 0 is gone");

    // Across the notch the second plane is seen: its caps carry its number.
    let notch = vec![vec![
        below(0.0),
        ClipSurface::plane(DVec3::ZERO, DVec3::NEG_X),
    ]];
    let exact = sound(
        &scene(vec![unit_cube()], notch, orbit(60.0, 20.0)),
        [128, 128],
    );
    for surface in [0, 1] {
        let seen = exact
            .layers
            .pixels
            .iter()
            .filter(|l| l.kind == Kind::Cap && l.clip_surface == surface)
            .count();
        assert!(seen > 500, "surface {surface} made {seen} px of cap");
    }
}

#[test]
fn nested_shells_leave_a_ring_whichever_way_the_inner_one_faces() {
    let camera = parallel(FRONT, DVec3::ZERO, 2.5);
    let cut = || vec![vec![below(0.01)]];
    let hollow = |inner| joined(ball(1.0, 64, 64), inner);
    let proper = sound(
        &scene(vec![hollow(inside_out(ball(0.5, 64, 64)))], cut(), camera),
        [300, 300],
    );
    let same = frame(
        &scene(vec![hollow(ball(0.5, 64, 64))], cut(), camera),
        [300, 300],
    );
    let px = 2.5f64 / 300.0;
    let area = proper.layers.count(Kind::Cap) as f64 * px * px;
    assert!((area - PI * 0.75).abs() < 0.02, "ring of {area}");
    assert_eq!(
        proper.layers.count(Kind::Cap),
        same.layers.count(Kind::Cap),
        "parity does not ask which way a shell faces"
    );
    assert_eq!(odd(&same), 0, "two closed shells");
    assert!(
        same.layers.at(150, 150).back_face && !proper.layers.at(150, 150).back_face,
        "only the unflipped void shows its inner side"
    );
}

#[test]
fn of_overlapping_parts_the_smaller_has_the_cap() {
    let camera = parallel(FRONT, DVec3::ZERO, 2.0);
    let inner = cuboid(DVec3::splat(-0.25), DVec3::splat(0.25));
    let exact = sound(
        &scene(vec![unit_cube(), inner], vec![vec![below(0.0)]], camera),
        [64, 64],
    );
    let of_part = |part: u16| {
        exact
            .layers
            .pixels
            .iter()
            .filter(|l| l.kind == Kind::Cap && l.part == part)
            .count()
    };
    assert_eq!(of_part(1), 16 * 16, "the inner cube is drawn over");
    assert_eq!(of_part(0), 32 * 32 - 16 * 16, "the outer has the rest");
}
