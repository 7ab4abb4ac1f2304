//! What of a frame is neither scene nor strategy.

use crate::passes::Rasteriser;

/// What of a frame is neither scene nor strategy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameOptions {
    /// Who rasterises the mesh.
    pub rasteriser: Rasteriser,
    /// Shows caps that several solids share in this colour, sRGB.
    pub interference: Option<[u8; 3]>,
}

impl FrameOptions {
    /// The usual options, drawn by this rasteriser.
    pub const fn by(rasteriser: Rasteriser) -> Self {
        Self {
            rasteriser,
            interference: None,
        }
    }
}
