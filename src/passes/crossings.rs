//! The one list of crossings per pixel, as resources: who makes it is a cap surface, who reads it is everybody.

use crate::plan::{Binding, ResourceId};

/// The list of crossings.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossings {
    /// Count and starting sides, 8 bytes per pixel.
    pub heads: ResourceId,
    /// Depth-buffer values.
    pub z: ResourceId,
    /// Clip-surfaces.
    pub surfaces: ResourceId,
    /// How many a pixel has room for.
    pub capacity: u32,
}

impl Crossings {
    /// The bindings of `shaders/lib/crossings.wgsl`.
    pub(crate) fn bindings(&self) -> [Binding; 3] {
        [
            Binding::read("crossing_heads", self.heads),
            Binding::read("crossing_z", self.z),
            Binding::read("crossing_surface", self.surfaces),
        ]
    }
}
