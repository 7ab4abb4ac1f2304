//! The plane of a triangle: the depth at which a ray meets it, and the largest error of that depth in a picture.
//!
//! A rasteriser moves corners by fractions of a pixel, and may interpolate depths from slopes in f32; both matter where the plane is
//! steep. The first error costs some products per crossing; the second needs the triangle clipped at the near plane and projected.
//!
//! Limit: the rounding of every rasteriser cannot be bounded. The error allowed for slopes is twice the largest seen with llvmpipe.

use cutaway::scene::{Prepared, View};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::screen::Corner;

/// The plane of a triangle, and the range of the triangle's depths.
pub(super) struct Facet {
    /// The corners in scene space, sorted by their coordinates, so that coincident faces have exactly the same depths, whichever
    /// corner each face begins with.
    pub(super) points: [DVec3; 3],
    /// Normal by the counter-clockwise rule; its length is twice the area.
    pub(super) normal: DVec3,
    depths: [f64; 2],
}

impl Facet {
    /// Makes the facet of three corners in scene space with their depths.
    pub(super) fn of(points: [DVec3; 3], depths: [f64; 3]) -> Self {
        let mut points = points;
        // Each swap of two corners flips the normal.
        let mut turn = 1.0;
        for (i, j) in [(0, 1), (1, 2), (0, 1)] {
            if points[j].to_array() < points[i].to_array() {
                points.swap(i, j);
                turn = -turn;
            }
        }
        let [a, b, c] = points;
        Self {
            points,
            normal: (b - a).cross(c - a) * turn,
            depths: [
                depths[0].min(depths[1]).min(depths[2]),
                depths[0].max(depths[1]).max(depths[2]),
            ],
        }
    }

    /// Depth at which a ray meets the plane, clamped to the range of the corners' depths; an edge-on triangle needs the clamp.
    pub(super) fn depth(&self, origin: DVec3, direction: DVec3) -> f64 {
        let [lo, hi] = self.depths;
        let depth = (self.points[0] - origin).dot(self.normal) / self.normal.dot(direction);
        if depth.is_nan() {
            0.5 * (lo + hi)
        } else {
            depth.clamp(lo, hi)
        }
    }

    /// Difference between the largest and the smallest depth of the corners.
    pub(super) fn extent(&self) -> f64 {
        self.depths[1] - self.depths[0]
    }

    /// Change of the depth within the triangle when a sample moves by [`View::doubt_px`], plus the interpolation error of the view's
    /// rasteriser.
    pub(super) fn depth_change(&self, view: &View, direction: DVec3, depth: f64) -> f64 {
        // For an edge-on triangle both are infinite or NaN.
        (self.plane_change(view, direction, depth) + self.slopes(view, depth)).min(self.extent())
    }

    /// Approximate maximum of [`Self::depth_change`] in the triangle, whose farthest corner is at depth `far`.
    pub(super) fn greatest_change(&self, view: &View, far: f64) -> f64 {
        (self.plane_change_in_middle(view).abs() + self.slopes(view, far)).min(self.extent())
    }

    /// Depth error caused by the interpolation in the view's rasteriser.
    fn slopes(&self, view: &View, depth: f64) -> f64 {
        match view.precision.slopes_in_f32 {
            true => self.slope_rounding(view, depth),
            false => 0.0,
        }
    }

    /// Change of the depth on the plane when a sample moves by [`View::doubt_px`], not limited to the triangle's depths.
    pub(super) fn plane_change(&self, view: &View, direction: DVec3, depth: f64) -> f64 {
        let along = self.normal.dot(direction).abs();
        let across = lateral(view, self.normal) * view.pixel_size(depth) * view.doubt_px();
        across / along
    }

    /// [`Self::plane_change`] on the ray through the middle of the triangle.
    pub(super) fn plane_change_in_middle(&self, view: &View) -> f64 {
        self.plane_change_at(view, self.points.iter().sum::<DVec3>() / 3.0)
    }

    /// [`Self::plane_change`] on the ray through a point of the plane.
    pub(super) fn plane_change_at(&self, view: &View, point: DVec3) -> f64 {
        let depth = view.depth_of(point);
        let direction = match view.orthographic {
            true => view.forward,
            false => (point - view.eye) / depth,
        };
        self.plane_change(view, direction, depth)
    }

    /// Error of a depth that is interpolated in f32. The rasteriser interpolates the depth-buffer value over the part of the triangle
    /// beyond the near plane, as triangles that share a corner. It computes the slopes in the picture from products of edges, each
    /// rounded to an ulp of the squared length, divided by the area. So the error of a value is this ulp over the area, times the
    /// range of values. With llvmpipe the error is up to 0.02 px at tube walls 1200 px long and 2 px wide. For a wall that
    /// passes the eye, and is thousands of pixels long where it meets the near plane, the error is as large as the wall is wide.
    fn slope_rounding(&self, view: &View, depth: f64) -> f64 {
        let corners = self.points.map(|p| Corner::of(view, p));
        let mut piece = [corners[0]; 4];
        let mut count = 0;
        let mut add = |corner: Corner| {
            piece[count] = corner;
            count += 1;
        };
        for (i, corner) in corners.iter().enumerate() {
            let next = &corners[(i + 1) % 3];
            let is_beyond = [corner, next].map(|c| c.depth > view.near);
            if is_beyond[0] {
                add(*corner);
            }
            if is_beyond[0] != is_beyond[1] {
                add(corner.at_depth(next, view.near));
            }
        }
        let Some((first, rest)) = piece[..count].split_first() else {
            return 0.0;
        };
        let worst = rest.array_windows().map(|[b, c]| {
            let corners = [first, b, c];
            let values = corners.map(|c| view.buffer_from_depth(c.depth));
            let range = values.into_iter().fold(f64::NEG_INFINITY, f64::max)
                - values.into_iter().fold(f64::INFINITY, f64::min);
            let [a, b, c] = corners.map(Corner::pixel);
            let longest = [b - a, c - b, a - c]
                .map(DVec2::length_squared)
                .into_iter()
                .fold(0.0, f64::max);
            longest * range / (b - a).perp_dot(c - a).abs()
        });
        let value = f64::from(f32::EPSILON) * worst.fold(0.0, f64::max);
        // Derivative of the depth with respect to the depth-buffer value.
        let per_value = match view.orthographic {
            true => view.far - view.near,
            false => depth * depth / view.near,
        };
        value * per_value
    }
}

/// Returns true if, somewhere in a scene, the error of depths interpolated in f32 exceeds the margin that vertex snapping leaves, which
/// moves vertices by at most 0.7 of [`View::doubt_px`]. This happens where triangles are long and narrow.
pub(super) fn slopes_matter(prepared: &Prepared, view: &View) -> bool {
    let parts = prepared.parts.par_iter();
    let of_parts = parts.map(|part| (&part.positions[..], &part.triangles[..]));
    let cutters = (prepared.surfaces.par_iter()).filter_map(|surface| surface.volume.as_ref());
    let of_cutters = cutters.map(|cutter| (&cutter.positions[..], cutter.triangles()));
    (of_parts.chain(of_cutters)).any(|(positions, triangles)| {
        triangles.par_iter().any(|corners| {
            let points = corners.map(|i| positions[i as usize].as_dvec3());
            let depths = points.map(|p| view.depth_of(p));
            // The ratio of slope error to margin grows with depth, so the two are compared at the triangle's farthest corner.
            let (far, depth) =
                points
                    .into_iter()
                    .zip(depths)
                    .fold((points[0], depths[0]), |far, other| {
                        if other.1 > far.1 { other } else { far }
                    });
            let facet = Facet::of(points, depths);
            depth > view.near
                && facet.slope_rounding(view, depth) > SPARE * facet.plane_change_at(view, far)
        })
    })
}

/// Share of [`View::doubt_px`] that snapping does not use.
const SPARE: f64 = 0.25;

/// Length of a vector's component in the picture plane.
pub(super) fn lateral(view: &View, v: DVec3) -> f64 {
    v.dot(view.right).hypot(v.dot(view.up))
}
