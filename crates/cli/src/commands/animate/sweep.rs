//! `--sweep`: a plane that moves through the model over the whole animation.
//!
//! The plane becomes a cut of the document, and its motion a key that moves the cut's origin, so that `--save` writes both. Percentages
//! refer to the model's bounding box over all times, and are converted to positions.

use cutaway::scene::{Amount, Bounds};
use cutaway::{Error, Result};
use cutaway_io::document::{Document, Node, Origin, Value, cut, plane};
use glam::DVec3;

use crate::input::sections::SectionArgs;

/// An axis, its kept side, and the start and end of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlaneSweep {
    axis: usize,
    sign: f64,
    ends: [Amount; 2],
}

/// The name of the cut.
const NAME: &str = "sweep";

impl PlaneSweep {
    /// Adds the cut and its key.
    pub(super) fn amend(
        self,
        document: &mut Document,
        bounds: &Bounds,
        [start_s, last_s, end_s]: [f64; 3],
        sections: &SectionArgs,
    ) -> Result<()> {
        let ends = self.ends.map(|end| {
            let mut origin = bounds.centre();
            origin[self.axis] = end.between(bounds.min[self.axis], bounds.max[self.axis]);
            origin
        });
        if ends[0] == ends[1] {
            let help = "give it another end position, for example y=10%:90%";
            return Err(Error::input("--sweep", "the plane does not move", help));
        }
        let before = document
            .root()
            .get("cut")
            .map_or(0, |cuts| cuts.items().len());
        let surface = plane(DVec3::AXES[self.axis] * self.sign, ends[0]);
        document.add_cut(sections.spare(cut([surface]).name(NAME)))?;
        let list = |v: DVec3| Value::from(v.to_array().to_vec());
        let name = (document.root().get("cut"))
            .and_then(|cuts| cuts.items().get(before)?.name().map(str::to_owned))
            .unwrap_or_else(|| NAME.to_owned());
        let key: Value = Value::from([
            ("target", format!("cut.{name}.surfaces.0.origin").into()),
            ("times_s", vec![start_s, last_s, end_s].into()),
            (
                "values",
                vec![list(ends[0]), list(ends[1]), list(ends[1])].into(),
            ),
        ]);
        let origin = Origin::Option("--sweep".into());
        document.push("key", Node::new(key).said(&origin))
    }
}

/// Reads `[-]AXIS=FROM:TO`.
pub(super) fn parse_sweep(text: &str) -> Result<PlaneSweep, String> {
    let fault = |what: String| format!("{what}\n  help: write for example y=10%:90%, or -z=0:25");
    let no_form = || fault("expected AXIS=FROM:TO".to_owned());
    let (axis, places) = text.split_once('=').ok_or_else(no_form)?;
    let (from, to) = places.split_once(':').ok_or_else(no_form)?;
    let (sign, letter) = match axis.trim().strip_prefix('-') {
        Some(letter) => (-1.0, letter),
        None => (1.0, axis.trim()),
    };
    let axis = ["x", "y", "z"]
        .iter()
        .position(|a| letter.eq_ignore_ascii_case(a));
    let axis = axis.ok_or_else(|| fault(format!("`{letter}` is not an axis")))?;
    let ends = [
        Amount::parse(from).map_err(fault)?,
        Amount::parse(to).map_err(fault)?,
    ];
    Ok(PlaneSweep { axis, sign, ends })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sweeps_are_read_or_refused_with_an_example() {
        let sweep = parse_sweep("-y=10%:2.5").expect("an axis and two places");
        assert_eq!((sweep.axis, sweep.sign), (1, -1.0));
        assert_eq!(sweep.ends, [Amount::Percent(10.0), Amount::Units(2.5)]);
        for text in ["y", "y=10%", "w=0:1", "y=a:1", "y=0:nan", "=0:1", ""] {
            let message = parse_sweep(text).expect_err(text);
            assert!(message.contains("help:"), "{text}: {message}");
        }
    }
}
