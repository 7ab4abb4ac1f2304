//! Edges at which the number or the depth of crossings changes, and the samples too close to such edges.
//!
//! If exactly two faces share an edge and lie on opposite sides of it in the picture, the edge is no outline: whichever face a sample
//! hits, the ray crosses once. Every other edge is an outline: a fold (*silhouette*), a rim (*boundary*), an edge of more than two faces
//! and, for the nonzero rule, an edge of inconsistently oriented faces. Vertices are matched by position: a mesh may store one twice.
//!
//! If one of the two faces is far steeper than the other, or its depths are interpolated far less precisely, their edge is a *seam*:
//! whichever face a sample hits, there is one crossing, but the depth may differ.
//!
//! A sample is not reliably on one side of the edges of a needle narrower than the sub-pixel grid: these edges are outlines too (see
//! [`sliver_reach`]), unless the needle crosses the near plane.
//!
//! An adapter with fewer sub-pixel bits than usual (SwiftShader) clips each triangle at the near plane separately, so that a gap of one
//! sub-pixel step can open between two triangles that share an edge: then all edges through the near plane are outlines at which the part
//! may be open. This was not observed on llvmpipe, which has 8 bits.
//!
//! Rasterisers snap vertices to a fraction of a pixel, usually 1/256, and transforms in f32 move them too. All rasterisers tried
//! (llvmpipe, SwiftShader, compute) agreed on every sample farther than [`View::doubt_px`] from all outlines.

use cutaway::scene::{View, longest_edge};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::ambiguity::rounding;
use super::facet::lateral;
use super::raster::{Projected, centres};
use super::screen::Corner;

/// Maximum difference of two depths: a scene lies in a ball of radius 1. Depths on the plane of a needle seen edge-on have no bound.
const SCENE_DIAMETER: f64 = 2.0;

/// Maximum ratio of the two faces' depth changes at an edge; above it, the edge is a seam.
const SEAM: f64 = 4.0;

/// Two steps of f32 near 1: a triangle no wider than this has no plane in f32.
const LINE_WIDTH: f64 = 2.0 * f32::EPSILON as f64;

/// An edge that is an outline; only what lies beyond a depth slightly before the near plane is kept.
pub(super) struct SilhouetteEdge {
    ends: [Corner; 2],
    rank: u16,
    edge: OutlineEdge,
    margin: f64,
}

/// What is undecided near an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OutlineEdge {
    /// There may be two more crossings.
    Fold,
    /// The part may be open: the edge has an odd number of faces or, for the nonzero rule, face directions that do not cancel; or an
    /// adapter with few sub-pixel bits leaves a gap between the triangles at the edge.
    Rim,
    /// Either of two triangles may be crossed.
    Seam([u32; 2]),
}

/// A sample near an outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Brush {
    /// Number of the pixel in its band.
    pub(super) pixel: u32,
    /// Rank of the part.
    pub(super) rank: u16,
    /// What is undecided there.
    pub(super) edge: OutlineEdge,
    /// Depth of the edge.
    pub(super) depth: f64,
    /// Largest difference between the edge's depth and that of its faces within [`View::doubt_px`].
    pub(super) margin: f64,
}

/// One face at an edge. `side` is the face's side of the edge in the picture: 1 and -1 are opposite, 0 is edge-on.
struct FaceAtEdge {
    key: (u32, u32),
    triangle: u32,
    side: i8,
    /// 1 if the face traverses the edge in the direction of the edge's key, else -1.
    direction: i8,
    /// Approximate change of the depth on the face.
    change: f64,
}

/// The outlines of a part.
pub(super) fn outlines(view: &View, rank: u16, projected: &Projected<'_>) -> Vec<SilhouetteEdge> {
    let names = points(projected);
    let mut uses: Vec<FaceAtEdge> = projected
        .triangles
        .par_iter()
        .enumerate()
        .flat_map_iter(|(index, t)| {
            let facing = match sliver_reach(view, projected, index as u32) {
                Some(_) => 0,
                None => projected.facing[index],
            };
            let change = depth_change(view, projected, index as u32);
            let t = t.map(|i| names[i as usize]);
            // A triangle with two equal corners is only an edge and not counted as a face.
            let degenerate = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
            (0..if degenerate { 0 } else { 3 }).map(move |e| {
                let (from, to) = (t[e], t[(e + 1) % 3]);
                FaceAtEdge {
                    key: (from.min(to), from.max(to)),
                    triangle: index as u32,
                    side: if from < to { facing } else { -facing },
                    direction: if from < to { 1 } else { -1 },
                    change,
                }
            })
        })
        .collect();
    uses.par_sort_unstable_by_key(|u| (u.key, u.triangle));
    let fill = projected.fill;
    let is_coarse = view.precision.is_coarse();
    let is_clipped = |(from, to): (u32, u32)| {
        let is_beyond = |i: u32| projected.corners[i as usize].depth > view.near;
        is_coarse && is_beyond(from) != is_beyond(to)
    };
    let sum = |faces: &[FaceAtEdge]| -> i32 { faces.iter().map(|f| i32::from(f.direction)).sum() };
    uses.chunk_by(|a, b| a.key == b.key)
        .filter_map(|faces| {
            let (from, to) = faces[0].key;
            let edge = match faces {
                _ if fill.holds(sum(faces)) || is_clipped((from, to)) => OutlineEdge::Rim,
                [a, b] if a.side != 0 && a.side == -b.side => {
                    let least = a.change.min(b.change) + rounding(view, view.near);
                    let is_seam = a.change.max(b.change) > SEAM * least;
                    is_seam.then_some(OutlineEdge::Seam([a.triangle, b.triangle]))?
                }
                _ => OutlineEdge::Fold,
            };
            let [a, b] = [from, to].map(|i| projected.corners[i as usize]);
            let margin = faces
                .iter()
                .map(|f| {
                    let facet = projected.facet(f.triangle);
                    let within = || facet.plane_change_in_middle(view).min(facet.extent());
                    sliver_reach(view, projected, f.triangle).unwrap_or_else(within)
                })
                .fold(0.0, f64::max);
            // Near an edge just before the near plane, the edge's faces may reach beyond the plane, or be rounded there.
            let before = view.before_near(margin + rounding(view, view.near));
            let ends = beyond(before, a, b)?;
            Some(SilhouetteEdge {
                ends,
                rank,
                edge,
                margin,
            })
        })
        .collect()
}

/// Approximate change of the depth on a triangle, from snapping and interpolation.
fn depth_change(view: &View, projected: &Projected<'_>, triangle: u32) -> f64 {
    let far = projected.corners(triangle).map(|c| c.depth);
    let far = far.into_iter().fold(view.near, f64::max);
    projected.facet(triangle).greatest_change(view, far)
}

/// For each vertex, the first vertex at the same position.
fn points(projected: &Projected<'_>) -> Vec<u32> {
    let positions = projected.positions;
    // Adding 0 turns -0 into 0.
    let bits = |i: u32| {
        positions[i as usize]
            .to_array()
            .map(|c| (c + 0.0).to_bits())
    };
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.par_sort_unstable_by_key(|i| (bits(*i), *i));
    let mut names = vec![0; positions.len()];
    let mut first = 0;
    for (i, vertex) in order.iter().enumerate() {
        if i == 0 || bits(first) != bits(*vertex) {
            first = *vertex;
        }
        names[*vertex as usize] = first;
    }
    names
}

/// Largest depth error of a needle so narrow that rounding its corners to the sub-pixel grid may turn it over: which side a rasteriser
/// sees, and so which depth it finds, is undefined. The needle's edges are outlines: no sample lies reliably on one side of them.
///
/// If its depths differ by more than the width of a pixel, the error is that difference. Otherwise, the change of its plane within
/// [`View::doubt_px`] counts too, which is unbounded for a needle seen edge-on: some rasterisers round the corners, so cover samples
/// outside the needle, and evaluate the unrounded plane there. If the corners lie on a line there is no plane, and any depth may result.
/// However little the depth changes, the visible side is open: a needle that is turned over shows its back.
///
/// None for a triangle that is no needle, and for a needle that crosses the near plane and so is clipped.
fn sliver_reach(view: &View, projected: &Projected<'_>, triangle: u32) -> Option<f64> {
    let corners = projected.corners(triangle);
    if corners.iter().any(|c| c.depth <= view.near) {
        return None;
    }
    let [a, b, c] = corners.map(Corner::pixel);
    let longest = [b - a, c - b, a - c]
        .map(DVec2::length)
        .into_iter()
        .fold(0.0, f64::max);
    let is_narrow = (b - a).perp_dot(c - a).abs() < 2.0 * view.doubt_px() * longest;
    if !is_narrow {
        return None;
    }
    let facet = projected.facet(triangle);
    let extent = facet.extent();
    Some(if is_line(facet.points) {
        SCENE_DIAMETER
    } else if extent > view.pixel_size(corners[0].depth) {
        extent
    } else {
        extent
            .max(facet.plane_change_in_middle(view))
            .min(SCENE_DIAMETER)
    })
}

/// Returns true if three corners lie on a line, up to f32 rounding.
fn is_line(points: [DVec3; 3]) -> bool {
    let [a, b, c] = points;
    (b - a).cross(c - a).length() <= LINE_WIDTH * longest_edge(points)
}

/// The part of an edge beyond a depth.
fn beyond(near: f64, a: Corner, b: Corner) -> Option<[Corner; 2]> {
    match (a.depth > near, b.depth > near) {
        (true, true) => Some([a, b]),
        (true, false) => Some([a, a.at_depth(&b, near)]),
        (false, true) => Some([a.at_depth(&b, near), b]),
        (false, false) => None,
    }
}

impl SilhouetteEdge {
    /// Range of rows whose samples may be near the outline.
    pub(super) fn rows(&self, view: &View) -> Option<[u32; 2]> {
        let ([a, b], near_px) = (self.ends.map(|e| e.pixel()), view.doubt_px());
        centres(a.x.min(b.x), a.x.max(b.x), near_px, view.size_px[0])?;
        centres(a.y.min(b.y), a.y.max(b.y), near_px, view.size_px[1])
    }

    /// Lists the samples of a band that are near the outline.
    pub(super) fn brush(
        &self,
        view: &View,
        [first_row, end_row]: [u32; 2],
        found: &mut Vec<Brush>,
    ) {
        let ([a, b], near_px) = (self.ends.map(|e| e.pixel()), view.doubt_px());
        let Some([lo, hi]) = centres(a.y.min(b.y), a.y.max(b.y), near_px, view.size_px[1]) else {
            return;
        };
        let along = b - a;
        for row in lo.max(first_row)..(hi + 1).min(end_row) {
            let y = f64::from(row) + 0.5;
            let share = |y: f64| ((y - a.y) / along.y).clamp(0.0, 1.0);
            // The stretch of the edge within this row; the whole edge if it runs along the row.
            let (from, to) = if along.y.abs() > near_px {
                (share(y - near_px), share(y + near_px))
            } else {
                (0.0, 1.0)
            };
            let (x0, x1) = (a.x + along.x * from, a.x + along.x * to);
            let Some([left, right]) = centres(x0.min(x1), x0.max(x1), near_px, view.size_px[0])
            else {
                continue;
            };
            for column in left..=right {
                let at = DVec2::new(f64::from(column) + 0.5, y);
                let t = (at - a).dot(along) / along.length_squared();
                let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
                if (a + along * t).distance_squared(at) > near_px * near_px {
                    continue;
                }
                let [za, zb] = self.ends.map(|e| e.depth);
                let depth = if view.orthographic {
                    za + (zb - za) * t
                } else {
                    1.0 / ((1.0 - t) / za + t / zb)
                };
                found.push(Brush {
                    pixel: (row - first_row) * view.size_px[0] + column,
                    rank: self.rank,
                    edge: self.edge,
                    depth,
                    margin: self.margin + rounding(view, depth),
                });
            }
        }
    }
}

/// Length of a vector's component in the picture plane, times the size of a pixel at a depth.
pub(super) fn change_per_px(view: &View, gradient: DVec3, depth: f64) -> f64 {
    lateral(view, gradient) * view.pixel_size(depth)
}
