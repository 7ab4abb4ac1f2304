//! Crossings whose order against a clip-surface is known of their whole triangle, and not left to rounding.
//!
//! A triangle close to a flat clip-surface lies on one side of it ([`Settled`]): a crossing with it that rounding has put on the
//! other side of the surface's root gets the depth of that root bit for bit, and its place before it or behind. So all of a face in
//! a clip-surface is kept or removed alike, in every view. A sample by the rim of what lies alike may, moved a little, meet a triangle
//! of another side: there the order is as open as any.
//!
//! A face of a part in a face of a cutter is before the cutter where the ray leaves the part by it, behind where it enters; only
//! exact coincidence counts there, and what is merely close is left to [`super::ambiguity`].

use std::collections::BTreeMap;

use glam::DVec2;

use super::clip::{Ray, Root};
use super::raster::Crossing;
use super::ray_scratch::RayScratch;
use super::{Lines, ambiguity, cutter};
use crate::scene::{Prepared, PreparedPart, Settled, Side, lies_in};

/// What is settled of the triangles of a part.
pub(super) struct SettledFaces {
    /// By triangle.
    all: Vec<Settled>,
    /// Of each, whether the edges from its corners on are at its rim: whether the next triangle is on another side, or may be.
    rims: Vec<[bool; 3]>,
}

impl SettledFaces {
    /// That of a part.
    pub(super) fn of(prepared: &Prepared, part: &PreparedPart) -> Self {
        let all = prepared.settled(part);
        let edges = |s: &Settled| {
            let corners = part.triangles[s.triangle as usize];
            [0, 1, 2].map(|i| {
                let (a, b) = (corners[i], corners[(i + 1) % 3]);
                (a.min(b), a.max(b), s.surface, s.side)
            })
        };
        let mut uses: BTreeMap<_, u32> = BTreeMap::new();
        for edge in all.iter().flat_map(edges) {
            *uses.entry(edge).or_default() += 1;
        }
        Self {
            rims: (all.iter())
                .map(|s| edges(s).map(|e| uses[&e] != 2))
                .collect(),
            all,
        }
    }

    /// What settles a triangle, and where its rim is.
    fn by(&self, triangle: u32) -> impl Iterator<Item = (&Settled, [bool; 3])> {
        let first = self.all.partition_point(|s| s.triangle < triangle);
        let after = self.all[first..].partition_point(|s| s.triangle == triangle);
        let range = first..first + after;
        self.all[range.clone()]
            .iter()
            .zip(self.rims[range].iter().copied())
    }
}

impl Lines<'_> {
    /// Puts crossings on the side of each clip-surface that their triangles are known to lie on.
    pub(super) fn settle(&self, at: DVec2, ray: &Ray, bench: &mut RayScratch) {
        for (index, crossing) in bench.crossings.iter_mut().enumerate() {
            let rank = usize::from(crossing.rank);
            for (settled, rim) in self.settled[rank].by(crossing.triangle) {
                let corners = self.parts[rank].corners(crossing.triangle);
                let is_by_the_rim = (0..3)
                    .any(|e| rim[e] && cutter::is_by_edge(self.view.doubt_px(), at, corners, e));
                let mut roots = bench.roots.iter();
                if let Some(root) = roots.find(|r| r.surface == settled.surface) {
                    let is_behind = (settled.side == Side::Kept) == root.to_kept;
                    if !is_by_the_rim {
                        let place = if is_behind { 1 } else { -1 };
                        bench.settled.push((index as u32, settled.surface, place));
                    }
                    if (crossing.depth > root.depth) != is_behind || crossing.depth == root.depth {
                        crossing.depth = root.depth;
                        crossing.place = if is_behind { 1 } else { -1 };
                    }
                }
            }
            for root in bench.roots.iter().filter(|r| r.face.is_some()) {
                if self.coincides(ray, root, crossing) {
                    crossing.depth = root.depth;
                    crossing.place = crossing.step();
                    if self.goes_on(at, root, crossing) {
                        let place = crossing.place;
                        bench.settled.push((index as u32, root.surface, place));
                    }
                }
            }
        }
    }

    /// Whether a crossing is with a face that lies in the face of a cutter, to the last bit.
    fn coincides(&self, ray: &Ray, root: &Root, crossing: &Crossing) -> bool {
        let distance = (crossing.depth - root.depth).abs();
        let close = ambiguity::rounding(self.view, root.depth) + root.depth_change(self.view, ray);
        distance <= close
            && root.face.is_some_and(|face| {
                let of_part = self.parts[usize::from(crossing.rank)].facet(crossing.triangle);
                let of_cutter = self.mesh_of_cutter(root.surface).facet(face.triangle);
                lies_in(of_part.points, of_cutter.points)
            })
    }

    /// Whether both triangles of a coincidence are still met when the sample moves a little.
    fn goes_on(&self, at: DVec2, root: &Root, crossing: &Crossing) -> bool {
        root.face.is_none_or(|face| {
            let of_cutter = self.mesh_of_cutter(root.surface).corners(face.triangle);
            let of_part = self.parts[usize::from(crossing.rank)].corners(crossing.triangle);
            cutter::share_the_sample(self.view.doubt_px(), at, [of_cutter, of_part])
        })
    }
}
