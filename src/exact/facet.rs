//! The plane of a triangle: at which depth a ray meets it, and how far off that may be in a picture.
//!
//! A rasteriser moves corners by parts of a pixel, and may interpolate depths by their slopes in f32; both matter where the plane is
//! steep. Costs some products a crossing, and no projection: areas and lengths in the picture have the same unit, which cancels.
//!
//! Cannot: bound the rounding of every rasteriser. What it allows for slopes is twice the most that was seen of llvmpipe.

use glam::DVec3;
use rayon::prelude::*;

use crate::scene::{Prepared, View};

/// The plane of a triangle and the depths between which it lies.
pub(super) struct Facet {
    /// The corners in scene space, in order of their coordinates: faces that coincide have the same depths bit for bit, whichever
    /// corner their lists begin at.
    pub(super) points: [DVec3; 3],
    /// Normal by the counter-clockwise rule, as long as twice the area.
    pub(super) normal: DVec3,
    depths: [f64; 2],
}

impl Facet {
    /// That of three corners in scene space with their depths.
    pub(super) fn of(points: [DVec3; 3], depths: [f64; 3]) -> Self {
        let mut points = points;
        // Each exchange of two corners turns the normal over.
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

    /// Depth at which a ray meets the plane, kept between the depths of the corners: an edge-on triangle has no other.
    pub(super) fn depth(&self, origin: DVec3, direction: DVec3) -> f64 {
        let [lo, hi] = self.depths;
        let depth = (self.points[0] - origin).dot(self.normal) / self.normal.dot(direction);
        if depth.is_nan() {
            0.5 * (lo + hi)
        } else {
            depth.clamp(lo, hi)
        }
    }

    /// How far apart the depths of the corners are.
    pub(super) fn extent(&self) -> f64 {
        self.depths[1] - self.depths[0]
    }

    /// How much the depth may change within the triangle when a sample moves by [`View::doubt_px`], and by how the view's rasteriser
    /// interpolates.
    pub(super) fn depth_change(&self, view: &View, direction: DVec3, depth: f64) -> f64 {
        let slopes = match view.precision.slopes_in_f32 {
            true => self.slope_rounding(view) / self.normal.dot(direction).abs(),
            false => 0.0,
        };
        // Of an edge-on triangle the first is infinite, or no number.
        (self.plane_change(view, direction, depth) + slopes).min(self.extent())
    }

    /// How much the depth on the plane changes, wherever that leads, when a sample moves by [`View::doubt_px`].
    pub(super) fn plane_change(&self, view: &View, direction: DVec3, depth: f64) -> f64 {
        let along = self.normal.dot(direction).abs();
        let across = lateral(view, self.normal) * view.pixel_size(depth) * view.doubt_px();
        across / along
    }

    /// How far off a depth may be that is interpolated in f32, times the area that the ray sees of the triangle, twice. Slopes of depth in
    /// the picture are found by products of edges, each rounded to an ulp of the square of the triangle's length, and divided by its area
    /// (both have the same unit here). What that does to a depth is the ratio of the two, times the range of the depths: with llvmpipe
    /// up to 0.02 px at the walls of a tube that are 1200 px long and 2 px wide.
    fn slope_rounding(&self, view: &View) -> f64 {
        let [a, b, c] = self.points;
        let longest = [b - a, c - b, a - c]
            .map(|edge| lateral(view, edge))
            .into_iter()
            .fold(0.0, f64::max);
        f64::from(f32::EPSILON) * longest.powi(2) * self.extent()
    }
}

/// Whether depths that are interpolated in f32 are farther off, somewhere in a scene, than what sub-pixel bits leave open by a margin:
/// vertices move by 0.7 of [`View::doubt_px`] at most. So it is where triangles are long and narrow.
pub(super) fn slopes_matter(prepared: &Prepared, view: &View) -> bool {
    prepared.parts.par_iter().any(|part| {
        let depth = |p: &DVec3| (*p - view.eye).dot(view.forward);
        part.triangles.par_iter().any(|corners| {
            let points = corners.map(|i| part.positions[i as usize].as_dvec3());
            let depths = points.map(|p| depth(&p));
            let facet = Facet::of(points, depths);
            let across =
                lateral(view, facet.normal) * view.pixel_size(facet.depths[0].max(view.near));
            facet.slope_rounding(view) > SPARE * across * view.doubt_px()
        })
    })
}

/// What snapping leaves of [`View::doubt_px`].
const SPARE: f64 = 0.25;

/// Length of the part of a vector that lies in the picture.
pub(super) fn lateral(view: &View, v: DVec3) -> f64 {
    v.dot(view.right).hypot(v.dot(view.up))
}
