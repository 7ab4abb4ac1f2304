//! What of a frame is neither scene nor strategy.

use crate::passes::{Rasteriser, ReliefWalk};
use crate::scene::HeightFilter;

/// What of a frame is neither scene nor strategy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameOptions {
    /// Who rasterises the mesh.
    pub rasteriser: Rasteriser,
    /// Whether the compute rasteriser uses atomics of 64 bits: the picture is the same, in one sweep instead of two. `None`
    /// leaves it to the adapter, and to core WebGPU where a plan is recorded without one.
    pub wide_atomics: Option<bool>,
    /// How rays are followed through reliefs: the crossings are the same. `None` chooses by the cells that a ray meets.
    pub relief_walk: Option<ReliefWalk>,
    /// Who interpolates the heights of reliefs between texels. `None` is exact; planes hear nothing of it, and strategies that do not
    /// ask for heights at points refuse any other.
    pub height_filter: Option<HeightFilter>,
    /// Shows caps that several solids share in this colour, sRGB.
    pub interference: Option<[u8; 3]>,
}

impl FrameOptions {
    /// The usual options, drawn by this rasteriser.
    pub const fn by(rasteriser: Rasteriser) -> Self {
        Self {
            rasteriser,
            wide_atomics: None,
            relief_walk: None,
            height_filter: None,
            interference: None,
        }
    }
}
