//! What happens in which order, seen by a watcher: expectations are reported before any time is taken, and a request to stop is met.

use std::cell::RefCell;

use cutaway::Result;
use cutaway::error::Diagnostic;
use cutaway_lab::experiment::run::{Assignment, Measured, measure};
use cutaway_lab::experiment::{Invocation, Machine, Reached, Warning, Watcher};

use super::{common, read, scenes};

/// Writes down what it is told, and says stop after so many steps.
struct Writes {
    reported: RefCell<Vec<String>>,
    messages: RefCell<Vec<Diagnostic>>,
    stops_after: usize,
}

impl Watcher for Writes {
    fn step(&self, what: String) {
        self.reported.borrow_mut().push(what);
    }

    fn opened(&self, message: &Diagnostic) {
        self.messages.borrow_mut().push(message.clone());
    }

    fn reached(&self, reached: &Reached) {
        let reported = format!("{} holds: {}", reached.strategy, reached.holds);
        self.reported.borrow_mut().push(reported);
    }

    fn goes_on(&self) -> bool {
        self.reported.borrow().len() < self.stops_after
    }
}

fn measured(
    scene: &str,
    truth: &str,
    more: &str,
    stops_after: usize,
) -> (Result<Option<Measured>>, Vec<String>) {
    let text = format!(
        "question = \"Is it?\"\nanalysis = \"\"\n[[run]]\nname = \"cube\"\n{truth}\nresolution = [32, 24]\n\
         scene = {{ part = [{{ shape = \"{scene}\" }}], cut = [{{ name = \"far\", surfaces = [{{ section = \"-z=50%\" }}] }}, {{ surfaces = [{{ section = \"-z=900\" }}], enabled = true }}] }}\n\
         strategies = [\"raycast+mask\", \"planar\"]\nrounds = 2\n{more}\n\
         [[run.expect]]\nstrategies = [\"raycast+mask\"]\ndecided_wrong_px = 7\n"
    );
    let run = scenes(&read(&text).unwrap(), false);
    let watcher = Writes {
        reported: RefCell::default(),
        messages: RefCell::default(),
        stops_after,
    };
    let assignment = Assignment {
        experiment: "01-test",
        run_name: "cube",
        run: &run,
        point: &run.points[0],
        rounds: run.rounds,
        is_quick: false,
        keeps_pictures: run.pictures.are_kept(0, run.points.len()),
        identity: "me".to_owned(),
        command: "cutaway".to_owned(),
        machine: &Machine::default(),
        invocation: &Invocation::default(),
    };
    let measured = measure(&mut common::session(), &assignment, &watcher);
    let texts: Vec<String> = (watcher.messages.borrow().iter())
        .map(|r| r.text.clone())
        .collect();
    let mut once = texts.clone();
    once.dedup();
    assert_eq!(texts, once, "scene and truth say the same but once");
    assert!(!texts.is_empty(), "a warning has words");
    (measured, watcher.reported.into_inner())
}

#[test]
fn expectations_are_told_before_any_time_is_taken() {
    let (found, reported) = measured("cube", "", "", usize::MAX);
    let found = found.unwrap().unwrap();
    assert_eq!(
        reported[1..],
        [
            "exact",
            "raycast+mask",
            "planar",
            "raycast+mask holds: false",
            "warm-up",
            "round 1 of 2",
            "round 2 of 2"
        ]
    );
    let record = found.record;
    assert_eq!(
        (record.run.as_str(), record.identity.as_str()),
        ("cube", "me")
    );
    assert_eq!(record.measurement.rounds, 2);
    assert_eq!(
        record.measurement.strategies[0].time_ms.frame.samples.len(),
        2
    );
    assert_eq!(record.expectations[0].found, "decided_wrong_px 0");
    let files: Vec<&str> = found
        .pictures
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    let [exact, drawn] = [&record.pictures[0], &record.pictures[1]];
    assert_eq!(files[..2], [exact.file.as_str(), drawn.file.as_str()]);
    assert_eq!(drawn.heatmap.as_deref(), Some(files[2]));
    assert_eq!(found.pictures[0].1.dimensions(), (32, 24));
}

#[test]
fn whoever_says_stop_is_heard_between_rounds() {
    // After the seventh word, the first round.
    let (found, reported) = measured("cube", "", "", 7);
    assert!(found.unwrap().is_none(), "what is not complete is not kept");
    assert_eq!(reported.last().unwrap(), "round 1 of 2");
}

#[test]
fn the_truth_must_be_framed_as_the_scene_is() {
    let truth = "truth = { \"camera.zoom\" = 1 }";
    let (found, _) = measured("cube", truth, "pictures = false", usize::MAX);
    let found = found.unwrap().unwrap();
    assert!(found.pictures.is_empty());
    let is_opening = |w: &&Warning| matches!(w, Warning::Opening { .. });
    let openings = found.record.warnings.iter().filter(is_opening);
    assert_eq!(openings.count(), 1, "{:?}", found.record.warnings);
    let truth = "truth = { \"part.0.shape\" = \"crank\" }";
    let (found, _) = measured("cube", truth, "", usize::MAX);
    let message = found.err().unwrap().to_string();
    assert!(message.contains("bounds"), "{message}");
}

#[test]
fn a_drift_adds_its_figures_and_changes_no_error() {
    let of = |drift| {
        measured("cube", "", drift, usize::MAX)
            .0
            .unwrap()
            .unwrap()
            .record
    };
    let (still, drifted) = (of(""), of("drift = { frames = 5, px = 0.25 }"));
    assert!(still.figures[0].is_empty(), "{:?}", still.figures);
    let figures = &drifted.figures[0];
    assert_eq!(
        figures["flicker_excess_px"], 0.0,
        "it is exact: {figures:?}"
    );
    assert!(figures["flicker_px"] > 0.0, "a whole pixel: {figures:?}");
    let errors = |r: &cutaway_lab::experiment::Record| r.measurement.strategies[0].comparison;
    assert_eq!(errors(&still), errors(&drifted));
}
