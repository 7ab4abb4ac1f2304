//! Cap surfaces.
//!
//! Most fill the one list of crossings per pixel ([`list`]), which every inside test that sees the camera's rays asks about. The
//! tessellated ones are drawn by the paper's rule as well ([`paper::record`]), where an inside test answers for points instead.

pub mod adaptive;
mod cutter;
pub mod grid;
pub mod paper;
pub mod planar;
pub mod raycast;
pub mod tessellation;

use super::row::{CapSurface, Caps};
use super::unpaired;
use crate::passes::{Crossings, Recorder, Refusal, Store};
use crate::plan::Capacities;

/// How many crossings a pixel is given room for.
pub fn capacity(recorder: &Recorder<'_>, capacities: &Capacities) -> u32 {
    raycast::capacity(recorder, capacities)
}

/// Records the passes that write the list of crossings, and makes every pixel ready for its first fragment on the way; a refusal where
/// a cap surface has none.
pub fn list(
    recorder: &mut Recorder<'_>,
    surface: CapSurface,
    capacity: u32,
    store: &Store,
    capacities: &Capacities,
) -> Result<Crossings, Refusal> {
    let steps = surface.steps();
    match surface.row().caps {
        Caps::Rays(list) => list(recorder, steps, capacity, store, capacities),
        Caps::Triangles(tessellate) => {
            tessellation::list(recorder, capacity, store, capacities, |recorder| {
                tessellate(recorder, steps, false, capacities)
            })
        }
        Caps::Alone(_) => Err(unpaired(surface, "lists no crossings")),
    }
}
