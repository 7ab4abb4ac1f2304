//! Cap surfaces.
//!
//! Most write the per-pixel list of crossings ([`list`]), which every inside test along the camera's rays reads. The tessellated ones can
//! also be drawn by the paper's rule ([`paper::record`]), with an inside test that answers for points.

pub(crate) mod adaptive;
mod cutter;
pub(crate) mod grid;
pub(crate) mod paper;
pub(crate) mod planar;
pub(crate) mod raycast;
pub(crate) mod tessellation;

use super::row::{CapSurface, Caps, unpaired};
use crate::passes::{Crossings, Refusal, SceneBuffers, Store};
use crate::plan::Plan;

pub(crate) use raycast::capacity;

/// Records the passes that write the list of crossings, with the given capacity per pixel, and that prepare every pixel for its first
/// fragment; a refusal if the cap surface has no list.
pub(crate) fn list(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    surface: CapSurface,
    capacity: u32,
    store: &Store,
) -> Result<Crossings, Refusal> {
    match surface.row().caps {
        Caps::Rays(list) => list(plan, scene, capacity, store),
        Caps::Triangles(tessellate) => {
            tessellation::list(plan, scene, capacity, store, |plan, scene| {
                tessellate(plan, scene, surface.steps(), false)
            })
        }
        Caps::Alone(_) => Err(unpaired(surface, "lists no crossings")),
    }
}
