//! Glossary of the words in the tables, as one short table.

use super::figures::percent;
use super::pictures;
use crate::report::derived::BETWEEN_RUNS;
use crate::report::document::{Cell, Grid, ReportBlock};
use crate::report::recorded::RecordedFolders;

const WORDS: [[&str; 2]; 14] = [
    [
        "undecided",
        "a pixel where sampling is ambiguous within the error of f32: no answer there can be called wrong",
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
        "a hole: a back face where the reference is sure of a surface or a cap, or background where none is within a pixel of it",
    ],
    [
        "outline",
        "background where the reference is sure of a surface or a cap and has background within a pixel: a border that moved",
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
        "missed, leaked, wrong part, interior and edge count all pixels, undecided ones too, so that they may exceed `decided wrong`; cracks and outlines leave undecided ones out",
    ],
    [
        "ratio, ×",
        "time over that of drawing the uncut scene, the median over the rounds",
    ],
    [
        "MAD, ±",
        "median absolute deviation: the median of the distances of the rounds of one point from their median, in one run",
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
            "how another run differs: by the load, the clock rate and the caches of the machine, by the order of the points. Two runs of the curated \
             experiments on one machine differed by up to {} in a ratio, where the deviation within each run was 5 %",
            percent(BETWEEN_RUNS)
        ),
    ]);
    vec![
        ReportBlock::Grid(grid),
        ReportBlock::Text("Colours of pictures of errors:".to_owned()),
        ReportBlock::Swatches(pictures::colors()),
    ]
}
