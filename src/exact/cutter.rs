//! Where a ray crosses a cutter: the triangles of a closed mesh as one clip-surface.
//!
//! Parity alone tells what is inside, so crossings alternate in the order of their depths, whichever way faces are turned. Those
//! of the whole line count, behind the eye too: the side at the start of a range is what those before it say. A crossing
//! is then a [`Root`] like that of any other clip-surface, with the triangle's normal for its gradient, and all that holds of
//! ties and of events that are too close to order holds of it as well.
//!
//! A face of a part that lies in a face of the cutter is on the kept side, all of it ([`lies_in`]), as in a clip-plane.
//!
//! An outline of a cutter is what a graze of a relief is: a pair of crossings that a sample moved by a hair may have or
//! not. It leaves a sample undecided where that could change what is seen: where some part that the cut applies to may be
//! inside there, and neither another cut nor another surface of the same cut settles its fate ([`bites`]).

use glam::DVec3;
use robust::{Coord3D, orient3d};

use super::clip::{Face, Ray, Root};
use super::outline::Brush;
use super::raster::{Crossing, Projected};
use super::walk::{Cause, Event, State};
use crate::scene::Prepared;

/// The crossings of a ray with one cutter.
pub(super) struct Met {
    /// The ray is on the removed side at the start of the range.
    pub(super) removed: bool,
    /// An odd number of crossings along the whole line: the eye is on the mesh to the last bit.
    pub(super) odd: bool,
}

/// Appends the crossings in `range` as roots of clip-surface `surface`. `found` are all crossings with the mesh.
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
                face: Some(Face {
                    triangle: crossing.triangle,
                    extent: facet.extent(),
                }),
            });
        }
    }
    met
}

/// Whether three points are in the plane of a triangle, to the last bit.
pub(super) fn lies_in(points: [DVec3; 3], face: [DVec3; 3]) -> bool {
    let of = |p: DVec3| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    };
    let [a, b, c] = face.map(of);
    points.iter().all(|p| orient3d(a, b, c, of(*p)) == 0.0)
}

/// Whether a pair of crossings with a cutter at one of its outlines, there or not, may change what is seen. `events` are those
/// of the ray with how far each may move, `start` is the state before them.
pub(super) fn bites<'a>(
    prepared: &Prepared,
    (brush, surface): (&Brush, u16),
    ranks: &[u16],
    start: &State,
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
        if !cuts.contains(&cut) || !(state.is_inside(*rank) || mesh_is_close) {
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
