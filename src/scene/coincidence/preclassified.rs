//! Decides on which side of a flat clip-surface nearby triangles lie: once per triangle, by signs, never by depth.
//!
//! Cuts along a face of a part are the most common ones in CAD, and there the depths of a fragment and of the clip-surface are equal
//! except for rounding. So depths are not compared. A triangle within [`CLOSE`] of the surface is *preclassified* if its vertices
//! decide its side:
//!
//! - All vertices are on one side, or on the surface: the triangle lies on that side. The same holds for triangles that share a vertex
//!   with such a close triangle, like the walls around a face.
//! - It belongs to a face in the surface ([`FacesInPlane`](super::faces_in_plane)): it lies on its solid's side. A cut thus leaves nothing
//!   of zero thickness: a solid is an open set, without its boundary (by design, a face where a ray enters is infinitesimally farther, and
//!   one where the ray leaves is infinitesimally nearer, in both directions of the ray). Vertices of such a face are on the surface.
//!
//! Signs are exact for the real numbers that the f64 values represent.
//!
//! Cost: one product per vertex and surface; if three vertices are close, a pass over all triangles; if any is preclassified, another.
//!
//! Cannot: classify triangles that the surface crosses, reliefs that are not flat, or parts that their pose bends, since the device
//! computes their vertices. Single faces that are oriented the wrong way end up on the wrong side.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::faces_in_plane::Candidates;
use crate::scene::{Bounds, FlatSurface, Prepared, PreparedPart, PreparedSurface, Side};

/// Distance from a surface within which triangles are preclassified, in scene units: about the depth error that snapping vertices to 1/256
/// px causes along a surface in a 60 px picture, and more than any rounding error.
const CLOSE: f64 = 1.0 / 16384.0;

/// Maximum sine of the angle between the surface and a preclassified triangle that does not lie in it.
const STEEPEST: f64 = 0.02;

/// A triangle whose side of a clip-surface is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PreclassifiedTriangle {
    /// Index in the part's triangles.
    pub triangle: u32,
    /// Index in [`Prepared::surfaces`](crate::scene::Prepared::surfaces).
    pub surface: u16,
    /// Side on which it lies.
    pub side: Side,
}

/// A triangle whose side of one clip-surface is known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClassifiedTriangle {
    /// Its index.
    pub(crate) triangle: u32,
    /// Side on which it lies.
    pub(crate) side: Side,
    /// True if it belongs to a face in the surface.
    pub(crate) is_in: bool,
}

impl FlatSurface {
    /// Returns true if geometry in a box may be close enough to classify; vertices of faces in the surface may be off by up to `tolerance`.
    pub fn comes_near(&self, bounds: &Bounds, tolerance: f64) -> bool {
        let heights = bounds.corners().map(|c| self.height(c));
        let close = CLOSE.max(tolerance);
        heights.iter().any(|h| *h <= close) && heights.iter().any(|h| *h >= -close)
    }

    /// The triangles of a mesh that are preclassified, in order; vertices of faces in the surface may be as far off as `tolerance`.
    pub(crate) fn preclassified(
        &self,
        positions: &[Vec3],
        triangles: &[[u32; 3]],
        tolerance: f64,
    ) -> Vec<ClassifiedTriangle> {
        let reach = CLOSE.max(tolerance);
        let close: Vec<bool> = (positions.par_iter().with_min_len(1 << 14))
            .map(|p| self.rough_height(p.as_dvec3()).abs() <= reach)
            .collect();
        if close.iter().filter(|c| **c).take(3).count() < 3 {
            return Vec::new();
        }
        let near: Vec<u32> = (triangles.par_iter().enumerate().with_min_len(1 << 13))
            .filter(|(_, t)| t.iter().all(|i| close[*i as usize]))
            .map(|(index, _)| index as u32)
            .collect();
        if near.is_empty() {
            return Vec::new();
        }
        let at = |i: u32| positions[i as usize].as_dvec3();
        let in_plane = self.faces_in(Candidates {
            triangles,
            position: at,
            near: near.clone(),
            tolerance,
            is_inside_out: &|| volume_sign(positions, triangles) < 0.0,
        });
        let is_of_face = |i: u32| close[i as usize] && in_plane.holds(at(i));
        let height = |i: u32| match is_of_face(i) {
            true => 0.0,
            false => self.height(at(i)),
        };
        let side_of_all = |t: u32| side_of_all(triangles[t as usize].map(height));
        let is_along = |t: u32| {
            let [a, b, c] = triangles[t as usize].map(at);
            let normal = (b - a).cross(c - a);
            normal.cross(self.normal).length() <= STEEPEST * normal.length()
        };
        let side_of = |t: u32| match in_plane.side(t) {
            Some(side) => Some(side),
            None => side_of_all(t).filter(|_| is_along(t)),
        };
        let faces: BTreeMap<u32, Side> = near
            .into_iter()
            .filter_map(|t| Some((t, side_of(t)?)))
            .collect();
        if faces.is_empty() {
            return Vec::new();
        }
        let mut is_rim = vec![false; positions.len()];
        for i in faces.keys().flat_map(|t| triangles[*t as usize]) {
            is_rim[i as usize] = true;
        }
        let side = |t: u32| {
            let face = faces.get(&t).copied();
            let is_wall = || {
                let at_rim = |i: &u32| is_rim[*i as usize] || is_of_face(*i);
                triangles[t as usize].iter().any(at_rim)
            };
            face.or_else(|| is_wall().then(|| side_of_all(t))?)
        };
        (0..triangles.len() as u32)
            .into_par_iter()
            .with_min_len(1 << 13)
            .filter_map(|t| {
                Some(ClassifiedTriangle {
                    triangle: t,
                    side: side(t)?,
                    is_in: in_plane.side(t).is_some(),
                })
            })
            .collect()
    }
}

/// The side that all heights are on or touch; `None` if they are on both sides or all on the surface.
fn side_of_all(heights: [f64; 3]) -> Option<Side> {
    let is_above = heights.iter().any(|h| *h > 0.0);
    let is_below = heights.iter().any(|h| *h < 0.0);
    match (is_above, is_below) {
        (true, false) => Some(Side::Kept),
        (false, true) => Some(Side::Removed),
        _ => None,
    }
}

/// A number with the sign of the volume that the triangles enclose.
fn volume_sign(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    let middle = positions.first().map_or(DVec3::ZERO, |p| p.as_dvec3());
    let volumes = triangles.par_iter().with_min_len(1 << 13).map(|t| {
        let [a, b, c] = t.map(|i| positions[i as usize].as_dvec3() - middle);
        a.dot(b.cross(c))
    });
    volumes.sum()
}

impl PreparedSurface {
    /// The height of a flat relief, which is a plane; 0 for a plane and `None` for any other relief.
    pub fn flat_height(&self) -> Option<f64> {
        let Some(map) = &self.relief else {
            return Some(0.0);
        };
        let [low, high] = map.range();
        (low == high || self.height_scale == 0.0).then(|| f64::from(low) * self.height_scale)
    }

    /// Least and greatest height of the relief over the plane, in scene units; zeros for a plane.
    pub fn slab(&self) -> [f64; 2] {
        let ends = self.relief.as_ref().map_or([0.0; 2], |map| {
            map.range().map(|h| f64::from(h) * self.height_scale)
        });
        [ends[0].min(ends[1]), ends[0].max(ends[1])]
    }

    /// Least and greatest height of a box over the plane.
    pub(crate) fn heights_of(&self, bounds: &Bounds) -> [f64; 2] {
        let corners = bounds.corners();
        let heights = corners.map(|c| (c - self.origin).dot(self.frame.normal));
        [
            heights.iter().copied().fold(f64::INFINITY, f64::min),
            heights.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ]
    }

    /// This clip-surface as a flat surface; `None` for a cutter, and for a relief that is not flat.
    pub fn flat(&self) -> Option<FlatSurface> {
        let lift = self.flat_height().filter(|_| self.volume.is_none())?;
        Some(FlatSurface {
            origin: self.origin,
            normal: self.frame.normal,
            lift,
        })
    }
}

impl Prepared {
    /// The triangles of a part that are preclassified by the flat clip-surfaces of its cuts, in order.
    pub fn preclassified(&self, part: &PreparedPart) -> Vec<PreclassifiedTriangle> {
        if part.is_posed {
            return Vec::new();
        }
        let mut all = Vec::new();
        for surface in part.cuts.iter().flat_map(|c| &self.cuts[*c].surfaces) {
            let flat = self.surfaces[*surface].flat();
            let Some(flat) = flat.filter(|f| f.comes_near(&part.bounds, part.plane_tolerance))
            else {
                continue;
            };
            let of_one = flat.preclassified(&part.positions, &part.triangles, part.plane_tolerance);
            all.extend(of_one.into_iter().map(|one| PreclassifiedTriangle {
                triangle: one.triangle,
                surface: *surface as u16,
                side: one.side,
            }));
        }
        all.sort_unstable();
        all
    }
}
