//! `drift` of a run: how its camera moves.

use crate::Result;
use crate::document::reader::Table;
use crate::experiment::drift::Drift;

/// Reads it, if it is there.
pub(super) fn drift(table: &Table<'_>) -> Result<Option<Drift>> {
    let Some(entry) = table.get("drift") else {
        return Ok(None);
    };
    let table = entry.table(&["frames", "px", "samples"])?;
    let frames = table.need("frames", "64")?;
    let px = table.need("px", "0.015625")?;
    let drift = Drift {
        frames: frames.whole()?,
        px: px.number()?,
        samples: match table.get("samples") {
            Some(samples) => samples.whole()?,
            None => 0,
        },
    };
    if drift.samples > 16 {
        let samples = table.need("samples", "4")?;
        return Err(samples.fault("a picture of so many samples is never drawn", "use 2 to 16"));
    }
    if !(2..=4096).contains(&drift.frames) {
        return Err(frames.fault("nothing changes between so many frames", "use 2 to 4096"));
    }
    Ok(Some(drift))
}
