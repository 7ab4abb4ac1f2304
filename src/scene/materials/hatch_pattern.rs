//! Patterns of hatches by material: families of parallel lines, as drawings have them.
//!
//! A pattern has no size of its own: its lines are as far apart as the hatch of the part asks, on the mean over those of one direction.

use std::sync::Arc;

/// The most strokes and dots of a period of dashes.
pub const MOST_STROKES: usize = 4;

/// Hatch of a part's caps, in styles that have hatches.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum CapHatch {
    /// Parallel lines.
    #[default]
    General,
    /// Nothing.
    None,
    /// Filled without gaps.
    Solid,
    /// A pattern.
    Pattern(Arc<HatchPattern>),
}

/// Families of lines.
#[derive(Clone, Debug, PartialEq)]
pub struct HatchPattern {
    /// Name of the pattern.
    pub name: String,
    /// At least one; their directions are over that of the hatch's first class less 45 degrees.
    pub families: Vec<LineFamily>,
}

/// Parallel lines of a pattern, in units of the pattern.
#[derive(Clone, Debug, PartialEq)]
pub struct LineFamily {
    /// Direction of the lines, in degrees from the horizontal.
    pub angle_deg: f64,
    /// A point that a line begins at.
    pub origin: [f64; 2],
    /// Offset of each line from the previous one along the line direction.
    pub shift: f64,
    /// Distance from line to line; not 0.
    pub spacing: f64,
    /// Stretches of a line from the origin, of which [`MOST_STROKES`] are drawn at most; none for lines without end.
    pub dashes: Vec<Dash>,
}

/// A stretch of a dashed line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dash {
    /// 0 is a dot.
    pub length: f64,
    /// True for a stroke, false for a gap.
    pub is_drawn: bool,
}

impl LineFamily {
    /// Length after which the dashes repeat; 0 for lines without end.
    pub fn period(&self) -> f64 {
        self.dashes.iter().map(|d| d.length).sum()
    }

    /// Returns true if the lines of both are parallel.
    fn is_parallel_to(&self, other: &Self) -> bool {
        let apart = (self.angle_deg - other.angle_deg).rem_euclid(180.0);
        apart.min(180.0 - apart) < 0.5
    }
}

impl HatchPattern {
    /// The mean distance from line to line over the families of one direction, the least of all directions.
    pub fn unit(&self) -> f64 {
        let distance = |of: &LineFamily| {
            let alike = self.families.iter().filter(|f| f.is_parallel_to(of));
            1.0 / alike.map(|f| 1.0 / f.spacing.abs()).sum::<f64>()
        };
        self.families
            .iter()
            .map(distance)
            .fold(f64::INFINITY, f64::min)
    }

    /// Returns true if lines run in more than one direction, so that a quarter turn may change nothing.
    pub fn is_crossed(&self) -> bool {
        let first = self.families.first();
        first.is_some_and(|first| !self.families.iter().all(|f| f.is_parallel_to(first)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn family(angle_deg: f64, spacing: f64) -> LineFamily {
        LineFamily {
            angle_deg,
            origin: [0.0; 2],
            shift: 0.0,
            spacing,
            dashes: Vec::new(),
        }
    }

    #[test]
    fn the_unit_is_the_mean_distance_of_one_direction() {
        let of = |families: Vec<LineFamily>| HatchPattern {
            name: "p".into(),
            families,
        };
        let pairs = of(vec![family(45.0, 3.0), family(225.0, -3.0)]);
        assert!((pairs.unit() - 1.5).abs() < 1e-12 && !pairs.is_crossed());
        let crossed = of(vec![family(45.0, 2.0), family(135.0, 1.0)]);
        assert!((crossed.unit() - 1.0).abs() < 1e-12 && crossed.is_crossed());
    }
}
