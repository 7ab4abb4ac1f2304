//! Glossary of the words used in the tables.

use super::figures::percent;
use super::pictures;
use crate::report::derived::BETWEEN_RUNS;
use crate::report::document::{Cell, Grid, ReportBlock};
use crate::report::recorded::RecordedFolders;

const WORDS: [[&str; 2]; 14] = [
    [
        "undecided",
        "a pixel where sampling is ambiguous within f32 rounding errors, so that no result there can be called wrong",
    ],
    [
        "decided wrong",
        "a wrong pixel where the reference is sure: undecided pixels are left out",
    ],
    [
        "missed cap",
        "the reference has a cap there, the strategy has none",
    ],
    [
        "leaked cap",
        "the strategy has a cap there, the reference has none",
    ],
    [
        "wrong part",
        "both have the same kind there, but the part or, for a cap, the clip-surface differs",
    ],
    [
        "crack",
        "a hole: where the reference is sure of a surface or a cap, the strategy has a back face, or has background although the reference has none within a pixel",
    ],
    [
        "outline",
        "a border that moved: the strategy has background where the reference is sure of a surface or a cap, and the reference has background within a pixel",
    ],
    [
        "interior",
        "a wrong pixel farther than one pixel from every border of the reference image",
    ],
    [
        "edge",
        "a wrong pixel within one pixel of a border of the reference image",
    ],
    [
        "unreliable (marked)",
        "a pixel that the strategy itself marks as possibly wrong, whether it is wrong or not",
    ],
    [
        "unmarked wrong",
        "a decided wrong pixel that the strategy does not mark: only a reference shows it",
    ],
    [
        "sums",
        "missed, leaked, wrong part, interior and edge also count undecided pixels, so that they may exceed `decided wrong`; crack and outline do not count undecided pixels",
    ],
    [
        "ratio, ×",
        "time divided by the time to draw the uncut scene, as the median over the rounds",
    ],
    [
        "MAD, ±",
        "median absolute deviation: the median distance of a point's rounds from their median, within one run",
    ],
];

/// The table; empty if nothing was measured.
pub(super) fn chapter(recorded: &RecordedFolders) -> Vec<ReportBlock> {
    let mut experiments = recorded.folders.iter().flat_map(|f| &f.experiments);
    if experiments.all(|e| e.records.is_empty()) {
        return Vec::new();
    }
    let mut grid = Grid::new("what the words mean", ["word", "meaning"]);
    for words in WORDS {
        grid.row(words.map(Cell::from));
    }
    grid.row([
        "what ± does not cover".to_owned(),
        format!(
            "how another run differs, through the load, clock rate and caches of the machine and the order of the points. Two runs of the curated \
             experiments on one machine differed by up to {} in a ratio, although the deviation within each run was 5 %",
            percent(BETWEEN_RUNS)
        ),
    ]);
    vec![
        ReportBlock::Grid(grid),
        ReportBlock::Text("Colours of heat maps:".to_owned()),
        ReportBlock::Swatches(pictures::colors()),
    ]
}
