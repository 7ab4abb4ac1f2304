//! Case 44, the stencil against the mask, bit for bit; and the classic stencil from either side, in either projection.

use cutaway::gpu::{ClockSet, Program};
use cutaway::layers::Kind;
use cutaway::plan::StencilStep;
use cutaway::plan::{Capacities, DepthCompare, Plan, Work};
use cutaway::scene::{ClipSurface, Cut, Fill, Part, Scene};
use cutaway::session::Outcome;
use cutaway::strategies::{self, Strategy};
use cutaway_lab::compare::compare;
use glam::{DAffine3, DVec3};

use crate::common::{Question, hardware_precision, meshes, scenes, session};

fn masks(question: &Question) -> [Vec<u32>; 2] {
    let mut session = session();
    [Strategy::RAYCAST_MASK, Strategy::RAYCAST_STENCIL].map(|strategy| {
        let drawn = (session.draw(&question.model, &question.view, strategy)).expect("a frame");
        assert_eq!(drawn.outcome, Outcome::Complete, "{strategy}");
        session.words(strategy, "mask").expect("its mask")
    })
}

/// Lists of one crossing and of many, one part and several, the eye outside and inside.
fn asked(size: u32) -> Vec<Scene> {
    let mut all = vec![scenes::torus_cut()];
    for file in [
        "10-eye-inside",
        "12-near-plane",
        "19-doubled",
        "20-open",
        "28-steps",
        "38-crossing-surfaces",
    ] {
        all.extend(scenes::of_case(file, size));
    }
    // One of these sections cuts nothing, and leaves no mask.
    let aligned = scenes::of_case("04-rays-through-vertices", size);
    all.extend(aligned.into_iter().filter(|s| !s.name.contains("z=-10")));
    for shape in ["earth?subdivisions=3", "gears?flank=2"] {
        let mut scene = scenes::sectioned(shape, &["-1,0.2,0.1@45%,50%,50%"]);
        let rough = scenes::relief(&scene, "-z=45%", "fractal:size=64,seed=3,amplitude=6%");
        scene.cuts.push(Cut::new("rough", vec![rough]));
        all.push(scene);
    }
    all
}

#[test]
fn case_44_the_stencil_leaves_the_mask_bit_for_bit() {
    let mut set = 0;
    for scene in asked(128) {
        let [mask, stencil] = masks(&Question::new(&scene, [128; 2]));
        assert_eq!(mask.len(), stencil.len(), "{}", scene.name);
        let differing = mask.iter().zip(&stencil).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "{}: words of {}", scene.name, mask.len());
        set += mask.iter().filter(|w| **w != 0).count();
    }
    assert!(set > 100_000, "only {set} words hold anything");
}

#[test]
fn case_44_nonzero_leaves_whether_the_count_is_0() {
    for scene in scenes::of_case("16-hollow-nonzero", 128) {
        let question = Question::new(&scene, [128; 2]);
        let [mask, stencil] = masks(&question);
        let (totals, counts) = mask.split_at(128 * 128);
        for ((total, count), bits) in totals.iter().zip(counts).zip(&stencil) {
            let [inside, odd] = [count & 0xff != 0, total & 0xffff != 0].map(u32::from);
            assert_eq!(*bits, inside | odd << 1, "{}", scene.name);
        }
        let judged = question.answer(Strategy::RAYCAST_STENCIL);
        assert_eq!(judged.fault_of_exact(), None, "{}", scene.name);
    }
}

fn plan_of(question: &Question, strategy: &Strategy) -> Plan {
    let (model, view) = (&question.model, &question.view);
    strategies::plan(model, view, strategy, &Capacities::UNKNOWN).expect("a plan")
}

/// Decided wrong pixels of a plan.
fn wrong(question: &Question, plan: Plan) -> usize {
    let session = session();
    let mut program = Program::default();
    program
        .load(session.gpu(), plan)
        .expect("a plan that loads");
    program.run(session.gpu(), ClockSet::ALL).expect("a frame");
    let layers = (program.layers(session.gpu(), question.view.size_px)).expect("layers");
    let exact = question.exact.at(hardware_precision());
    let scale = question.model.prepared.scale;
    compare(&exact, &layers, &question.view, scale).decided_wrong_px
}

#[test]
fn a_stencil_that_is_wrong_in_one_step_is_found_out() {
    let mut scene = scenes::sectioned("earth?subdivisions=3", &["-z=50%"]);
    scene.parts.push({
        let mut ball = Part::new("ball", meshes::shape("sphere?subdivisions=3"));
        ball.fill = Fill::Nonzero;
        ball.world_from_part = DAffine3::from_translation(scene.bounds().size() * 0.4);
        ball
    });
    let question = Question::new(&scene, [96; 2]);
    type Fault = fn(&mut cutaway::plan::DepthTarget);
    let faults: [(&str, Strategy, &str, Fault); 5] = [
        (
            "both sides of the crossing count",
            Strategy::RAYCAST_STENCIL,
            "mark",
            |d| {
                d.compare = DepthCompare::Always;
            },
        ),
        (
            "the bit of another",
            Strategy::RAYCAST_STENCIL,
            "mark 0 crossing",
            |d| {
                if let Some(s) = &mut d.stencil {
                    s.step = StencilStep::Flip { bits: 2 };
                }
            },
        ),
        (
            "what a batch before has left",
            Strategy::RAYCAST_STENCIL,
            "mark",
            |d| {
                if let Some(s) = &mut d.stencil {
                    s.clear = true;
                }
            },
        ),
        (
            "hidden fragments do not count",
            Strategy::STENCIL,
            "solid",
            |d| {
                if let Some(s) = &mut d.stencil {
                    s.step = StencilStep::Wind;
                }
            },
        ),
        (
            "the cap is not cut to the section",
            Strategy::STENCIL,
            "cap",
            |d| d.stencil = None,
        ),
    ];
    for strategy in [Strategy::RAYCAST_STENCIL, Strategy::STENCIL] {
        assert_eq!(
            wrong(&question, plan_of(&question, &strategy)),
            0,
            "{strategy}"
        );
    }
    for (what, strategy, name, fault) in faults {
        let mut plan = plan_of(&question, &strategy);
        let mut planted = 0;
        for pass in plan.passes.iter_mut().filter(|p| p.name.starts_with(name)) {
            if let Work::Draw { depth, .. } = &mut pass.work {
                fault(depth);
                planted += 1;
            }
        }
        assert!(planted > 0, "{what}: no pass `{name}`");
        let wrong = wrong(&question, plan);
        assert!(wrong > 20, "{strategy}, {what}: {wrong} wrong go unnoticed");
    }
}

#[test]
fn the_classic_is_exact_from_either_side_in_either_projection() {
    let mut caps = 0;
    for shape in [
        "torus?segments=40&sides=20",
        "earth?subdivisions=3",
        "gears?flank=2",
    ] {
        for orthographic in [false, true] {
            for (azimuth, elevation) in [(35.0, 25.0), (-140.0, -40.0), (90.0, 5.0)] {
                for section in ["-0.3,-1,-0.2@50%,50%,50%", "-z=50%", "z=50%"] {
                    let mut scene = scenes::sectioned(shape, &[section]);
                    scene.camera = scenes::orbit(azimuth, elevation, orthographic);
                    let question = Question::new(&scene, [96, 72]);
                    let judged = question.answer(Strategy::STENCIL);
                    let what = format!("{shape}, {section} from {azimuth}, {elevation}");
                    assert_eq!(judged.fault_of_exact(), None, "{what}");
                    caps += judged.layers.count(Kind::Cap);
                }
            }
        }
    }
    assert!(caps > 10_000, "only {caps} cap pixels");
}

#[test]
fn the_classic_keeps_parts_and_rules_apart() {
    // A ball wound twice among others that overlap it: nonzero and even-odd side by side in one stencil.
    let ball = meshes::shape("sphere?subdivisions=3");
    let mut twice = ball.clone();
    twice.triangles.extend(ball.triangles.clone());
    let part = |name: &str, mesh: &cutaway::scene::Mesh, x: f64, fill: Fill| {
        let mut part = Part::new(name, mesh.clone());
        part.world_from_part = DAffine3::from_translation(DVec3::X * x);
        part.fill = fill;
        part
    };
    let parts = vec![
        part("wound", &twice, -0.3, Fill::Nonzero),
        part("void", &twice, 0.3, Fill::EvenOdd),
        part("plain", &ball, 0.8, Fill::EvenOdd),
        part("turned", &meshes::turned(&ball), 1.2, Fill::Nonzero),
    ];
    let mut scene = scenes::of_parts("balls", parts, Vec::new());
    let plane = ClipSurface::parse("-0.1,-0.3,-1@50%,50%,50%", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    let question = Question::new(&scene, [192, 128]);
    for strategy in [
        Strategy::RAYCAST_MASK,
        Strategy::RAYCAST_STENCIL,
        Strategy::STENCIL,
    ] {
        let judged = question.answer(strategy);
        assert_eq!(judged.fault_of_exact(), None, "{strategy}");
        for (part, capped) in [(0, true), (1, false), (2, true), (3, true)] {
            let caps = judged.layers.pixels.iter();
            let count = caps
                .filter(|p| p.kind == Kind::Cap && p.part == part)
                .count();
            assert_eq!(
                count > 50,
                capped,
                "{strategy}: {count} cap pixels of {part}"
            );
        }
    }
}
