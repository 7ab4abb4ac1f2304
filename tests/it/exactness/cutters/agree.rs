//! Every inside test that reads the one list, by both rasterisers, against exact.

use cutaway::layers::{Kind, Layers};
use cutaway::scene::{Camera, ClipSurface, Cut, Part, Scene};
use cutaway::session::Outcome;
use glam::{DAffine3, DQuat, DVec3};

use super::common::meshes::{self, block, moved, shape};
use super::common::{Judged, Question, class_of, coarseness, scenes as cameras, strategy};
use super::scenes::{bitten, cutter, judged_by_compute, shaped, solid};

const SIZE: [u32; 2] = [160, 120];

/// Strategies that are exact.
const EXACT: [&str; 4] = [
    "raycast+mask",
    "raycast+stencil",
    "raycast+abuffer",
    "raycast+kbuffer:32",
];
/// Those that the compute rasteriser draws too.
const BY_COMPUTE: [&str; 2] = ["raycast+mask", "raycast+abuffer"];

/// How far normals of caps may be beside the truth, in degrees: 13 bits of each fraction, and 16 of the layers.
const NORMAL_ERROR_DEG: f32 = 0.05;
/// Share of the pixels of caps that may have the normal of the next triangle: those within 1/256 px of an edge, and chance.
const NEXT_TRIANGLE_SHARE: f64 = 0.02;

/// Caps of one kind whose normals differ.
fn turned_px(question: &Question, layers: &Layers) -> usize {
    let pairs = question.exact.layers.pixels.iter().zip(&layers.pixels);
    pairs
        .filter(|(a, b)| a.kind == Kind::Cap && class_of(a) == class_of(b))
        .filter(|(a, b)| a.normal.angle_between(b.normal).to_degrees() > NORMAL_ERROR_DEG)
        .count()
}

fn fault(question: &Question, judged: &Judged) -> Option<String> {
    let turned = turned_px(question, &judged.layers);
    let few =
        NEXT_TRIANGLE_SHARE * coarseness() * question.exact.layers.count(Kind::Cap) as f64 + 3.0;
    (judged.fault_of_exact())
        .or_else(|| (turned as f64 > few).then(|| format!("{turned} normals are not the truth")))
}

/// What is wrong with the frames of a scene, if anything is.
fn faults(name: &str, scene: &Scene) -> Vec<String> {
    let question = Question::new(scene, SIZE);
    let caps = question.exact.layers.count(Kind::Cap);
    let mut faults = Vec::new();
    if caps < 40 {
        faults.push(format!("{name}: only {caps} cap pixels: it asks nothing"));
    }
    let few = question.boundary_px() / 40 + 40;
    let undecided = question.exact.undecided_px();
    if undecided > few {
        faults.push(format!("{name}: {undecided} undecided, {few} are many"));
    }
    for of in EXACT {
        let judged = question.answer(strategy(of));
        faults.extend(fault(&question, &judged).map(|f| format!("{name}: {of}: {f}")));
    }
    for of in BY_COMPUTE {
        let judged = judged_by_compute(&question, of);
        faults.extend(fault(&question, &judged).map(|f| format!("{name}: {of} by compute: {f}")));
    }
    faults
}

fn crank() -> Vec<Part> {
    meshes::parts("crank?throws=2&detail=16")
}

fn centre(parts: &[Part]) -> (DVec3, f64) {
    let bounds = bitten("", parts.to_vec(), Vec::new()).bounds();
    (bounds.centre(), bounds.size().length())
}

#[test]
fn shapes_bite_into_a_crank() {
    let (at, size) = centre(&crank());
    let mut found = Vec::new();
    for (spec, share) in [
        ("sphere?subdivisions=3", 0.32),
        ("knot?segments=160&sides=12", 0.3),
        ("gears?flank=2", 0.3),
        ("sponge?level=2", 0.35),
    ] {
        for (orthographic, flip) in [(false, false), (true, false), (false, true)] {
            let unit = shaped(spec, 1.0, DVec3::ZERO).bounds_in_world();
            let scale = share * size / unit.size().length() * 2.0;
            let offset = at + DVec3::new(0.02, 0.04, 0.11) * size - unit.centre() * scale;
            let mut bite = shaped(spec, scale, offset);
            if flip {
                bite = bite.flipped();
            }
            let mut scene = bitten(spec, crank(), vec![bite]);
            scene.camera = cameras::orbit(35.0, 40.0, orthographic);
            found.extend(faults(
                &format!("{spec}, parallel {orthographic}, flipped {flip}"),
                &scene,
            ));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Shells, one in the other, and a ball that bites into them.
fn shells() -> Scene {
    let parts = meshes::parts("earth?subdivisions=3");
    let (at, size) = centre(&parts);
    let ball = shaped(
        "sphere?subdivisions=3",
        size * 0.22,
        at + DVec3::new(0.1, 0.12, 0.22) * size,
    );
    let mut scene = bitten("shells", parts, vec![ball]);
    scene.camera = cameras::orbit(25.0, 30.0, false);
    scene
}

#[test]
fn several_parts_are_cut_as_their_filters_say() {
    let mut found = faults("all", &shells());
    let names: Vec<String> = shells().parts.iter().map(|p| p.name.clone()).collect();
    // What is spared hides what is cut inside of it: the outermost may be cut alone instead.
    for name in &names[..names.len() - 1] {
        let mut scene = shells();
        scene.cuts[0].except = vec![name.clone()];
        found.extend(faults(&format!("but {name}"), &scene));
    }
    let mut scene = shells();
    scene.cuts[0].applies_to = vec![names[names.len() - 1].clone()];
    found.extend(faults("the outermost alone", &scene));
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn cutters_go_with_planes_reliefs_and_each_other() {
    let mut found = Vec::new();
    for orthographic in [false, true] {
        let mut scene = shells();
        scene.camera = cameras::orbit(25.0, 30.0, orthographic);
        let bounds = scene.bounds();
        let plane = ClipSurface::parse("-1,0.2,0.1@55%,50%,50%", &bounds).expect("a section");
        let rough = cameras::relief(&scene, "-z=60%", "fractal:size=32,amplitude=6%");
        let ball = scene.cuts[0].volume.clone().expect("the ball");
        let (at, size) = centre(&scene.parts);
        let knot = shaped(
            "knot?segments=120&sides=10",
            size * 0.12,
            at + DVec3::Z * 0.3 * size,
        );

        scene.cuts[0].surfaces = vec![plane.clone()];
        found.extend(faults("ball and plane", &scene));
        scene.cuts[0].surfaces = vec![rough.clone()];
        found.extend(faults("ball and relief", &scene));
        scene.cuts[0].surfaces = vec![rough.clone(), plane.clone()];
        found.extend(faults("ball, relief and plane", &scene));
        scene.cuts = vec![
            Cut::by(ball.clone()),
            Cut::new("rough", vec![rough.clone()]),
        ];
        found.extend(faults("ball or relief", &scene));
        scene.cuts = vec![Cut::by(ball.clone()), Cut::by(knot.clone())];
        found.extend(faults("ball or knot", &scene));
        scene.cuts = vec![
            Cut::by(ball.flipped()),
            Cut::by(knot),
            Cut::new("plane", vec![plane]),
        ];
        found.extend(faults("outside of ball, or knot, or plane", &scene));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_box_cuts_as_exactly_as_its_planes_however_it_is_turned() {
    let mut found = Vec::new();
    for turn in 0..4 {
        let turn = f64::from(turn);
        let by = DQuat::from_euler(glam::EulerRot::XYZ, 0.3 * turn, 0.2 * turn, 0.5 * turn);
        let mesh = moved(
            &shape("cube?divisions=3"),
            DAffine3::from_rotation_translation(by, DVec3::splat(0.31)),
        );
        let mut scene = solid(
            "box",
            shape("torus?segments=40&sides=20"),
            vec![cutter(mesh)],
        );
        scene.camera = cameras::orbit(40.0, 30.0, turn > 1.5);
        found.extend(faults(&format!("turn {turn}"), &scene));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A cube with a face in the plane of a cutter's, which is divided otherwise.
fn shared_face(min: DVec3, max: DVec3) -> Scene {
    let divided = shape("cube?divisions=7");
    let place = DAffine3::from_translation((min + max) * 0.5) * DAffine3::from_scale(max - min);
    let cube = block(DVec3::splat(-0.5), DVec3::splat(0.5));
    solid("shared face", cube, vec![cutter(moved(&divided, place))])
}

#[test]
fn a_shared_face_leaves_nothing_without_thickness() {
    let mut found = Vec::new();
    for (min, max) in [
        (DVec3::splat(-0.5), DVec3::splat(0.5)),
        (DVec3::new(-0.25, -0.25, 0.5), DVec3::new(0.25, 0.25, 0.75)),
        (DVec3::new(-0.3, -0.2, 0.1), DVec3::new(0.25, 0.25, 0.5)),
    ] {
        for orthographic in [false, true] {
            let mut scene = shared_face(min, max);
            scene.camera = cameras::orbit(30.0, 40.0, orthographic);
            let question = Question::new(&scene, SIZE);
            let is_pocket = (-0.4..0.5).contains(&min.z);
            let caps = question.exact.layers.count(Kind::Cap);
            assert_eq!(caps > 0, is_pocket, "{caps} pixels of caps: {min}");
            for of in EXACT {
                let judged = question.answer(strategy(of));
                found.extend(judged.fault_of_exact().map(|f| format!("{of}, {min}: {f}")));
            }
            for of in BY_COMPUTE {
                let judged = judged_by_compute(&question, of);
                found.extend(
                    judged
                        .fault_of_exact()
                        .map(|f| format!("{of} by compute, {min}: {f}")),
                );
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn the_eye_may_be_in_the_cutter_and_the_near_plane_cut_it() {
    let void = shaped("sphere?subdivisions=4", 0.35, DVec3::new(0.05, 0.0, 0.02));
    let mut scene = solid(
        "void",
        block(DVec3::splat(-0.5), DVec3::splat(0.5)),
        vec![void],
    );
    let mut found = Vec::new();
    for (from, to, near) in [
        (DVec3::ZERO, DVec3::X, 0.01),
        (DVec3::new(0.1, 0.1, 0.1), DVec3::new(-1.0, 0.3, 0.2), 0.2),
        (DVec3::new(1.4, 0.3, 0.2), DVec3::ZERO, 1.2),
        (DVec3::new(1.4, 0.3, 0.2), DVec3::ZERO, 1.45),
    ] {
        let mut camera: Camera = cameras::looking(from, to, 70.0);
        camera.near = Some(near);
        scene.camera = camera;
        let question = Question::new(&scene, SIZE);
        assert!(
            question.exact.layers.count(Kind::Cap) > 200,
            "walls of the void"
        );
        for of in EXACT {
            let judged = question.answer(strategy(of));
            found.extend(
                judged
                    .fault_of_exact()
                    .map(|f| format!("{of} from {from}: {f}")),
            );
        }
        for of in BY_COMPUTE {
            let judged = judged_by_compute(&question, of);
            found.extend(
                judged
                    .fault_of_exact()
                    .map(|f| format!("{of} by compute, {from}: {f}")),
            );
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_cutter_may_reach_far_beyond_the_parts() {
    let mut found = Vec::new();
    for orthographic in [false, true] {
        // All of it but a little is before the near plane, beyond the far plane and beside the picture.
        let wedge = block(DVec3::new(0.1, 0.05, -40.0), DVec3::new(30.0, 20.0, 50.0));
        let turn = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 0.5).normalize(), 0.2);
        let mesh = moved(&wedge, turn);
        let mut scene = solid("far", shape("sphere?subdivisions=4"), vec![cutter(mesh)]);
        scene.camera = cameras::orbit(50.0, 35.0, orthographic);
        found.extend(faults(&format!("parallel {orthographic}"), &scene));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

fn layers_of(question: &Question, name: &str) -> Layers {
    let judged = question.answer(strategy(name));
    assert_eq!(judged.outcome, Outcome::Complete, "{name}");
    judged.layers
}

#[test]
fn inside_tests_agree_to_the_bit() {
    let question = Question::new(&shells(), SIZE);
    let [first, rest @ ..] = EXACT.map(|name| layers_of(&question, name));
    for (layers, name) in rest.iter().zip(&EXACT[1..]) {
        assert_eq!(*layers, first, "{name}");
    }
}

#[test]
fn tessellated_reliefs_go_with_cutters() {
    let mut scene = shells();
    let alone = Question::new(&scene, SIZE);
    let raycast = layers_of(&alone, "raycast+mask");
    let rough = cameras::relief(&scene, "-z=60%", "fractal:size=32,amplitude=6%");
    scene.cuts.push(Cut::new("rough", vec![rough]));
    let both = Question::new(&scene, SIZE);
    for name in ["adaptive:0.5+mask", "grid:64+mask", "adaptive:0.5+abuffer"] {
        assert_eq!(layers_of(&alone, name), raycast, "{name}: the cutter alone");
        let judged = both.answer(strategy(name));
        let c = &judged.comparison;
        assert_eq!([c.odd_parity_px, c.crack_px], [0, 0], "{name}");
        let (wrong, boundary) = (c.decided_wrong_px, both.boundary_px());
        println!("{name}: {wrong} wrong of {boundary}");
        assert!(wrong * 10 < boundary, "{name}: {wrong} of {boundary}");
    }
    // The control: the relief is there.
    let without = Question {
        exact: both.exact.clone(),
        ..Question::new(&shells(), SIZE)
    };
    let judged = without.answer(strategy("adaptive:0.5+mask"));
    let wrong = judged.comparison.decided_wrong_px;
    assert!(wrong > both.boundary_px(), "{wrong} without the relief");
}

#[test]
fn the_other_half_of_a_flipped_cutter_is_caught() {
    // The control of all of the above: another cutter than the reference was asked about.
    let mut scene = shells();
    let question = Question::new(&scene, SIZE);
    let ball = scene.cuts[0].volume.clone().expect("the ball");
    for (other, what) in [
        (ball.clone().flipped(), "flipped"),
        (
            ball.placed(DAffine3::from_translation(DVec3::X * 0.02)),
            "moved",
        ),
    ] {
        scene.cuts[0].volume = Some(other);
        let asked = Question {
            exact: question.exact.clone(),
            ..Question::new(&scene, SIZE)
        };
        let judged = asked.answer(strategy("raycast+mask"));
        assert!(judged.comparison.decided_wrong_px > 50, "{what}");
    }
    // And normals turned to the other side.
    let mut layers = question.answer(strategy("raycast+mask")).layers;
    let (as_they_are, few) = (turned_px(&question, &layers), 20.0 * coarseness());
    assert!((as_they_are as f64) < few, "normals as they are");
    (layers.pixels.iter_mut()).for_each(|p| p.normal = -p.normal);
    let turned = turned_px(&question, &layers);
    assert!(turned > as_they_are + 50, "normals turned round");
}
