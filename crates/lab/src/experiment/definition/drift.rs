//! Parser of a run's `drift`: how the camera moves.

use cutaway::Result;
use cutaway_io::document::reader::Table;

use crate::experiment::drift::Drift;

/// Reads the drift of a run, if it has one.
pub(super) fn drift(table: &Table<'_>) -> Result<Option<Drift>> {
    let Some(entry) = table.get("drift") else {
        return Ok(None);
    };
    let table = entry.table(&["frames", "px", "zoom", "turn_deg", "fineness", "samples"])?;
    let frames = table.need("frames", "64")?;
    let number = |key, usual| table.get(key).map_or(Ok(usual), |e| e.number());
    let drift = Drift {
        frames: frames.whole()?,
        px: number("px", 0.0)?,
        zoom: number("zoom", 1.0)?,
        turn_deg: number("turn_deg", 0.0)?,
        fineness: table.get("fineness").map_or(Ok(1), |e| e.whole())?,
        samples: table.get("samples").map_or(Ok(0), |e| e.whole())?,
    };
    if (drift.px, drift.zoom, drift.turn_deg) == (0.0, 1.0, 0.0) {
        let help = "write for example `px = 0.015625`, `zoom = 1.01` or `turn_deg = 0.25`";
        return Err(entry.fault("the camera does not move", help));
    }
    if !(0.5..=2.0).contains(&drift.zoom) {
        let zoom = table.need("zoom", "1.01")?;
        return Err(zoom.fault("the zoom between frames must be from 0.5 to 2", "use 1.01"));
    }
    if !(1..=4).contains(&drift.fineness) {
        let fineness = table.need("fineness", "2")?;
        return Err(fineness.fault("it must be from 1 to 4", "use 2, as pictures usually do"));
    }
    if drift.samples > 16 {
        let samples = table.need("samples", "4")?;
        return Err(samples.fault("pictures cannot have this many samples", "use 2 to 16"));
    }
    if !(2..=4096).contains(&drift.frames) {
        return Err(frames.fault("a drift cannot have this number of frames", "use 2 to 4096"));
    }
    Ok(Some(drift))
}
