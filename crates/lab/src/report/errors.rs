//! The counts of wrong pixels, each with its name in tables, which are in the same order on the terminal and on the page.

use crate::Comparison;

/// A word, and the count that it stands for.
pub(super) type ErrorCount = (&'static str, fn(&Comparison) -> usize);

/// All of them, the sum first.
pub(super) const ERRORS: [ErrorCount; 9] = [
    ("decided wrong px", |c| c.decided_wrong_px),
    ("missed cap", |c| c.missed_cap_px),
    ("leaked cap", |c| c.leaked_cap_px),
    ("wrong part", |c| c.wrong_part_px),
    ("crack", |c| c.crack_px),
    ("outline", |c| c.outline_px),
    ("interior", |c| c.interior_wrong_px),
    ("edge", |c| c.edge_wrong_px),
    ("unreliable", |c| c.odd_parity_px),
];
