//! Clip-surfaces and cuts in scene space: plain data.

use std::sync::Arc;

use glam::DVec3;

use super::PreparedVolume;
use crate::scene::{OffsetMap, SurfaceFrame, Wrap};

/// A clip-surface in scene space. `T = map_from_scene * (P - origin)`, kept height `(P - origin).N + f(T).height_scale`.
#[derive(Clone, Debug)]
pub struct PreparedSurface {
    /// `O`, rounded to f32 if it is near the model; for a repeating relief, the repeat of `O` near the model.
    pub origin: DVec3,
    /// `Û`, `V̂`, `N`.
    pub frame: SurfaceFrame,
    /// Texture coordinates per scene unit along `Û` and `V̂`: `Sx / |U|` and `Sy / |V|`.
    pub map_per_unit: [f64; 2],
    /// `Sz` in scene units.
    pub height_scale: f64,
    /// Offset map, for a relief.
    pub relief: Option<Arc<OffsetMap>>,
    /// Address mode of the map outside 0..1.
    pub wrap: Wrap,
    /// A closed mesh that replaces plane and relief: its inside is the removed side.
    pub volume: Option<Arc<PreparedVolume>>,
    /// Index into [`Prepared::cuts`](crate::scene::Prepared::cuts).
    pub cut: usize,
}

/// A cut, as the indices of its clip-surfaces.
#[derive(Clone, Debug)]
pub struct PreparedCut {
    /// Name of the cut.
    pub name: String,
    /// Index in [`Scene::cuts`](crate::scene::Scene::cuts).
    pub of: usize,
    /// Offset from the scene's cut, in world units; positive keeps more ([`Cut::offsets`](crate::scene::Cut::offsets)).
    pub keeps: f64,
    /// Indices into [`Prepared::surfaces`](crate::scene::Prepared::surfaces); the intersection of their removed sides is removed.
    pub surfaces: Vec<usize>,
}
