//! `[[cut]]`: clip-surfaces in three forms, boxes and wedges, and the parts they cut.
//!
//! A surface is `{ origin, u, v, scale }`, the paper's own parametrisation, or a plane: `{ section = "z=50%" }` or `{ normal, origin }`,
//! whose relief is placed by `amplitude` and `period`. `flip = true` keeps the other side. A cut removes the intersection of its
//! `surfaces`, `box` and `wedge` ([`regions`]), or lists of boxes and wedges, and a closed mesh ([`cutters`]). `cutout` and `breakaway`
//! ([`cutaways`]) are placed automatically.

use std::sync::Arc;

use cutaway::error::{Diagnostic, Result, did_you_mean};
use cutaway::scene::relief::place_map;
use cutaway::scene::{
    Amount, Bounds, ClipSurface, Cut, CutoutFrame, Offset, OffsetMap, Part, PlaneSpec, Role, Up,
    glob_matches, range,
};
use glam::DVec3;

use super::cutaways;
use super::cutters;
use super::regions::{self, Union};
use super::reliefs::Maps;
use crate::document::Keys;
use crate::document::describe::{CutDesc, ReliefUse, SurfaceDesc};
use crate::document::read::described;
use crate::document::read::reader::{Entry, Table};

/// Keys of a cut.
pub(in crate::document::read) static KEYS: Keys = Keys::below("cut.*");
const FULL: &[&str] = &["origin", "u", "v", "scale", "relief", "wrap", "flip"];
const SECTION: &[&str] = &[
    "section",
    "spin_deg",
    "relief",
    "amplitude",
    "period",
    "wrap",
    "flip",
];
const NORMAL: &[&str] = &[
    "normal",
    "origin",
    "spin_deg",
    "relief",
    "amplitude",
    "period",
    "wrap",
    "flip",
];

/// Everything outside a cut's table that its values refer to.
pub(in crate::document::read) struct Context<'a> {
    pub(in crate::document::read) parts: &'a [Part],
    /// Names of all parts that exist at any time.
    pub(in crate::document::read) names: &'a [&'a str],
    pub(in crate::document::read) bounds: Bounds,
    /// The up axis of the scene.
    pub(in crate::document::read) up: Up,
    pub(in crate::document::read) maps: &'a Maps,
}

/// Reads one cut. A region that is not an intersection of clip-surfaces becomes several cuts with the same name.
pub(in crate::document::read) fn read(
    entry: &Entry<'_>,
    index: usize,
    (cutter, frame): (Option<&cutters::CutterSource>, Option<&CutoutFrame>),
    context: &Context<'_>,
    notes: &mut Vec<Diagnostic>,
) -> Result<Vec<Cut>> {
    let table = entry.table(KEYS.all())?;
    let desc: CutDesc = described::read(&table)?;
    let volume = cutters::read((&table, &desc), cutter, &context.bounds)?;
    let breakaway = (table.get("breakaway")).map(|e| cutaways::breakaway(&e));
    let breakaway = breakaway.transpose()?;
    if let (Some(_), Some(entry)) = (&volume, table.get("breakaway")) {
        let help = "make each a separate cut";
        return Err(entry.fault(
            "the cut has a `volume`, and a cut can have only one cutter",
            help,
        ));
    }
    let has_volume = volume.is_some() || breakaway.is_some();
    let region = region(&table, has_volume, frame, context)?;
    let name = desc.name.unwrap_or_else(|| index.to_string());
    let mut cut = Cut::new(name, Vec::new());
    cut.volume = volume;
    cut.breakaway = breakaway;
    if let Some(globs) = table.get("applies_to") {
        cut.applies_to = globs_of(&globs, context)?;
    }
    if let Some(globs) = table.get("except") {
        cut.except = globs_of(&globs, context)?;
    }
    let may_cut = |p: &Part| cut.enabled && p.role == Role::Exterior && cut.names(p);
    if !context.parts.iter().any(may_cut) {
        notes.push(Diagnostic::note("cuts-no-part", "it cuts no part").about(&entry.key));
    }
    if let Some(offsets) = table.get("offset") {
        if has_volume {
            let help = "a mesh cannot be offset: scale it in a separate cut for these parts";
            return Err(offsets.fault("the cut has a `volume`, which cannot be offset", help));
        }
        cut.offsets = offsets_of(&offsets, &cut, context, notes)?;
    }
    cut.enabled = desc.enabled.unwrap_or(true) && !region.is_empty;
    let of_surfaces = |surfaces: Vec<ClipSurface>| Cut {
        surfaces,
        ..cut.clone()
    };
    Ok(region.alternatives.into_iter().map(of_surfaces).collect())
}

/// Region of a cut, the intersection of `surfaces`, `box` and `wedge`. It may be all of space only if the cut has a cutter.
fn region(
    table: &Table<'_>,
    has_volume: bool,
    frame: Option<&CutoutFrame>,
    context: &Context<'_>,
) -> Result<Union> {
    let mut region = Union::everywhere();
    let surfaces = table.get("surfaces");
    let [boxes, wedges] = [
        one_or_several(table, "box")?,
        one_or_several(table, "wedge")?,
    ];
    if let Some(surfaces) = &surfaces {
        let all = surfaces.list()?;
        if all.is_empty() {
            return Err(surfaces.fault("a cut needs a surface", "add `{ section = \"z=50%\" }`"));
        }
        let all = all.iter().map(|s| surface(s, context));
        region.intersect(Union::of(all.collect::<Result<_>>()?));
    }
    for block in &boxes {
        region.intersect(regions::block(block, context)?);
    }
    for wedge in &wedges {
        region.intersect(regions::wedge(wedge, context)?);
    }
    if let Some(entry) = table.get("cutout") {
        region.intersect(cutaways::cutout(&entry, frame, context)?);
    }
    if region.is_everywhere() && !has_volume {
        if let Some(wedge) = wedges.first() {
            let help = "let it turn by less than 360 degrees, or bound it by `min` or `max`";
            let what = "the wedge turns all the way round and has no end along its axis, so it would remove everything";
            return Err(wedge.fault(what, help));
        }
        let help = "add for example `surfaces = [{ section = \"z=50%\" }]`, a `box`, a `wedge`, a `cutout`, a `breakaway` or a `volume`";
        return Err(table.entry.fault(
            "it has no clip-surface, so it would remove everything",
            help,
        ));
    }
    Ok(region)
}

/// Returns the table at a key, or all tables if the value is a list.
fn one_or_several<'a>(table: &Table<'a>, key: &str) -> Result<Vec<Entry<'a>>> {
    match table.get(key) {
        None => Ok(Vec::new()),
        Some(entry) if entry.is_list() => entry.list(),
        Some(entry) => Ok(vec![entry]),
    }
}

/// Reads offsets by glob. Globs have no order in a file, so only one may match a part, unless an entry has the part's exact name.
fn offsets_of(
    entry: &Entry<'_>,
    cut: &Cut,
    context: &Context<'_>,
    notes: &mut Vec<Diagnostic>,
) -> Result<Vec<Offset>> {
    let diagonal = context.bounds.size().length();
    let mut offsets = Vec::new();
    for (glob, value) in entry.open_table()?.all() {
        must_name_a_part(&value, glob, context)?;
        let mut cut_parts = context.parts.iter().filter(|p| cut.names(p));
        if !cut_parts.any(|p| glob_matches(glob, &p.name)) {
            let note = Diagnostic::note("no-such-part", "no part of the cut has this name");
            notes.push(note.about(&value.key));
        }
        let keeps = match value.amount()? {
            Amount::Units(v) => v,
            Amount::Percent(p) => diagonal * p / 100.0,
        };
        if let Some(what) = range::beside(keeps, &context.bounds) {
            return Err(value.fault(format!("it is {what}"), "give a smaller offset"));
        }
        offsets.push(Offset {
            parts: glob.to_owned(),
            keeps,
        });
    }
    for part in context.parts.iter().filter(|p| cut.names(p)) {
        let fits = |o: &&Offset| glob_matches(&o.parts, &part.name);
        let globs: Vec<&str> = (offsets.iter().filter(fits))
            .map(|o| o.parts.as_str())
            .collect();
        if globs.len() > 1 && !globs.contains(&part.name.as_str()) {
            let what = format!("part `{}` fits {}", part.name, globs.join(" and "));
            let help = format!("add `\"{}\" = 0.1`, which takes priority", part.name);
            return Err(entry.fault(what, help));
        }
    }
    Ok(offsets)
}

/// Reads globs. A glob without a wildcard must be the name of a part, because anything else is a mistake.
fn globs_of(entry: &Entry<'_>, context: &Context<'_>) -> Result<Vec<String>> {
    let globs = entry.list()?.into_iter().map(|glob| {
        must_name_a_part(&glob, glob.text()?, context)?;
        glob.text().map(str::to_owned)
    });
    globs.collect()
}

fn must_name_a_part(entry: &Entry<'_>, glob: &str, context: &Context<'_>) -> Result<()> {
    let names = || context.names.iter().copied();
    if glob.contains(['*', '?']) || names().any(|n| n == glob) {
        return Ok(());
    }
    let what = format!("there is no part `{glob}`");
    Err(entry.fault(what, did_you_mean(glob, names())))
}

pub(in crate::document::read) fn surface(
    entry: &Entry<'_>,
    context: &Context<'_>,
) -> Result<ClipSurface> {
    let open = entry.open_table()?;
    let table = if open.get("section").is_some() {
        entry.table(SECTION)?
    } else if open.get("normal").is_some() {
        entry.table(NORMAL)?
    } else {
        entry.table(FULL)?
    };
    let desc: SurfaceDesc = described::read(&table)?;
    let spec = match (&desc.section, desc.normal) {
        (Some(section), _) => Some(("section", PlaneSpec::parse(section))),
        (None, Some(normal)) => {
            let point = desc.origin.unwrap_or(context.bounds.centre());
            Some(("normal", PlaneSpec::through(point, normal)))
        }
        (None, None) => None,
    };
    let surface = match spec {
        Some((key, spec)) => {
            let plane = spec.and_then(|s| s.surface(&context.bounds, context.up));
            let given = table.need(key, "\"z=50%\"")?;
            let plane = plane.map_err(|e| given.place(e))?;
            let plane = match desc.spin_deg {
                0.0 => plane,
                spin_deg => plane.spun(spin_deg.to_radians()),
            };
            on_plane(plane, (&table, &desc.ruffle), context)?
        }
        None => in_full(&table, &desc, context)?,
    };
    sound(&surface, &context.bounds, entry)?;
    Ok(if desc.flip {
        surface.flipped()
    } else {
        surface
    })
}

/// Refuses invalid clip-surfaces.
pub(in crate::document::read) fn sound(
    surface: &ClipSurface,
    model: &Bounds,
    entry: &Entry<'_>,
) -> Result<()> {
    let help = "u and v must be finite, not zero and at a right angle; u = [1, 0, 0], v = [0, 1, 0] keep z > origin";
    match surface.defect_beside(model) {
        Some(what) => Err(entry.fault(what, help)),
        None => Ok(()),
    }
}

/// Reads a surface in the paper's parametrisation, without converting it.
fn in_full(table: &Table<'_>, desc: &SurfaceDesc, context: &Context<'_>) -> Result<ClipSurface> {
    table.need("u", "[1, 0, 0]")?;
    table.need("v", "[0, 1, 0]")?;
    Ok(ClipSurface {
        origin: desc.origin.unwrap_or(DVec3::ZERO),
        u: desc.u.unwrap_or(DVec3::X),
        v: desc.v.unwrap_or(DVec3::Y),
        scale: desc.scale.unwrap_or(DVec3::ONE),
        relief: map_of(table, context)?,
        wrap: desc.ruffle.placement.wrap,
    })
}

/// Adds the relief named in a plane's table, if there is one.
pub(in crate::document::read) fn on_plane(
    plane: ClipSurface,
    (table, desc): (&Table<'_>, &ReliefUse),
    context: &Context<'_>,
) -> Result<ClipSurface> {
    let Some(map) = map_of(table, context)? else {
        for key in ["amplitude", "period", "wrap"] {
            if let Some(entry) = table.get(key) {
                let help = "add `relief = \"NAME\"`, or remove the key";
                return Err(entry.fault("a plane has none: there is no relief", help));
            }
        }
        return Ok(plane);
    };
    let placed = place_map(plane, map, &desc.placement, &context.bounds);
    placed.map_err(|what| {
        let help = "give `amplitude` and `period` in scene units, or as \"6%\" of the diagonal";
        let relief = table.get("relief");
        relief
            .unwrap_or_else(|| table.entry.clone())
            .fault(what, help)
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
    let help = if context.maps.is_empty() {
        format!("describe it in a table [relief.{name}]")
    } else {
        did_you_mean(name, context.maps.keys().map(String::as_str))
    };
    Err(entry.fault(format_args!("there is no relief `{name}`"), help))
}
