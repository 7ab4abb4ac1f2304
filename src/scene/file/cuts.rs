//! `[[cut]]`: clip-surfaces in three forms, and the parts they cut.
//!
//! `{ origin, u, v, scale }` is the paper's own parametrisation; `{ section = "z=50%" }` and `{ normal, origin }` are
//! planes whose relief is placed by `amplitude` and `period`. `flip = true` keeps the other side in all of them. A closed mesh may
//! be one more of them, or stand alone: [`cutters`].

use std::sync::Arc;

use glam::DVec3;

use super::cutters;
use super::reader::{Entry, Table};
use super::reliefs::Maps;
use crate::error::{Result, did_you_mean};
use crate::scene::relief::{Placement, parse_wrap, place_map};
use crate::scene::section::section_surface;
use crate::scene::{Bounds, ClipSurface, Cut, OffsetMap, Part, Wrap};

const KEYS: &[&str] = &[
    "name",
    "applies_to",
    "except",
    "surfaces",
    "volume",
    "translate",
    "rotate_deg",
    "scale",
    "pivot",
    "matrix",
    "flip",
];
const FULL: &[&str] = &["origin", "u", "v", "scale", "relief", "wrap", "flip"];
const SECTION: &[&str] = &["section", "relief", "amplitude", "period", "wrap", "flip"];
const NORMAL: &[&str] = &[
    "normal",
    "origin",
    "relief",
    "amplitude",
    "period",
    "wrap",
    "flip",
];

/// What a cut may refer to.
pub(super) struct Context<'a> {
    pub(super) parts: &'a [Part],
    /// Names of all parts that there are at any time.
    pub(super) names: &'a [String],
    pub(super) bounds: Bounds,
    pub(super) maps: &'a Maps,
}

/// Reads one cut.
pub(super) fn read(
    entry: &Entry<'_>,
    index: usize,
    cutter: Option<&cutters::Held>,
    context: &Context<'_>,
    notes: &mut Vec<String>,
) -> Result<Cut> {
    let table = entry.table(KEYS)?;
    let name = match table.get("name") {
        Some(name) => name.text()?.to_owned(),
        None => format!("{index}"),
    };
    let volume = cutters::read(&table, cutter)?;
    let surfaces = match table.get("surfaces") {
        None if volume.is_some() => None,
        _ => Some(table.need("surfaces", "[{ section = \"z=50%\" }]")?),
    };
    let all = surfaces.as_ref().map_or(Ok(Vec::new()), |s| s.list())?;
    if let Some(surfaces) = &surfaces
        && all.is_empty()
    {
        return Err(surfaces.fault("a cut needs a surface", "add `{ section = \"z=50%\" }`"));
    }
    let all = all
        .iter()
        .map(|s| surface(s, context))
        .collect::<Result<_>>()?;
    let mut cut = Cut::of(name, all);
    cut.volume = volume;
    if let Some(globs) = table.get("applies_to") {
        cut.applies_to = globs_of(&globs, context)?;
    }
    if let Some(globs) = table.get("except") {
        cut.except = globs_of(&globs, context)?;
    }
    if !context.parts.iter().any(|p| cut.applies_to(p)) {
        notes.push(format!("{}: it cuts no part", entry.key));
    }
    Ok(cut)
}

/// Globs; one without a wildcard has to be the name of a part, for it can be nothing but a slip otherwise.
fn globs_of(entry: &Entry<'_>, context: &Context<'_>) -> Result<Vec<String>> {
    let globs = entry.texts()?;
    let names = || context.names.iter().map(String::as_str);
    for glob in &globs {
        if !glob.contains(['*', '?']) && !names().any(|n| n == glob) {
            let what = format!("there is no part `{glob}`");
            return Err(entry.fault(what, did_you_mean(glob, names())));
        }
    }
    Ok(globs)
}

fn surface(entry: &Entry<'_>, context: &Context<'_>) -> Result<ClipSurface> {
    let open = entry.open_table()?;
    let surface = if open.get("section").is_some() {
        let table = entry.table(SECTION)?;
        let section = table.need("section", "\"z=50%\"")?;
        let plane = section_surface(section.text()?, &context.bounds);
        on_plane(plane.map_err(|e| section.place(e))?, &table, context)?
    } else if open.get("normal").is_some() {
        let table = entry.table(NORMAL)?;
        let normal = table.need("normal", "[0, 0, 1]")?;
        let [x, y, z] = normal.vector::<3>()?;
        let [px, py, pz] = match table.get("origin") {
            Some(origin) => origin.vector::<3>()?,
            None => context.bounds.centre().to_array(),
        };
        let plane = section_surface(&format!("{x},{y},{z}@{px},{py},{pz}"), &context.bounds);
        on_plane(plane.map_err(|e| normal.place(e))?, &table, context)?
    } else {
        in_full(&entry.table(FULL)?, context)?
    };
    if let Some(what) = surface.defect() {
        let mend = "u and v must be finite, not zero and at a right angle; u = [1, 0, 0], v = [0, 1, 0] keep z > origin";
        return Err(entry.fault(what, mend));
    }
    let flip = open.get("flip").map_or(Ok(false), |f| f.flag())?;
    Ok(if flip { surface.flipped() } else { surface })
}

/// The paper's form: nothing is computed, nothing moved.
fn in_full(table: &Table<'_>, context: &Context<'_>) -> Result<ClipSurface> {
    let or = |key: &str, usual: DVec3| match table.get(key) {
        Some(entry) => entry.vector().map(DVec3::from),
        None => Ok(usual),
    };
    Ok(ClipSurface {
        origin: or("origin", DVec3::ZERO)?,
        u: DVec3::from(table.need("u", "[1, 0, 0]")?.vector()?),
        v: DVec3::from(table.need("v", "[0, 1, 0]")?.vector()?),
        scale: or("scale", DVec3::ONE)?,
        relief: map_of(table, context)?,
        wrap: wrap_of(table)?,
    })
}

fn on_plane(plane: ClipSurface, table: &Table<'_>, context: &Context<'_>) -> Result<ClipSurface> {
    let Some(map) = map_of(table, context)? else {
        for key in ["amplitude", "period", "wrap"] {
            if let Some(entry) = table.get(key) {
                let mend = "add `relief = \"NAME\"`, or remove the key";
                return Err(entry.fault("a plane has none: there is no relief", mend));
            }
        }
        return Ok(plane);
    };
    let amount = |key: &str| table.get(key).map(|e| e.amount()).transpose();
    let placement = Placement {
        amplitude: amount("amplitude")?.unwrap_or(Placement::default().amplitude),
        period: amount("period")?,
        wrap: wrap_of(table)?,
    };
    let placed = match placement.defect() {
        Some(what) => Err(what),
        None => place_map(plane, map, &placement, &context.bounds),
    };
    placed.map_err(|what| {
        let mend = "give `amplitude` and `period` in scene units, or as \"6%\" of the diagonal";
        table.entry.fault(what, mend)
    })
}

fn map_of(table: &Table<'_>, context: &Context<'_>) -> Result<Option<Arc<OffsetMap>>> {
    let Some(entry) = table.get("relief") else {
        return Ok(None);
    };
    let name = entry.text()?;
    if let Some(map) = context.maps.get(name) {
        return Ok(Some(Arc::clone(map)));
    }
    let mend = if context.maps.is_empty() {
        format!("describe it in a table [relief.{name}]")
    } else {
        did_you_mean(name, context.maps.keys().map(String::as_str))
    };
    Err(entry.fault(format_args!("there is no relief `{name}`"), mend))
}

fn wrap_of(table: &Table<'_>) -> Result<Wrap> {
    let Some(entry) = table.get("wrap") else {
        return Ok(Wrap::default());
    };
    let name = entry.text()?;
    parse_wrap(name).map_err(|mend| entry.fault(format_args!("{name:?} is no wrap mode"), mend))
}
