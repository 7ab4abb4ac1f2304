//! Cap surfaces.
//!
//! Most fill the one list of crossings per pixel ([`list`]), which every inside test that sees the camera's rays asks about. The
//! tessellated ones are drawn by the paper's rule as well ([`paper::record`]), where an inside test answers for points instead.

pub mod adaptive;
mod cutter;
pub mod grid;
pub mod paper;
pub mod planar;
mod raycast;
pub mod tessellation;

use tessellation::Tessellation;

use super::CapSurface;
use crate::passes::{Crossings, Recorder, Store};
use crate::plan::Capacities;

/// How many crossings a pixel is given room for.
pub fn capacity(recorder: &Recorder<'_>, capacities: &Capacities) -> u32 {
    raycast::capacity(recorder, capacities)
}

/// Records the passes that write the list of crossings, and makes every pixel ready for its first fragment on the way; the
/// reason where a cap surface has none.
pub fn list(
    recorder: &mut Recorder<'_>,
    surface: CapSurface,
    capacity: u32,
    store: &Store,
    capacities: &Capacities,
) -> Result<Crossings, String> {
    match surface {
        CapSurface::Raycast => cutter::list(recorder, capacity, store, capacities),
        CapSurface::Grid { .. } | CapSurface::Adaptive { .. } => {
            let tessellate = |r: &mut Recorder<'_>| tessellate(r, surface, false, capacities);
            tessellation::list(recorder, capacity, store, capacities, tessellate)
        }
        CapSurface::Planar | CapSurface::Alone => Err(format!("{surface} lists no crossings")),
    }
}

/// The clip-surfaces as triangles, of planes only where they are asked for; the reason where a cap surface makes none, or not of these.
pub fn tessellate(
    recorder: &mut Recorder<'_>,
    surface: CapSurface,
    with_planes: bool,
    capacities: &Capacities,
) -> Result<Tessellation, String> {
    match surface {
        CapSurface::Grid { cells } => Ok(grid::tessellation(recorder, cells)),
        CapSurface::Adaptive { tau } => {
            adaptive::tessellation(recorder, tau, with_planes, capacities)
        }
        CapSurface::Raycast | CapSurface::Planar | CapSurface::Alone => {
            Err(format!("{surface} makes no triangles of clip-surfaces"))
        }
    }
}
