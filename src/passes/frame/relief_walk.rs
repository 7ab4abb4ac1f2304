//! Ray traversal of reliefs.

use std::fmt;

/// Method of ray traversal through the heights of a relief.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ReliefWalk {
    /// From cell to cell.
    Cells,
    /// Over nodes of a pyramid; cell by cell where the relief is near.
    Pyramid,
}

impl fmt::Display for ReliefWalk {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cells => "cells",
            Self::Pyramid => "pyramid",
        })
    }
}
