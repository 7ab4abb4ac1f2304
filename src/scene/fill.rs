//! Fill rule: decides from crossing counts whether a point is inside a mesh.
//!
//! Along any ray from the point, each crossing with a triangle counts 1 if the ray meets the triangle's inner side, -1 if it meets
//! the outer side; the sum is the *winding number*. A closed mesh that faces outward and does not intersect itself has 1
//! inside and 0 outside, and both rules give the same solid. They differ where shells overlap, nest or repeat: even-odd carves
//! a void wherever two overlap, nonzero unites them. The names come from 2D drawing; for solids see Rossignac, Fudos &
//! Vasilakis, *Direct rendering of Boolean combinations of self-trimmed surfaces* (2013).
//!
//! Nonzero depends on the orientation of every triangle; even-odd ignores it. Where neighbours face opposite ways, the winding number
//! jumps across the edge between them, and the mesh is as open there as if one of them were missing.

use std::fmt;
use std::str::FromStr;

use crate::Error;
use crate::error::did_you_mean;
use crate::scene::describe::{Described, words};

/// Fill rule: the points that a mesh encloses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Described)]
pub enum Fill {
    /// Points with an odd number of crossings along a ray.
    #[default]
    EvenOdd,
    /// Points with a nonzero winding number.
    Nonzero,
}

impl Fill {
    /// Returns true if a point with this winding number is inside. The winding number has the same parity as the number of crossings.
    pub fn holds(self, winding: i32) -> bool {
        match self {
            Self::EvenOdd => winding % 2 != 0,
            Self::Nonzero => winding != 0,
        }
    }
}

impl fmt::Display for Fill {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Fill {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::named(text).ok_or_else(|| {
            Error::input(
                format!("fill `{text}`"),
                "there is no such rule",
                did_you_mean(text, words(&Self::ALL)),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rules_part_at_two() {
        for (winding, even_odd, nonzero) in [
            (0, false, false),
            (1, true, true),
            (-1, true, true),
            (2, false, true),
            (-2, false, true),
            (-3, true, true),
        ] {
            assert_eq!(Fill::EvenOdd.holds(winding), even_odd, "{winding}");
            assert_eq!(Fill::Nonzero.holds(winding), nonzero, "{winding}");
        }
    }

    #[test]
    fn names_are_read_and_mended() {
        for name in Fill::ALL.map(|(name, _)| name) {
            assert_eq!(name.parse::<Fill>().expect(name).to_string(), name);
        }
        let message = "nonzer".parse::<Fill>().expect_err("no rule").to_string();
        assert!(message.contains("`nonzero`"), "{message}");
    }
}
