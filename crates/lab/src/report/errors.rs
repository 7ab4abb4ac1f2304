//! The counts of wrong pixels with their names in tables. The order of the counts is the same on the terminal and on the page.

use crate::Comparison;

/// Name of a count in tables, and the function that reads the count.
pub(super) type ErrorCount = (&'static str, fn(&Comparison) -> usize);

/// All counts, the sum first.
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
