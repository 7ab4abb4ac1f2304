//! Projection of vertices into the picture, and the test on which side of an edge a sample lies.
//!
//! Notation: a vertex is `(x w, y w, w)` in pixels, where `w` is its depth (1 in orthographic views). The edge from `f` to `t` is
//! represented by the plane through the eye with normal `f x t`; `E(x, y) = (x, y, 1).(f x t)` is linear in the picture and needs
//! no clipping where `w <= 0` (Olano & Greer 1997). A sample is in a triangle in front of the eye iff all three `E` have the
//! sign of `det(a, b, c)`, and in a triangle behind the eye iff all three have the other sign.
//!
//! Every vertex is rounded to f64 once, here, and pixel centres are exact. From these, a filter or [`robust`] computes each sign
//! without error. So exactly one of two triangles covers a sample on the edge that they share, whichever direction the edge
//! has in each.
//!
//! Tie rule: a sample stands for `(x + e, y + e^2)` with `e` infinitely small, so a sample on an edge belongs to the triangle to the
//! right of the edge, or below it. This is the rasterisers' top-left rule.

use cutaway::scene::View;
use glam::{DVec2, DVec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// A vertex in homogeneous pixel coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// `(x w, y w, w)`.
    pub(super) at: DVec3,
    /// Distance from the eye along the viewing direction.
    pub(super) depth: f64,
}

impl Corner {
    /// Projects a point of the scene.
    pub(super) fn of(view: &View, point: DVec3) -> Self {
        let d = point - view.eye;
        let depth = view.depth_of(point);
        let w = if view.orthographic { 1.0 } else { depth };
        let k = 0.5 * f64::from(view.size_px[1]) / view.half_height;
        let at = DVec3::new(
            d.dot(view.right) * k + view.centre_px.x * w,
            view.centre_px.y * w - d.dot(view.up) * k,
            w,
        );
        Self { at, depth }
    }

    /// The projected point, in pixels; meaningless where `w` is 0.
    pub(super) fn pixel(&self) -> DVec2 {
        self.at.truncate() / self.at.z
    }

    /// The point at depth `depth` on the line from this corner to another.
    pub(super) fn at_depth(&self, other: &Self, depth: f64) -> Self {
        self.lerp(other, (depth - self.depth) / (other.depth - self.depth))
    }

    /// The point at fraction `share` of the way from this corner to another.
    pub(super) fn lerp(&self, other: &Self, share: f64) -> Self {
        Self {
            at: self.at.lerp(other.at, share),
            depth: self.depth + (other.depth - self.depth) * share,
        }
    }
}

/// Sign of `det(a, b, c)`: 1, -1 or 0. Positive where the counter-clockwise side faces away from the eye.
pub(super) fn facing(a: &Corner, b: &Corner, c: &Corner) -> i8 {
    sign(determinant(a.at, b.at, c.at))
}

fn determinant(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    });
    // Subtracting the origin is exact, so this is the 3 x 3 determinant itself.
    orient3d(
        a,
        b,
        c,
        Coord3D {
            x: 0.0,
            y: 0.0,
            z: 0.0,
        },
    )
}

/// `a.x b.y - a.y b.x` with the right sign.
fn determinant2(a: [f64; 2], b: [f64; 2]) -> f64 {
    let [a, b] = [a, b].map(|p| Coord { x: p[0], y: p[1] });
    orient2d(a, b, Coord { x: 0.0, y: 0.0 })
}

fn sign(x: f64) -> i8 {
    i8::from(x > 0.0) - i8::from(x < 0.0)
}

/// The edge function of two corners, evaluated over a picture.
pub(super) struct EdgeFunction {
    from: DVec3,
    to: DVec3,
    /// `from x to`: coefficients of `x`, `y` and 1.
    pub(super) normal: DVec3,
    /// Maximum rounding error of the edge function in the picture.
    pub(super) error: f64,
}

impl EdgeFunction {
    /// The line through two corners.
    pub(super) fn through(from: &Corner, to: &Corner, size_px: [u32; 2]) -> Self {
        let (f, t) = (from.at, to.at);
        let terms = DVec3::new(
            (f.y * t.z).abs() + (f.z * t.y).abs(),
            (f.z * t.x).abs() + (f.x * t.z).abs(),
            (f.x * t.y).abs() + (f.y * t.x).abs(),
        );
        let [w, h] = size_px.map(f64::from);
        Self {
            from: f,
            to: t,
            normal: f.cross(t),
            // 2 roundings in a coefficient, 3 in the sum: 2.5 epsilon; the rest covers the products of errors.
            error: 4.0 * f64::EPSILON * terms.dot(DVec3::new(w, h, 1.0)),
        }
    }

    /// Side of a sample, 1 or -1; 0 only for a line whose corners coincide in the picture.
    pub(super) fn side(&self, at: DVec2) -> i8 {
        let value = self.normal.dot(at.extend(1.0));
        if value.abs() > self.error {
            return sign(value);
        }
        let (f, t) = (self.from, self.to);
        let exact = || sign(determinant(at.extend(1.0), f, t));
        let right = || sign(determinant2([f.y, f.z], [t.y, t.z]));
        let below = || sign(determinant2([f.z, f.x], [t.z, t.x]));
        [&exact as &dyn Fn() -> i8, &right, &below]
            .into_iter()
            .map(|s| s())
            .find(|s| *s != 0)
            .unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64, y: f64, w: f64) -> Corner {
        Corner {
            at: DVec3::new(x * w, y * w, w),
            depth: w,
        }
    }

    #[test]
    fn a_sample_on_a_shared_edge_belongs_to_the_right_or_lower_triangle() {
        let at = DVec2::new(2.5, 2.5);
        // (from, to, side of an interior that lies right of or below the edge)
        for (from, to, inner) in [
            ((2.5, 0.0), (2.5, 5.0), (9.0, 2.5)),
            ((0.0, 2.5), (5.0, 2.5), (2.5, 9.0)),
            ((0.0, 5.0), (5.0, 0.0), (5.0, 5.0)),
        ] {
            let (f, t) = (corner(from.0, from.1, 3.0), corner(to.0, to.1, 7.0));
            let line = EdgeFunction::through(&f, &t, [8, 8]);
            let back = EdgeFunction::through(&t, &f, [8, 8]);
            let inner = DVec2::new(inner.0, inner.1);
            assert_eq!(
                line.side(at),
                line.side(inner),
                "edge {from:?} {to:?} gave the sample to the wrong side"
            );
            assert_eq!(
                line.side(at),
                -back.side(at),
                "the two ways round disagree at {from:?} {to:?}"
            );
        }
    }

    #[test]
    fn nearly_collinear_samples_get_the_sign_of_the_real_number() {
        // The edge passes 2^-60 of a pixel from the sample, far below the resolution of f64 in one product.
        let off = (-50f64).exp2();
        let line = |d: f64| {
            EdgeFunction::through(
                &corner(0.5 + d, 0.5, 1.0),
                &corner(1023.5 + d, 1023.5, 1.0),
                [1024, 1024],
            )
        };
        let at = DVec2::splat(512.5);
        assert_eq!(
            line(off).side(at),
            -line(-off).side(at),
            "the exact sign was lost"
        );
    }
}
