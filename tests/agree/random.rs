//! Random scenes: unions of boxes and lumpy balls, one or two cuts of one or two planes or reliefs, eyes outside and inside.
//!
//! A scene that the exact strategy gets wrong is made simpler as long as it stays wrong, and printed to become a regression.

use cutaway::session::Outcome;
use cutaway::strategies::Strategy;

use super::recipe::Recipe;
use crate::common::numbers::Numbers;
use crate::common::{Judged, Question, strategy};

const SIZE: [u32; 2] = [64, 48];
const SCENES: u64 = 400;
/// Asks for more scenes than the usual ones: a search for the next regression.
const MORE: &str = "CUTAWAY_RANDOM_SCENES";
/// Where the numbers begin; another seed asks other questions.
const SEED: u64 = 20_130_701;

fn scenes() -> u64 {
    let asked = std::env::var(MORE).map(|n| n.parse().expect("a number of scenes"));
    asked.map_or(SCENES, |n: u64| n.max(SCENES))
}

/// What is wrong with an answer of the exact strategy. More crossings than the mask has bits may be told instead of drawn:
/// then the pixels that are not marked are right.
fn fault_of(judged: &Judged) -> Option<String> {
    match &judged.outcome {
        Outcome::Overflowed(reason) if reason.contains("crossings per pixel") => {
            let mut vouched = judged.decided_wrong();
            let unmarked = vouched.find(|i| !judged.layers.pixels[*i].unreliable);
            unmarked.map(|i| format!("wrong and not marked: {}", judged.told(i)))
        }
        _ => judged.fault_of_exact(),
    }
}

fn fault(recipe: &Recipe) -> Option<String> {
    fault_of(&Question::of(&recipe.scene(), SIZE).answer(&Strategy::RAYCAST_MASK))
}

/// The simplest recipe that can be reached without mending the fault, and its fault.
fn shrunk(
    mut recipe: Recipe,
    mut told: String,
    fault: impl Fn(&Recipe) -> Option<String>,
) -> (Recipe, String) {
    'again: loop {
        for simpler in recipe.simpler() {
            if let Some(fault) = fault(&simpler) {
                (recipe, told) = (simpler, fault);
                continue 'again;
            }
        }
        return (recipe, told);
    }
}

#[test]
fn random_scenes_have_no_decided_wrong_pixel() {
    let mut faults = Vec::new();
    let (mut covered, mut undecided, mut caps, mut drawn) = (0, 0, 0, 0);
    for seed in 0..scenes() {
        let recipe = Recipe::random(&mut Numbers(SEED ^ (seed << 32)));
        let question = Question::of(&recipe.scene(), SIZE);
        covered += question.exact.covered_px();
        undecided += question.exact.undecided_px();
        caps += question.exact.layers.count(cutaway::layers::Kind::Cap);
        let judged = question.answer(&Strategy::RAYCAST_MASK);
        drawn += usize::from(judged.outcome == Outcome::Complete);
        if let Some(told) = fault_of(&judged) {
            let (recipe, told) = shrunk(recipe, told, fault);
            faults.push(format!("seed {seed}: {told}\n{recipe:?}"));
            if faults.len() == 5 {
                break;
            }
        }
    }
    println!("{caps} cap pixels, {undecided} undecided of {covered} covered");
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
    assert!(
        drawn as u64 > scenes() * 9 / 10,
        "only {drawn} scenes were drawn"
    );
    assert!(caps > 50_000, "only {caps} cap pixels in all");
    assert!(
        (undecided as f64) < 1e-2 * covered as f64,
        "{undecided} undecided of {covered} covered pixels"
    );
}

#[test]
fn the_papers_strategy_draws_every_random_scene() {
    let paper = strategy("grid:32+vds:128");
    for seed in 0..SCENES / 8 {
        let recipe = Recipe::random(&mut Numbers(SEED ^ (seed << 32)));
        let judged = Question::of(&recipe.scene(), SIZE).answer(&paper);
        assert_eq!(judged.outcome, Outcome::Complete, "seed {seed}: {recipe:?}");
        let depths = judged.layers.pixels.iter().all(|p| !p.depth.is_nan());
        assert!(depths, "seed {seed} has a depth that is no number");
    }
}

#[test]
fn shrinking_ends_in_a_simple_scene_that_is_still_wrong() {
    // The paper's strategy with a coarse sprite stands for an exact one with a fault.
    let coarse = strategy("grid:8+vds:32");
    let fault = |recipe: &Recipe| {
        let judged = Question::of(&recipe.scene(), SIZE).answer(&coarse);
        judged.first_decided_wrong().map(|pixel| judged.told(pixel))
    };
    let (recipe, told) = (0..SCENES)
        .map(|seed| Recipe::random(&mut Numbers(SEED ^ (seed << 32))))
        .filter(|r| r.solids.len() == 2 && r.cuts.concat().len() > 2)
        .find_map(|r| fault(&r).map(|told| (r, told)))
        .expect("a coarse sprite is wrong somewhere");
    let (simple, told) = shrunk(recipe, told, fault);
    assert!(
        fault(&simple).is_some(),
        "the fault was mended on the way: {told}"
    );
    assert_eq!(
        (simple.solids.len(), simple.cuts.concat().len()),
        (1, 1),
        "{simple:?}"
    );
}
