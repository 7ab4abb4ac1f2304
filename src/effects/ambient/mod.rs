//! Ambient occlusion: the fraction of the sky that is visible from a point, by three methods.

pub(super) mod horizon;
pub(super) mod occlusion;
pub(super) mod relief_sky;
mod unsharp;
