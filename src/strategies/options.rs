//! What of a frame is neither scene nor strategy.

use crate::passes::Rasteriser;

/// What of a frame is neither scene nor strategy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameOptions {
    /// Who rasterises the mesh.
    pub rasteriser: Rasteriser,
    /// Whether the compute rasteriser uses atomics of 64 bits: the picture is the same, in one sweep instead of two. `None`
    /// leaves it to the adapter, and to core WebGPU where a plan is recorded without one.
    pub wide_atomics: Option<bool>,
}
