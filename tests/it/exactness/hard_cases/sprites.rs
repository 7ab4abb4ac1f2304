//! Cases 35 and 36: buffers that are too small, and the sprite's first order.

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Scene};
use cutaway::session::Outcome;
use cutaway::strategies::Strategy;
use glam::DVec3;

use crate::common::{Judged, Question, meshes, scenes, session, strategy, tolerances};

/// Sections whose misclassified shares are averaged: with one alone, its alignment with the texels would decide.
fn sections() -> Vec<Scene> {
    [[-0.3, -0.5, -1.0], [0.2, -0.9, -0.5], [-0.8, -0.3, -0.6]]
        .into_iter()
        .flat_map(|normal| {
            [0.0, 0.07].map(|shift| {
                let plane = ClipSurface::plane(DVec3::splat(shift), DVec3::from_array(normal));
                scenes::scene(
                    "torus",
                    meshes::shape("torus?segments=72&sides=36"),
                    vec![plane],
                )
            })
        })
        .collect()
}

#[test]
fn case_35_the_error_of_the_sprite_halves_as_its_resolution_doubles() {
    let questions: Vec<Question> = sections()
        .iter()
        .map(|s| Question::new(s, [1024; 2]))
        .collect();
    let resolutions = [256, 512, 1024, 2048];
    let shares = resolutions.map(|resolution| {
        let paper = strategy(&format!("grid:1+vds:{resolution}"));
        let (mut wrong, mut caps) = (0, 0);
        for question in &questions {
            let judged = question.answer(paper);
            wrong += judged.decided_wrong().count();
            caps += judged.exact.layers.count(Kind::Cap);
        }
        println!("vds:{resolution}: {wrong} wrong of {caps} cap pixels");
        wrong as f64 / caps as f64
    });
    if !tolerances::holds_lower_bounds() {
        return;
    }
    for (pair, resolution) in shares.windows(2).zip(&resolutions[1..]) {
        let halving = 2.0 * pair[1] / pair[0];
        assert!(
            (halving - 1.0).abs() <= tolerances::SPRITE_HALVING,
            "from half of {resolution} to {resolution} the error changes by {:.3}, not by half",
            pair[1] / pair[0]
        );
    }
}

/// Plates one behind the other, seen by the sprite along its shortest side.
fn plates(teeth: u32) -> Scene {
    scenes::sectioned(
        &format!("comb?teeth={teeth}&length=0.9"),
        &["-0.2,-1,-0.1@50%,40%,50%"],
    )
}

/// The answer of a strategy with a sprite, and the layers that the sprite has room for.
fn answer(question: &Question, strategy: Strategy) -> (Judged, u32) {
    let mut session = session();
    let judged = question.answer_in(&mut session, strategy);
    let plan = session.plan(strategy).expect("a drawn plan");
    (judged, plan.bounded[0].capacity)
}

#[test]
fn case_36_layers_are_counted_and_too_many_are_told() {
    let few = strategy("grid:8+vds:128");
    let (judged, layers) = answer(&Question::new(&plates(8), [64; 2]), few);
    assert_eq!(judged.outcome, Outcome::Complete, "16 layers fit");
    assert_eq!(layers, 16, "two faces of each plate");
    // 200 plates are 400 layers where the resolution tells them apart, and no sprite has so many.
    let judged = Question::new(&plates(200), [64; 2]).answer(few);
    let Outcome::Overflowed(reason) = &judged.outcome else {
        panic!("400 layers in one sprite: {:?}", judged.outcome);
    };
    assert!(reason.contains("400"), "the need is not told: {reason}");
}

#[test]
fn case_36_layers_are_counted_at_the_resolution_used() {
    // A needle that no coarse texel hits.
    let needle = meshes::block(
        DVec3::new(0.401, 0.401, 0.3),
        DVec3::new(0.4025, 0.4025, 0.45),
    );
    let slab = meshes::block(DVec3::new(-0.5, -0.5, -0.2), DVec3::new(0.5, 0.5, 0.2));
    let plane = ClipSurface::plane(DVec3::ZERO, DVec3::new(0.0, -1.0, -0.1));
    let scene = scenes::scene(
        "slab and needle",
        meshes::joined(&[slab, needle]),
        vec![plane],
    );
    let question = Question::new(&scene, [64; 2]);
    let layers = [64, 2048].map(|resolution| {
        let strategy = strategy(&format!("grid:8+vds:{resolution}"));
        let (judged, layers) = answer(&question, strategy);
        assert_eq!(judged.outcome, Outcome::Complete, "at {resolution}");
        layers
    });
    assert_eq!(layers, [2, 4], "the needle counts where a texel hits it");
}
