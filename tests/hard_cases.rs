//! Hard cases: scenes with a known answer, numbered, and the outcome that each strategy is expected to reach.
//!
//! The table is `cutaway::hard_cases`, and `table` holds it; the other modules hold what a case asks beyond its outcome.

mod common;

#[path = "hard_cases/adaptive.rs"]
mod adaptive;
#[path = "hard_cases/algebra.rs"]
mod algebra;
#[path = "hard_cases/cameras.rs"]
mod cameras;
#[path = "hard_cases/drift.rs"]
mod drift;
#[path = "hard_cases/grids.rs"]
mod grids;
#[path = "hard_cases/listed.rs"]
mod listed;
#[path = "hard_cases/long_lists.rs"]
mod long_lists;
#[path = "hard_cases/meshes.rs"]
mod meshes;
#[path = "hard_cases/planes.rs"]
mod planes;
#[path = "hard_cases/pyramids.rs"]
mod pyramids;
#[path = "common/refined.rs"]
mod refined;
#[path = "hard_cases/reliefs.rs"]
mod reliefs;
#[path = "hard_cases/sprites.rs"]
mod sprites;
#[path = "hard_cases/stencils.rs"]
mod stencils;
#[path = "hard_cases/table.rs"]
mod table;
#[path = "hard_cases/users.rs"]
mod users;
#[path = "hard_cases/windings.rs"]
mod windings;
