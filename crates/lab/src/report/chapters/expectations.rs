//! Expectations and their results.

use super::figures::counted;
use crate::experiment::{Reached, Record};
use crate::report::document::{Cell, Grid, ReportBlock, Tone};

/// Notices of a point's missed expectations.
pub(super) fn missed(expectations: &[Reached]) -> impl Iterator<Item = ReportBlock> {
    expectations.iter().filter(|r| !r.holds).map(missed_notice)
}

/// A strategy's expectation that several points of a run have in common.
struct SharedExpectation<'a> {
    first: &'a Reached,
    reached: usize,
    missed: usize,
    /// Distinct measured results.
    found: Vec<&'a str>,
}

/// The expectations of some points in one table, for all strategies or only one; missed expectations come first.
pub(super) fn of_run(records: &[&Record], only: Option<&str>) -> Option<ReportBlock> {
    let mut all: Vec<SharedExpectation<'_>> = Vec::new();
    let expected = records.iter().flat_map(|r| &r.expectations);
    for reached in expected.filter(|r| only.is_none_or(|name| r.strategy == name)) {
        let is_it = |s: &&mut SharedExpectation<'_>| {
            s.first.strategy == reached.strategy && s.first.expected == reached.expected
        };
        let place = match all.iter_mut().find(is_it) {
            Some(shared) => shared,
            None => {
                all.push(SharedExpectation {
                    first: reached,
                    reached: 0,
                    missed: 0,
                    found: Vec::new(),
                });
                let last = all.len() - 1;
                &mut all[last]
            }
        };
        place.reached += usize::from(reached.holds);
        place.missed += usize::from(!reached.holds);
        if !place.found.contains(&reached.found.as_str()) {
            place.found.push(&reached.found);
        }
    }
    if all.is_empty() {
        return None;
    }
    all.sort_by_key(|s| s.missed == 0);
    let heading = ["strategy", "expected", "found", "at", "", "why"];
    let mut grid = Grid::new("expectations", heading);
    for shared in &all {
        let expected = &shared.first.expected;
        let (word, tone) = match (shared.missed, &expected.why) {
            (0, Some(_)) => ("declared".to_owned(), Tone::Fair),
            (0, None) => ("reached".to_owned(), Tone::Good),
            (missed, _) => (format!("{missed} missed"), Tone::Bad),
        };
        grid.row([
            Cell::from(shared.first.strategy.as_str()),
            Cell::from(expected.what.as_str()),
            found(&shared.found),
            Cell::from(counted(shared.reached + shared.missed, "point")),
            Cell::from(word).toned(tone),
            Cell::from(expected.why.clone().unwrap_or_default()),
        ]);
    }
    let missed: usize = all.iter().map(|s| s.missed).sum();
    let count = all.iter().map(|s| s.reached + s.missed).sum();
    let of_them = match missed {
        0 => "all reached".to_owned(),
        missed => format!("{missed} missed"),
    };
    Some(ReportBlock::Folded {
        summary: format!("{}: {of_them}", counted(count, "expectation")),
        open: false,
        blocks: vec![ReportBlock::Grid(grid)],
    })
}

/// Cell with the results at several points; the tooltip lists all of them.
fn found(all: &[&str]) -> Cell {
    const MOST: usize = 3;
    match all.len() {
        ..=MOST => Cell::from(all.join("; ")),
        many => {
            let text = format!("{}; and {} more", all[..MOST].join("; "), many - MOST);
            Cell::from(text).titled(all.join("; "))
        }
    }
}

/// Notice of a missed expectation.
pub(super) fn missed_notice(reached: &Reached) -> ReportBlock {
    ReportBlock::Notice(
        Tone::Bad,
        format!(
            "Expectation missed by {}. Expected: {}. Found: {}.",
            reached.strategy, reached.expected.what, reached.found
        ),
    )
}
