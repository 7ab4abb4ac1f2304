//! Ambient occlusion: how much of the sky a point sees, by three methods.

pub(super) mod horizon;
pub(super) mod occlusion;
pub(super) mod relief_sky;
mod unsharp;
