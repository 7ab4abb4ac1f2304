//! Report on a measurement for a terminal: errors first, then times, then what was refused and why.

use super::TextTable;
use super::errors::ERRORS;
use super::number::{mebibytes, milliseconds, significant};
use crate::experiment::{Measurement, StrategyMeasurement};

/// The report as text.
pub fn text(report: &Measurement) -> String {
    let mut text = format!(
        "{} ({} triangles) at {} x {} on {}\n",
        report.scene,
        report.triangles,
        report.resolution[0],
        report.resolution[1],
        report.adapter.in_words()
    );
    let exact = &report.exact;
    text.push_str(&format!(
        "exact: {} cap px, {} surface px, {} undecided px{}, {} ms on the CPU\n",
        exact.cap_px,
        exact.surface_px,
        exact.undecided_px,
        (exact.judged_px).map_or_else(String::new, |px| format!(", {px} judged px")),
        milliseconds(exact.time_ms)
    ));
    // One number applies to all strategies, as an adapter has only one rasteriser.
    if let Some(px) = report.strategies.iter().find_map(|s| s.undecided_px) {
        text.push_str(&format!("undecided for the hardware rasteriser: {px} px\n"));
    }
    text.push('\n');
    text.push_str(&errors(report).to_text());
    text.push('\n');
    text.push_str(&times(report).to_text());
    for line in shortfalls(report) {
        text.push_str(&format!("\n{line}"));
    }
    if text.ends_with('\n') {
        text
    } else {
        text + "\n"
    }
}

/// Errors of each strategy, in pixels, scene units and degrees.
fn errors(report: &Measurement) -> TextTable {
    let words = ERRORS.iter().map(|(word, _)| *word);
    let heading = std::iter::once("error").chain(words);
    let mut table = TextTable::new(heading.chain(["depth max", "normal max deg"]));
    for strategy in &report.strategies {
        let Some(c) = &strategy.comparison else {
            table.row([strategy.name.as_str(), strategy.outcome.name()]);
            continue;
        };
        let counts = ERRORS.iter().map(|(_, count)| count(c).to_string());
        let numbers = [
            significant(c.depth_error_max),
            format!("{:.2}", c.normal_error_deg_max),
        ];
        let cells = counts.chain(numbers);
        table.row(std::iter::once(strategy.name.clone()).chain(cells));
    }
    table
}

/// Costs of each strategy.
fn times(report: &Measurement) -> TextTable {
    let mut table = TextTable::new([
        "time, median ms",
        "solid",
        "cut",
        "frame",
        "frame min..max",
        "x draw only",
        "x uncut",
        "cut alone",
        "ns/px",
        "MiB solid",
        "MiB cut",
        "MiB frame",
    ]);
    let draw_only = &report.draw_only_ms;
    let [least, most] = draw_only.range();
    table.row([
        "draw only".to_owned(),
        "-".to_owned(),
        "-".to_owned(),
        milliseconds(draw_only.median),
        format!("{}..{}", milliseconds(least), milliseconds(most)),
        "1.00".to_owned(),
    ]);
    if let Some(uncut) = &report.draw_only_compute_ms {
        let [least, most] = uncut.range();
        table.row([
            "draw only, compute".to_owned(),
            "-".to_owned(),
            "-".to_owned(),
            milliseconds(uncut.median),
            format!("{}..{}", milliseconds(least), milliseconds(most)),
            two_digits(Some(uncut.over(draw_only).median)),
        ]);
    }
    for strategy in report.strategies.iter().filter(|s| s.was_drawn()) {
        table.row(time_row(strategy));
    }
    table
}

fn time_row(strategy: &StrategyMeasurement) -> Vec<String> {
    let time = &strategy.time_ms;
    let [least, most] = time.frame.range();
    let ratio = strategy.frame_over_draw_only;
    vec![
        strategy.name.clone(),
        milliseconds(time.solid.median),
        milliseconds(time.cut.median),
        milliseconds(time.frame.median),
        format!("{}..{}", milliseconds(least), milliseconds(most)),
        two_digits(ratio),
        two_digits(strategy.cut.map(|c| c.over_uncut)),
        two_digits(strategy.cut.map(|c| c.ms)),
        two_digits(strategy.cut.and_then(|c| c.ns_per_px)),
        mebibytes(strategy.bytes.solid),
        mebibytes(strategy.bytes.cut),
        mebibytes(strategy.bytes.frame),
    ]
}

fn two_digits(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |v| format!("{v:.2}"))
}

/// A line for each strategy that did not draw the whole frame.
fn shortfalls(report: &Measurement) -> Vec<String> {
    let short = report.strategies.iter().filter_map(|s| {
        let reason = s.reason.as_ref()?;
        Some(format!("{} {}: {reason}", s.name, s.outcome.name()))
    });
    short.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;

    #[test]
    fn the_text_says_what_was_found_and_what_was_refused() {
        let text = text(&example());
        for said in [
            "crank (12 triangles) at 64 x 48 on A & B",
            "10 cap px",
            "raycast+mask",
            "1.50",
            "planar+<mask> refused: a relief | is no plane",
        ] {
            assert!(text.contains(said), "{said} is missing from\n{text}");
        }
        assert!(text.ends_with('\n'), "the last line ends");
    }
}
