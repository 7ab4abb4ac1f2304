//! Random scenes, as `cutaway_lab::hard_cases::random` makes them: every strategy, and most scenes for the exact one.
//!
//! A scene that comes out wrong is made simpler as long as it stays wrong, and printed to become a regression.

use cutaway::session::Outcome;
use cutaway::strategies::Method;
use cutaway_lab::hard_cases::random::{Searched, fault, recipe, search, shrunk};
use cutaway_lab::hard_cases::usual_methods;

use crate::common::{is_long, session, strategy};

/// Scenes for the exact strategy: usually, and where tests run whole.
const SCENES: [u64; 2] = [200, 1500];
/// For each of the others.
const SCENES_OF_OTHERS: [u64; 2] = [20, 200];
/// Asks for more scenes than the usual ones: a search for the next regression.
const MORE: &str = "CUTAWAY_RANDOM_SCENES";
/// Where the numbers begin; another seed asks other questions.
const SEED: u64 = 20_130_701;

fn asked([usual, long]: [u64; 2]) -> u64 {
    let least = if is_long() { long } else { usual };
    let asked = std::env::var(MORE).map(|n| n.parse().expect("a number of scenes"));
    asked.map_or(least, |n: u64| n.max(least))
}

fn searched(scenes: u64, methods: &[Method]) -> Searched {
    let searched = search(&mut session(), scenes, SEED, methods, &mut |_| (), &|| true);
    searched.expect("frames").expect("nobody ends it")
}

#[track_caller]
fn nothing_found(searched: &Searched) {
    let findings = searched.findings.iter().map(|f| {
        format!(
            "{}, scene {}: {}\n{:?}",
            f.strategy, f.scene, f.what, f.recipe
        )
    });
    let findings: Vec<String> = findings.collect();
    assert!(findings.is_empty(), "{}", findings.join("\n\n"));
}

#[test]
fn random_scenes_have_no_decided_wrong_pixel() {
    let scenes = asked(SCENES);
    let searched = searched(scenes, &["raycast+mask".parse::<Method>().expect("a name")]);
    let (covered, undecided) = (searched.covered_px, searched.undecided_px);
    let caps = searched.caps_px;
    println!("{caps} cap pixels, {undecided} undecided of {covered} covered");
    nothing_found(&searched);
    let drawn = searched.drawn[0];
    assert!(
        drawn as u64 > scenes * 9 / 10,
        "only {drawn} scenes were drawn"
    );
    assert!(caps as u64 > 125 * scenes, "only {caps} cap pixels in all");
    assert!(
        (undecided as f64) < 1e-2 * covered as f64,
        "{undecided} undecided of {covered} covered pixels"
    );
}

#[test]
fn every_strategy_draws_random_scenes_as_it_must() {
    let scenes = asked(SCENES_OF_OTHERS);
    let mut methods = usual_methods(64);
    methods.retain(|e| e.to_string() != "raycast+mask");
    let searched = searched(scenes, &methods);
    for (method, drawn) in methods.iter().zip(&searched.drawn) {
        println!("{method}: {drawn} of {scenes} drawn");
    }
    nothing_found(&searched);
    for (method, drawn) in methods.iter().zip(searched.drawn) {
        // Who draws planes alone refuses most scenes; nobody may refuse all.
        let few = method.strategy == strategy("stencil") || method.strategy == strategy("planar");
        let least = if few { 1 } else { scenes as usize * 8 / 10 };
        assert!(drawn >= least, "{method} drew only {drawn} of {scenes}");
    }
}

#[test]
fn shrinking_ends_in_a_simple_scene_that_is_still_wrong() {
    // The paper's strategy with a coarse sprite stands for an exact one with a fault.
    let coarse = "grid:8+vds:32".parse::<Method>().expect("a name");
    let fault = |recipe: &_| {
        let recipe: &cutaway_lab::hard_cases::random::Recipe = recipe;
        let judged = recipe.question().answer(&mut session(), &coarse)?;
        Ok(judged
            .first_decided_wrong()
            .map(|pixel| judged.describe(pixel)))
    };
    let (first, what) = (0..SCENES[1])
        .map(|scene| recipe(SEED, scene))
        .filter(|r| r.solids.len() == 2 && r.cuts.concat().len() > 2)
        .find_map(|r| {
            let what: cutaway::Result<_> = fault(&r);
            what.expect("a frame").map(|what| (r, what))
        })
        .expect("a coarse sprite is wrong somewhere");
    let (simple, what) = shrunk(first, what, &mut |r| fault(r)).expect("frames");
    assert!(
        fault(&simple).expect("a frame").is_some(),
        "the fault was mended on the way: {what}"
    );
    assert_eq!(
        (simple.solids.len(), simple.cuts.concat().len()),
        (1, 1),
        "{simple:?}"
    );
}

#[test]
fn what_is_wrong_is_found_whoever_drew_it() {
    // One pixel of a right answer, away from every outline, shows something else.
    let question = (0..SCENES[1])
        .map(|scene| recipe(SEED, scene).question())
        .find(|q| q.exact.layers.count(cutaway::layers::Kind::Cap) > 300)
        .expect("a scene with a cap");
    for name in [
        "raycast+mask",
        "raycast+abuffer@compute",
        "grid:256+mask",
        "adaptive:0.5+mask",
    ] {
        let method = name.parse::<Method>().expect(name);
        let mut judged = question.answer(&mut session(), &method).expect("a frame");
        assert_eq!(judged.outcome, Outcome::Complete, "{name}");
        assert_eq!(fault(&question, &judged, &method), None, "{name}");
        let of_cap = |i: &usize| {
            judged.exact.layers.pixels[*i].kind == cutaway::layers::Kind::Cap
                && !judged.exact.undecided[*i]
        };
        let pixel = (0..judged.layers.pixels.len()).find(of_cap).expect("a cap");
        judged.layers.pixels[pixel].kind = cutaway::layers::Kind::Surface;
        judged.layers.pixels[pixel].back_face = true;
        judged.comparison = question.compare(&judged.layers);
        assert!(
            fault(&question, &judged, &method).is_some(),
            "{name}: planted"
        );
    }
}
