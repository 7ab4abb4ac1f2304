//! Broken meshes: who is wrong least, and who says so.

use super::figures::{counts, ranged, shares};
use super::inputs::best_marker;
use super::point::Point;
use crate::experiment::Record;
use crate::report::derived::{harms, has_defect};
use crate::report::document::{Cell, Grid, Tone};

/// A row for each defect and strategy; none where no point has another scene for its truth.
pub(super) fn grid(points: &[Point<'_>]) -> Option<Grid> {
    let mut grid = Grid::new(
        "broken meshes",
        [
            "defect",
            "strategy",
            "points",
            "drawn",
            "wrong, of the exact cap",
            "wrong and unmarked px",
            "frame, × draw only",
            "best",
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
        let marker = best_marker(&harms).map(|h| &h.standing.name);
        for (place, harm) in harms.iter().enumerate() {
            let standing = &harm.standing;
            let count = |n: usize| Cell::number(n.to_string(), n as f64);
            let is_least = place == 0 && standing.refused() == 0;
            let is_marker = marker == Some(&standing.name);
            let tone = |is_best: bool| if is_best { Tone::Good } else { Tone::Plain };
            let best = match (is_least, is_marker) {
                (true, true) => "least wrong, least unmarked",
                (true, false) => "least wrong",
                (false, true) => "least unmarked",
                (false, false) => "",
            };
            grid.row([
                Cell::from(*run).titled(format!("{experiment}, run {run}")),
                Cell::from(standing.name.as_str()),
                count(standing.asked),
                count(standing.drawn),
                shares(harm.wrong).toned(tone(is_least)),
                counts(harm.unmarked_px).toned(tone(is_marker)),
                ranged(standing.ratio),
                Cell::from(best),
            ]);
        }
    }
    (!runs.is_empty()).then_some(grid)
}
