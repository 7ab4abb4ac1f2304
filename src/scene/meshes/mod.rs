//! Triangle meshes: their topology, welding and smoothing of vertices, and analyses made before cutting.

pub(super) mod base;
mod buckets;
pub(super) mod doubled;
mod equal_positions;
pub(super) mod filled_part;
pub(super) mod mesh;
pub(super) mod smooth;
#[doc(hidden)]
pub mod topology;
pub(crate) mod tree;
pub(super) mod triangle;
#[doc(hidden)]
pub mod weld;
