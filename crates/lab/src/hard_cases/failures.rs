//! By how much the built-in strategies fail where they are expected to: wrong pixels per covered pixel over all pictures of a case.
//!
//! The table holds what was found, the least and the most of pictures of 64 and of 256 px; half the one to double the other is let pass.
//! A failure that gets worse is reported, and so is one that is nearly gone. Strategies with other parameters have no line here: of them
//! no more is asked than to fail.

use cutaway::strategies::Method;

use super::tolerances::FACTOR;

/// The name of a case, that of a strategy, and the least and the most that was found.
type Found = (&'static str, &'static str, [f64; 2]);

/// How much of the covered pixels may be wrong, at least and at most, where a strategy is expected to fail at a case.
pub(super) fn bounds(case: &str, method: &Method) -> Option<[f64; 2]> {
    let name = method.to_string();
    let line = FOUND.iter().find(|(c, e, _)| *c == case && *e == name)?;
    let [least, most] = line.2;
    Some([least / FACTOR, most * FACTOR])
}

const FOUND: &[Found] = &[
    ("every face twice", "raycast+vds:512", [0.81991, 0.81991]),
    ("every face twice", "grid:256+vds:512", [0.81991, 0.84137]),
    (
        "one triangle missing, nonzero",
        "stencil",
        [0.00759, 0.00863],
    ),
    (
        "one triangle missing, nonzero",
        "planar",
        [0.01168, 0.01347],
    ),
    (
        "one triangle missing, nonzero",
        "planar@compute",
        [0.01168, 0.01168],
    ),
    (
        "one triangle missing",
        "raycast+ldi:512",
        [0.02102, 0.02102],
    ),
    (
        "one triangle missing",
        "raycast+vds:512",
        [0.02102, 0.02102],
    ),
    ("one triangle missing", "stencil", [0.00759, 0.00863]),
    ("one triangle missing", "planar", [0.01168, 0.01347]),
    ("one triangle missing", "planar@compute", [0.01168, 0.01168]),
    (
        "one triangle missing",
        "grid:256+ldi:512",
        [0.02160, 0.02160],
    ),
    (
        "one triangle missing",
        "grid:256+vds:512",
        [0.02160, 0.02337],
    ),
    (
        "edges split on one side",
        "raycast+ldi:512",
        [0.01510, 0.01510],
    ),
    (
        "edges split on one side",
        "raycast+vds:512",
        [0.01510, 0.01510],
    ),
    ("edges split on one side", "stencil", [0.00529, 0.00581]),
    (
        "edges split on one side",
        "grid:256+ldi:512",
        [0.01568, 0.01568],
    ),
    (
        "edges split on one side",
        "grid:256+vds:512",
        [0.01568, 0.01841],
    ),
    (
        "cut almost along a face",
        "grid:256+ldi:512",
        [0.00362, 0.00362],
    ),
    (
        "cut almost along a face",
        "grid:256+vds:512",
        [0.00362, 0.00683],
    ),
    (
        "no bottom, T-junctions, a face twice",
        "raycast+ldi:512",
        [0.07773, 0.07773],
    ),
    (
        "no bottom, T-junctions, a face twice",
        "raycast+vds:512",
        [0.07773, 0.07773],
    ),
    (
        "no bottom, T-junctions, a face twice",
        "stencil",
        [0.02810, 0.03109],
    ),
    (
        "no bottom, T-junctions, a face twice",
        "grid:256+ldi:512",
        [0.07846, 0.07846],
    ),
    (
        "no bottom, T-junctions, a face twice",
        "grid:256+vds:512",
        [0.07846, 0.08313],
    ),
    (
        "parts that are moved, and open",
        "raycast+ldi:512",
        [0.21894, 0.21894],
    ),
    (
        "parts that are moved, and open",
        "raycast+vds:512",
        [0.21894, 0.21894],
    ),
    (
        "parts that are moved, and open",
        "stencil",
        [0.04677, 0.12112],
    ),
    (
        "parts that are moved, and open",
        "grid:256+ldi:512",
        [0.22671, 0.22671],
    ),
    (
        "parts that are moved, and open",
        "grid:256+vds:512",
        [0.22671, 0.25998],
    ),
    (
        "triangles missing here and there",
        "raycast+ldi:512",
        [0.11337, 0.11337],
    ),
    (
        "triangles missing here and there",
        "raycast+vds:512",
        [0.11337, 0.11337],
    ),
    (
        "triangles missing here and there",
        "stencil",
        [0.03914, 0.04057],
    ),
    (
        "triangles missing here and there",
        "grid:256+ldi:512",
        [0.11695, 0.11695],
    ),
    (
        "triangles missing here and there",
        "grid:256+vds:512",
        [0.11562, 0.11695],
    ),
    (
        "a face in the plane, or an ulp beside it",
        "grid:256+ldi:512",
        [0.22451, 0.22451],
    ),
    (
        "a face in the plane, or an ulp beside it",
        "grid:256+vds:512",
        [0.22451, 0.22787],
    ),
    (
        "a plane in the face between two products",
        "raycast+ldi:512",
        [0.00405, 0.00405],
    ),
    (
        "a plane in the face between two products",
        "raycast+vds:512",
        [0.00405, 0.00405],
    ),
    (
        "a plane in the face between two products",
        "grid:256+ldi:512",
        [0.00045, 0.00045],
    ),
    (
        "a plane in the face between two products",
        "grid:256+vds:512",
        [0.00003, 0.00045],
    ),
];

#[cfg(test)]
mod tests {
    use super::super::usual_methods;
    use super::*;
    use crate::hard_cases::{Expected, cases};

    /// Failures of built-in strategies, and whether a line says by how much each fails.
    fn failures() -> Vec<(&'static str, String, bool)> {
        let mut all = Vec::new();
        for case in cases() {
            for method in usual_methods(0) {
                match case.expected(&method) {
                    Expected::Fails(_) => all.push((case.name, method.to_string(), false)),
                    Expected::FailsWithin(..) => all.push((case.name, method.to_string(), true)),
                    _ => {}
                }
            }
        }
        all
    }

    #[test]
    fn every_failure_has_a_line_and_every_line_a_failure() {
        let failures = failures();
        let bare: Vec<_> = failures.iter().filter(|f| !f.2).collect();
        assert!(bare.is_empty(), "nobody says by how much: {bare:?}");
        let is_used = |line: &&Found| failures.iter().any(|f| f.0 == line.0 && f.1 == line.1);
        let unused: Vec<_> = FOUND.iter().filter(|l| !is_used(l)).collect();
        assert!(unused.is_empty(), "lines of what does not fail: {unused:?}");
        assert_eq!(FOUND.len(), failures.len(), "a line is there twice");
        let is_ordered = |line: &Found| 0.0 < line.2[0] && line.2[0] <= line.2[1];
        assert!(FOUND.iter().all(is_ordered), "least before most");
    }

    #[test]
    fn other_parameters_have_no_bounds() {
        let bounds =
            |name: &str| bounds("every face twice", &name.parse::<Method>().expect("a name"));
        assert!(bounds("grid:256+vds:512").is_some(), "built in");
        assert_eq!(bounds("grid:16+vds:32"), None);
    }
}
