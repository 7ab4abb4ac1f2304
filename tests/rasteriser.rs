//! The compute rasteriser covers what it must, exactly once, and draws what the GPU's own rasteriser draws.

mod common;

#[path = "rasteriser/agree.rs"]
mod agree;
#[path = "rasteriser/coverage.rs"]
mod coverage;
#[path = "rasteriser/plans.rs"]
mod plans;
#[path = "rasteriser/solids.rs"]
mod solids;
#[path = "rasteriser/ways.rs"]
mod ways;
