//! Hard cases: scenes with a known answer, numbered, and the outcome that each strategy is expected to reach.
//!
//! `cases` is the table, of scenes in `solids` and `bumps`, and `table` runs it; the other modules hold what a case asks beyond its outcome.

mod common;

#[path = "hard_cases/algebra.rs"]
mod algebra;
#[path = "hard_cases/band.rs"]
mod band;
#[path = "hard_cases/bumps.rs"]
mod bumps;
#[path = "hard_cases/cameras.rs"]
mod cameras;
#[path = "hard_cases/cases.rs"]
mod cases;
#[path = "hard_cases/grids.rs"]
mod grids;
#[path = "hard_cases/meshes.rs"]
mod meshes;
#[path = "hard_cases/planes.rs"]
mod planes;
#[path = "hard_cases/reliefs.rs"]
mod reliefs;
#[path = "hard_cases/solids.rs"]
mod solids;
#[path = "hard_cases/sprites.rs"]
mod sprites;
#[path = "hard_cases/stencils.rs"]
mod stencils;
#[path = "hard_cases/table.rs"]
mod table;
#[path = "hard_cases/windings.rs"]
mod windings;
