//! The crossings of each pixel's ray with the clip-surfaces, as passes ask for them: who makes the one list is a cap surface, who reads it
//! is everybody. Where the only clip-surface is a plane there need be none: each asks the plane.

use super::SceneBuffers;
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

/// What fills `cutaway::crossings` in a shader.
#[derive(Clone, Debug)]
pub(crate) struct AskedCrossings {
    /// The file.
    pub file: &'static str,
    /// What it binds.
    pub bindings: Vec<Binding>,
}

impl Crossings {
    /// The bindings of `shaders/lib/crossings/list.wgsl`.
    pub(crate) fn bindings(&self) -> [Binding; 3] {
        [
            Binding::read("crossing_heads", self.heads),
            Binding::read("crossing_z", self.z),
            Binding::read("crossing_surface", self.surfaces),
        ]
    }

    /// The list, for who may as well ask a plane.
    pub(crate) fn asked(&self) -> AskedCrossings {
        AskedCrossings {
            file: LISTED,
            bindings: self.bindings().into(),
        }
    }
}

impl AskedCrossings {
    /// Whether they are those of a list: then the pass that makes it has made every pixel ready for its first fragment too.
    pub(super) fn are_listed(&self) -> bool {
        self.file == LISTED
    }

    /// The only clip-surface, a plane.
    pub(crate) fn of_plane(scene: &SceneBuffers<'_>) -> Self {
        Self {
            file: "lib/crossings/plane.wgsl",
            bindings: vec![scene.ray_table.clone()],
        }
    }
}

/// The file that reads the list.
pub(crate) const LISTED: &str = "lib/crossings/list.wgsl";
