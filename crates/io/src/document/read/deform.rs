//! `deform` of a part: what bends its mesh.
//!
//! Lengths are in units of the mesh, or in percent of the diagonal of its bounds; `turn_deg` is the turn from one end of
//! the bounds to the other along the axis. The axis goes through the middle of the bounds, along their longest side, unless
//! the file says otherwise. Bounds are those of the rest mesh, and of all frames of a sequence: they stay what they are.

use cutaway::error::Result;
use cutaway::scene::{Amount, Axis, Bounds, Deformer, next_axis, range};
use glam::DVec3;

use super::reader::{Entry, Table};

/// Kind of a deformer, chosen by name.
#[derive(Clone, Copy)]
enum Kind {
    Twist,
    Bend,
    Wave,
    Inflate,
}

const KINDS: [(&str, Kind); 4] = [
    ("twist", Kind::Twist),
    ("bend", Kind::Bend),
    ("wave", Kind::Wave),
    ("inflate", Kind::Inflate),
];

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
    let kind = open.need("kind", "\"twist\"")?.choice(&KINDS)?;
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
    if let Kind::Inflate = kind {
        let by = entry.table(INFLATE)?.need("by", "\"2%\"")?;
        return Ok(Deformer::Inflate { by: length(&by)? });
    }
    let table = entry.table(if matches!(kind, Kind::Wave) {
        WAVE
    } else {
        TURN
    })?;
    let axis = axis(&table, bounds)?;
    let extent = bounds.size().dot(axis.along.abs());
    if !(extent > 0.0 && extent.is_finite()) {
        let what = "the part has no extent along the axis";
        return Err(entry.fault(what, "choose another axis"));
    }
    if let Kind::Wave = kind {
        let amplitude = length(&table.need("amplitude", "\"2%\"")?)?;
        let period = match table.get("period") {
            Some(period) => {
                let length = length(&period)?;
                if length <= extent / range::MOST_RADII {
                    let least = range::MOST_RADII;
                    let what = format!("it must be above 0, more than a {least:.0e}th of the part");
                    return Err(period.fault(what, "write for example \"25%\""));
                }
                length
            }
            None => extent,
        };
        let phase = table.get("phase_deg").map_or(Ok(0.0), |p| p.number())?;
        return Ok(Deformer::Wave {
            axis,
            amplitude,
            period,
            phase: phase.to_radians(),
        });
    }
    let turn = table.need("turn_deg", "90")?.number()?.to_radians();
    if turn.abs() > range::MOST_RADII {
        let what = format!("it turns by more than {:.0e}", range::MOST_RADII);
        return Err(entry.fault(what, "write for example `turn_deg = 90`"));
    }
    let turn_per_unit = turn / extent;
    Ok(match kind {
        Kind::Bend => Deformer::Bend {
            axis,
            turn_per_unit,
        },
        _ => Deformer::Twist {
            axis,
            turn_per_unit,
        },
    })
}

fn axis(table: &Table<'_>, bounds: Bounds) -> Result<Axis> {
    let along = match table.get("axis") {
        Some(entry) => direction(&entry)?,
        None => {
            let size = bounds.size();
            let longest = (0..3).rev().max_by(|a, b| size[*a].total_cmp(&size[*b]));
            DVec3::AXES[longest.unwrap_or(0)]
        }
    };
    let centre = match table.get("centre") {
        Some(entry) => DVec3::from(entry.vector()?),
        None => bounds.centre(),
    };
    let across = match table.get("across") {
        Some(entry) => {
            let across = direction(&entry)?;
            let across = across - along * across.dot(along);
            if across.length() < 1e-6 {
                let help = "use a direction across it";
                return Err(entry.fault("it points along the axis", help));
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

/// Directions by their names.
pub(super) const AXES: [(&str, DVec3); 6] = [
    ("x", DVec3::X),
    ("y", DVec3::Y),
    ("z", DVec3::Z),
    ("-x", DVec3::NEG_X),
    ("-y", DVec3::NEG_Y),
    ("-z", DVec3::NEG_Z),
];

/// `"x"`, `"-y"` or a vector of any length but 0.
pub(super) fn direction(entry: &Entry<'_>) -> Result<DVec3> {
    if entry.is_text() {
        return entry.choice(&AXES);
    }
    let v = DVec3::from(entry.vector()?);
    let greatest = v.abs().max_element();
    if greatest > 0.0 {
        Ok((v / greatest).normalize())
    } else {
        Err(entry.fault("it points nowhere", "write for example \"y\" or [0, 1, 0]"))
    }
}
