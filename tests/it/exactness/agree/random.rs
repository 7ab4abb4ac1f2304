//! Random scenes, as `cutaway_lab::hard_cases::random` makes them: every strategy, and most scenes for the exact one.
//!
//! A scene that comes out wrong is made simpler as long as it stays wrong, and printed to become a regression.

use std::ops::Range;

use cutaway::layers::{Kind, Layer, Layers};
use cutaway::session::Outcome;
use cutaway::strategies::Method;
use cutaway_lab::hard_cases::random::{Searched, fault, recipe, search, shrunk};
use cutaway_lab::hard_cases::usual_methods;

use crate::common::{is_long, session, strategy};

/// Scenes for the exact strategy: usually, and where tests run whole.
const SCENES: [u64; 2] = [200, 1500];
/// For each of the others.
const SCENES_OF_OTHERS: [u64; 2] = [20, 200];
/// Other scenes than the usual ones, as in `500..1000`: a search for the next regression, scene by scene on stderr.
const OTHERS: &str = "CUTAWAY_RANDOM_SCENES";
/// Where the numbers begin; another seed makes other scenes.
const SEED: u64 = 20_130_701;

fn scenes([usual, long]: [u64; 2]) -> Range<u64> {
    let Ok(range) = std::env::var(OTHERS) else {
        return 0..if is_long() { long } else { usual };
    };
    let ends = range.split_once("..").and_then(|(first, end)| {
        let [first, end] = [first, end].map(|n| n.parse().ok());
        first.zip(end)
    });
    let (first, end) =
        ends.unwrap_or_else(|| panic!("{OTHERS}={range}: two numbers as in 500..1000"));
    first..end
}

fn searched(scenes: Range<u64>, methods: &[Method]) -> Searched {
    let mut step = |scene| {
        if std::env::var_os(OTHERS).is_some() {
            eprintln!("{scene}");
        }
    };
    let searched = search(&mut session(), scenes, SEED, methods, &mut step, &|| true);
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
    let scenes = scenes(SCENES);
    let searched = searched(
        scenes.clone(),
        &["raycast+mask".parse::<Method>().expect("a name")],
    );
    let scenes = scenes.end - scenes.start;
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
    let scenes = scenes(SCENES_OF_OTHERS);
    let mut methods = usual_methods(64);
    methods.retain(|e| e.to_string() != "raycast+mask");
    let searched = searched(scenes.clone(), &methods);
    let scenes = scenes.end - scenes.start;
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

/// What 2,000 scenes found of methods that are not exact: folds of a grid whose cells are some pixels wide, and crossings that peeling lost.
#[test]
fn folds_of_wide_cells_and_lost_ties_are_no_findings() {
    for (method, scenes) in [
        ("grid:256+mask", [154, 606, 772, 1875].as_slice()),
        ("raycast+vds:512", &[1591, 1837]),
    ] {
        let method = method.parse::<Method>().expect("a name");
        for scene in scenes {
            let question = recipe(SEED, *scene).question();
            let judged = question.answer(&mut session(), &method).expect("a frame");
            let wrong = judged.comparison.decided_wrong_px;
            assert!(wrong > 0, "{method} has nothing to let pass in {scene}");
            nothing_found(&searched(*scene..scene + 1, &[method]));
        }
    }
}

/// A hole in the middle of a solid, of pixels that are narrower than a cell.
#[test]
fn a_hole_is_found_however_wide_cells_are() {
    let method = "grid:256+mask".parse::<Method>().expect("a name");
    let question = recipe(SEED, 772).question();
    let mut judged = question.answer(&mut session(), &method).expect("a frame");
    assert_eq!(fault(&question, &judged, &method), None);
    let [width, height] = question.view.size_px.map(|s| s as usize);
    let pixels = &question.exact.layers.pixels;
    let is_outside = |l: &Layer| l.kind != Kind::Background && !l.back_face;
    let is_solid = |x: &usize| {
        let mut rows = pixels.chunks(width);
        let is_decided = !question.exact.undecided[4 * width + x..][..2].contains(&true);
        is_decided && rows.all(|row| row[x - 11..x + 13].iter().all(is_outside))
    };
    assert_eq!(height, 8);
    let hole = 4 * width + (11..width - 13).find(is_solid).expect("a solid");
    for (pixel, has_fault) in [(hole, false), (hole + 1, true)] {
        judged.layers.pixels[pixel] = Layers::background([1; 2]).pixels[0];
        judged.comparison = question.compare(&judged.layers);
        let found = fault(&question, &judged, &method);
        assert_eq!(found.is_some(), has_fault, "{found:?}");
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
    // One pixel of a right answer, where exact is sure of it, shows something else.
    let question = (0..SCENES[1])
        .map(|scene| recipe(SEED, scene).question())
        .find(|q| q.exact.layers.count(Kind::Cap) > 300)
        .expect("a scene with a cap");
    for name in [
        "raycast+mask",
        "raycast+abuffer@compute",
        "grid:256+mask",
        "adaptive:0.5+mask",
        "raycast+vds:512",
    ] {
        let method = name.parse::<Method>().expect(name);
        let mut judged = question.answer(&mut session(), &method).expect("a frame");
        assert_eq!(judged.outcome, Outcome::Complete, "{name}");
        assert_eq!(fault(&question, &judged, &method), None, "{name}");
        let of_cap = |i: &usize| {
            judged.exact.layers.pixels[*i].kind == Kind::Cap && !judged.exact.undecided[*i]
        };
        // A sprite may be wrong along outlines: not everywhere.
        let planted = method.strategy.resolution().map_or(1, |_| usize::MAX);
        let caps = (0..judged.layers.pixels.len()).filter(of_cap);
        for pixel in caps.take(planted) {
            judged.layers.pixels[pixel].kind = Kind::Surface;
            judged.layers.pixels[pixel].back_face = true;
        }
        judged.comparison = question.compare(&judged.layers);
        assert!(
            fault(&question, &judged, &method).is_some(),
            "{name}: planted"
        );
    }
}
