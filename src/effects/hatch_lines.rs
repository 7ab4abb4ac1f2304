//! Lines of a hatch, general or patterned. The class of the part determines their rotation and spacing, so that touching parts differ.

use glam::DVec2;

use crate::plan::pack;
use crate::scene::{HatchPattern, LineFamily, MOST_STROKES};

/// Spacing factor that lies between two thickness steps, so that the hatch differs from that of a thicker part with the same direction.
const WIDER: f64 = 1.57;
/// Direction of each class relative to the first, in degrees, and the factor on its spacing.
const CLASSES: [(f64, f64); 8] = [
    (0.0, 1.0),
    (90.0, 1.0),
    (0.0, WIDER),
    (90.0, WIDER),
    (-25.0, 1.0),
    (115.0, 1.0),
    (25.0, 1.0),
    (65.0, 1.0),
];
/// As [`CLASSES`], for patterns that a quarter turn leaves unchanged.
const CROSSED: [(f64, f64); 8] = [
    (0.0, 1.0),
    (45.0, 1.0),
    (0.0, WIDER),
    (45.0, WIDER),
    (22.0, 1.0),
    (-22.0, 1.0),
    (22.0, WIDER),
    (-22.0, WIDER),
];
/// Hatch angle at which patterns keep their own directions in the first class.
const PATTERN_DEG: f64 = 45.0;

/// Placement of the lines of a part.
pub(super) struct HatchPlacement {
    /// Class of the part.
    pub(super) class: usize,
    /// Direction of the general hatch in the first class.
    pub(super) angle_deg: f64,
    /// Line spacing in the first class, in scene units.
    pub(super) spacing: f64,
}

/// Makes the lines of a pattern, or of the general hatch.
pub(super) fn lines_of(
    pattern: Option<&HatchPattern>,
    placed: &HatchPlacement,
) -> Vec<pack::HatchLine> {
    let is_crossed = pattern.is_some_and(HatchPattern::is_crossed);
    let classes = if is_crossed { &CROSSED } else { &CLASSES };
    let (turn_deg, wider) = classes[placed.class % classes.len()];
    let round = (placed.class / classes.len()) as f64;
    let turn_deg = placed.angle_deg - PATTERN_DEG + turn_deg + 15.0 * round;
    let spacing = placed.spacing * wider * (1.0 + 0.25 * round);
    let general = [LineFamily {
        angle_deg: PATTERN_DEG,
        origin: [0.0; 2],
        shift: 0.0,
        spacing: 1.0,
        dashes: Vec::new(),
    }];
    let (families, unit) = match pattern {
        Some(pattern) => (pattern.families.as_slice(), pattern.unit()),
        None => (general.as_slice(), 1.0),
    };
    let lines = families.iter();
    lines
        .map(|f| line_of(f, turn_deg, spacing / unit))
        .collect()
}

/// A line family, rotated and scaled.
fn line_of(family: &LineFamily, turn_deg: f64, scale: f64) -> pack::HatchLine {
    let turned = |angle_deg: f64| DVec2::from_angle(angle_deg.to_radians());
    let along = turned(family.angle_deg + turn_deg);
    let origin = turned(turn_deg).rotate(DVec2::from(family.origin) * scale);
    let across = along.perp() / (family.spacing * scale);
    let mut dash_count = 0;
    let [mut dash_centres, mut dash_lengths] = [[0.0; MOST_STROKES]; 2];
    let period = family.period();
    let mut at = 0.0;
    for dash in &family.dashes {
        if dash.is_drawn && dash_count < MOST_STROKES {
            dash_centres[dash_count] = ((at + dash.length / 2.0) / period) as f32;
            dash_lengths[dash_count] = (dash.length / period) as f32;
            dash_count += 1;
        }
        at += dash.length;
    }
    let along = match dash_count {
        0 => DVec2::ZERO,
        _ => along / (period * scale),
    };
    pack::HatchLine {
        across: across.as_vec2().to_array(),
        along: along.as_vec2().to_array(),
        phase: -across.dot(origin) as f32,
        dash_phase: -along.dot(origin) as f32,
        shift: match dash_count {
            0 => 0.0,
            _ => (family.shift / period) as f32,
        },
        dash_count: dash_count as u32,
        dash_centres,
        dash_lengths,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Dash;

    fn placed(class: usize) -> HatchPlacement {
        HatchPlacement {
            class,
            angle_deg: 45.0,
            spacing: 1.0,
        }
    }

    #[test]
    fn no_two_classes_look_alike() {
        let net = HatchPattern {
            name: "net".into(),
            families: [45.0, 135.0]
                .map(|angle_deg| LineFamily {
                    angle_deg,
                    origin: [0.0; 2],
                    shift: 0.0,
                    spacing: 1.0,
                    dashes: Vec::new(),
                })
                .to_vec(),
        };
        for (pattern, count) in [(None, 40), (Some(&net), 16)] {
            let all: Vec<Vec<DVec2>> = (0..count)
                .map(|class| {
                    let lines = lines_of(pattern, &placed(class));
                    let across = lines.iter().map(|l| DVec2::from(l.across.map(f64::from)));
                    across.collect()
                })
                .collect();
            // Opposite directions are the same line, and families are unordered.
            let apart = |a: DVec2, b: DVec2| (a - b).length().min((a + b).length());
            for (i, a) in all.iter().enumerate() {
                for b in &all[..i] {
                    let lonely = a.iter().any(|a| b.iter().all(|b| apart(*a, *b) > 0.05));
                    assert!(lonely, "{a:?} and {b:?}");
                }
            }
        }
    }

    #[test]
    fn a_dashed_line_has_its_strokes_where_the_pattern_has_them() {
        let dash = |length, is_drawn| Dash { length, is_drawn };
        let family = LineFamily {
            angle_deg: 0.0,
            origin: [2.0, 1.0],
            shift: 3.0,
            spacing: 2.0,
            dashes: vec![
                dash(3.0, true),
                dash(1.0, false),
                dash(0.0, true),
                dash(2.0, false),
            ],
        };
        let line = line_of(&family, 0.0, 10.0);
        // Half a period is three units.
        assert_eq!((line.dash_count, line.shift), (2, 0.5));
        assert_eq!(line.dash_centres[..2], [0.25, 4.0 / 6.0]);
        assert_eq!(line.dash_lengths[..2], [0.5, 0.0]);
        let at = |[x, y]: [f32; 2], [u, v]: [f32; 2]| x * u + y * v;
        // The first line passes through the origin of the family, and the next is two units above.
        assert!((at(line.across, [7.0, 10.0]) + line.phase).abs() < 1e-6);
        assert!((at(line.across, [7.0, 30.0]) + line.phase - 1.0).abs() < 1e-6);
        assert!((at(line.along, [20.0, 0.0]) + line.dash_phase).abs() < 1e-6);
        assert!((at(line.along, [80.0, 0.0]) + line.dash_phase - 1.0).abs() < 1e-6);
    }
}
