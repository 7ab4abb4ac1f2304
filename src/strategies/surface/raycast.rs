//! `raycast`: all crossings of each pixel's ray with the clip-surfaces, as one sorted list of depths per pixel.
//!
//! No mesh, no tessellation: planes in closed form, reliefs by a walk over the cells of the offset map with the sign carried
//! from cell to cell and citardauq roots. The list decides surface, cap and inside together, so no pixel can show the inside
//! of the shell. Per frame: one invocation per pixel, time in proportion to the cells that a ray passes inside the slab of
//! heights and the box of the cut solids; 8 bytes per pixel and 4 (one clip-surface) or 8 per crossing it can hold.
//!
//! Cannot: hold more than 31 crossings per pixel. A longer list keeps the nearest, marks the pixel and reports its need.

use crate::passes::{Crossings, NEED_OF_CELLS, NEED_OF_CROSSINGS, Recorder, Store, pixels};
use crate::plan::pack;
use crate::plan::{Binding, Bounded, Capacities, Clock, Knob, Resource};
use crate::shader::Shader;

/// Crossings that one relief is given room for until a frame reports what it needs: with its parity bit a lane of 8.
const FIRST_PER_RELIEF: u32 = 7;

/// How many crossings a pixel is given room for.
pub(super) fn capacity(recorder: &Recorder<'_>, capacities: &Capacities) -> u32 {
    let surfaces = &recorder.relevance.surfaces;
    let reliefs = surfaces
        .iter()
        .filter(|s| recorder.model.is_relief(**s))
        .count() as u32;
    let planes = surfaces.len() as u32 - reliefs;
    let usual = planes + reliefs * FIRST_PER_RELIEF;
    let most = if reliefs == 0 {
        planes
    } else {
        capacities.crossings.unwrap_or(usual).max(planes + reliefs)
    };
    most.clamp(1, Capacities::MOST_CROSSINGS)
}

/// Records the pass that writes the list, and makes every pixel ready for its first fragment on the way. Clip-surfaces with a bit
/// in `sheets` are left to the passes that draw them as triangles.
pub(super) fn record(
    recorder: &mut Recorder<'_>,
    capacity: u32,
    store: &Store,
    sheets: u32,
) -> Crossings {
    let count = pixels(recorder.view.size_px);
    let one_surface = recorder.relevance.surfaces.len() < 2;
    let mut surfaces = recorder.relevance.surfaces.iter().enumerate();
    let reliefs = surfaces.any(|(i, s)| sheets >> i & 1 == 0 && recorder.model.is_relief(*s));
    let mut buffer = |name: &str, bytes: u64| {
        recorder.once(name, |_| Resource::storage(name, bytes, Clock::Frame))
    };
    let crossings = Crossings {
        heads: buffer("crossing_heads", count * 8),
        z: buffer("crossing_z", count * 4 * u64::from(capacity)),
        surfaces: buffer(
            "crossing_surface",
            if one_surface {
                4
            } else {
                count * 4 * u64::from(capacity)
            },
        ),
    };
    let need = recorder.need(Clock::Frame);
    let mut bindings = vec![
        recorder.frame(),
        recorder.cut_table(),
        recorder.ray_table(),
        Binding::write("crossing_heads", crossings.heads),
        Binding::write("crossing_z", crossings.z),
        Binding::write("crossing_surface", crossings.surfaces),
        Binding::write("need", need),
    ];
    bindings.extend(store.begun());
    let (shader, reason) = if reliefs {
        bindings.push(recorder.heights());
        (
            "strategies/surface/raycast/reliefs.wgsl",
            "the one list of depths per pixel; a relief is walked cell by cell",
        )
    } else if sheets == 0 {
        (
            "strategies/surface/raycast/planes.wgsl",
            "the one list of depths per pixel; only planes, so no walk",
        )
    } else {
        (
            "strategies/surface/raycast/planes.wgsl",
            "the one list of depths per pixel; the planes among the clip-surfaces, for reliefs are drawn as sheets",
        )
    };
    let mut constants = vec![("capacity", f64::from(capacity))];
    if sheets != 0 {
        constants.push(("sheets", f64::from(sheets)));
    }
    recorder.compute(
        "crossings",
        Clock::Frame,
        reason,
        Shader::from(shader).with(store.file),
        bindings,
        constants,
        recorder.view.size_px,
    );
    recorder.plan.bounded.push(Bounded {
        what: "crossings per pixel".to_owned(),
        slot: NEED_OF_CROSSINGS,
        capacity,
        knob: Some(Knob::Crossings),
        exact: false,
    });
    if reliefs {
        let limits = recorder.relevance.surfaces.iter().map(|number| {
            let surface = &recorder.model.prepared.surfaces[*number];
            pack::cell_limit(surface, recorder.relevance.reach())
        });
        recorder.plan.bounded.push(Bounded {
            what: "cells of a relief along a ray".to_owned(),
            slot: NEED_OF_CELLS,
            capacity: limits.max().unwrap_or(0),
            knob: None,
            exact: false,
        });
    }
    crossings
}
