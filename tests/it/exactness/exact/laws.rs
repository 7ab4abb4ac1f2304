//! One scene in two guises must look the same.

use cutaway::layers::Kind;
use cutaway::scene::{Camera, ClipSurface, Mesh, Projection, Scene, Viewpoint};
use cutaway_lab::exact::Exact;
use glam::{DQuat, DVec3, dvec3};

use crate::exactness::exact::solids::{
    ball, cuboid, differing, fractal, frame, mapped, parallel, relief, scene, unit_cube,
};

const SIZE: [u32; 2] = [128, 128];

fn meshes() -> Vec<Mesh> {
    let pin = cuboid(dvec3(-0.15, -0.15, -0.9), dvec3(0.15, 0.15, 0.9));
    vec![
        ball(0.8, 20, 24),
        pin,
        mapped(unit_cube(), |p| p * 0.8 + 0.35),
    ]
}

fn camera(turn: DQuat) -> Camera {
    Camera {
        viewpoint: Viewpoint::Explicit {
            position: turn * dvec3(1.5, 1.0, 3.0),
            focal_point: turn * dvec3(0.1, 0.0, 0.0),
            view_up: Some(turn * DVec3::Y),
        },
        projection: Projection::Perspective { fov_y_deg: 35.0 },
        near: Some(0.1),
        ..Camera::default()
    }
}

fn turned(s: &ClipSurface, turn: DQuat) -> ClipSurface {
    ClipSurface {
        origin: turn * s.origin,
        u: turn * s.u,
        v: turn * s.v,
        ..s.clone()
    }
}

fn ragged() -> ClipSurface {
    relief(0.15, 0.9, 0.3, fractal(32, 4))
}

fn turned_frame(turn: DQuat) -> Exact {
    let meshes = meshes()
        .into_iter()
        .map(|m| mapped(m, |p| turn * p))
        .collect();
    let cut = vec![turned(&ragged(), turn)];
    frame(&scene(meshes, vec![cut], camera(turn)), SIZE)
}

#[test]
fn turning_everything_changes_nothing() {
    let here = turned_frame(DQuat::IDENTITY);
    assert!(
        here.layers.count(Kind::Cap) > 1000,
        "caps are what is compared"
    );
    for turn in [
        DQuat::from_rotation_x(0.7),
        DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2),
        DQuat::from_euler(glam::EulerRot::XYZ, 1.0, 2.0, 3.0),
    ] {
        let there = turned_frame(turn);
        assert_eq!(differing(&here, &there), 0, "turned by {turn}");
    }
}

#[test]
fn the_order_of_triangles_changes_nothing() {
    let turn = DQuat::IDENTITY;
    let build = |reverse: bool| {
        let mut meshes = meshes();
        for m in &mut meshes {
            if reverse {
                m.triangles.reverse();
                for t in &mut m.triangles {
                    t.rotate_left(1);
                }
            }
        }
        frame(&scene(meshes, vec![vec![ragged()]], camera(turn)), SIZE)
    };
    let [a, b] = [build(false), build(true)];
    for (p, q) in a.layers.pixels.iter().zip(&b.layers.pixels) {
        assert_eq!(
            (p.kind, p.part, p.clip_surface),
            (q.kind, q.part, q.clip_surface),
            "classes"
        );
    }
    assert_eq!(a.undecided, b.undecided, "undecided pixels");
}

fn kinds(e: &Exact) -> Vec<(Kind, u16)> {
    e.layers.pixels.iter().map(|l| (l.kind, l.part)).collect()
}

#[test]
fn a_cut_is_the_union_of_its_two_sides() {
    let whole: Scene = scene(meshes(), vec![vec![ragged()]], camera(DQuat::IDENTITY));
    let whole = frame(&whole, SIZE);
    for divider in [
        ClipSurface::plane(dvec3(0.05, 0.0, 0.0), dvec3(1.0, 0.4, 0.2)),
        relief(0.3, 0.7, 0.2, fractal(16, 8)),
    ] {
        let cuts = vec![
            vec![ragged(), divider.clone()],
            vec![ragged(), divider.flipped()],
        ];
        let split = frame(&scene(meshes(), cuts, camera(DQuat::IDENTITY)), SIZE);
        let wrong = (0..whole.layers.pixels.len())
            .filter(|i| !whole.undecided[*i] && !split.undecided[*i])
            .filter(|i| kinds(&whole)[*i] != kinds(&split)[*i])
            .count();
        assert_eq!(wrong, 0, "dividing a cut left a trace");
        // Without one of the halves something must stay.
        let half = vec![vec![ragged(), divider.clone()]];
        let half = frame(&scene(meshes(), half, camera(DQuat::IDENTITY)), SIZE);
        assert!(kinds(&half) != kinds(&whole), "half a cut is not the cut");
    }
}

#[test]
fn flipping_twice_is_no_flip_and_flipping_once_gives_the_other_half() {
    let cube = || vec![unit_cube()];
    let from = |side: f64| parallel(DVec3::Z * (4.0 * side), DVec3::ZERO, 2.0);
    let surface = relief(0.0, 0.7, 0.3, fractal(32, 4));
    let lower = frame(&scene(cube(), vec![vec![surface.clone()]], from(1.0)), SIZE);
    let twice = surface.flipped().flipped();
    let again = frame(&scene(cube(), vec![vec![twice]], from(1.0)), SIZE);
    assert_eq!(lower.layers, again.layers, "flipped twice");
    // The other half, from the other side, shows the same cap in a mirror: depths add up to the distance of the cameras.
    let upper = frame(
        &scene(cube(), vec![vec![surface.flipped()]], from(-1.0)),
        SIZE,
    );
    assert_eq!(lower.layers.count(Kind::Cap), 64 * 64, "all of the section");
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let (a, b) = (lower.layers.at(x, y), upper.layers.at(SIZE[0] - 1 - x, y));
            assert_eq!(a.kind, b.kind, "pixel {x}, {y}");
            if a.kind == Kind::Cap {
                assert!(
                    (a.depth + b.depth - 8.0).abs() < 1e-9,
                    "{} + {}",
                    a.depth,
                    b.depth
                );
                assert!(
                    (a.normal + b.normal).length() < 1e-6,
                    "normals are opposite"
                );
            }
        }
    }
}
