//! `cutout` and `breakaway` of a cut: openings with automatic placement.
//!
//! ```toml
//! cutout = {}                                               # a wedge of 110 degrees about the main axis, open to the camera
//! cutout = { axis = "x", angle_deg = 90, turn_deg = 20, relief = "saw", amplitude = "2%" }
//! breakaway = {}                                            # shows the interiors from every camera position
//! breakaway = { distance = "3%", bevel_deg = 0, clusters = "one", view = "first" }
//! ```
//!
//! A cutout is placed by the axes of the unanimated exterior parts and turned to the camera at time 0. It stays there as the scene moves.

use cutaway::error::Result;
use cutaway::scene::describe::OrWord;
use cutaway::scene::{AxisRule, Breakaway, CutoutFrame, Wedge};

use super::cuts::Context;
use super::regions::{Union, listed, ruffled};
use crate::document::Keys;
use crate::document::describe::CutoutDesc;
use crate::document::read::deform::direction;
use crate::document::read::described;
use crate::document::read::reader::{Entry, Table};

static CUTOUT: Keys = Keys::below("cut.*.cutout");
static BREAKAWAY: Keys = Keys::below("cut.*.breakaway");

/// Opens the table of a cutout and reads its description.
fn opened<'a>(entry: &Entry<'a>) -> Result<(Table<'a>, CutoutDesc)> {
    let table = entry.table(CUTOUT.all())?;
    let desc = described::read(&table)?;
    Ok((table, desc))
}

/// The rule for the axis of a cutout.
fn axis_rule(table: &Table<'_>, desc: &CutoutDesc) -> Result<AxisRule> {
    match &desc.axis {
        None => Ok(AxisRule::Auto),
        Some(OrWord::Word(word)) if word == "auto" => Ok(AxisRule::Auto),
        Some(OrWord::Word(word)) if word == "main" => Ok(AxisRule::Main),
        Some(OrWord::Word(word)) if word == "symmetry" => Ok(AxisRule::Symmetry),
        Some(axis) => direction(axis, table, "axis").map(AxisRule::Along),
    }
}

/// Returns the number and the axis rule of each cut that is a cutout.
pub(in crate::document) fn cutouts(root: &Table<'_>) -> Result<Vec<(usize, AxisRule)>> {
    let cuts = root.tables("cut")?;
    let mut rules = Vec::new();
    for (number, cut) in cuts.iter().enumerate() {
        if let Some(entry) = cut.open_table()?.get("cutout") {
            let (table, desc) = opened(&entry)?;
            rules.push((number, axis_rule(&table, &desc)?));
        }
    }
    Ok(rules)
}

/// Reads a cutout. While its frame is unknown, the region is empty and has an arbitrary position.
pub(in crate::document::read) fn cutout(
    entry: &Entry<'_>,
    frame: Option<&CutoutFrame>,
    context: &Context<'_>,
) -> Result<Union> {
    let (table, desc) = opened(entry)?;
    axis_rule(&table, &desc)?;
    let somewhere = CutoutFrame {
        origin: context.bounds.centre(),
        along: context.up.axis(),
        zero: context.up.axis().any_orthonormal_vector(),
        eye_deg: 0.0,
        is_even: false,
    };
    let CutoutFrame {
        origin,
        along,
        zero,
        eye_deg,
        ..
    } = *frame.unwrap_or(&somewhere);
    let middle_deg = desc.turn_deg + if desc.fixed { 0.0 } else { eye_deg };
    let [second, third] = desc.offset.to_array();
    let wedge = Wedge {
        origin: origin + zero * second + along.cross(zero) * third,
        along,
        zero,
        from_deg: middle_deg - desc.angle_deg / 2.0,
        to_deg: middle_deg + desc.angle_deg / 2.0,
        min: None,
        max: None,
    };
    let listed = listed(&["from", "to"], &table)?;
    let alternatives = wedge
        .alternatives(!listed.is_empty(), context.up)
        .into_iter();
    let ruffled =
        alternatives.map(|faces| ruffled(faces, &listed, (&table, &desc.ruffle), context));
    Ok(Union {
        alternatives: ruffled.collect::<Result<_>>()?,
        is_empty: frame.is_none() || wedge.is_empty(),
    })
}

/// Reads a breakaway.
pub(in crate::document::read) fn breakaway(entry: &Entry<'_>) -> Result<Breakaway> {
    let mut breakaway = Breakaway::default();
    described::amend(&mut breakaway, &entry.table(BREAKAWAY.all())?)?;
    Ok(breakaway)
}
