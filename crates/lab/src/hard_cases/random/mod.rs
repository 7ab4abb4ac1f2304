//! Random scenes: unions of boxes, lumpy balls and bundles of long prisms, flush with one another or not, rotated or not, some with
//! needles; one or two cuts by one or two planes or reliefs each; eyes outside and inside. Pictures are small, or some rows of a large one.
//!
//! Each method draws each scene, and the frame is compared with exact: exact strategies must have no decided wrong pixel, depth images
//! none beyond their theoretical error, and tessellations with one per-pixel list no hole. A scene that is drawn wrong is simplified as
//! long as it stays wrong, and printed as code for a numbered regression test. A scene costs one exact image of 64 x 48 pixels (of
//! 2400 x 8 for one scene in twelve) and a frame per method; simplifying a scene costs some hundred exact images and frames.

mod recipe;

use std::ops::Range;

pub use recipe::{Bumps, RandomSolid, Recipe, Surface};

use cutaway::Result;
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{CapSurface, InsideTest, Method, Strategy};

use super::expected::{list_fault, unmarked_fault};
use super::numbers::Numbers;
use super::{Judged, Question, band};

/// Maximum number of findings per method: further findings add no information.
const MOST_FINDINGS: usize = 5;

/// A scene that was drawn wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongScene {
    /// Name of the strategy.
    pub strategy: String,
    /// Number of the scene in the search.
    pub scene: u64,
    /// Fault of the simplest scene reached.
    pub what: String,
    /// Recipe of that scene.
    pub recipe: Recipe,
}

/// Result of a search.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Searched {
    /// Scenes that were drawn wrong.
    pub findings: Vec<WrongScene>,
    /// Per method, in order: the number of scenes it drew completely. All other scenes it refused, or drew with an overflow.
    pub drawn: Vec<usize>,
    /// Pixels that show a cap in exact.
    pub caps_px: usize,
    /// Pixels that exact covers.
    pub covered_px: usize,
    /// Pixels that exact leaves undecided.
    pub undecided_px: usize,
}

/// Recipe of a scene, from the seed of the search and the scene's number in the search.
pub fn recipe(seed: u64, scene: u64) -> Recipe {
    Recipe::random(&mut Numbers(seed ^ (scene << 32)))
}

/// Draws the scenes with these numbers by each method, and returns those drawn wrong. `step` is called before each scene is drawn, and
/// with each finding. Ends early, without a result, as soon as `goes_on` returns false; `goes_on` is called before each frame.
pub fn search(
    session: &mut Session,
    scenes: Range<u64>,
    seed: u64,
    methods: &[Method],
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Searched>> {
    let mut searched = Searched {
        drawn: vec![0; methods.len()],
        ..Searched::default()
    };
    for scene in scenes.clone() {
        step(format!("random scene {} of {}", scene + 1, scenes.end));
        let recipe = recipe(seed, scene);
        let question = recipe.question();
        searched.covered_px += question.exact.covered_px();
        searched.undecided_px += question.exact.undecided_px();
        searched.caps_px += question.exact.layers.count(cutaway::layers::Kind::Cap);
        for (method, drawn) in methods.iter().zip(&mut searched.drawn) {
            let strategy = method.to_string();
            let by_it = searched.findings.iter().filter(|f| f.strategy == strategy);
            if by_it.count() == MOST_FINDINGS {
                continue;
            }
            if !goes_on() {
                return Ok(None);
            }
            let judged = question.answer(session, method)?;
            *drawn += usize::from(judged.outcome == Outcome::Complete);
            let Some(what) = fault_kept(session, &question, &judged, method)? else {
                continue;
            };
            let (recipe, what) = shrunk(recipe.clone(), what, &mut |recipe| {
                // Reporting no fault ends the simplification at the current recipe.
                if !goes_on() {
                    return Ok(None);
                }
                let question = recipe.question();
                let judged = question.answer(session, method)?;
                fault_kept(session, &question, &judged, method)
            })?;
            step(format!("{strategy}, scene {scene}: {what}"));
            searched.findings.push(WrongScene {
                strategy,
                scene,
                what,
                recipe,
            });
        }
    }
    Ok(goes_on().then_some(searched))
}

/// As [`fault`], but ignores what a depth sprite loses in peeling: of two crossings at one depth in a texel, as at needles and teeth, it
/// keeps only one. A layered depth image with as many texels keeps both: if that image has no fault, peeling was the cause.
fn fault_kept(
    session: &mut Session,
    question: &Question,
    judged: &Judged,
    method: &Method,
) -> Result<Option<String>> {
    let found = fault(question, judged, method);
    let sprite = method
        .strategy
        .inside
        .filter(|i| *i == InsideTest::vds(i.steps()));
    let (Some(sprite), Some(_)) = (sprite, &found) else {
        return Ok(found);
    };
    let strategy = Strategy::new(method.strategy.surface, InsideTest::ldi(sprite.steps()));
    let lists = Method {
        strategy,
        ..*method
    };
    let by_lists = question.answer(session, &lists)?;
    Ok(found.filter(|_| fault(question, &by_lists, &lists).is_some()))
}

/// Fault of an answer. A refusal is not a fault. A reported overflow is not a fault if all wrong pixels are marked.
pub fn fault(question: &Question, judged: &Judged, method: &Method) -> Option<String> {
    let strategy = &method.strategy;
    let is_whole = |judged: &Judged| judged.layers.pixels.iter().all(|p| !p.depth.is_nan());
    match &judged.outcome {
        Outcome::Refused(_) => None,
        _ if strategy.is_by_the_papers_rule() => {
            (!is_whole(judged)).then(|| "a depth that is no number".to_owned())
        }
        Outcome::Overflowed(_) => unmarked_fault(judged),
        Outcome::Complete if strategy.is_tessellated() => {
            list_fault(judged, outline_px(question, strategy))
        }
        Outcome::Complete => match strategy.resolution() {
            Some(resolution) => band::fault(question, judged, resolution),
            None => judged.fault_of_exact(),
        },
    }
}

/// Largest displacement of an outline, in pixels: a fold of a grid is up to one cell away from the relief's fold. A cell is about as
/// wide as the picture divided by the number of cells. Adaptive cells displace outlines by less than a pixel.
fn outline_px(question: &Question, strategy: &Strategy) -> usize {
    let cells = strategy.surface.steps();
    if strategy.surface != CapSurface::grid(cells) {
        return 1;
    }
    let [width, height] = question.view.size_px;
    width.max(height).div_ceil(cells) as usize
}

/// The simplest recipe that can be reached while a fault remains, and that fault.
pub fn shrunk(
    mut recipe: Recipe,
    mut what: String,
    fault: &mut dyn FnMut(&Recipe) -> Result<Option<String>>,
) -> Result<(Recipe, String)> {
    'again: loop {
        for simpler in recipe.simpler() {
            if let Some(fault) = fault(&simpler)? {
                (recipe, what) = (simpler, fault);
                continue 'again;
            }
        }
        return Ok((recipe, what));
    }
}
