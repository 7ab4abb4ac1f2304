//! What is sliced, and when: a new plane, a part that moved or another mesh; never for a camera.

use cutaway::Model;
use cutaway::gpu::ClockSet;
use cutaway::plan::Clock;
use cutaway::scene::{ClipSurface, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use glam::{DAffine3, DVec3};

use super::common::{Question, gpu, meshes, scenes};

fn scene() -> Scene {
    let plane = ClipSurface::plane(DVec3::Z * 0.02, DVec3::new(0.1, 0.15, -1.0));
    let torus = "torus?segments=40&sides=20";
    let mut parts = meshes::parts(torus);
    parts.extend(meshes::parts("cube"));
    parts[1].world_from_part = DAffine3::from_translation(DVec3::X * 1.5);
    let mut scene = scenes::of_parts("clocks", parts, vec![plane]);
    scene.stage = Some(cutaway::scene::Bounds {
        min: DVec3::splat(-2.5),
        max: DVec3::splat(2.5),
    });
    scene
}

/// The clocks on which something changed, and whether anything was sliced.
fn drawn(session: &mut Session, model: &Model, size: [u32; 2]) -> (ClockSet, bool) {
    let view = model.prepared.view(size);
    let drawn = session.draw(model, &view, Strategy::PLANAR);
    let drawn = drawn.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(drawn.outcome, Outcome::Complete, "a frame");
    let sliced = drawn.ran_on(Clock::Cut).contains(&"slice");
    assert_eq!(
        drawn.times.clock_ms(Clock::Cut) > 0.0,
        sliced,
        "slicing is the only work on the clock of the cut"
    );
    (drawn.clocks, sliced)
}

#[test]
fn only_what_is_new_is_sliced() {
    let mut session = Session::new(gpu()).timed();
    let mut scene = scene();
    let mut model = Model::new(&scene);
    let size = [64, 48];
    let (clocks, sliced) = drawn(&mut session, &model, size);
    assert!(clocks.contains(Clock::Solid) && sliced, "the first frame");
    let mut step = |what: &str, scene: &Scene, size: [u32; 2], expected: (ClockSet, bool)| {
        model = model.updated(scene);
        assert_eq!(drawn(&mut session, &model, size), expected, "{what}");
    };
    let still = (ClockSet::FRAME, false);
    let cut = (ClockSet::FRAME.with(Clock::Cut), true);
    step("nothing changed", &scene, size, still);
    scene.camera = scenes::orbit(70.0, -20.0, true);
    step("the camera moved", &scene, size, still);
    scene.cuts[0].surfaces[0].origin.z += 0.11;
    step("the plane moved", &scene, size, cut);
    step("and stood still", &scene, size, still);
    scene.cuts[0].surfaces[0].origin.z -= 0.11;
    let (clocks, sliced) = {
        model = model.updated(&scene);
        drawn(&mut session, &model, size)
    };
    assert!(
        clocks.contains(Clock::Cut) && !sliced,
        "it moved back: what was sliced is known"
    );
    // The control: another mesh is sliced, and uploaded.
    scene.parts[0].mesh = std::sync::Arc::new(meshes::shape("sphere?subdivisions=2"));
    model = model.updated(&scene);
    let (clocks, sliced) = drawn(&mut session, &model, size);
    assert!(clocks.contains(Clock::Solid) && sliced, "another mesh");
}

#[test]
fn rounds_that_are_repeated_time_slicers_as_well() {
    let mut session = Session::new(gpu()).timed();
    let mut scene = scene();
    let model = Model::new(&scene);
    let ran = |times: &cutaway::gpu::RunTimes| -> Vec<(String, Clock)> {
        let of_cpu = (times.passes.iter()).filter(|p| p.name.starts_with("slice"));
        of_cpu.map(|p| (p.name.clone(), p.clock)).collect()
    };
    let both = [("slicers", Clock::Solid), ("slice", Clock::Cut)].map(|(n, c)| (n.to_owned(), c));
    let mut frame = |model: &Model| {
        let view = model.prepared.view([64, 48]);
        let drawn = session.draw(model, &view, Strategy::PLANAR);
        drawn.unwrap_or_else(|e| panic!("{e}")).times
    };
    assert_eq!(ran(&frame(&model)), both, "the first frame");
    assert_eq!(ran(&frame(&model)), [], "all is known");
    scene.cuts[0].surfaces[0].origin.z += 0.11;
    assert_eq!(
        ran(&frame(&model.updated(&scene))),
        both[1..],
        "a plane that moves finds its slicers"
    );
    let all = ClockSet::FRAME.with(Clock::Solid).with(Clock::Cut);
    let again = session.repeat(Strategy::PLANAR, all).expect("times");
    assert_eq!(ran(&again), both, "another round");
    assert!(
        again.clock_ms(Clock::Solid) > 0.0,
        "slicers take their time"
    );
}

#[test]
fn what_moves_is_sliced_where_it_stands() {
    let mut scene = scene();
    let mut model = Model::new(&scene);
    for (turn, rasteriser) in [
        (0.0, Rasteriser::Hardware),
        (0.4, Rasteriser::Hardware),
        (0.9, Rasteriser::Compute),
        (0.9, Rasteriser::Hardware),
    ] {
        scene.parts[1].world_from_part = DAffine3::from_translation(DVec3::X * 1.5)
            * DAffine3::from_rotation_y(turn)
            * DAffine3::from_rotation_x(0.5 * turn);
        model = model.updated(&scene);
        let question = Question::of_model(model.clone(), &scene, [160, 120]);
        let judged = question.answer(Method::new(Strategy::PLANAR, DrawOptions::by(rasteriser)));
        let caps = judged.layers.pixels.iter();
        let of_cube = caps.filter(|p| p.part == 1 && p.clip_surface == 0).count();
        assert_eq!(judged.fault_of_exact(), None, "turned by {turn}");
        assert!(of_cube > 200, "turned by {turn}");
    }
    // It stood still in the last two: nothing is sliced anew for a program that is.
    let mut fresh = Session::new(gpu()).timed();
    let (_, sliced) = drawn(&mut fresh, &model, [160, 120]);
    assert!(!sliced, "known from before");
    let mut again = model.updated(&scene);
    let (_, sliced) = drawn(&mut fresh, &again, [160, 120]);
    assert!(!sliced, "it stands still");
    scene.parts[1].world_from_part.translation.y += 0.1;
    again = again.updated(&scene);
    let (_, sliced) = drawn(&mut fresh, &again, [160, 120]);
    assert!(sliced, "it moved");
}

#[test]
fn a_mirrored_part_and_a_new_rule_are_sliced_right() {
    let mut scene = scene();
    scene.parts[0].world_from_part = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    for fill in [cutaway::scene::Fill::EvenOdd, cutaway::scene::Fill::Nonzero] {
        for part in &mut scene.parts {
            part.fill = fill;
        }
        let judged = Question::new(&scene, [160, 120]).answer(Strategy::PLANAR);
        assert_eq!(judged.fault_of_exact(), None, "{fill}");
    }
    // Two balls that overlap in one mesh: the rule alone changes between two frames of one model.
    let ball = meshes::shape("sphere?subdivisions=3");
    let mesh = meshes::joined(&[
        ball.clone(),
        meshes::moved(&ball, DAffine3::from_translation(DVec3::X * 0.6)),
    ]);
    let plane = ClipSurface::plane(DVec3::Z * 0.02, DVec3::new(0.1, 0.15, -1.0));
    let mut scene = scenes::scene("balls", mesh, vec![plane]);
    let first = Model::new(&scene);
    let caps = |model: Model, scene: &Scene| {
        let judged = Question::of_model(model, scene, [160, 120]).answer(Strategy::PLANAR);
        assert_eq!(judged.fault_of_exact(), None, "{}", scene.parts[0].fill);
        judged.layers.count(cutaway::layers::Kind::Cap)
    };
    let even_odd = caps(first.clone(), &scene);
    scene.parts[0].fill = cutaway::scene::Fill::Nonzero;
    let nonzero = caps(first.updated(&scene), &scene);
    assert!(nonzero > even_odd + 100, "{nonzero} against {even_odd}");
}
