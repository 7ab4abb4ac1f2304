//! Promise: parts that move are cut and capped as exactly as parts that stand still, in every pose, by every rasteriser; what did
//! not move is not built again; no frame shows what was right a frame ago.
//!
//! The device poses in f32, the reference in f64 (`Part::posed_mesh`), and here a third time, from the definition.

mod common;

#[path = "moving/actors.rs"]
mod actors;
#[path = "moving/clocks.rs"]
mod clocks;
#[path = "moving/frames.rs"]
mod frames;
#[path = "moving/memory.rs"]
mod memory;
#[path = "moving/models.rs"]
mod models;
#[path = "moving/vertices.rs"]
mod vertices;
