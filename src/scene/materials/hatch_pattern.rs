//! Hatch patterns for materials: families of parallel lines, as used in technical drawings.
//!
//! A pattern has no size of its own: it is scaled so that the mean spacing of its lines in one direction equals the part's hatch spacing.

use std::sync::Arc;

/// Maximum number of strokes and dots in a dash period.
pub const MOST_STROKES: usize = 4;

/// Hatch of a part's caps, used by styles that hatch.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum CapHatch {
    /// Plain parallel lines.
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
    /// At least one family; angles are relative to the hatch direction of the first class minus 45 degrees.
    pub families: Vec<LineFamily>,
}

/// Parallel lines of a pattern, in units of the pattern.
#[derive(Clone, Debug, PartialEq)]
pub struct LineFamily {
    /// Direction of the lines, in degrees from the horizontal.
    pub angle_deg: f64,
    /// A point at which one of the lines and its dashes start.
    pub origin: [f64; 2],
    /// Offset of each line from the previous one along the line direction.
    pub shift: f64,
    /// Distance between adjacent lines; not 0.
    pub spacing: f64,
    /// Dashes of a line from the origin, of which at most [`MOST_STROKES`] are drawn; empty for continuous lines.
    pub dashes: Vec<Dash>,
}

/// A stroke or gap of a dashed line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dash {
    /// Length; 0 is a dot.
    pub length: f64,
    /// True for a stroke, false for a gap.
    pub is_drawn: bool,
}

impl LineFamily {
    /// Length after which the dashes repeat; 0 for continuous lines.
    pub fn period(&self) -> f64 {
        self.dashes.iter().map(|d| d.length).sum()
    }

    /// Returns true if the lines of both families are parallel.
    fn is_parallel_to(&self, other: &Self) -> bool {
        let apart = (self.angle_deg - other.angle_deg).rem_euclid(180.0);
        apart.min(180.0 - apart) < 0.5
    }
}

impl HatchPattern {
    /// Mean distance between the lines of all families with the same direction; the smallest such mean over all directions.
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

    /// Returns true if lines run in more than one direction, in which case a quarter turn may not change the pattern.
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
