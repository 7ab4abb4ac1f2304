//! Flat clip-surfaces, and the exact sign of a point's height over one.

use glam::DVec3;

use crate::scene::geometry::exact_sum::sum_of_products;

/// Rounding error of a height in f64, as a share of the sum of its terms' magnitudes: less than 3 ulp.
const RELATIVE_ROUNDING: f64 = 1e-15;

/// A side of a clip-surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// The side that is kept.
    Kept,
    /// The side that is removed, wherever all other clip-surfaces of the cut remove too.
    Removed,
}

impl Side {
    /// The opposite side.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Kept => Self::Removed,
            Self::Removed => Self::Kept,
        }
    }
}

/// A clip-surface without relief, or with a flat one: the points with `(P - O).N + lift = 0`; points with a negative value are removed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatSurface {
    /// `O`.
    pub origin: DVec3,
    /// `N`.
    pub normal: DVec3,
    /// Height of the relief.
    pub lift: f64,
}

impl FlatSurface {
    /// Signed height of a point, positive on the kept side; only the sign is exact, so the height is zero only on the surface.
    pub fn height(&self, point: DVec3) -> f64 {
        let terms = (point - self.origin) * self.normal;
        let sum = terms.element_sum() + self.lift;
        let size = terms.abs().element_sum() + self.lift.abs();
        if sum.abs() > size * RELATIVE_ROUNDING + f64::MIN_POSITIVE {
            sum
        } else {
            self.exact_height(point)
        }
    }

    /// Signed height of a point, computed in f64 with rounding errors.
    pub(crate) fn rough_height(&self, point: DVec3) -> f64 {
        (point - self.origin).dot(self.normal) + self.lift
    }

    /// Signed height of a point, computed exactly and rounded once. Takes about 100 ns.
    pub fn exact_height(&self, point: DVec3) -> f64 {
        let (p, o, n) = (point, self.origin, self.normal);
        sum_of_products([
            [p.x, n.x],
            [p.y, n.y],
            [p.z, n.z],
            [-o.x, n.x],
            [-o.y, n.y],
            [-o.z, n.z],
            [self.lift, 1.0],
        ])
    }
}
