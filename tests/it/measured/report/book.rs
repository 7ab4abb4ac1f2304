//! The tables of the book, worked out again from the committed record; that of README is held against them (`documents::figures`).

use std::fs;

use cutaway_lab::Comparison;
use cutaway_lab::experiment::{Record, Samples, StrategyMeasurement};

use super::{RECORDED, root};

const PAPER: &str = "grid:256+vds:1024";
const MASK: &str = "raycast+mask";
const COMPUTE: &str = "raycast+mask@compute";

/// Points of a run of an experiment, all runs where none is named, that have one of the values of an axis.
fn points(experiment: &str, run: &str, axis: &str, values: &[&str]) -> Vec<&'static Record> {
    let mut experiments = RECORDED.folders.iter().flat_map(|f| &f.experiments);
    let found = experiments.find(|e| e.synopsis.name == experiment);
    let records = found.unwrap().records.iter();
    let is_it = |r: &&Record| {
        let is_value = |v: &str| (r.parameters.get(axis)).is_some_and(|p| p.to_string() == v);
        (run.is_empty() || r.run == run)
            && (values.is_empty() || values.iter().any(|v| is_value(v)))
    };
    let found: Vec<&Record> = records.filter(is_it).collect();
    assert!(!found.is_empty(), "{experiment}, {run}: {values:?}");
    found
}

/// What was found of a strategy at some points.
fn of<'a>(points: &[&'a Record], name: &str) -> Vec<(&'a Record, &'a StrategyMeasurement)> {
    let all = points.iter().map(|point| {
        let mut strategies = point.measurement.strategies.iter();
        (*point, strategies.find(|s| s.name == name).unwrap())
    });
    all.collect()
}

fn frames(points: &[&Record], name: &str) -> Vec<f64> {
    let all = of(points, name).into_iter();
    all.map(|(_, s)| s.frame_over_draw_only.unwrap()).collect()
}

/// Ratios where all clocks are paid.
fn all_clocks(points: &[&Record], name: &str) -> Vec<f64> {
    let ratio = |(point, s): (&Record, &StrategyMeasurement)| {
        let time = &s.time_ms;
        let sum = Samples::sum(&[&time.solid, &time.cut, &time.frame]);
        sum.over(&point.measurement.draw_only_ms).median
    };
    of(points, name).into_iter().map(ratio).collect()
}

fn wrong(points: &[&Record], name: &str) -> Vec<f64> {
    let all = of(points, name).into_iter();
    all.map(|(_, s)| s.comparison.unwrap().decided_wrong_px as f64)
        .collect()
}

/// Percent of the exact cap, in the median.
fn share(points: &[&Record], name: &str, px: fn(&Comparison) -> usize) -> f64 {
    let percent = |(point, s): (&Record, &StrategyMeasurement)| {
        let cap_px = point.measurement.exact.cap_px as f64;
        100.0 * px(&s.comparison.unwrap()) as f64 / cap_px
    };
    median(of(points, name).into_iter().map(percent).collect())
}

fn median(values: Vec<f64>) -> f64 {
    Samples::new(values).median
}

/// `1.3 to 1.4`, or one number where both are written so.
fn range(values: &[f64], digits: usize) -> String {
    let [least, most] = Samples::new(values.into()).range();
    let (least, most) = (format!("{least:.digits$}"), format!("{most:.digits$}"));
    match least == most {
        true => least,
        false => format!("{least} to {most}"),
    }
}

/// A page of the book, on one line where texts are looked for.
fn page(name: &str) -> String {
    fs::read_to_string(root().join("docs").join(name)).unwrap()
}

/// The first of the texts that is not in a row, in this order.
fn missing<'a>(row: &str, texts: &'a [String]) -> Option<&'a String> {
    let mut rest = row;
    texts.iter().find(|text| match rest.find(text.as_str()) {
        Some(at) => {
            rest = &rest[at + text.len()..];
            false
        }
        None => true,
    })
}

/// The row of the results that begins with a text holds texts in this order.
fn check(start: &str, texts: &[String]) {
    let page = page("results.md");
    let row = page
        .lines()
        .find(|l| l.starts_with(&format!("| {start} |")));
    let row = row.unwrap_or_else(|| panic!("docs/results.md has no row {start}"));
    if let Some(text) = missing(row, texts) {
        panic!("`{text}` is by the record, and not in its place in docs/results.md: {row}");
    }
}

/// The text under a heading of the results holds texts in this order.
fn check_prose(heading: &str, texts: &[String]) {
    let page = page("results.md");
    let from = page.find(&format!("## {heading}\n")).unwrap();
    let section = page[from + 3..].split("\n## ").next().unwrap();
    let section = section.split_whitespace().collect::<Vec<_>>().join(" ");
    if let Some(text) = missing(&section, texts) {
        panic!("`{text}` is by the record, and not in its place in docs/results.md: {section}");
    }
}

#[test]
fn the_book_has_the_figures_of_planes_and_reliefs() {
    let one = points("06-planar", "", "", &[]);
    let [compute, stencil] = [COMPUTE, "stencil"].map(|name| range(&frames(&one, name), 1));
    let ratio = format!("| {compute}, {stencil} |");
    let paper = format!("× {}", range(&frames(&one, PAPER), 1));
    let px = format!("{} px", range(&wrong(&one, PAPER), 0));
    check("one plane", &[ratio, paper, px]);

    let several = points("07-surfaces", "planes", "surfaces", &["2", "4", "6"]);
    let ratio = format!("| {} |", range(&frames(&several, COMPUTE), 1));
    let hardware = format!("rasteriser {} |", range(&frames(&several, MASK), 1));
    let paper = format!("× {}", range(&frames(&several, PAPER), 1));
    let px = format!("{} px", range(&wrong(&several, PAPER), 0));
    check("several planes", &[ratio, hardware, paper, px]);

    let mut reliefs = points("07-surfaces", "reliefs", "surfaces", &["1", "2"]);
    reliefs.extend(points("01-paper", "", "", &[]));
    let three = points("07-surfaces", "reliefs", "surfaces", &["3"]);
    let ratio = format!("| {} |", range(&frames(&reliefs, COMPUTE), 1));
    let of_three = format!("three take {}", range(&frames(&three, COMPUTE), 1));
    let hardware = format!("rasteriser {} |", range(&frames(&reliefs, MASK), 1));
    let paper = format!("× {}", range(&frames(&reliefs, PAPER), 1));
    let px = format!("{} px", range(&wrong(&reliefs, PAPER), 0));
    let paper_three = format!("three: {}", range(&frames(&three, PAPER), 1));
    check(
        "one or two reliefs",
        &[ratio, of_three, hardware, paper, px, paper_three],
    );

    let grazing = points("10-grazing", "", "", &[]);
    let [pyramid, cells, paper] = ["raycast+mask@pyramid", "raycast+mask@cells", PAPER]
        .map(|name| format!("{:.1}", median(frames(&grazing, name))));
    let [.., most] = Samples::new(wrong(&grazing, PAPER)).range();
    check(
        "a relief seen at grazing angles, a map of many texels",
        &[
            format!("| {pyramid} |"),
            format!("{cells} without"),
            format!("× {paper}, up to {most:.0} px"),
        ],
    );
}

#[test]
fn the_book_has_the_figures_of_moving_deep_and_huge_meshes() {
    let moving = points("04-moving", "faces", "", &[]);
    let [stencil, compute, paper] =
        ["stencil", COMPUTE, PAPER].map(|name| range(&all_clocks(&moving, name), 1));
    check(
        "a mesh that moves in every frame, one plane",
        &[
            format!("| {stencil}, {compute} |"),
            format!("× {paper} with"),
        ],
    );

    let deep = points("05-depth", "", "teeth", &["128"]);
    let [stencil, planar, mask, abuffer, paper] =
        ["stencil", "planar", MASK, "raycast+abuffer", PAPER]
            .map(|name| range(&frames(&deep, name), 1));
    let px = range(&wrong(&deep, PAPER), 0);
    check(
        "many layers (256)",
        &[
            format!("| {stencil}, {planar}, {mask} |"),
            format!("A-buffer takes {abuffer},"),
            format!("× {paper}, {px} px"),
        ],
    );

    let huge = points("13-huge", "", "", &[]);
    let [compute, narrow, paper] =
        [COMPUTE, "raycast+mask@compute,32-bit", PAPER].map(|name| range(&frames(&huge, name), 1));
    let largest = points("13-huge", "", "faces", &["5000000"]);
    let sprite_ms = of(&largest, PAPER)[0].1.time_ms.solid.median;
    check(
        "millions of faces",
        &[
            format!("| {compute} |"),
            format!("atomics {narrow} |"),
            format!("× {paper}, {sprite_ms:.0} ms more"),
        ],
    );

    let sections = [points("06-planar", "", "", &[]), huge].concat();
    let large = points("13-huge", "", "faces", &["2000000", "5000000"]);
    let slices = of(&large, "planar").into_iter();
    let slices: Vec<f64> = slices.map(|(_, s)| s.time_ms.cut.median).collect();
    check(
        "an outline, an area, a drawing",
        &[
            format!("| {} |", range(&frames(&sections, "planar"), 1)),
            format!("{} ms of CPU time", range(&slices, 0)),
        ],
    );
}

#[test]
fn the_book_has_the_figures_of_meshes_with_holes() {
    let holes = points("09-broken", "holes", "amount", &["1%", "5%", "10%"]);
    let all = |c: &Comparison| c.decided_wrong_px;
    let unmarked = |c: &Comparison| c.unmarked_wrong_px;
    let sprite = "grid:256+vds:512";
    let by_winding = "raycast+winding@compute";
    check(
        "a mesh with holes",
        &[
            format!("| {:.1} |", median(frames(&holes, by_winding))),
            format!(
                "{:.1} % of the cap are wrong",
                share(&holes, by_winding, all)
            ),
            format!("{:.1} % with", share(&holes, MASK, all)),
            format!("{:.1} % unmarked", share(&holes, MASK, unmarked)),
            format!("× {:.1} |", median(frames(&holes, MASK))),
            format!(
                "`{sprite}`: {:.0} % of the cap wrong and unmarked",
                share(&holes, sprite, unmarked)
            ),
        ],
    );
}

/// Wrong pixels of strategies at one point, as a list.
fn wrong_of(point: &[&Record], names: &[String]) -> String {
    let px = names.iter().map(|name| range(&wrong(point, name), 0));
    px.collect::<Vec<_>>().join(", ")
}

fn cracks(points: &[&Record], name: &str) -> Vec<String> {
    let all = of(points, name).into_iter();
    all.map(|(_, s)| s.comparison.unwrap().crack_px.to_string())
        .collect()
}

#[test]
fn the_book_has_the_figures_of_the_paper_and_of_its_gap() {
    let paper = points("01-paper", "", "", &[]);
    let found = of(&paper, PAPER)[0].1;
    let comparison = found.comparison.unwrap();
    check_prose(
        "What the paper's path costs and misses",
        &[
            format!("× {:.1} and", found.frame_over_draw_only.unwrap()),
            format!("{} decided wrong pixels", comparison.decided_wrong_px),
            format!("{} of them holes", comparison.crack_px),
            format!("{:.0} ms more", found.time_ms.solid.median),
            format!("`{MASK}` × {}", range(&frames(&paper, MASK), 1)),
            format!("`{COMPUTE}` × {}", range(&frames(&paper, COMPUTE), 1)),
        ],
    );
    let accuracy = points("02-accuracy", "", "", &[]);
    let grids = [64, 128, 256, 512].map(|n| format!("grid:{n}+mask"));
    let adaptive = ["2", "1", "0.5", "0.25"].map(|tau| format!("adaptive:{tau}+mask"));
    check_prose(
        "What a tenth of the error costs",
        &[
            format!("`grid:N+mask` {} px", wrong_of(&accuracy, &grids)),
            format!("`adaptive:TAU+mask` {} px", wrong_of(&accuracy, &adaptive)),
        ],
    );
    let density = points("03-gaps", "density", "", &[]);
    let falls = [32, 64, 128, 256, 512].map(|n| cracks(&density, &format!("grid:{n}+vds:1024")));
    let grows = ["10", "3", "1", "0.1"].map(|tilt| {
        let point = points("03-gaps", "tangency", "tilt_deg", &[tilt]);
        cracks(&point, PAPER).concat()
    });
    check_prose(
        "What the gap does",
        &[
            format!("{} px", falls.concat().join(", ")),
            format!("{} px", grows.join(", ")),
        ],
    );
    let wrong = ["holes".to_owned(), "× 3.1".to_owned()];
    assert!(
        missing("× 3.1, holes", &wrong).is_some(),
        "the control: another order"
    );
}

#[test]
fn the_book_has_what_each_strategy_costs() {
    let relief = points("01-paper", "", "", &[]);
    let plane = points("06-planar", "one", "model", &["crank"]);
    let page = page("strategies.md");
    let rows = page
        .lines()
        .skip_while(|l| !l.starts_with("| method | × uncut"));
    let rows: Vec<&str> = rows.skip(2).take_while(|l| l.starts_with('|')).collect();
    assert!(rows.len() > 10, "{rows:?}");
    let measured = |points: &[&'static Record], name: &str| {
        let mut strategies = points[0].measurement.strategies.iter();
        strategies.find(|s| s.name == name)
    };
    let row = |name: &str| {
        let ratio = |s: Option<&StrategyMeasurement>, missing: &str| {
            let ratio = s.and_then(|s| s.frame_over_draw_only);
            ratio.map_or(missing.to_owned(), |x| format!("{x:.1}"))
        };
        let of_relief = measured(&relief, name);
        let errors = of_relief.and_then(|s| s.comparison);
        let px = |count: Option<usize>| count.map_or(String::new(), |px| px.to_string());
        format!(
            "| `{name}` | {} | {} | {} | {} |",
            ratio(measured(&plane, name), ""),
            ratio(of_relief, "refused"),
            px(errors.map(|c| c.decided_wrong_px)),
            px(errors.map(|c| c.crack_px)),
        )
    };
    for found in &rows {
        let name = found.split('`').nth(1).unwrap();
        assert_eq!(*found, row(name), "by the record");
    }
    let planted = rows[0].replacen("1.", "2.", 1);
    assert_ne!(planted, row("raycast+mask@compute"), "the control");
}
