//! Holds the table of hard cases: every strategy at 64 pixels, some at 256, each answer to its expected outcome.
//!
//! A declared failure that starts to pass is a fault too: then the table is wrong, and a reader of it is misled.

use cutaway::hard_cases::{
    Case, Entrant, Expected, Form, Keeps, Question, Tally, caps_px, cases, found, pictures, solids,
    tallied,
};
use cutaway::session::Outcome;

use crate::common::session;

fn run(size_px: u32) -> Vec<String> {
    let mut faults = Vec::new();
    for case in cases() {
        let pictures = pictures(case, size_px);
        let caps = caps_px(&pictures);
        // Of a doubled mesh nothing is inside, so nothing is capped; every other case is about caps.
        if (caps == 0) != (case.name == "every face twice") {
            faults.push(format!("{} {} has {caps} cap pixels", case.id, case.name));
        }
        for entrant in Entrant::all(size_px) {
            let expected = case.expected(&entrant);
            let tally = tallied(&mut session(), case, &entrant, &pictures).expect("frames");
            let found = tally.told(&expected);
            println!(
                "{:>3} {} at {size_px}: {entrant}: {expected}: {found}",
                case.id, case.name
            );
            let of_it = tally.faults_of(&expected);
            let named = |f| format!("{} {} at {size_px}: {entrant}: {f}", case.id, case.name);
            faults.extend(of_it.into_iter().map(named));
        }
        session().forget();
    }
    faults
}

#[track_caller]
fn none(faults: &[String]) {
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

#[test]
fn every_case_reaches_its_outcome_at_64_px() {
    none(&run(64));
}

#[test]
fn every_case_reaches_its_outcome_at_256_px() {
    none(&run(256));
}

fn named(name: &str) -> Entrant {
    Entrant::named(name).expect(name)
}

#[test]
fn every_expectation_can_be_missed() {
    let coarse = named("grid:16+vds:32");
    let scene = solids::torus_cut();
    let question = Question::of(&scene, [128; 2]);
    let judged = question.answer(&mut session(), &coarse).expect("a frame");
    // The bands of a sprite of 512 and of no error are too narrow for one of 32.
    let fine = named("grid:256+vds:512");
    for expected in [
        Expected::Exact,
        Expected::Band,
        Expected::Share(0.0),
        Expected::Listed(0.0),
        Expected::Marked,
        Expected::Doubted,
        Expected::Overflows("anything"),
        Expected::Refuses("anything"),
        Expected::RefusesSome("anything"),
    ] {
        let fault = expected.fault(&question, &judged, &fine);
        assert!(fault.is_some(), "{expected:?} takes anything");
    }
    let own = Expected::Band.fault(&question, &judged, &coarse);
    assert_eq!(own, None, "its own band is wide enough");
    // An open mesh whose marks are wiped off.
    let open = &solids::open(128)[0];
    let question = Question::of(open, [128; 2]);
    let mask = named("raycast+mask");
    let mut judged = question.answer(&mut session(), &mask).expect("a frame");
    let marked = Expected::Marked.fault(&question, &judged, &mask);
    assert_eq!(marked, None, "marked as it should be");
    for pixel in &mut judged.layers.pixels {
        pixel.unreliable = false;
    }
    let wiped = Expected::Marked.fault(&question, &judged, &mask);
    assert!(wiped.is_some(), "wiped marks go unnoticed");
}

#[test]
fn a_declaration_that_is_stale_is_a_fault() {
    let scene = &solids::each("cube", &["-z=0.1"])[0];
    let question = Question::of(scene, [64; 2]);
    let mask = named("raycast+mask");
    let judged = question.answer(&mut session(), &mask).expect("a frame");
    for stale in [
        Expected::Fails("it does not"),
        Expected::Refuses("it draws"),
        Expected::RefusesSome("it draws"),
        Expected::Overflows("it has room"),
    ] {
        let mut tally = Tally::default();
        tally.add(&judged, "cube", stale.fault(&question, &judged, &mask));
        assert_eq!(tally.faults_of(&stale).len(), 1, "{stale:?}");
    }
    // A refusal for another reason than the one that is declared.
    let stencil = named("stencil");
    let crossing = &cutaway::hard_cases::bumps::crossing(64)[0];
    let question = Question::of(crossing, [64; 2]);
    let refused = question.answer(&mut session(), &stencil).expect("a frame");
    assert!(
        matches!(refused.outcome, Outcome::Refused(_)),
        "{:?}",
        refused.outcome
    );
    for (words, faults) in [("relief", 0), ("near plane", 1)] {
        let expected = Expected::Refuses(words);
        let fault = expected.fault(&question, &refused, &stencil);
        assert_eq!(usize::from(fault.is_some()), faults, "{words}");
    }
}

#[test]
fn turned_normals_and_shifted_depths_are_noticed() {
    let case = Case {
        id: "planted",
        name: "planted",
        scenes: |_| solids::each("cube", &["-z=0.1"]),
        form: Form::Plane,
        exact: Expected::Exact,
        paper: Expected::Band,
        apart: &[],
        keeps: Keeps {
            normal_deg: 0.1,
            depth_px: 0.01,
        },
    };
    let (_, question) = &pictures(&case, 64)[0];
    let mask = named("raycast+mask");
    let judged = question.answer(&mut session(), &mask).expect("a frame");
    assert_eq!(case.fault(question, &judged, &mask), None, "as it is drawn");
    for (what, plant) in [
        (
            "normals",
            (|p| p.normal = -p.normal) as fn(&mut cutaway::layers::Layer),
        ),
        ("depths", |p| p.depth *= 1.01),
    ] {
        let mut planted = question.answer(&mut session(), &mask).expect("a frame");
        planted.layers.pixels.iter_mut().for_each(plant);
        planted.comparison = question.compare(&planted.layers);
        let fault = case.fault(question, &planted, &mask).unwrap_or_default();
        assert!(fault.contains(what), "{what}: {fault}");
    }
}

#[test]
fn what_is_asked_is_found_by_number_and_told() {
    let mut steps = Vec::new();
    let ids = ["1".to_owned(), "35".to_owned(), "B1?".to_owned()];
    let cases = found(&mut session(), &ids, &[32], None, &mut |s| steps.push(s));
    let cases = cases.expect("frames");
    let told: Vec<&str> = cases.iter().map(|c| c.id.as_str()).collect();
    assert_eq!(told, ["1", "35", "B10", "B11", "B12", "B13", "B14"]);
    assert!(steps.iter().all(|s| s.contains("at 32 px")), "{steps:?}");
    for case in &cases {
        let failed = case.reached.iter().find(|r| !r.holds);
        assert_eq!(failed, None, "{}", case.id);
    }
    let everybody = Entrant::all(32).len();
    assert_eq!(cases[0].reached.len(), everybody, "nobody is left out");
    assert_eq!(cases[1].reached.len(), 0, "35 has no pictures");
    let held_by = cases[1].held_by.clone().unwrap_or_default();
    assert!(held_by.contains("case_35"), "{held_by}");
    let unknown = found(&mut session(), &["99".to_owned()], &[32], None, &mut |_| ());
    let told = unknown.expect_err("no such case").to_string();
    assert!(told.contains("99") && told.contains("B14"), "{told}");
}
