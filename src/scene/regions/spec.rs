//! Boxes and wedges as one word of the command line.
//!
//! ```text
//! 0,0,0:1,1,1            a box between two corners; coordinates may be percentages of the bounds
//! 50%,50%,50%:           open where a corner is left out
//! z:0:90                 a wedge about z through the middle of the bounds, from x to y
//! -y:-30:200@0,50%,0     about another line; the axis may be -x, -y or -z
//! ```

use glam::DVec3;

use super::{Block, Wedge, next_axis};
use crate::error::{Error, Result};
use crate::scene::Bounds;
use crate::scene::section::Amount;

const BOX: &str = "write for example `0,0,0:1,1,1`, or `50%,50%,50%:` for a box that is open above";
const WEDGE: &str = "write for example `z:0:90`, or `-y:-30:200@0,50%,0`";

impl Block {
    /// Reads `MIN:MAX`.
    pub fn parse(text: &str, bounds: &Bounds) -> Result<Self> {
        let fault = |what: String| Error::input(format!("box `{text}`"), what, BOX);
        let Some((min, max)) = text.split_once(':') else {
            return Err(fault("it has no `:` between its corners".into()));
        };
        let corner = |text: &str| match text.trim() {
            "" => Ok([None; 3]),
            text => point(text, bounds).map(|p| p.to_array().map(Some)),
        };
        let block = Self {
            min: corner(min).map_err(fault)?,
            max: corner(max).map_err(fault)?,
        };
        if block == Self::default() {
            return Err(fault("it has no corner".into()));
        }
        Ok(block)
    }
}

impl Wedge {
    /// Reads `AXIS:FROM:TO`, with `@X,Y,Z` for a point of the axis.
    pub fn parse(text: &str, bounds: &Bounds) -> Result<Self> {
        let fault = |what: String| Error::input(format!("wedge `{text}`"), what, WEDGE);
        let (turn, origin) = match text.split_once('@') {
            Some((turn, origin)) => (turn, point(origin, bounds).map_err(fault)?),
            None => (text, bounds.centre()),
        };
        let words: Vec<&str> = turn.split(':').map(str::trim).collect();
        let [axis, from, to] = words[..] else {
            return Err(fault("it is not an axis and two angles".into()));
        };
        let (sign, letter) = match axis.strip_prefix('-') {
            Some(letter) => (-1.0, letter),
            None => (1.0, axis),
        };
        let along = match letter {
            "x" => DVec3::X,
            "y" => DVec3::Y,
            "z" => DVec3::Z,
            _ => return Err(fault(format!("`{axis}` is no axis"))),
        } * sign;
        let angle = |text: &str| match Amount::parse(text) {
            Ok(Amount::Units(degrees)) => Ok(degrees),
            Ok(Amount::Percent(_)) => Err(fault(format!("`{text}` is no angle"))),
            Err(what) => Err(fault(what)),
        };
        let (from_deg, to_deg) = (angle(from)?, angle(to)?);
        let turn_deg = to_deg - from_deg;
        if !(0.0..360.0).contains(&turn_deg) {
            let what =
                format!("it turns by {turn_deg} degrees, which is not from 0 to less than 360");
            return Err(fault(what));
        }
        Ok(Self {
            origin,
            along,
            zero: next_axis(along),
            from_deg,
            to_deg,
            min: None,
            max: None,
        })
    }
}

fn point(text: &str, bounds: &Bounds) -> Result<DVec3, String> {
    let amounts: Vec<Amount> = text
        .split(',')
        .map(Amount::parse)
        .collect::<Result<_, _>>()?;
    let [x, y, z] = amounts[..] else {
        return Err(format!("`{text}` has {} coordinates, not 3", amounts.len()));
    };
    let amounts = [x, y, z];
    let is_relative = amounts.iter().any(|a| matches!(a, Amount::Percent(_)));
    if is_relative && bounds.is_empty() {
        return Err("a percentage needs bounds, but there is no part".into());
    }
    Ok(DVec3::from(std::array::from_fn(|i| {
        amounts[i].between(bounds.min[i], bounds.max[i])
    })))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds() -> Bounds {
        Bounds {
            min: DVec3::new(-1.0, 0.0, 2.0),
            max: DVec3::new(3.0, 1.0, 12.0),
        }
    }

    #[test]
    fn words_are_what_they_say() {
        let block = Block::parse("50%,0,25%:3,1,100%", &bounds()).expect("a box");
        assert_eq!(block.min, [Some(1.0), Some(0.0), Some(4.5)]);
        assert_eq!(block.max, [Some(3.0), Some(1.0), Some(12.0)]);
        let open = Block::parse(":0,0.5,4", &bounds()).expect("a box");
        assert_eq!((open.min, open.max[2]), ([None; 3], Some(4.0)));

        let wedge = Wedge::parse("z:-30:200", &bounds()).expect("a wedge");
        assert_eq!((wedge.origin, wedge.along), (bounds().centre(), DVec3::Z));
        assert_eq!(wedge.zero, DVec3::X);
        assert_eq!((wedge.from_deg, wedge.to_deg), (-30.0, 200.0));
        let wedge = Wedge::parse("-x:0:90@0,50%,3", &bounds()).expect("a wedge");
        assert_eq!((wedge.along, wedge.zero), (DVec3::NEG_X, DVec3::Y));
        assert_eq!(wedge.origin, DVec3::new(0.0, 0.5, 3.0));
    }

    #[test]
    fn what_makes_no_sense_is_told() {
        for (text, told) in [
            ("0,0,0", "no `:`"),
            (":", "no corner"),
            ("0,0:1,1,1", "2 coordinates"),
            ("0,0,a:", "`a` is not a number"),
        ] {
            let error = Block::parse(text, &bounds()).expect_err(text).to_string();
            assert!(error.contains(told) && error.contains("help:"), "{error}");
        }
        for (text, told) in [
            ("z", "two angles"),
            ("w:0:90", "`w` is no axis"),
            ("z:0:9%", "no angle"),
            ("z:0:x", "not a number"),
            ("z:0:360", "less than 360"),
            ("z:90:0", "-90"),
            ("z:0:90@1,2", "2 coordinates"),
        ] {
            let error = Wedge::parse(text, &bounds()).expect_err(text).to_string();
            assert!(error.contains(told) && error.contains("help:"), "{error}");
        }
        let none = Block::parse("50%,0,0:", &Bounds::EMPTY);
        assert!(none.is_err(), "a percentage of nothing");
    }
}
