//! Promise: parts that move are cut and capped as exactly as parts that stand still, in every pose, by every rasteriser; what did
//! not move is not built again; no frame shows what was right a frame ago.
//!
//! The device poses in f32, the reference in f64 (`Part::posed_mesh`), and here a third time, from the definition.

use crate::common;

mod actors;
mod clocks;
mod frames;
mod memory;
mod models;
mod vertices;
