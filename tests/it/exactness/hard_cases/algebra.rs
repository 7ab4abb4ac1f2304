//! Cases 37, 38 and 41: laws between pictures.

use cutaway::Model;
use cutaway::gpu::{ClockSet, Gpu, Program};
use cutaway::layers::Kind;
use cutaway::plan::Capacities;
use cutaway::strategies::{Strategy, record};
use cutaway_lab::exact::evaluate;

use crate::common::numbers::Numbers;
use crate::common::{Question, class_of, gpu, scenes, session, strategy, tolerances};

#[test]
fn case_37_opposite_signs_are_complementary() {
    // Seen from both sides, what one surface keeps the flipped one removes: rays that meet the cap of both meet it at one
    // depth, and no ray that meets the solid misses both.
    let pair = scenes::of_case("37-opposite-signs", 256);
    let mut answers = Vec::new();
    for scene in &pair {
        let judged = Question::new(scene, [256; 2]).answer(Strategy::RAYCAST_MASK);
        assert_eq!(judged.fault_of_exact(), None, "{}", scene.name);
        answers.push(judged);
    }
    let mut whole = pair[0].clone();
    whole.cuts.clear();
    let whole = Question::new(&whole, [256; 2]).answer(Strategy::RAYCAST_MASK);
    let mut same_cap = 0;
    for i in 0..whole.layers.pixels.len() {
        if answers.iter().chain([&whole]).any(|a| a.exact.undecided[i]) {
            continue;
        }
        let [a, b] = [0, 1].map(|k| &answers[k].layers.pixels[i]);
        let union = a.depth.min(b.depth);
        let solid = whole.layers.pixels[i].depth;
        assert!(
            union == solid || (union - solid).abs() < tolerances::SAME_DEPTH,
            "pixel {i}: {union} is not {solid}"
        );
        same_cap += usize::from(a.kind == Kind::Cap || b.kind == Kind::Cap);
    }
    assert!(same_cap > 3000, "only {same_cap} pixels show a cap");
}

#[test]
fn case_38_and_or_differ_and_have_both_caps() {
    for scene in scenes::of_case("38-crossing-surfaces", 256) {
        let judged = Question::new(&scene, [256; 2]).answer(Strategy::RAYCAST_MASK);
        assert_eq!(judged.fault_of_exact(), None, "{}", scene.name);
        for surface in [0, 1] {
            let caps = judged.layers.pixels.iter();
            let count = caps
                .filter(|p| p.kind == Kind::Cap && p.clip_surface == surface)
                .count();
            assert!(
                count > 500,
                "{}: surface {surface} has {count} cap pixels",
                scene.name
            );
        }
    }
}

/// The mask and the layers, word for word.
fn words(program: &Program, gpu: &Gpu, names: &[&str]) -> Vec<Vec<u32>> {
    names
        .iter()
        .map(|n| program.words(gpu, n).expect("a buffer of the plan"))
        .collect()
}

#[test]
fn case_41_fifty_repeats_are_bit_identical() {
    let scene = &scenes::of_case("38-crossing-surfaces", 128)[0];
    let model = Model::new(scene);
    let view = model.prepared.view([128; 2]);
    let gpu = gpu();
    for (name, names) in [
        ("raycast+mask", &["mask", "layers"][..]),
        ("raycast+abuffer", &["mask", "layers"]),
        ("raycast+kbuffer:8", &["nearest fragments", "layers"]),
        ("raycast+ldi:128", &["mask", "layers"]),
        ("grid:32+vds:128", &["layers"]),
    ] {
        let capacities = Capacities {
            crossings: Some(15),
            layers: vec![2],
            fragments: Some(100_000),
            ..Capacities::UNKNOWN
        };
        let plan = record(&model, &view, strategy(name), &capacities).expect("a plan");
        let mut program = Program::default();
        program.load(&gpu, plan).expect("a plan that loads");
        program.run(&gpu, ClockSet::ALL).expect("a frame");
        let first = words(&program, &gpu, names);
        assert!(
            first.iter().all(|w| w.iter().any(|x| *x != 0)),
            "{name} wrote nothing"
        );
        for repeat in 1..50 {
            program.run(&gpu, ClockSet::ALL).expect("a frame");
            assert!(
                words(&program, &gpu, names) == first,
                "{name}: repeat {repeat} differs"
            );
        }
    }
}

#[test]
fn case_41_the_order_of_triangles_changes_nothing() {
    let scene = scenes::torus_cut();
    let draw = |scene: &cutaway::scene::Scene| {
        let question = Question::new(scene, [128; 2]);
        let mut session = session();
        let layers = (question.answer_in(&mut session, Strategy::RAYCAST_MASK)).layers;
        let picture = session.picture(Strategy::RAYCAST_MASK);
        (layers, picture.expect("a picture"))
    };
    let (layers, picture) = draw(&scene);
    for seed in 0..4 {
        let mut shuffled = scene.clone();
        let mut mesh = scene.parts[0].mesh.as_ref().clone();
        let mut numbers = Numbers(seed);
        for i in (1..mesh.triangles.len()).rev() {
            mesh.triangles.swap(i, numbers.below(i as u64 + 1) as usize);
        }
        shuffled.parts[0].mesh = mesh.into();
        let (other, other_picture) = draw(&shuffled);
        let differing = layers
            .pixels
            .iter()
            .zip(&other.pixels)
            .filter(|(a, b)| class_of(a) != class_of(b) || a.depth.to_bits() != b.depth.to_bits())
            .count();
        assert_eq!(differing, 0, "order {seed}");
        assert!(layers == other, "normals of order {seed}");
        assert!(picture == other_picture, "picture of order {seed}");
    }
    let flipped = scenes::sectioned("torus?segments=40&sides=20", &["0.3,1,0.2@50%,50%,50%"]);
    assert!(
        draw(&flipped).0 != layers,
        "another scene gives other layers"
    );
}

#[test]
fn case_41_one_thread_and_two_find_the_same() {
    for scene in scenes::of_case("38-crossing-surfaces", 128) {
        let model = Model::new(&scene);
        let view = model.prepared.view([128; 2]);
        let [one, two] = [1, 2].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("a pool of threads")
                .install(|| evaluate(&model.prepared, &view))
        });
        assert!(one.layers == two.layers, "{}: layers", scene.name);
        assert!(
            one.undecided == two.undecided,
            "{}: undecided pixels",
            scene.name
        );
    }
}
