//! Promise: what is inside of a closed mesh can be cut away, alone or with planes and reliefs, standing or moving, and every inside
//! test and both rasterisers draw it as exactly as they draw a plane.

#[path = "common/command.rs"]
mod command;
mod common;

#[path = "cutters/agree.rs"]
mod agree;
#[path = "cutters/exact.rs"]
mod exact;
#[path = "cutters/files.rs"]
mod files;
#[path = "cutters/moving.rs"]
mod moving;
#[path = "cutters/plans.rs"]
mod plans;
#[path = "cutters/real.rs"]
mod real;
#[path = "cutters/scenes.rs"]
mod scenes;
