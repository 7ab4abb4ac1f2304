//! What of a frame is neither scene nor strategy.

use crate::passes::Rasteriser;

/// What of a frame is neither scene nor strategy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameOptions {
    /// Who rasterises the mesh.
    pub rasteriser: Rasteriser,
}
