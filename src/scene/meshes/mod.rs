//! Triangle meshes: their topology, how vertices are joined and smoothed, and what is found of them before they are cut.

pub(super) mod base;
pub(super) mod doubled;
pub(super) mod filled_part;
pub(super) mod mesh;
pub(super) mod smooth;
#[doc(hidden)]
pub mod topology;
pub(crate) mod tree;
pub(super) mod triangle;
#[doc(hidden)]
pub mod weld;
