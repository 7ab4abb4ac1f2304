//! What is expected where an adapter snaps vertices to fewer than 8 sub-pixel bits: the table of what such adapters may differ in.
//!
//! Vulkan promises 4 bits, which SwiftShader has. All other expectations hold there too, with the band of doubt that goes with the bits.
//! Limits: found on SwiftShader alone.

use cutaway::scene::glob_matches;
use cutaway::strategies::Method;

use super::expected::Expected::{
    self, Doubted, Fails, FailsWithin, Overflows, Refuses, RefusesSome, Within,
};

/// The name of a case, a glob of methods, and what is expected of them.
type Difference = (&'static str, &'static str, Expected);

const DIFFERENCES: &[Difference] = &[
    // A triangle without area may cover a sample, and an edge that is split on one side parts by more than its vertex is off it.
    ("needles and triangles without area", "*", Doubted),
    ("edges split on one side", "*", Doubted),
    ("no bottom, T-junctions, a face twice", "*", Doubted),
    // Facets are narrower than a step of the rasteriser.
    (
        "steps one texel wide, very high",
        "adaptive:*",
        Within(0.01, NARROW),
    ),
    (
        "steps one texel wide, very high",
        "grid:*",
        Within(0.01, NARROW),
    ),
    ("maps of odd sizes", "grid:*", Within(0.228, NARROW)),
    ("mixed winding", "*", Within(1.0 / 16.0, MOVED)),
];

const NARROW: &str = "its facets are narrower than a step of this adapter's rasteriser";
const MOVED: &str =
    "faces that are wound against each other meet, and this adapter moves them by 1/16 px";

/// What is expected of a method at a case instead of what is usual.
pub(super) fn expected(case: &str, method: &Method, usual: Expected) -> Expected {
    if matches!(
        usual,
        Refuses(_) | RefusesSome(_) | Fails(_) | FailsWithin(..) | Overflows(_)
    ) {
        return usual;
    }
    let name = method.to_string();
    let mut rows = DIFFERENCES.iter();
    let row = rows.find(|(of, glob, _)| *of == case && glob_matches(glob, &name));
    row.map_or(usual, |(_, _, expected)| *expected)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hard_cases::{cases, usual_methods};

    #[test]
    fn every_difference_is_one_of_a_case() {
        for (name, glob, expected) in DIFFERENCES {
            let case = cases()
                .find(|c| c.name == *name)
                .unwrap_or_else(|| panic!("no case `{name}`"));
            let methods = usual_methods(64);
            let mut changed = methods.iter().filter(|m| {
                glob_matches(glob, &m.to_string()) && case.expected_on(m, true) == *expected
            });
            let differs = changed.any(|m| case.expected(m) != *expected);
            assert!(differs, "{name}, {glob}: nothing is expected otherwise");
        }
    }
}
