//! What was expected, and what came of it.

use super::counted;
use crate::experiment::Reached;
use crate::report::document::{Block, Cell, Grid, Tone};

/// The expectations of a point: what was missed is said aloud, the rest on demand.
pub(super) fn blocks(expectations: &[Reached]) -> Vec<Block> {
    if expectations.is_empty() {
        return Vec::new();
    }
    let missed: Vec<&Reached> = expectations.iter().filter(|r| !r.holds).collect();
    let mut blocks: Vec<Block> = missed.iter().map(|r| missed_notice(r)).collect();
    let mut grid = Grid::new("expectations", ["strategy", "expected", "found", "", "why"]);
    let held = expectations.iter().filter(|r| r.holds);
    for reached in missed.iter().copied().chain(held) {
        let (word, tone) = match (reached.holds, &reached.expected.why) {
            (false, _) => ("missed", Tone::Bad),
            (true, Some(_)) => ("declared", Tone::Fair),
            (true, None) => ("reached", Tone::Good),
        };
        grid.row([
            Cell::from(reached.strategy.as_str()),
            Cell::from(reached.expected.what.as_str()),
            Cell::from(reached.found.as_str()),
            Cell::from(word).toned(tone),
            Cell::from(reached.expected.why.clone().unwrap_or_default()),
        ]);
    }
    let summary = match missed.len() {
        0 => format!(
            "{}: all reached",
            counted(expectations.len(), "expectation")
        ),
        missed => format!(
            "{}: {missed} missed",
            counted(expectations.len(), "expectation")
        ),
    };
    blocks.push(Block::Folded {
        summary,
        open: false,
        blocks: vec![Block::Grid(grid)],
    });
    blocks
}

/// What was missed.
pub(super) fn missed_notice(reached: &Reached) -> Block {
    Block::Notice(
        Tone::Bad,
        format!(
            "Expectation missed by {}. Expected: {}. Found: {}.",
            reached.strategy, reached.expected.what, reached.found
        ),
    )
}
