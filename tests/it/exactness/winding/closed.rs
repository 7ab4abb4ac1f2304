//! On closed meshes nothing changes.

use cutaway::layers::{Kind, Layers};
use cutaway::scene::{ClipSurface, Cut, Fill, Part, Prepared, Projection, Role, Scene, Viewpoint};
use cutaway_lab::exact::{Exact, Windings, evaluate};
use glam::{DAffine3, DVec3};

use crate::common::{is_wrong, meshes, scenes};

const SIZE_PX: [u32; 2] = [192, 144];

/// The answers of exact and of winding numbers to a scene.
fn both(scene: &Scene) -> (Exact, Layers) {
    let prepared = Prepared::new(scene);
    let view = prepared.view(SIZE_PX);
    let layers = Windings::new(&prepared).layers(&prepared, &view);
    (evaluate(&prepared, &view), layers)
}

/// Decided pixels that differ, and marked ones.
fn faults(exact: &Exact, layers: &Layers) -> [usize; 2] {
    let pairs = exact.layers.pixels.iter().zip(&layers.pixels);
    let differ = pairs.zip(&exact.undecided);
    let wrong = differ.filter(|((truth, found), undecided)| !**undecided && is_wrong(truth, found));
    [
        wrong.count(),
        layers.pixels.iter().filter(|p| p.unreliable).count(),
    ]
}

#[track_caller]
fn agrees(name: &str, scene: &Scene, least_cap_px: usize) {
    let (exact, layers) = both(scene);
    assert_eq!(faults(&exact, &layers), [0, 0], "{name}: wrong, marked");
    let caps = layers.count(Kind::Cap);
    assert!(caps >= least_cap_px, "{name} has only {caps} cap pixels");
    // What is right is right in all it says.
    for (truth, found) in exact.layers.pixels.iter().zip(&layers.pixels) {
        if !is_wrong(truth, found) && truth.depth.is_finite() {
            assert!((truth.depth - found.depth).abs() < 1e-9, "{name}: depth");
            assert!(
                (truth.normal - found.normal).length() < 1e-6,
                "{name}: normal"
            );
            assert_eq!(truth.overlap, found.overlap, "{name}: overlap");
        }
    }
}

#[test]
fn closed_meshes_are_drawn_as_exact_draws_them() {
    for shape in meshes::SHAPES {
        for (section, relief) in [
            ("-1,-2,-1.5@50%,45%,60%", None),
            (
                "-0.4,-0.3,-1@50%,50%,55%",
                Some("fractal:size=64,amplitude=8%"),
            ),
        ] {
            let mut scene = scenes::sectioned(shape, &[section]);
            if let Some(relief) = relief {
                scene.cuts = vec![Cut::new(
                    "cut",
                    vec![scenes::relief(&scene, section, relief)],
                )];
            }
            agrees(shape, &scene, 60);
            scene.camera = scenes::orbit(200.0, -30.0, true);
            agrees(shape, &scene, 0);
        }
    }
}

#[test]
fn several_cuts_parts_and_rules_are_those_of_exact() {
    let mut scene = scenes::sectioned("sphere?subdivisions=3", &["-z=45%", "-x=45%"]);
    agrees("intersection", &scene, 60);
    let surfaces = scene.cuts.remove(0).surfaces;
    scene.cuts = surfaces
        .into_iter()
        .enumerate()
        .map(|(i, s)| Cut::new(format!("{i}"), vec![s]))
        .collect();
    agrees("union", &scene, 60);
    let mut ball = Part::new("ball", meshes::shape("sphere?subdivisions=2"));
    ball.world_from_part = DAffine3::from_translation(DVec3::splat(0.2));
    scene.parts.push(ball);
    agrees("overlap", &scene, 60);
    scene.parts[1].role = Role::Interior;
    agrees("interior part", &scene, 0);
    // Shells that overlap in one mesh: a void or not, by the rule.
    let balls = [0.0, 0.4].map(|x| {
        let by = DAffine3::from_translation(DVec3::X * x);
        meshes::moved(&meshes::shape("sphere?subdivisions=3"), by)
    });
    let plane = ClipSurface::plane(DVec3::ZERO, DVec3::NEG_Z);
    let mut lens = scenes::scene("lens", meshes::joined(&balls), vec![plane]);
    agrees("even-odd", &lens, 60);
    let carved = both(&lens).1.count(Kind::Cap);
    lens.parts[0].fill = Fill::Nonzero;
    agrees("nonzero", &lens, 60);
    assert!(
        both(&lens).1.count(Kind::Cap) > carved + 60,
        "the rules differ"
    );
}

#[test]
fn an_eye_inside_and_faces_in_the_plane_are_those_of_exact() {
    let mut scene = scenes::sectioned("cube", &["-z=70%"]);
    for near_cap in [true, false] {
        for (position, parallel) in [
            (DVec3::new(0.1, 0.05, 0.0), false),
            (DVec3::new(0.1, 0.05, 0.4), false),
            (DVec3::new(0.0, 0.1, 0.3), true),
        ] {
            scene.camera.near_cap = near_cap;
            scene.camera.viewpoint = Viewpoint::Explicit {
                position,
                focal_point: DVec3::new(-0.3, -0.2, -0.4),
                view_up: None,
            };
            scene.camera.projection = match parallel {
                true => Projection::Orthographic { height: Some(1.0) },
                false => scenes::orbit(0.0, 0.0, false).projection,
            };
            agrees("from within", &scene, 0);
        }
    }
    for section in ["z=100%", "-z=0%", "z=0%", "-z=100%", "x=0%"] {
        agrees(section, &scenes::sectioned("cube", &[section]), 0);
    }
}

#[test]
fn a_fault_would_be_seen() {
    let scene = scenes::sectioned("sphere?subdivisions=3", &["-z=50%"]);
    let (exact, layers) = both(&scene);
    assert_eq!(faults(&exact, &layers), [0, 0]);
    // Without most of its faces nothing tells that the rest is around anything.
    let mut bowl = scene.clone();
    let mut mesh = meshes::shape("sphere?subdivisions=3");
    let low: Vec<bool> = (0..mesh.triangles.len())
        .map(|t| mesh.corners(t).iter().all(|p| p.z < 0.2))
        .collect();
    let mut low = low.into_iter();
    mesh.triangles.retain(|_| !low.next().unwrap());
    bowl.parts[0].mesh = mesh.into();
    let [wrong, marked] = faults(&exact, &both(&bowl).1);
    assert!(wrong > 1000, "{wrong} pixels of the cap are missed");
    assert!(marked > 1000, "{marked} marked: numbers near a half");
}
