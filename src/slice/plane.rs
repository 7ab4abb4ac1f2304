//! The plane of a section, with an exact test for the side of a point.

use glam::{DVec2, DVec3};

use super::slicer::share;
use crate::scene::{Bounds, ClipSurface, FlatSurface, PreparedSurface, SurfaceFrame};

/// Largest coordinate used in computations: differences and products with directions stay finite.
pub(super) const LARGEST: f64 = 1e300;

/// A plane with a 2D frame. The side that the normal points to is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlicePlane {
    /// `O`, which decides the sides of points. It may be far away.
    pub origin: DVec3,
    /// The point with coordinates (0, 0): `O`, or one nearer to the sliced object ([`SlicePlane::seen_from`]).
    pub zero: DVec3,
    /// `Û`, `V̂` and `N`, orthonormal.
    pub frame: SurfaceFrame,
    /// Distance by which the plane was moved against its normal.
    pub lift: f64,
}

impl From<&ClipSurface> for SlicePlane {
    /// The plane of a clip-surface in world space; its relief, if it has one, is ignored.
    fn from(surface: &ClipSurface) -> Self {
        Self {
            origin: surface.origin,
            zero: surface.origin,
            frame: surface.frame(),
            lift: 0.0,
        }
    }
}

impl From<&PreparedSurface> for SlicePlane {
    /// The plane of a clip-surface in scene space; its relief, if it has one, is ignored.
    fn from(surface: &PreparedSurface) -> Self {
        Self {
            origin: surface.origin,
            zero: surface.origin,
            frame: surface.frame,
            lift: 0.0,
        }
    }
}

impl SlicePlane {
    /// The plane of a clip-surface in world space, at the height of its relief; `None` if the relief is not flat.
    #[doc(hidden)]
    pub fn of_flat(surface: &ClipSurface) -> Option<Self> {
        let plane = Self::from(surface);
        let Some(map) = &surface.relief else {
            return Some(plane);
        };
        let [low, high] = map.range().map(|h| f64::from(h) * surface.scale.z);
        (low == high).then(|| plane.keeping(low))
    }

    /// The same plane with the foot of a point at (0, 0): geometry near that point then has small coordinates, which lose no
    /// precision to the distance of `O`. Sides do not change.
    #[must_use]
    pub fn seen_from(self, point: DVec3) -> Self {
        let zero = point - self.frame.normal * self.height(point);
        Self {
            zero: if is_within(zero) { zero } else { self.zero },
            ..self
        }
    }

    /// The plane moved against its normal.
    #[must_use]
    pub fn keeping(self, distance: f64) -> Self {
        Self {
            lift: self.lift + distance,
            zero: self.zero - self.frame.normal * distance,
            ..self
        }
    }

    /// Coordinates along `Û` and `V̂` of the foot of a point.
    pub fn coordinates(&self, point: DVec3) -> DVec2 {
        let d = point - self.zero;
        DVec2::new(d.dot(self.frame.u_hat), d.dot(self.frame.v_hat))
    }

    /// The point of the plane with some coordinates along `Û` and `V̂`.
    pub fn point(&self, coordinates: DVec2) -> DVec3 {
        self.zero + self.frame.u_hat * coordinates.x + self.frame.v_hat * coordinates.y
    }

    /// Signed distance of a point, positive on the kept side: `(P - O).N + lift` of exactly these numbers, rounded once, so that its
    /// sign is exact and it is zero only on the plane.
    pub fn height(&self, point: DVec3) -> f64 {
        self.flat().exact_height(point)
    }

    /// Returns true if a point is strictly on the kept side, not on the plane.
    pub fn is_above(&self, point: DVec3) -> bool {
        self.signed(point) > 0.0
    }

    /// A number with the sign of [`SlicePlane::height`], but cheaper.
    pub(super) fn signed(&self, point: DVec3) -> f64 {
        self.flat().height(point)
    }

    /// The world axis that the plane is perpendicular to, and its position on that axis.
    fn place_on_axis(&self) -> Option<(usize, f64)> {
        let normal = self.frame.normal;
        let axis = (0..3).find(|i| normal[*i].abs() == 1.0)?;
        Some((axis, self.origin[axis] - self.lift * normal[axis]))
    }

    /// A point on the plane, except for rounding; without rounding error if the plane is axis-aligned.
    pub(super) fn preclassified(&self, mut point: DVec3) -> DVec3 {
        if let Some((axis, at)) = self.place_on_axis() {
            point[axis] = at;
        }
        point
    }

    /// Returns true if two planes contain the same points, whichever side each keeps.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let (own, of_other) = (self.frame.normal, other.frame.normal);
        let is_parallel = own == of_other || own == -of_other;
        let is_in = match (self.place_on_axis(), other.place_on_axis()) {
            (Some(own), Some(of_other)) => own == of_other,
            _ if self.lift == 0.0 && other.lift == 0.0 => self.signed(other.origin) == 0.0,
            _ => own == of_other && self.origin == other.origin && self.lift == other.lift,
        };
        is_parallel && is_in
    }

    /// The plane as a flat clip-surface.
    pub(super) fn flat(&self) -> FlatSurface {
        FlatSurface {
            origin: self.origin,
            normal: self.frame.normal,
            lift: self.lift,
        }
    }

    /// Returns true if a whole box is clearly on one side, and farther away than `margin`. May be false for such a box, but is never true
    /// for any other.
    pub(super) fn misses(&self, bounds: &Bounds, margin: f64) -> bool {
        // Halves first: the sum of two coordinates may be too large.
        let (low, high) = (bounds.min * 0.5, bounds.max * 0.5);
        let (centre, reach) = (low + high, high - low);
        let normal = self.frame.normal.abs();
        let distance = ((centre - self.origin).dot(self.frame.normal) + self.lift).abs();
        let extent = reach.dot(normal);
        let size = (centre.abs() + self.origin.abs() + reach).dot(normal) + self.lift.abs();
        // Infinities and NaN never count as clear.
        distance > extent + margin + size * (16.0 * f64::EPSILON) + f64::MIN_POSITIVE
    }

    /// The convex polygon in which the plane meets a box, as its corners in order: no section of an object in the box extends beyond
    /// it. Empty if the plane misses the box.
    pub fn across(&self, bounds: &Bounds) -> Vec<DVec2> {
        let corners = bounds.corners();
        let heights = corners.map(|c| self.height(c));
        let mut met = Vec::new();
        for (i, a) in corners.iter().enumerate() {
            for (j, b) in corners.iter().enumerate().skip(i + 1) {
                let is_edge = a.cmpeq(*b).bitmask().count_ones() == 2;
                if is_edge && (heights[i] < 0.0) != (heights[j] < 0.0) {
                    let way = share(heights[i].abs(), heights[j].abs());
                    met.push(self.coordinates(a.lerp(*b, way)));
                }
            }
        }
        let middle = met.iter().sum::<DVec2>() / met.len().max(1) as f64;
        met.sort_by(|p, q| {
            (*p - middle)
                .to_angle()
                .total_cmp(&(*q - middle).to_angle())
        });
        met
    }

    /// Returns true if the plane is usable in computations.
    pub(super) fn is_usable(&self) -> bool {
        let SurfaceFrame {
            u_hat,
            v_hat,
            normal,
        } = self.frame;
        let is_direction = |v: DVec3| (0.5..2.0).contains(&v.length_squared());
        [self.origin, self.zero, DVec3::splat(self.lift)]
            .into_iter()
            .all(is_within)
            && [u_hat, v_hat, normal].into_iter().all(is_direction)
    }
}

/// Returns true if a point is usable in computations.
pub(super) fn is_within(point: DVec3) -> bool {
    point.abs().cmple(DVec3::splat(LARGEST)).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(origin: DVec3, normal: DVec3) -> SlicePlane {
        SlicePlane::from(&ClipSurface::plane(origin, normal))
    }

    #[test]
    fn one_ulp_decides() {
        let origin = DVec3::new(0.1, 0.7, -0.3);
        for axis in 0..3 {
            let plane = plane(origin, DVec3::AXES[axis]);
            let mut p = DVec3::splat(123.456);
            for (at, above) in [
                (origin[axis].next_down(), false),
                (origin[axis], false),
                (origin[axis].next_up(), true),
            ] {
                p[axis] = at;
                assert_eq!(plane.is_above(p), above, "{at} on axis {axis}");
            }
        }
    }

    #[test]
    fn the_sign_is_that_of_the_exact_sum() {
        // On the diagonal plane x = y the sum cancels to nothing but the difference, far below the rounding of its terms.
        let mut oblique = plane(DVec3::ZERO, DVec3::Z);
        oblique.frame.normal = DVec3::new(0.6, -0.6, 0.0);
        oblique.origin = DVec3::new(1e17, 1e17, 0.0);
        let p = DVec3::new(0.3, 0.3_f64.next_up(), 5.0);
        let rounded = (p - oblique.origin).dot(oblique.frame.normal);
        assert_eq!(rounded, 0.0, "f64 alone would do: the case proves nothing");
        assert!(!oblique.is_above(p), "below by an ulp of 0.3");
        assert!(!oblique.is_above(DVec3::new(0.3, 0.3, 5.0)), "on the plane");
        let above = DVec3::new(0.3_f64.next_up(), 0.3, 5.0);
        assert!(oblique.is_above(above), "above by an ulp of 0.3");
    }

    #[test]
    fn a_box_that_touches_is_not_missed() {
        let plane = plane(DVec3::new(0.0, 0.0, 1.0), DVec3::Z);
        let between = |low: f64, high: f64| Bounds {
            min: DVec3::new(-1.0, -1.0, low),
            max: DVec3::new(1.0, 1.0, high),
        };
        for (low, high, misses) in [
            (1.0, 2.0, false),
            (0.0, 1.0, false),
            (1.001, 2.0, true),
            (-3.0, 0.999, true),
            (-1e300, 1e300, false),
        ] {
            assert_eq!(
                plane.misses(&between(low, high), 0.0),
                misses,
                "{low}..{high}"
            );
        }
    }

    #[test]
    fn a_box_is_met_in_a_polygon() {
        let bounds = Bounds {
            min: DVec3::splat(-1.0),
            max: DVec3::splat(1.0),
        };
        for (origin, normal, corners, area) in [
            (DVec3::ZERO, DVec3::Z, 4, 4.0),
            (DVec3::ZERO, DVec3::ONE, 6, 27.0_f64.sqrt()),
            (DVec3::splat(0.5), DVec3::ONE, 3, 9.0 / 8.0 * 3.0_f64.sqrt()),
            (DVec3::Z * 1.5, DVec3::Z, 0, 0.0),
        ] {
            let plane = plane(origin, normal.normalize());
            let met = plane.across(&bounds);
            let next = met.iter().cycle().skip(1);
            let twice: f64 = met.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum();
            assert_eq!(met.len(), corners, "{origin}, {normal}");
            assert!((0.5 * twice - area).abs() < 1e-12, "{origin}, {normal}");
        }
    }

    #[test]
    fn coordinates_and_points_are_inverse() {
        let plane = plane(DVec3::new(3.0, 1.0, 2.0), DVec3::new(1.0, 2.0, -0.5));
        let at = DVec2::new(0.25, -7.0);
        let back = plane.coordinates(plane.point(at));
        assert!((back - at).length() < 1e-14, "{back}");
        assert!(plane.height(plane.point(at)).abs() < 1e-14, "on the plane");
    }

    #[test]
    fn a_far_origin_is_seen_from_nearby() {
        let normal = DVec3::new(1.0, 2.0, -0.5).normalize();
        for far in [1e3, 1e6, 1e9, 1e15] {
            let given = plane(normal.cross(DVec3::X).normalize() * far, normal);
            let near = given.seen_from(DVec3::new(0.5, 0.25, 1.0));
            let p = DVec3::new(0.375, -0.5, 0.75);
            assert_eq!(given.height(p), near.height(p), "sides are those given");
            let foot = p - normal * near.height(p);
            let off = |plane: &SlicePlane| (plane.point(plane.coordinates(p)) - foot).length();
            assert!(off(&near) < 1e-14, "{far}: {}", off(&near));
            assert!(far < 1e6 || off(&given) > 1e-11, "the control at {far}");
        }
    }
}
