//! Holds the table of hard cases: every strategy at 64 pixels, some also at 256, each answer to its expected outcome.
//!
//! A declared failure that starts to pass is a fault too: then the table is wrong, and a reader of it is misled.

use std::path::Path;

use cutaway::session::Outcome;
use cutaway::strategies::{Method, Unsupported};
use cutaway_lab::hard_cases::{
    Case, CaseSelection, Expected, Question, Tally, caps_px, cases, check_ids, found, pictures,
    random, read, tallied, usual_methods,
};

use crate::common::shares::{Share, in_shares};
use crate::common::{scenes, session, tolerances};

/// Cases in which nothing is capped.
const CAPLESS: [&str; 4] = [
    "every face twice",
    "plane in a face",
    "a face in the plane, or an ulp beside it",
    "a plane in the face between two products",
];

/// What is not as expected of some cases, at all sizes together: a bound may be needed at one alone.
fn run<'a>(cases: impl Iterator<Item = &'a Case>) -> Vec<String> {
    let mut faults = Vec::new();
    for case in cases {
        let mut tallies: Vec<(Method, Tally)> = Vec::new();
        for size_px in [64, 256] {
            let pictures = pictures(case, size_px).expect("scenes");
            let caps = caps_px(&pictures);
            // Of a doubled mesh nothing is inside, and a plane in a face shows the face; every other case is about caps.
            if (caps == 0) != CAPLESS.contains(&&*case.name) {
                faults.push(format!("{} {} has {caps} cap pixels", case.id, case.name));
            }
            for method in usual_methods(size_px) {
                let tally = tallied(&mut session(), case, &method, &pictures).expect("frames");
                match tallies.iter_mut().find(|(e, _)| *e == method) {
                    Some((_, so_far)) => so_far.join(tally),
                    None => tallies.push((method, tally)),
                }
            }
            session().forget();
        }
        for (method, tally) in tallies {
            let expected = case.expected_on(&method, tally.is_coarse);
            let place = format!("{} {}: {method}", case.id, case.name);
            println!("{place}: {expected}: {}", tally.describe(&expected));
            let of_it = tally.faults_of(&expected);
            faults.extend(of_it.into_iter().map(|f| format!("{place}: {f}")));
        }
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

in_shares!(every_case_with_planes_reaches_its_outcome, 8);

fn every_case_with_planes_reaches_its_outcome(share: Share) {
    none(&run(share.part(cases().filter(|c| !c.form.has_reliefs()))));
}

in_shares!(every_case_with_reliefs_reaches_its_outcome, 2);

fn every_case_with_reliefs_reaches_its_outcome(share: Share) {
    none(&run(share.part(cases().filter(|c| c.form.has_reliefs()))));
}

fn named(name: &str) -> Method {
    name.parse::<Method>().expect(name)
}

#[test]
fn every_expectation_can_be_missed() {
    let coarse = named("grid:16+vds:32");
    let scene = scenes::torus_cut();
    let question = Question::new(&scene, [128; 2]);
    let judged = question.answer(&mut session(), &coarse).expect("a frame");
    // The bands of a sprite of 512 and of no error are too narrow for one of 32.
    let fine = named("grid:256+vds:512");
    for expected in [
        Expected::Exact,
        Expected::Band,
        Expected::Share(0.0),
        Expected::Listed(0.0),
        Expected::Marked,
        Expected::Leaks(0.0),
        Expected::Doubted,
        Expected::Overflows("anything".into()),
        Expected::Refuses(Unsupported::Limit),
        Expected::RefusesSome(Unsupported::Limit),
    ] {
        let fault = expected.fault(&question, &judged, &fine);
        assert!(fault.is_some(), "{expected:?} takes anything");
    }
    let own = Expected::Band.fault(&question, &judged, &coarse);
    assert_eq!(own, None, "its own band is wide enough");
    // An open mesh whose marks are wiped off.
    let open = &scenes::of_case("20-open", 128)[0];
    let question = Question::new(open, [128; 2]);
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
    if !tolerances::holds_lower_bounds() {
        return;
    }
    let scene = &scenes::sectioned("cube", &["-z=0.1"]);
    let question = Question::new(scene, [64; 2]);
    let mask = named("raycast+mask");
    let judged = question.answer(&mut session(), &mask).expect("a frame");
    for stale in [
        Expected::Fails("it does not".into()),
        Expected::FailsWithin("it does not".into(), 0.1, 0.2),
        Expected::Share(0.1),
        Expected::Within(0.1, "it is not wrong".into()),
        Expected::Listed(0.1),
        Expected::Refuses(Unsupported::Limit),
        Expected::RefusesSome(Unsupported::Limit),
        Expected::Overflows("it has room".into()),
    ] {
        let mut tally = Tally::default();
        tally.add(&judged, "cube", stale.fault(&question, &judged, &mask));
        assert_eq!(tally.faults_of(&stale).len(), 1, "{stale:?}");
    }
    // A refusal for another reason than the one that is declared.
    let stencil = named("stencil");
    let crossing = &scenes::of_case("38-crossing-surfaces", 64)[0];
    let question = Question::new(crossing, [64; 2]);
    let refused = question.answer(&mut session(), &stencil).expect("a frame");
    assert!(
        matches!(refused.outcome, Outcome::Refused(_)),
        "{:?}",
        refused.outcome
    );
    for (unsupported, faults) in [(Unsupported::Reliefs, 0), (Unsupported::NearPlane, 1)] {
        let expected = Expected::Refuses(unsupported);
        let fault = expected.fault(&question, &refused, &stencil);
        assert_eq!(usize::from(fault.is_some()), faults, "{unsupported}");
    }
}

#[test]
fn a_failure_that_gets_worse_or_better_is_told() {
    let failing = Expected::FailsWithin("planted".into(), 0.1, 0.4);
    for (wrong_px, phrase) in [
        (5, Some("better")),
        (10, None),
        (40, None),
        (41, Some("worse")),
    ] {
        let tally = Tally {
            wrong_px,
            covered_px: 100,
            ..Tally::default()
        };
        let faults = tally.faults_of(&failing);
        assert_eq!(faults.len(), usize::from(phrase.is_some()), "{faults:?}");
        let is_told = |phrase: &str| faults.iter().any(|f| f.contains(phrase));
        assert!(phrase.is_none_or(is_told), "{faults:?}");
    }
}

#[test]
fn a_bound_is_stale_only_if_nothing_is_wrong_at_any_usual_size() {
    let asked_at = |unasked_px: &[u32], wrong_px| Tally {
        wrong_px,
        unasked_px: unasked_px.to_vec(),
        ..Tally::default()
    };
    let faults = |tally: &Tally| tally.faults_of(&Expected::Share(0.1)).len();
    assert_eq!(faults(&asked_at(&[256], 0)), 0, "asked at 64 px alone");
    let mut both = asked_at(&[256], 0);
    both.join(asked_at(&[64], 0));
    assert_eq!(faults(&both), 1, "asked at both");
    let mut at_one = asked_at(&[256], 0);
    at_one.join(asked_at(&[64], 3));
    assert_eq!(faults(&at_one), 0, "needed at one");
}

#[test]
fn turned_normals_and_shifted_depths_are_noticed() {
    let case = read(
        Path::new("planted.toml"),
        "part = [{ shape = \"cube\" }]\ncut = [{ surfaces = [{ section = \"-z=0.1\" }] }]\n\
         [case]\nid = \"0\"\nname = \"planted\"\nexact = \"exact\"\npaper = \"band\"\n\
         keeps = { normal_deg = 0.1, depth_px = 0.01 }\n",
    );
    let case = case.expect("a case");
    let (_, question) = &pictures(&case, 64).expect("a scene")[0];
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
    let asked = CaseSelection {
        ids: &ids,
        sizes_px: &[32],
        methods: None,
    };
    let cases = found(&mut session(), &asked, &mut |s| steps.push(s), &|| true);
    let cases = cases.expect("frames").expect("nobody ends it");
    let listed: Vec<&str> = cases.iter().map(|c| c.id.as_str()).collect();
    assert_eq!(listed, ["1", "35", "B10", "B11", "B12", "B13", "B14"]);
    assert!(steps.iter().all(|s| s.contains("at 32 px")), "{steps:?}");
    for case in &cases {
        let failed = case.reached.iter().find(|r| !r.holds);
        assert_eq!(failed, None, "{}", case.id);
    }
    let everybody = usual_methods(32).len();
    assert_eq!(cases[0].reached.len(), everybody, "nobody is left out");
    assert_eq!(cases[1].reached.len(), 0, "35 has no pictures");
    let held_by = cases[1].held_by.clone().unwrap_or_default();
    assert!(held_by.contains("case_35"), "{held_by}");
    let unknown = check_ids(&["1".to_owned(), "99".to_owned()]);
    let message = unknown.expect_err("no such case").to_string();
    assert!(
        message.contains("99") && message.contains("B14"),
        "{message}"
    );
    assert!(check_ids(&ids).is_ok(), "all of them are there");
}

#[test]
fn exactly_the_named_are_asked_whatever_their_parameters() {
    let named = [named("grid:16+vds:32"), named("raycast+kbuffer:8")];
    let asked = CaseSelection {
        ids: &["1".to_owned()],
        // The usual ones of pictures of this size do not have the second of them.
        sizes_px: &[96],
        methods: Some(&named),
    };
    let cases = found(&mut session(), &asked, &mut |_| (), &|| true);
    let cases = cases.expect("frames").expect("nobody ends it");
    let reached: Vec<&str> = (cases[0].reached.iter())
        .map(|r| r.strategy.as_str())
        .collect();
    assert_eq!(reached, ["grid:16+vds:32", "raycast+kbuffer:8"]);
}

#[test]
fn hard_cases_and_the_search_end_when_they_are_told_to() {
    use std::cell::Cell;

    let left = Cell::new(0_u32);
    let goes_on = || left.replace(left.get().saturating_sub(1)) > 0;
    let mut steps = 0;
    let asked = CaseSelection {
        ids: &["*".to_owned()],
        sizes_px: &[16],
        methods: None,
    };
    left.set(20);
    let cases = found(&mut session(), &asked, &mut |_| steps += 1, &goes_on);
    assert_eq!(cases.expect("frames"), None, "nothing is kept");
    assert!(steps <= 2, "it went on for {steps} cases");
    let methods = [named("raycast+mask")];
    for (frames, ends) in [(3, true), (100, false)] {
        left.set(frames);
        let searched = random::search(&mut session(), 0..5, 1, &methods, &mut |_| (), &goes_on);
        assert_eq!(searched.expect("frames").is_none(), ends, "{frames} frames");
    }
}
