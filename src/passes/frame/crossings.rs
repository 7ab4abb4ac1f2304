//! The crossings of each pixel's ray with the clip-surfaces. A cap surface makes the per-pixel list, and any pass may read it. If the only
//! clip-surfaces are up to eight planes, no list is needed: each pass evaluates the planes.

use super::buffers::SceneBuffers;
use super::input::Input;
use crate::plan::{Binding, ResourceId};

/// The crossing list.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossings {
    /// Count and starting sides, 8 bytes per pixel.
    pub heads: ResourceId,
    /// Depth-buffer value of each crossing.
    pub z: ResourceId,
    /// Clip-surface of each crossing.
    pub surfaces: ResourceId,
    /// Capacity per pixel, in crossings.
    pub capacity: u32,
    /// File that fills `cutaway::surfaces`.
    pub surfaces_file: &'static str,
}

/// File that fills `cutaway::crossings` in a shader, and its dependencies.
#[derive(Clone, Debug)]
pub(crate) struct CrossingSource {
    /// That file, and those that fill what it imports.
    files: Vec<&'static str>,
    /// File that fills `cutaway::surfaces`.
    pub(crate) surfaces_file: &'static str,
    /// Bindings of the file.
    pub bindings: Vec<Binding>,
    /// Capacity of a list, in crossings; 0 without a list.
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

    /// The list as a crossing source, even where passes could evaluate planes instead.
    pub(crate) fn asked(&self) -> CrossingSource {
        CrossingSource {
            bindings: self.bindings().into(),
            ..CrossingSource::of_capacity(self.capacity, self.surfaces_file)
        }
    }
}

impl CrossingSource {
    /// Describes lists of `capacity` crossings that are not made yet, to estimate the cost of fragments.
    pub(crate) fn to_come(input: &Input<'_>, capacity: u32) -> Self {
        Self::of_capacity(capacity, surfaces_file(input))
    }

    fn of_capacity(capacity: u32, surfaces_file: &'static str) -> Self {
        Self {
            files: vec![LIST, surfaces_file],
            surfaces_file,
            bindings: Vec::new(),
            capacity,
        }
    }

    /// Loop rounds needed to count the crossings in front of a fragment.
    pub(crate) fn rounds(&self) -> u32 {
        match self.surfaces_file {
            ONE_SURFACE if self.capacity > 0 => {
                self.capacity.min(SHORT_LIST).max(self.capacity.ilog2() + 1)
            }
            _ => self.capacity,
        }
    }

    /// The file that fills `cutaway::crossings`, and those that fill what it imports.
    pub(crate) fn files(&self) -> &[&'static str] {
        &self.files
    }

    /// No crossings: nothing is cut.
    pub(crate) fn none() -> Self {
        Self {
            files: vec!["lib/crossings/nothing.wgsl", ONE_SURFACE],
            surfaces_file: ONE_SURFACE,
            bindings: Vec::new(),
            capacity: 0,
        }
    }

    /// The crossings with planes that are the only clip-surfaces.
    pub(crate) fn of_planes(scene: &SceneBuffers<'_>) -> Self {
        let surfaces_file = surfaces_file(scene.input);
        let files = match scene.input.has_one_surface() {
            true => vec!["lib/crossings/plane.wgsl", surfaces_file],
            false => {
                let fours_file = fours_file(scene.input);
                vec!["lib/crossings/planes.wgsl", surfaces_file, fours_file]
            }
        };
        Self {
            files,
            surfaces_file,
            bindings: vec![scene.ray_table.clone()],
            capacity: 0,
        }
    }
}

/// File that fills `cutaway::surfaces` where crossings are listed.
pub(crate) fn surfaces_file(input: &Input<'_>) -> &'static str {
    match input.has_one_surface() {
        true => ONE_SURFACE,
        false => ANY_SURFACES,
    }
}

/// File that fills `cutaway::fours` where clip-surfaces are evaluated four at a time.
pub(crate) fn fours_file(input: &Input<'_>) -> &'static str {
    match input.active_cuts.surfaces.len() > 4 {
        true => "lib/fours/two.wgsl",
        false => "lib/fours/one.wgsl",
    }
}

/// Lists up to this length are searched linearly; must match `shaders/lib/crossings/list.wgsl`.
const SHORT_LIST: u32 = 8;

/// The file that reads the list.
const LIST: &str = "lib/crossings/list.wgsl";
/// The files that read the list for any number of clip-surfaces.
pub(crate) const LISTED: [&str; 2] = [LIST, ANY_SURFACES];
/// File that fills `cutaway::surfaces` for any number of clip-surfaces.
pub(crate) const ANY_SURFACES: &str = "lib/surfaces/any.wgsl";
pub(crate) const ONE_SURFACE: &str = "lib/surfaces/one.wgsl";
