//! Crossings of a ray with a cutter: the triangles of a closed mesh as one clip-surface.
//!
//! Parity alone decides what is inside, so crossings alternate in depth order, whichever way faces are turned. All crossings of the
//! line count, also those behind the eye: the crossings before a range give the side at the start of the range. A crossing becomes a
//! [`Root`] as for any other clip-surface, with the triangle's normal as gradient. The rules for ties and for events that are too close
//! to order apply here too.
//!
//! A part's face that coincides with a cutter's face comes before the cutter if the ray leaves the part through the face, and after it if
//! the ray enters ([`super::classify`]). Unlike a plane, the cutter's face ends: if a sample is so close to an edge of either triangle
//! ([`share_the_sample`]) that it may hit one triangle and a neighbour of the other, the order is left to [`super::ambiguity`].
//!
//! An outline of a cutter is like a graze of a relief: a pair of crossings may appear or vanish when the sample moves a
//! little. The sample is undecided only if that could change what is seen: the ray may be inside some part that the cut
//! applies to, and neither another cut nor another surface of the same cut decides whether that part is kept ([`bites`]).

use cutaway::scene::Prepared;
use glam::DVec2;

use super::clip::{CutterTriangle, Ray, Root};
use super::outline::Brush;
use super::raster::{Crossing, Projected};
use super::screen::Corner;
use super::walk::{Cause, Event, RayState};

/// Positions of the cutters' meshes in the list of a picture's meshes: after the parts, in the order of their clip-surfaces.
pub(super) struct CutterMeshes {
    parts: u16,
    surfaces: Vec<u16>,
}

impl CutterMeshes {
    /// The cutters of a scene.
    pub(super) fn of(prepared: &Prepared) -> Self {
        let numbers = 0..prepared.surfaces.len() as u16;
        let is_cutter = |s: &u16| prepared.surfaces[usize::from(*s)].volume.is_some();
        Self {
            parts: prepared.parts.len() as u16,
            surfaces: numbers.filter(is_cutter).collect(),
        }
    }

    /// Number of entries that belong to parts, in a list ordered by rank.
    pub(super) fn split<T>(&self, all: &[T], rank: impl Fn(&T) -> u16) -> usize {
        all.partition_point(|one| rank(one) < self.parts)
    }

    /// Returns true if a clip-surface is a cutter.
    pub(super) fn contains(&self, surface: u16) -> bool {
        self.surfaces.binary_search(&surface).is_ok()
    }

    /// Rank of a cutter's mesh.
    pub(super) fn rank_of(&self, surface: u16) -> u16 {
        self.parts + self.surfaces.partition_point(|s| *s < surface) as u16
    }

    /// The clip-surface of a cutter's mesh.
    pub(super) fn surface_of(&self, rank: u16) -> u16 {
        self.surfaces[usize::from(rank - self.parts)]
    }
}

/// The crossings of a ray with one cutter.
pub(super) struct Met {
    /// True if the ray is on the removed side at the start of the range.
    pub(super) removed: bool,
    /// True if the whole line has an odd number of crossings: the eye is exactly on the mesh.
    pub(super) odd: bool,
}

/// Appends the crossings in `range` as roots of clip-surface `surface`. `found` holds all crossings of the line with the mesh.
pub(super) fn meet(
    (mesh, surface, keeps_inside): (&Projected<'_>, u16, bool),
    ray: &Ray,
    range: [f64; 2],
    found: &mut [Crossing],
    roots: &mut Vec<Root>,
) -> Met {
    found.sort_unstable_by(|a, b| {
        (a.depth.total_cmp(&b.depth)).then_with(|| a.triangle.cmp(&b.triangle))
    });
    let mut met = Met {
        removed: keeps_inside,
        odd: found.len() % 2 == 1,
    };
    let mut removed = keeps_inside;
    for crossing in found {
        removed = !removed;
        if crossing.depth <= range[0] {
            met.removed = removed;
        } else if crossing.depth < range[1] {
            let facet = mesh.facet(crossing.triangle);
            let up = facet.normal.normalize_or_zero();
            let to_kept = !removed;
            let along = up.dot(ray.direction) > 0.0;
            roots.push(Root {
                surface,
                depth: crossing.depth,
                to_kept,
                gradient: if along == to_kept { up } else { -up },
                bend: 0.0,
                face: Some(CutterTriangle {
                    triangle: crossing.triangle,
                    extent: facet.extent(),
                }),
            });
        }
    }
    met
}

/// Returns true if a sample hits both of two coplanar triangles, wherever it moves within `near_px`.
pub(super) fn share_the_sample(near_px: f64, at: DVec2, triangles: [[&Corner; 3]; 2]) -> bool {
    !triangles
        .into_iter()
        .any(|corners| is_by_an_edge(near_px, at, corners))
}

/// Returns true if a sample is so close to an edge of a triangle that, moved a little, it may hit the adjacent triangle; always true if
/// the triangle reaches behind the eye.
fn is_by_an_edge(near_px: f64, at: DVec2, corners: [&Corner; 3]) -> bool {
    if corners.iter().any(|c| c.at.z <= 0.0) {
        return true;
    }
    (0..3).any(|edge| is_by_edge(near_px, at, corners, edge))
}

/// Returns true if a sample is so close to the edge that begins at corner `edge` of a triangle that, moved a little, it may hit the
/// adjacent triangle; always true if the edge reaches behind the eye.
pub(super) fn is_by_edge(near_px: f64, at: DVec2, corners: [&Corner; 3], edge: usize) -> bool {
    let ends = [corners[edge], corners[(edge + 1) % 3]];
    if ends.iter().any(|c| c.at.z <= 0.0) {
        return true;
    }
    let [from, to] = ends.map(Corner::pixel);
    let share = (at - from).dot(to - from) / from.distance_squared(to);
    from.lerp(to, share.clamp(0.0, 1.0)).distance(at) <= near_px
}

/// Returns true if adding or removing a pair of crossings at an outline of a cutter may change what is seen. `events` are the ray's
/// events, each with the largest change of its depth; `start` is the state before them.
pub(super) fn bites<'a>(
    prepared: &Prepared,
    (brush, surface): (&Brush, u16),
    ranks: &[u16],
    start: &RayState,
    events: impl Iterator<Item = (&'a Event, f64)>,
) -> bool {
    let mut state = start.clone();
    let mut close: Vec<Cause> = Vec::new();
    for (event, margin) in events {
        if (event.depth - brush.depth).abs() <= brush.margin + margin {
            close.push(event.cause);
        } else if event.depth < brush.depth {
            state.apply(event);
        }
    }
    let cut = prepared.surfaces[surface as usize].cut;
    ranks.iter().any(|rank| {
        let cuts = &prepared.parts[*rank as usize].cuts;
        let mesh_is_close =
            (close.iter()).any(|c| matches!(c, Cause::Mesh { rank: of, .. } if of == rank));
        let may_be_inside = state.is_inside(*rank) || state.is_open[usize::from(*rank)];
        if !cuts.contains(&cut) || !(may_be_inside || mesh_is_close) {
            return false;
        }
        let other_is_close = close.iter().any(|c| {
            matches!(c, Cause::Clip { surface: of, .. }
                if *of != surface && cuts.contains(&prepared.surfaces[*of as usize].cut))
        });
        let mut removes = |removed: bool| {
            state.removed[surface as usize] = removed;
            state.removes(prepared, *rank)
        };
        other_is_close || removes(true) != removes(false)
    })
}
