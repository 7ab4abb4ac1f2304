//! `volume = "FILE"` in a `[[cut]]`: a closed mesh as cutter, with the same placement keys as parts.
//!
//! As with parts, names are resolved once, when the document is opened. An open mesh is refused then. The placement is read again for every
//! time.

use cutaway::error::Result;
use cutaway::scene::{Bounds, Cutter, too_far};

use crate::document::describe::{CutDesc, PlacementDesc};
use crate::document::read::described::keys_of;
use crate::document::read::opening::LoadContext;
use crate::document::read::parts;
use crate::document::read::reader::{Entry, Table};

/// A cutter's mesh and its bounds.
#[derive(Clone, Debug)]
pub(in crate::document::read) struct CutterSource {
    cutter: Cutter,
    /// Bounds of the mesh as the file places it.
    rest: Bounds,
}

/// Opens the cutters of a document, one for each cut that has one.
pub(in crate::document::read) fn open(
    entries: &[Entry<'_>],
    opening: &mut LoadContext<'_>,
) -> Result<Vec<Option<CutterSource>>> {
    entries
        .iter()
        .map(|entry| {
            let volume = entry.open_table()?.get("volume");
            volume.map(|v| open_one(&v, opening)).transpose()
        })
        .collect()
}

fn open_one(entry: &Entry<'_>, opening: &mut LoadContext<'_>) -> Result<CutterSource> {
    let text = entry.text()?;
    let solids = if text.starts_with("shape:") {
        opening.shape(entry, text)?
    } else {
        opening.mesh(entry, text)?
    };
    let cutter = Cutter::from_parts(text, &solids).map_err(|e| entry.place(e))?;
    Ok(CutterSource {
        rest: cutter.bounds_in_world(),
        cutter,
    })
}

/// The cutter of a cut, if it has one, with its placement at the current time. The bounds of the cut parts are `model`.
pub(in crate::document::read) fn read(
    (table, desc): (&Table<'_>, &CutDesc),
    held: Option<&CutterSource>,
    model: &Bounds,
) -> Result<Option<Cutter>> {
    let Some(held) = held else {
        let of_volume = keys_of(PlacementDesc::FIELDS).into_iter().chain(["flip"]);
        if let Some(entry) = of_volume.filter_map(|key| table.get(key)).next() {
            let help = "add `volume = \"FILE\"`, or place and flip the surfaces themselves";
            return Err(entry.fault("it belongs to a `volume`, and the cut has none", help));
        }
        return Ok(None);
    };
    let placed = held
        .cutter
        .clone()
        .placed(parts::placement(table, &desc.placement, held.rest)?);
    let corners = held.rest.corners();
    let corners = corners.map(|c| placed.world_from_cutter.transform_point3(c));
    if let Some(what) = too_far(&Bounds::from_points(corners), model) {
        let what = format!("`{}` {what} once it is placed", placed.name());
        return Err((table.entry).fault(what, "use a smaller scale or translation"));
    }
    Ok(Some(if desc.flip { placed.flipped() } else { placed }))
}
