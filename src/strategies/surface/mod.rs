//! Cap surfaces.
//!
//! Most fill the one list of crossings per pixel ([`list`]), which every inside test that sees the camera's rays asks about. The
//! tessellated ones are drawn by the paper's rule as well ([`grid::record`]), where an inside test answers for points instead.

pub mod adaptive;
pub mod grid;
mod raycast;
pub mod tessellation;

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
    _capacities: &Capacities,
) -> Result<Crossings, String> {
    match surface {
        CapSurface::Raycast => Ok(raycast::record(recorder, capacity, store)),
        CapSurface::Grid { .. } | CapSurface::Adaptive { .. } => {
            Err(format!("{surface} lists no crossings yet"))
        }
        CapSurface::Planar | CapSurface::Alone => Err(format!("{surface} lists no crossings")),
    }
}
