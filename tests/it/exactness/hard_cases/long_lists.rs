//! Case 27: white noise seen along its plane, which a ray crosses more often than a lane of one word can tell.

use cutaway::gpu::{ClockSet, Program};
use cutaway::layers::{Kind, Layers};
use cutaway::passes::NEED_OF_CROSSINGS;
use cutaway::plan::{Capacities, Plan};
use cutaway::scene::{Fill, Mesh, Scene, Wrap};
use cutaway::session::Outcome;
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser, Strategy};
use glam::DVec3;

use crate::common::numbers::Numbers;
use crate::common::{Judged, Question, coarseness, is_wrong, meshes, scenes, session, strategy};

const SIZE: [u32; 2] = [128; 2];

/// White noise seen along its plane: `cells` texels side by side across the solid.
fn noisy(cells: u32, height: f64, solid: Mesh) -> Scene {
    let mut numbers = Numbers(27);
    let texels: Vec<f32> = (0..cells * cells)
        .map(|_| (numbers.unit() - 0.5) as f32)
        .collect();
    let map = scenes::map([cells; 2], |x, y| texels[(y * cells + x) as usize]);
    let surface = scenes::mapped(DVec3::ZERO, -DVec3::Y, map, (1.0, height), Wrap::Repeat);
    let mut scene = scenes::scene("noise", solid, vec![surface]);
    scene.camera = scenes::looking(DVec3::new(0.0, 0.08, 2.0), DVec3::ZERO, 30.0);
    scene
}

/// A wall behind much air, and a post before it: a ray has crossed the noise often when it comes to a cap.
fn far_wall() -> Mesh {
    let wall = meshes::block(DVec3::new(-0.5, -0.3, -0.5), DVec3::new(0.5, 0.3, -0.3));
    let post = meshes::block(DVec3::new(0.45, -0.3, 0.45), DVec3::new(0.5, 0.3, 0.5));
    meshes::joined(&[wall, post])
}

/// The answer of a strategy by a rasteriser, its mask, and how many crossings a pixel had room for.
fn answer(
    question: &Question,
    strategy: &Strategy,
    rasteriser: Rasteriser,
) -> (Judged, Vec<u32>, u32) {
    let mut session = session();
    // With all crossings in the lists, so that masks are the same word by word.
    let list = Some(true);
    let options = DrawOptions::by(rasteriser);
    let method = Method::new(*strategy, DrawOptions { list, ..options });
    let drawn = (session.draw(&question.model, &question.view, method))
        .unwrap_or_else(|e| panic!("{strategy}: {e}"));
    let mask = session.words(method, "mask").expect("a mask");
    let capacity = session.plan(method).expect("a plan").bounded[0].capacity;
    let judged = question.judge(&session, method, drawn.outcome);
    (judged, mask, capacity)
}

/// Runs a plan: its layers, and the longest list that it asked for beyond its capacity.
fn run(plan: Plan) -> (Layers, u32) {
    let session = session();
    let gpu = session.gpu();
    let mut program = Program::default();
    program.load(gpu, plan).unwrap_or_else(|e| panic!("{e}"));
    (program.run(gpu, ClockSet::ALL)).unwrap_or_else(|e| panic!("{e}"));
    let need = program.words(gpu, "need").unwrap_or_else(|e| panic!("{e}"));
    let layers = program.layers(gpu, SIZE).unwrap_or_else(|e| panic!("{e}"));
    (layers, need[NEED_OF_CROSSINGS as usize])
}

fn plan_for(question: &Question, crossings: u32) -> Plan {
    let capacities = Capacities {
        crossings: Some(crossings),
        ..Capacities::UNKNOWN
    };
    let strategy = Strategy::RAYCAST_MASK;
    strategies::plan(&question.model, &question.view, strategy, &capacities)
        .unwrap_or_else(|e| panic!("{e}"))
}

/// Decided pixels that are wrong: marked, and unmarked.
fn wrong(question: &Question, layers: &Layers) -> [usize; 2] {
    let mut wrong = [0; 2];
    for (i, found) in layers.pixels.iter().enumerate() {
        let is_decided = !question.exact.undecided[i];
        if is_decided && is_wrong(&question.exact.layers.pixels[i], found) {
            wrong[usize::from(!found.unreliable)] += 1;
        }
    }
    wrong
}

#[test]
fn case_27_up_to_31_crossings_the_list_grows() {
    let question = Question::new(
        &noisy(
            24,
            0.4,
            meshes::block(DVec3::new(-0.5, -0.3, -0.5), DVec3::new(0.5, 0.3, 0.5)),
        ),
        SIZE,
    );
    let (judged, _, capacity) = answer(&question, &Strategy::RAYCAST_MASK, Rasteriser::Hardware);
    assert_eq!(judged.fault_of_exact(), None, "noise of 24 texels");
    assert!(
        (8..=31).contains(&capacity),
        "the list holds {capacity}: it did not have to grow"
    );
}

#[test]
fn case_27_beyond_31_crossings_lanes_are_several_words() {
    let question = Question::new(&noisy(256, 0.5, far_wall()), SIZE);
    let (judged, written, longest) =
        answer(&question, &Strategy::RAYCAST_MASK, Rasteriser::Hardware);
    assert_eq!(judged.fault_of_exact(), None, "noise of 256 texels");
    assert!(judged.layers.count(Kind::Cap) > 1000, "caps are seen");
    assert!(longest > 64, "{longest} crossings are no three words");
    for (name, rasteriser) in [
        ("raycast+mask", Rasteriser::Compute),
        ("raycast+abuffer", Rasteriser::Hardware),
        ("raycast+abuffer", Rasteriser::Compute),
        ("raycast+kbuffer:16", Rasteriser::Hardware),
        ("raycast+stencil", Rasteriser::Hardware),
    ] {
        let (judged, mask, _) = answer(&question, &strategy(name), rasteriser);
        assert_eq!(judged.fault_of_exact(), None, "{name} by {rasteriser}");
        // Rasterisers that move vertices alike count alike to the bit.
        if coarseness() <= 1.0 || rasteriser == Rasteriser::Hardware {
            let differ = written.iter().zip(&mask).filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "words of the mask, {name} by {rasteriser}");
        }
    }
    // An image of the volume errs at its rims alone, however long the list.
    let (judged, ..) = answer(
        &question,
        &strategy("raycast+ldi:1024"),
        Rasteriser::Hardware,
    );
    assert_eq!(judged.outcome, Outcome::Complete);
    let decided = judged.comparison.decided_wrong_px;
    assert!(
        decided * 50 < judged.layers.count(Kind::Cap),
        "ldi: {decided} wrong"
    );
}

#[test]
fn case_27_counts_have_a_byte_for_each_crossing() {
    let mut scene = noisy(256, 0.5, far_wall());
    scene.parts[0].fill = Fill::Nonzero;
    let question = Question::new(&scene, SIZE);
    for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
        let (judged, ..) = answer(&question, &Strategy::RAYCAST_MASK, rasteriser);
        assert_eq!(judged.fault_of_exact(), None, "nonzero by {rasteriser}");
    }
}

#[test]
fn case_27_what_finds_no_room_is_marked_and_told() {
    let question = Question::new(&noisy(256, 0.5, far_wall()), SIZE);
    let (layers, need) = run(plan_for(&question, 31));
    assert!(need > 64, "{need} is what the frame asks for");
    let marked = layers.pixels.iter().filter(|p| p.unreliable).count();
    let [_, unmarked] = wrong(&question, &layers);
    assert!(marked > 20, "only {marked} pixels are marked");
    assert_eq!(unmarked, 0, "wrong and not marked");
    let (layers, beyond) = run(plan_for(&question, need));
    assert_eq!(beyond, 0, "{need} are enough");
    assert_eq!(wrong(&question, &layers), [0, 0]);
    let marked = layers.pixels.iter().filter(|p| p.unreliable).count();
    assert_eq!(marked, 0, "pixels are marked though all found room");
}

#[test]
fn case_27_a_lane_too_short_is_noticed() {
    let question = Question::new(&noisy(256, 0.5, far_wall()), SIZE);
    let (_, need) = run(plan_for(&question, 31));
    // Who marks, or who decides, believes that a lane is one word.
    for pass in ["solid", "resolve"] {
        let mut plan = plan_for(&question, need);
        let of_pass = plan.passes.iter_mut().find(|p| p.name == pass);
        let constants = of_pass.map(|p| &mut p.constants);
        let bits = constants.and_then(|c| c.iter_mut().find(|c| c.0 == "lane_bits"));
        let bits = bits.unwrap_or_else(|| panic!("{pass} has no lane_bits"));
        assert!(bits.1 > 64.0, "{} bits", bits.1);
        bits.1 = 32.0;
        let (layers, _) = run(plan);
        let marked = layers.pixels.iter().filter(|p| p.unreliable).count();
        let [_, unmarked] = wrong(&question, &layers);
        assert!(
            marked + unmarked > 20,
            "`{pass}` with lanes too short: {marked} marked, {unmarked} wrong"
        );
    }
}

#[test]
fn a_picture_with_no_room_for_long_lists_holds_them_shorter() {
    let question = Question::new(
        &noisy(
            24,
            0.4,
            meshes::block(DVec3::new(-0.5, -0.3, -0.5), DVec3::new(0.5, 0.3, 0.5)),
        ),
        SIZE,
    );
    let capacity = |size: [u32; 2]| {
        let view = question.model.prepared.view(size);
        let capacities = Capacities {
            crossings: Some(Capacities::MOST_CROSSINGS),
            ..Capacities::UNKNOWN
        };
        let strategy = Strategy::RAYCAST_MASK;
        strategies::plan(&question.model, &view, strategy, &capacities)
            .unwrap_or_else(|e| panic!("{e}"))
            .bounded[0]
            .capacity
    };
    for (size, most) in [
        ([256, 256], 1023),
        ([1024, 768], 512),
        ([3840, 2160], 64),
        ([16_384, 16_384], 31),
    ] {
        assert_eq!(capacity(size), most, "{size:?}");
    }
}
