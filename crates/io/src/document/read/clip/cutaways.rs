//! `cutout` and `breakaway` of a cut: openings that place themselves.
//!
//! ```toml
//! cutout = {}                                               # a wedge of 110 degrees about the main axis, open to the camera
//! cutout = { axis = "x", angle_deg = 90, turn_deg = 20, relief = "saw", amplitude = "2%" }
//! breakaway = {}                                            # what is inside is seen, from wherever the camera is
//! breakaway = { distance = "3%", bevel_deg = 0, clusters = "one", view = "first" }
//! ```
//!
//! A cutout lies where the axes of the exteriors put it at rest, and is turned to where the camera is then; both stay as the scene moves.

use cutaway::error::Result;
use cutaway::scene::{Amount, AxisRule, Breakaway, BreakawayView, Clusters, CutoutFrame, Wedge};

use super::cuts::Context;
use super::regions::{RELIEF, Union, listed, ruffled};
use crate::document::read::deform::{AXES, direction};
use crate::document::read::reader::{Entry, Table};

const CUTOUT: &[&str] = &["axis", "angle_deg", "turn_deg", "fixed", "offset"];
const BREAKAWAY: &[&str] = &["distance", "bevel_deg", "clusters", "view"];
/// Between the faces of a cutout, where nothing is said (Diepstraten, Weiskopf and Ertl 2003).
const USUAL_ANGLE_DEG: f64 = 110.0;

/// Reads the rule for the axis of a cutout.
pub(in crate::document::read) fn axis_rule(entry: &Entry<'_>) -> Result<AxisRule> {
    let table = entry.table(&[CUTOUT, RELIEF].concat())?;
    let Some(axis) = table.get("axis") else {
        return Ok(AxisRule::Auto);
    };
    if !axis.is_text() {
        return direction(&axis).map(AxisRule::Along);
    }
    let rules = [
        ("auto", AxisRule::Auto),
        ("main", AxisRule::Main),
        ("symmetry", AxisRule::Symmetry),
    ];
    let axes = AXES.map(|(name, axis)| (name, AxisRule::Along(axis)));
    axis.choice(&[&rules[..], &axes].concat())
}

/// Returns the number and the axis rule of each cut that is a cutout.
pub(in crate::document) fn cutouts(root: &Table<'_>) -> Result<Vec<(usize, AxisRule)>> {
    let cuts = root.tables("cut")?;
    let mut rules = Vec::new();
    for (number, cut) in cuts.iter().enumerate() {
        if let Some(entry) = cut.open_table()?.get("cutout") {
            rules.push((number, axis_rule(&entry)?));
        }
    }
    Ok(rules)
}

/// Reads a cutout. Where its frame is not known yet it has no inside, and lies anywhere.
pub(in crate::document::read) fn cutout(
    entry: &Entry<'_>,
    frame: Option<&CutoutFrame>,
    context: &Context<'_>,
) -> Result<Union> {
    axis_rule(entry)?;
    let table = entry.table(&[CUTOUT, RELIEF].concat())?;
    let number = |key: &str, usual| table.get(key).map_or(Ok(usual), |e| e.number());
    let angle_deg = number("angle_deg", USUAL_ANGLE_DEG)?;
    if !(0.0..=359.0).contains(&angle_deg) {
        let angle = table.need("angle_deg", "110")?;
        let what = "it must be from 0 to 359: a full turn would remove everything";
        return Err(angle.fault(what, "write for example `angle_deg = 110`"));
    }
    let fixed = table.get("fixed").map_or(Ok(false), |e| e.flag())?;
    let [second, third] = table.get("offset").map_or(Ok([0.0; 2]), |e| e.vector())?;
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
    let middle_deg = number("turn_deg", 0.0)? + if fixed { 0.0 } else { eye_deg };
    let wedge = Wedge {
        origin: origin + zero * second + along.cross(zero) * third,
        along,
        zero,
        from_deg: middle_deg - angle_deg / 2.0,
        to_deg: middle_deg + angle_deg / 2.0,
        min: None,
        max: None,
    };
    let listed = listed(&["from", "to"], &table)?;
    let alternatives = wedge
        .alternatives(!listed.is_empty(), context.up)
        .into_iter();
    let ruffled = alternatives.map(|faces| ruffled(faces, &listed, &table, context));
    Ok(Union {
        alternatives: ruffled.collect::<Result<_>>()?,
        is_empty: frame.is_none() || wedge.is_empty(),
    })
}

/// Reads a breakaway.
pub(in crate::document::read) fn breakaway(entry: &Entry<'_>) -> Result<Breakaway> {
    let table = entry.table(BREAKAWAY)?;
    let mut breakaway = Breakaway::default();
    if let Some(distance) = table.get("distance") {
        breakaway.distance = distance.amount()?;
        if matches!(breakaway.distance, Amount::Units(d) | Amount::Percent(d) if d < 0.0) {
            return Err(distance.fault(
                "it must be 0 or more",
                "write for example `distance = \"1%\"`",
            ));
        }
    }
    if let Some(bevel) = table.get("bevel_deg") {
        breakaway.bevel_deg = bevel.number()?;
        if !(0.0..=60.0).contains(&breakaway.bevel_deg) {
            return Err(bevel.fault(
                "it must be from 0 to 60",
                "write for example `bevel_deg = 12`",
            ));
        }
    }
    if let Some(clusters) = table.get("clusters") {
        breakaway.clusters =
            clusters.choice(&[("auto", Clusters::Auto), ("one", Clusters::One)])?;
    }
    if let Some(view) = table.get("view") {
        let views = [
            ("each", BreakawayView::Each),
            ("first", BreakawayView::First),
        ];
        breakaway.view = view.choice(&views)?;
    }
    Ok(breakaway)
}
