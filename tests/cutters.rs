//! Promise: what is inside of a closed mesh can be cut away, alone or with planes and reliefs, standing or moving, and every inside
//! test and both rasterisers draw it as exactly as they draw a plane.

mod common;

#[path = "cutters/agree.rs"]
mod agree;
#[path = "cutters/exact.rs"]
mod exact;
#[path = "cutters/scenes.rs"]
mod scenes;
