//! Cap surfaces.

pub mod grid;
pub mod raycast;
