//! `deform` of a part: deformations of its mesh.
//!
//! Lengths are in mesh units, or in percent of the diagonal of the mesh's bounds. `turn_deg` is the angle between the two ends of the
//! bounds along the axis. The default axis goes through the middle of the bounds, along their longest side. The bounds enclose the rest
//! mesh, or all frames of a sequence, so they do not change over time.

use cutaway::error::Result;
use cutaway::scene::describe::OrWord;
use cutaway::scene::{Amount, Axis, Bounds, Deformer, next_axis, range};
use glam::DVec3;

use super::described;
use super::reader::{Entry, Table};
use crate::document::describe::{AXES, DeformDesc, DeformKind};

const TURN: &[&str] = &["kind", "axis", "centre", "across", "turn_deg"];
const WAVE: &[&str] = &[
    "kind",
    "axis",
    "centre",
    "across",
    "amplitude",
    "period",
    "phase_deg",
];
const INFLATE: &[&str] = &["kind", "by"];

/// Reads a list of deformers.
pub(super) fn read(entry: &Entry<'_>, bounds: Bounds) -> Result<Vec<Deformer>> {
    entry
        .list()?
        .iter()
        .map(|one| read_one(one, bounds))
        .collect()
}

fn read_one(entry: &Entry<'_>, bounds: Bounds) -> Result<Deformer> {
    let open = entry.open_table()?;
    let kinds = DeformKind::ALL;
    let kind = open.need("kind", "\"twist\"")?.choice(&kinds)?;
    let length = |entry: &Entry<'_>| {
        let length = match entry.amount()? {
            Amount::Units(v) => v,
            Amount::Percent(p) => bounds.size().length() * p / 100.0,
        };
        match range::beside(length, &bounds) {
            Some(what) => Err(entry.fault(format!("it is {what}"), "use a smaller one")),
            None => Ok(length),
        }
    };
    if let DeformKind::Inflate = kind {
        let by = entry.table(INFLATE)?.need("by", "\"2%\"")?;
        return Ok(Deformer::Inflate { by: length(&by)? });
    }
    let table = entry.table(if matches!(kind, DeformKind::Wave) {
        WAVE
    } else {
        TURN
    })?;
    let desc: DeformDesc = described::read(&table)?;
    let axis = axis(&table, &desc, bounds)?;
    let extent = bounds.size().dot(axis.along.abs());
    if !(extent > 0.0 && extent.is_finite()) {
        let what = "the part has no extent along the axis";
        return Err(entry.fault(what, "choose another axis"));
    }
    if let DeformKind::Wave = kind {
        let amplitude = length(&table.need("amplitude", "\"2%\"")?)?;
        let period = match table.get("period") {
            Some(period) => {
                let length = length(&period)?;
                if length <= extent / range::MOST_RADII {
                    let least = range::MOST_RADII;
                    let what = format!(
                        "it must be above 0, and more than 1/{least:.0e} of the part's extent"
                    );
                    return Err(period.fault(what, "write for example \"25%\""));
                }
                length
            }
            None => extent,
        };
        return Ok(Deformer::Wave {
            axis,
            amplitude,
            period,
            phase: desc.phase_deg.to_radians(),
        });
    }
    let turn = table.need("turn_deg", "90")?.number()?.to_radians();
    if turn.abs() > range::MOST_RADII {
        let what = format!("it turns by more than {:.0e}", range::MOST_RADII);
        return Err(entry.fault(what, "write for example `turn_deg = 90`"));
    }
    let turn_per_unit = turn / extent;
    Ok(match kind {
        DeformKind::Bend => Deformer::Bend {
            axis,
            turn_per_unit,
        },
        _ => Deformer::Twist {
            axis,
            turn_per_unit,
        },
    })
}

fn axis(table: &Table<'_>, desc: &DeformDesc, bounds: Bounds) -> Result<Axis> {
    let along = match &desc.axis {
        Some(axis) => direction(axis, table, "axis")?,
        None => {
            let size = bounds.size();
            let longest = (0..3).rev().max_by(|a, b| size[*a].total_cmp(&size[*b]));
            DVec3::AXES[longest.unwrap_or(0)]
        }
    };
    let centre = desc.centre.unwrap_or(bounds.centre());
    let across = match &desc.across {
        Some(across) => {
            let across = direction(across, table, "across")?;
            let across = across - along * across.dot(along);
            if across.length() < 1e-6 {
                let entry = table.need("across", "\"x\"")?;
                return Err(entry.fault(
                    "it points along the axis",
                    "use a direction at an angle to the axis",
                ));
            }
            across.normalize()
        }
        None => next_axis(along),
    };
    Ok(Axis {
        centre,
        along,
        across,
    })
}

/// Reads a direction at a table's key, given as a name or as a vector of any non-zero length.
pub(super) fn direction(given: &OrWord<DVec3>, table: &Table<'_>, key: &str) -> Result<DVec3> {
    let v = match given {
        OrWord::Value(v) => *v,
        OrWord::Word(name) => {
            let named = AXES.iter().find(|(known, _)| known == name);
            return Ok(named.map_or(DVec3::X, |(_, axis)| *axis));
        }
    };
    let greatest = v.abs().max_element();
    if greatest > 0.0 {
        return Ok((v / greatest).normalize());
    }
    let entry = table.need(key, "\"y\"")?;
    Err(entry.fault(
        "it has no direction",
        "write for example \"y\" or [0, 1, 0]",
    ))
}
