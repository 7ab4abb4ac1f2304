//! `box` and `wedge` of a cut: regions described by a few numbers.
//!
//! ```toml
//! box = { min = ["50%", 0, 0], max = ["100%", 1, 1] }       # percent of the bounds; without `min` or `max` unbounded on that side
//! box = { centre = [0, 0, 0], size = 0.5 }                  # or a size along each axis
//! wedge = { axis = "z", from_deg = 0, to_deg = 90 }         # about the middle of the bounds, or `origin`
//! wedge = { axis = [1, 1, 0], from_deg = -30, to_deg = 200, min = "10%", max = "90%" }
//! ```
//!
//! Angles are counter-clockwise when looking against the axis. Angle 0 is at the next axis: x for z, y for x, z for y. A wedge of more than
//! 180 degrees becomes two cuts with the same name. `min` and `max` of a wedge are coordinates along its axis.
//!
//! The keys `relief`, `amplitude`, `period` and `wrap` work as in a section. They apply to all faces, or to those in a list such as `faces
//! = ["from", "to"]`. A box has the faces `-x` to `+z`, and a wedge `from`, `to`, `min` and `max`.

use cutaway::error::Result;
use cutaway::scene::describe::OrWord;
use cutaway::scene::{Amount, Block, Bounds, ClipSurface, RegionFace, Wedge, in_common, next_axis};
use glam::DVec3;

use super::cuts::{Context, on_plane, sound};
use crate::document::Keys;
use crate::document::describe::{BoxDesc, ReliefUse, WedgeDesc};
use crate::document::read::deform::direction;
use crate::document::read::described;
use crate::document::read::reader::{Entry, Table};

const CENTRED: [&str; 2] = ["centre", "size"];
const CORNERS: [&str; 2] = ["min", "max"];
static BOX: Keys = Keys::below("cut.*.box");
static WEDGE: Keys = Keys::below("cut.*.wedge");

/// A union of intersections of removed half-spaces.
pub(in crate::document::read) struct Union {
    pub(in crate::document::read) alternatives: Vec<Vec<ClipSurface>>,
    /// True if the region is empty.
    pub(in crate::document::read) is_empty: bool,
}

impl Union {
    /// Intersection of clip-surfaces.
    pub(in crate::document::read) fn of(surfaces: Vec<ClipSurface>) -> Self {
        Self {
            alternatives: vec![surfaces],
            is_empty: false,
        }
    }

    /// Returns the region that is all of space.
    pub(in crate::document::read) fn everywhere() -> Self {
        Self::of(Vec::new())
    }

    /// Returns true if one of the intersections is all of space.
    pub(in crate::document::read) fn is_everywhere(&self) -> bool {
        self.alternatives.iter().any(Vec::is_empty)
    }

    /// Intersects the region with another one.
    pub(in crate::document::read) fn intersect(&mut self, other: Self) {
        self.alternatives = in_common(&self.alternatives, &other.alternatives);
        self.is_empty |= other.is_empty;
    }
}

/// Reads a box.
pub(in crate::document::read) fn block(entry: &Entry<'_>, context: &Context<'_>) -> Result<Union> {
    let bounds = &context.bounds;
    let table = entry.table(BOX.all())?;
    let desc: BoxDesc = described::read(&table)?;
    let is_centred = CENTRED.iter().any(|key| table.get(key).is_some());
    let block = if is_centred {
        if let Some(corner) = CORNERS.iter().find_map(|key| table.get(key)) {
            let help = "keep `min` and `max`, or `centre` and `size`";
            return Err(corner.fault("the box also has a centre or a size", help));
        }
        centred(&table, &desc, bounds)?
    } else {
        let corner = |amounts: Option<[Amount; 3]>| match amounts {
            Some(amounts) => point(amounts, bounds).to_array().map(Some),
            None => [None; 3],
        };
        Block {
            min: corner(desc.min),
            max: corner(desc.max),
        }
    };
    if let Some(axis) = block.inverted_axis() {
        let what = format!(
            "its `max` is below its `min` along {}",
            ["x", "y", "z"][axis]
        );
        let help = "let no number of `min` exceed that of `max`, and no size be below 0";
        return Err(entry.fault(what, help));
    }
    let faces = block.faces(bounds.centre(), context.up);
    if faces.is_empty() {
        let help = "add for example `min = [0, 0, 0]`, or `centre` and `size`";
        return Err(entry.fault("it has no corner, centre or size", help));
    }
    let present: Vec<_> = faces.iter().map(|f| f.name).collect();
    Ok(Union {
        is_empty: block.is_empty(),
        alternatives: vec![ruffled(
            faces,
            &listed(&present, &table)?,
            (&table, &desc.ruffle),
            context,
        )?],
    })
}

fn centred(table: &Table<'_>, desc: &BoxDesc, bounds: &Bounds) -> Result<Block> {
    let centre = desc.centre.map_or(bounds.centre(), |c| point(c, bounds));
    table.need("size", "[1, 1, 1]")?;
    let amounts = desc.size.unwrap_or([Amount::Units(0.0); 3]);
    let whole = bounds.size();
    let size = DVec3::from(std::array::from_fn(|i| match amounts[i] {
        Amount::Units(v) => v,
        Amount::Percent(p) => whole[i] * p / 100.0,
    }));
    Ok(Block {
        min: (centre - size * 0.5).to_array().map(Some),
        max: (centre + size * 0.5).to_array().map(Some),
    })
}

/// Reads a wedge.
pub(in crate::document::read) fn wedge(entry: &Entry<'_>, context: &Context<'_>) -> Result<Union> {
    let table = entry.table(WEDGE.all())?;
    let desc: WedgeDesc = described::read(&table)?;
    let bounds = &context.bounds;
    table.need("axis", "\"z\"")?;
    let axis = desc.axis.unwrap_or(OrWord::Value(DVec3::Z));
    let along = direction(&axis, &table, "axis")?;
    let angle = |key: &str, example: &str, angle: Option<f64>| match angle {
        Some(angle) => Ok(angle),
        None => table.need(key, example).map(|_| 0.0),
    };
    let from_deg = angle("from_deg", "0", desc.from_deg)?;
    let to_deg = angle("to_deg", "90", desc.to_deg)?;
    if !(0.0..=360.0).contains(&(to_deg - from_deg)) {
        let what = format!("it turns by {} degrees", to_deg - from_deg);
        let help = "let `to_deg` be from 0 to 360 more than `from_deg`";
        return Err(entry.fault(what, help));
    }
    let origin = desc.origin.map_or(bounds.centre(), |p| point(p, bounds));
    let extent = bounds.corners().map(|c| c.dot(along));
    let [least, most] = extent
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], c| {
            [a.min(*c), b.max(*c)]
        });
    let end = |amount: Option<Amount>| amount.map(|a| a.between(least, most));
    let wedge = Wedge {
        origin,
        along,
        zero: next_axis(along),
        from_deg,
        to_deg,
        min: end(desc.min),
        max: end(desc.max),
    };
    if matches!((wedge.min, wedge.max), (Some(a), Some(b)) if a > b) {
        let help = "let `min` be at most `max`: both are coordinates along the axis";
        return Err(entry.fault("its `max` is below its `min` along its axis", help));
    }
    // A full turn has neither of these faces. It is allowed, because an animated wedge may pass through a full turn.
    let mut present = vec!["from", "to"];
    present.extend(wedge.min.map(|_| "min"));
    present.extend(wedge.max.map(|_| "max"));
    let listed = listed(&present, &table)?;
    let ragged = listed.iter().any(|name| ["from", "to"].contains(name));
    let alternatives = wedge.alternatives(ragged, context.up).into_iter();
    let ruffled =
        alternatives.map(|faces| ruffled(faces, &listed, (&table, &desc.ruffle), context));
    Ok(Union {
        alternatives: ruffled.collect::<Result<_>>()?,
        is_empty: wedge.is_empty(),
    })
}

/// A point whose coordinates are numbers, or percentages of the bounds.
fn point(amounts: [Amount; 3], bounds: &Bounds) -> DVec3 {
    DVec3::from(std::array::from_fn(|i| {
        amounts[i].between(bounds.min[i], bounds.max[i])
    }))
}

/// Returns the names of the faces that have the table's relief. `present` are the names of all faces.
pub(in crate::document::read) fn listed(
    present: &[&'static str],
    table: &Table<'_>,
) -> Result<Vec<&'static str>> {
    let has_relief = table.get("relief").is_some();
    match table.get("faces") {
        None if has_relief => Ok(present.to_vec()),
        None => Ok(Vec::new()),
        Some(list) if !has_relief => {
            let help = "add `relief = \"NAME\"`, or remove the key";
            Err(list.fault("there is no relief for these faces", help))
        }
        Some(list) => {
            let choices: Vec<_> = present.iter().map(|name| (*name, *name)).collect();
            let named = list.list()?.into_iter().map(|e| e.choice(&choices));
            named.collect()
        }
    }
}

/// The clip-surfaces of faces. The listed faces have the table's relief.
pub(in crate::document::read) fn ruffled(
    faces: Vec<RegionFace>,
    listed: &[&'static str],
    (table, desc): (&Table<'_>, &ReliefUse),
    context: &Context<'_>,
) -> Result<Vec<ClipSurface>> {
    let surfaces = faces.into_iter().map(|face| {
        let surface = if listed.contains(&face.name) {
            on_plane(face.plane, (table, desc), context)?
        } else {
            face.plane
        };
        sound(&surface, &context.bounds, &table.entry)?;
        Ok(surface)
    });
    surfaces.collect()
}
