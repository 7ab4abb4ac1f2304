//! Broken meshes: which strategy is least wrong, and how many of its wrong pixels it marks.

use super::figures::{counts, ranged, shares};
use super::point::RecordedPoint;
use crate::experiment::Record;
use crate::report::derived::{harms, has_defect, usage};
use crate::report::document::{Cell, Grid, Tone};

/// A table with a row for each defect and strategy; `None` if no point is judged by another scene.
pub(super) fn grid(points: &[RecordedPoint<'_>]) -> Option<Grid> {
    let mut grid = Grid::new(
        "broken meshes",
        [
            "defect",
            "strategy",
            "points",
            "drawn",
            "wrong, of the exact cap",
            "wrong and unmarked px",
            "marked, of the exact cap",
            "frame, × draw only",
            "verdict",
        ],
    );
    let mut runs: Vec<(&str, &str, Vec<&Record>)> = Vec::new();
    for point in points.iter().filter(|p| has_defect(p.record)) {
        let (experiment, run) = (point.record.experiment.as_str(), point.record.run.as_str());
        match runs
            .iter_mut()
            .find(|(e, r, _)| *e == experiment && *r == run)
        {
            Some((.., records)) => records.push(point.record),
            None => runs.push((experiment, run, vec![point.record])),
        }
    }
    for (experiment, run, records) in &runs {
        let harms = harms(records);
        let used = harms
            .iter()
            .position(|h| h.is_usable() && usage(&h.totals.name).is_some());
        for (place, harm) in harms.iter().enumerate() {
            let totals = &harm.totals;
            let count = |n: usize| Cell::number(n.to_string(), n as f64);
            let (word, tone) = match (harm.is_usable(), usage(&totals.name)) {
                (true, _) if used == Some(place) => ("use", Tone::Good),
                (true, None) if place == 0 => ("least wrong, only in compare", Tone::Good),
                (false, _) if totals.refused() == 0 => ("too much is lost", Tone::Faint),
                _ => ("", Tone::Plain),
            };
            grid.row([
                Cell::from(*run).titled(format!("{experiment}, run {run}")),
                Cell::from(totals.name.as_str()),
                count(totals.asked),
                count(totals.drawn),
                shares(harm.wrong).toned(tone),
                counts(harm.unmarked_px),
                shares(harm.marked),
                ranged(totals.ratio),
                Cell::from(word),
            ]);
        }
    }
    (!runs.is_empty()).then_some(grid)
}
