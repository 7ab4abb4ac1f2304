//! Expectations held against figures that are made up, each with figures that it does not hold of.

use std::collections::BTreeMap;

use cutaway::gpu::AdapterReport;
use cutaway_lab::compare::Comparison;
use cutaway_lab::experiment::expect::{Findings, reached};
use cutaway_lab::experiment::{
    Ending, Measurement, PerClock, Reached, Reference, Samples, StrategyMeasurement, Timing,
};

use super::{read, scenes};

/// Name, and decided wrong and crack pixels, or why it refused.
type Found<'a> = (&'a str, Result<[usize; 2], &'a str>);

fn measurement(found: &[Found<'_>]) -> Measurement {
    let of = |(name, found): &Found<'_>| StrategyMeasurement {
        name: (*name).to_owned(),
        outcome: if found.is_ok() {
            Ending::Complete
        } else {
            Ending::Refused
        },
        reason: found.err().map(str::to_owned),
        comparison: found.ok().map(|[decided_wrong_px, crack_px]| Comparison {
            decided_wrong_px,
            crack_px,
            ..Comparison::default()
        }),
        undecided_px: None,
        bytes: PerClock::default(),
        time_ms: PerClock::default(),
        frame_over_draw_only: None,
        frame_over_draw_only_mad: None,
        cut: None,
        passes: Vec::new(),
    };
    Measurement {
        scene: "cube".to_owned(),
        command: String::new(),
        version: String::new(),
        triangles: 12,
        resolution: [32, 24],
        adapter: AdapterReport {
            name: String::new(),
            backend: String::new(),
            driver: String::new(),
            software: true,
            sub_pixel_bits: Some(8),
        },
        timing: Timing::Wall,
        rounds: 0,
        exact: Reference {
            cap_px: 1,
            surface_px: 1,
            background_px: 1,
            undecided_px: 0,
            judged_px: None,
            overlap_px: 0,
            time_ms: 0.0,
        },
        draw_only_ms: Samples::default(),
        draw_only_compute_ms: None,
        strategies: found.iter().map(of).collect(),
    }
}

/// What comes of an expectation, where these were found in the order of the renderers.
fn outcome(expect: &str, found: &[Found<'_>]) -> Vec<Reached> {
    outcome_on(Some(8), expect, found)
}

/// The same on an adapter of so many sub-pixel bits.
fn outcome_on(bits: Option<u32>, expect: &str, found: &[Found<'_>]) -> Vec<Reached> {
    let text = format!(
        "question = \"Is it?\"\nanalysis = \"\"\n[[run]]\nname = \"cube\"\nscene.part = [{{ shape = \"cube\" }}]\n\
         strategies = [\"raycast+mask\", \"grid:{{cells}}+mask\", \"grid:{{cells}}+vds:64\"]\n\
         sweep = {{ cells = [8, 16] }}\n[[run.expect]]\n{expect}\n"
    );
    let run = scenes(&read(&text).unwrap(), false);
    let point = &run.points[0];
    let names: Vec<String> = point
        .trials
        .iter()
        .map(|e| e.renderer.to_string())
        .collect();
    let expected: Vec<&str> = found.iter().map(|f| f.0).collect();
    assert_eq!(names, expected, "figures are in the order of renderers");
    let mut measurement = measurement(found);
    measurement.adapter.sub_pixel_bits = bits;
    let figures = vec![BTreeMap::new(); found.len()];
    let found = Findings {
        measurement: &measurement,
        figures: &figures,
    };
    reached(&run, point, &found)
}

const FOUND: [Found<'static>; 5] = [
    ("raycast+mask", Ok([0, 0])),
    ("grid:8+mask", Ok([9, 4])),
    ("grid:16+mask", Ok([9, 0])),
    ("grid:8+vds:64", Ok([20, 6])),
    ("grid:16+vds:64", Err("a cube is no sphere")),
];

#[test]
fn an_expectation_holds_or_not_of_all_that_it_means() {
    for (expect, expected) in [
        (
            "strategies = [\"raycast+*\"]\ndecided_wrong_px = 0",
            vec![true],
        ),
        (
            "strategies = [\"grid:*+mask\"]\ndecided_wrong_px = 0",
            vec![false, false],
        ),
        (
            "strategies = [\"grid:*+mask\"]\ndecided_wrong_px = 9",
            vec![true, true],
        ),
        (
            "strategies = [\"grid:*+mask\"]\nwhere = { cells = 8 }\ndecided_wrong_px = 9",
            vec![true],
        ),
        (
            "strategies = [\"grid:8+*\"]\nwhy = \"w\"\ndecided_wrong_px = { most = 10 }",
            vec![true, false],
        ),
        // A declared failure that passes is a fault as well.
        (
            "strategies = [\"*\"]\nwhere = { cells = 8 }\nwhy = \"w\"\ncrack_px = { least = 5 }",
            vec![false, true],
        ),
        (
            "strategies = [\"raycast+mask\"]\nwhy = \"w\"\ndecided_wrong_px = { least = 1 }",
            vec![false],
        ),
        // What was refused has no figures to hold.
        (
            "strategies = [\"grid:16+vds:64\"]\ndecided_wrong_px = 0",
            vec![false],
        ),
        (
            "strategies = [\"grid:*+vds:64\"]\nwhy = \"w\"\noutcome = \"refused\"\nreason = \"no sphere\"",
            vec![false, true],
        ),
        (
            "strategies = [\"grid:16+vds:64\"]\nwhy = \"w\"\noutcome = \"refused\"\nreason = \"no cube\"",
            vec![false],
        ),
        (
            "strategies = [\"grid:16+vds:64\"]\nwhy = \"w\"\noutcome = \"overflowed\"",
            vec![false],
        ),
        (
            "strategies = [\"grid:*+mask\"]\noutcome = \"complete\"",
            vec![true, true],
        ),
        // 4, then 0.
        (
            "strategies = [\"grid:*+mask\"]\ncrack_px = { falls_along = \"cells\" }",
            vec![true],
        ),
        // 9, then 9.
        (
            "strategies = [\"grid:*+mask\"]\ndecided_wrong_px = { falls_along = \"cells\" }",
            vec![false],
        ),
    ] {
        let reached = outcome(expect, &FOUND);
        let holds: Vec<bool> = reached.iter().map(|r| r.holds).collect();
        assert_eq!(holds, expected, "{expect}\n{reached:#?}");
    }
}

#[test]
fn an_expectation_of_8_sub_pixel_bits_is_about_adapters_that_have_them() {
    let expect = "strategies = [\"grid:8+mask\"]\nsub_pixel_bits = 8\ndecided_wrong_px = 0";
    for (bits, held) in [(Some(8), 1), (Some(4), 0), (None, 1)] {
        let reached = outcome_on(bits, expect, &FOUND);
        assert_eq!(reached.len(), held, "{bits:?}");
        assert!(reached.iter().all(|r| !r.holds), "{bits:?}: 9 are wrong");
    }
}

#[test]
fn what_was_refused_does_not_fall_and_what_is_0_throughout_has_nothing_to_fall() {
    let expect = "strategies = [\"grid:*\"]\ncrack_px = { falls_along = \"cells\" }";
    let mut found = FOUND;
    found[1].1 = Ok([9, 0]);
    let reached = outcome(expect, &found);
    let steps: Vec<(&str, bool)> = reached
        .iter()
        .filter(|r| r.expected.what.contains("falls"))
        .map(|r| (r.strategy.as_str(), r.holds))
        .collect();
    assert_eq!(steps, [("grid:16+mask", false), ("grid:16+vds:64", false)]);
    let seen = reached.iter().find(|r| r.strategy == "grid:16+mask");
    assert!(seen.unwrap().found.contains("cannot fall"), "{reached:?}");
}

#[test]
fn what_has_fallen_to_0_may_stay_there() {
    let text = "question = \"Is it?\"\nanalysis = \"\"\n[[run]]\nname = \"cube\"\nscene.part = [{ shape = \"cube\" }]\n\
         strategies = [\"grid:{cells}+mask\"]\nsweep = { cells = [8, 16, 32] }\n[[run.expect]]\n\
         strategies = [\"*\"]\ncrack_px = { falls_along = \"cells\" }\n";
    let run = scenes(&read(text).unwrap(), false);
    for (cracks, expected) in [
        ([4, 0, 0], [true, true]),
        ([4, 0, 1], [true, false]),
        ([0, 0, 0], [false, false]),
        ([0, 4, 0], [false, true]),
    ] {
        let names = ["grid:8+mask", "grid:16+mask", "grid:32+mask"];
        let found: Vec<Found<'_>> = names.into_iter().zip(cracks.map(|c| Ok([9, c]))).collect();
        let measurement = measurement(&found);
        let figures = vec![BTreeMap::new(); 3];
        let found = Findings {
            measurement: &measurement,
            figures: &figures,
        };
        let reached = reached(&run, &run.points[0], &found);
        let holds: Vec<bool> = (reached.iter())
            .filter(|r| r.expected.what.contains("falls"))
            .map(|r| r.holds)
            .collect();
        assert_eq!(holds, expected, "{cracks:?}");
    }
}

#[test]
fn an_answer_says_what_was_expected_why_and_what_was_found() {
    let expect =
        "strategies = [\"grid:8+vds:64\"]\nwhy = \"it is coarse\"\ncrack_px = { most = 5 }";
    let reached = &outcome(expect, &FOUND)[0];
    assert_eq!(reached.strategy, "grid:8+vds:64");
    assert_eq!(reached.expected.what, "crack_px at most 5");
    assert_eq!(reached.expected.why.as_deref(), Some("it is coarse"));
    assert_eq!(reached.found, "crack_px 6");
}
