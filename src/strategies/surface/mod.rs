//! Cap surfaces.
//!
//! Most fill the one list of crossings per pixel ([`list`]), which every inside test that sees the camera's rays asks about. The
//! tessellated ones are drawn by the paper's rule as well ([`paper::record`]), where an inside test answers for points instead.

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

/// Records the passes that write the list of crossings, with the given capacity per pixel, and makes every pixel ready for its first
/// fragment on the way; a refusal where a cap surface has none.
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
