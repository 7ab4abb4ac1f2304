//! Hard cases: scenes with a known answer, numbered, and the outcome that each strategy is expected to reach.
//!
//! The table is `cutaway_lab::hard_cases`, and `table` holds it; the other modules hold what a case asks beyond its outcome.

mod adaptive;
mod algebra;
mod cameras;
mod drift;
mod grids;
mod listed;
mod long_lists;
mod meshes;
mod planes;
mod pyramids;
use crate::common::refined;
mod reliefs;
mod sprites;
mod stencils;
mod table;
mod users;
mod windings;
