//! How rays traverse reliefs.

use std::fmt;

/// How a ray traverses the heights of a relief.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ReliefWalk {
    /// From cell to cell.
    Cells,
    /// Over the nodes of a pyramid, and cell by cell near the relief.
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
