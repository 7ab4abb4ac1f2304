//! The crossings of each pixel's ray with the clip-surfaces. A cap surface makes the one list, and any pass may read it. Where the only
//! clip-surface is a plane no list is needed: each pass evaluates the plane.

use super::buffers::SceneBuffers;
use super::input::Input;
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
    /// Room per pixel, in crossings.
    pub capacity: u32,
    /// File that fills `cutaway::surfaces`.
    pub surfaces_file: &'static str,
}

/// File that fills `cutaway::crossings` in a shader, and its dependencies.
#[derive(Clone, Debug)]
pub(crate) struct CrossingSource {
    file: &'static str,
    /// File that fills `cutaway::surfaces`.
    pub(crate) surfaces_file: &'static str,
    /// Bindings of the file.
    pub bindings: Vec<Binding>,
    /// Crossings that a list has room for; 0 where there is none.
    pub(crate) capacity: u32,
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

    /// The list, for passes that could evaluate a plane instead.
    pub(crate) fn asked(&self) -> CrossingSource {
        CrossingSource {
            bindings: self.bindings().into(),
            ..CrossingSource::of_capacity(self.capacity, self.surfaces_file)
        }
    }
}

impl CrossingSource {
    /// Lists of `capacity` crossings that do not exist yet, used to estimate the cost of fragments.
    pub(crate) fn to_come(input: &Input<'_>, capacity: u32) -> Self {
        let surfaces_file = match input.has_one_surface() {
            true => ONE_SURFACE,
            false => ANY_SURFACES,
        };
        Self::of_capacity(capacity, surfaces_file)
    }

    fn of_capacity(capacity: u32, surfaces_file: &'static str) -> Self {
        Self {
            file: LIST,
            surfaces_file,
            bindings: Vec::new(),
            capacity,
        }
    }

    /// Rounds of a loop until the crossings before a fragment are counted.
    pub(crate) fn rounds(&self) -> u32 {
        match self.surfaces_file {
            ONE_SURFACE if self.capacity > 0 => {
                self.capacity.min(SHORT_LIST).max(self.capacity.ilog2() + 1)
            }
            _ => self.capacity,
        }
    }

    /// The file that fills `cutaway::crossings`, and that which it asks for.
    pub(crate) fn files(&self) -> [&'static str; 2] {
        [self.file, self.surfaces_file]
    }

    /// There are none: nothing is cut.
    pub(crate) fn none() -> Self {
        Self {
            file: "lib/crossings/nothing.wgsl",
            surfaces_file: ONE_SURFACE,
            bindings: Vec::new(),
            capacity: 0,
        }
    }

    /// The only clip-surface, a plane.
    pub(crate) fn of_plane(scene: &SceneBuffers<'_>) -> Self {
        Self {
            file: "lib/crossings/plane.wgsl",
            surfaces_file: ONE_SURFACE,
            bindings: vec![scene.ray_table.clone()],
            capacity: 0,
        }
    }
}

/// Lists up to this length are looked through one by one: `shaders/lib/crossings/list.wgsl`.
const SHORT_LIST: u32 = 8;

/// The file that reads the list.
const LIST: &str = "lib/crossings/list.wgsl";
/// The files that read it whatever the clip-surfaces are.
pub(crate) const LISTED: [&str; 2] = [LIST, ANY_SURFACES];
/// Clip-surface count for shaders: files that fill `cutaway::surfaces`.
pub(crate) const ANY_SURFACES: &str = "lib/surfaces/any.wgsl";
pub(crate) const ONE_SURFACE: &str = "lib/surfaces/one.wgsl";
