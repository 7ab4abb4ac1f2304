//! Crossings whose order against a clip-surface is known of their whole triangle, and not left to rounding.
//!
//! A triangle close to a flat clip-surface lies on one side of it ([`Settled`]): a crossing with it that rounding has put on the
//! other side of the surface's root gets the depth of that root bit for bit, and its place before it or behind. So all of a face in
//! a clip-surface is kept or removed alike, in every view.
//!
//! A face of a part in a face of a cutter is before the cutter where the ray leaves the part by it, behind where it enters; only
//! exact coincidence counts there, and what is merely close is left to [`super::ambiguity`].

use glam::DVec2;

use super::bench::Bench;
use super::clip::{Ray, Root};
use super::raster::Crossing;
use super::{Lines, ambiguity, cutter};
use crate::scene::{Settled, Side};

impl Lines<'_> {
    /// What settles a triangle of a part.
    fn settled_by(&self, rank: u16, triangle: u32) -> &[Settled] {
        let of_part = &self.settled[usize::from(rank)];
        let first = of_part.partition_point(|s| s.triangle < triangle);
        let after = of_part[first..].partition_point(|s| s.triangle == triangle);
        &of_part[first..first + after]
    }

    /// Puts crossings on the side of each clip-surface that their triangles are known to lie on.
    pub(super) fn settle(&self, at: DVec2, ray: &Ray, bench: &mut Bench) {
        for (index, crossing) in bench.crossings.iter_mut().enumerate() {
            for settled in self.settled_by(crossing.rank, crossing.triangle) {
                bench.settled.push((index as u32, settled.surface));
                let mut roots = bench.roots.iter();
                if let Some(root) = roots.find(|r| r.surface == settled.surface) {
                    let is_behind = (settled.side == Side::Kept) == root.to_kept;
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
                        bench.settled.push((index as u32, root.surface));
                    }
                }
            }
        }
    }

    /// Whether a crossing is with a face that lies in the face of a cutter, to the last bit.
    fn coincides(&self, ray: &Ray, root: &Root, crossing: &Crossing) -> bool {
        let distance = (crossing.depth - root.depth).abs();
        let close =
            ambiguity::rounding(self.view, root.depth) + root.depth_change(self.view, ray);
        distance <= close
            && root.face.is_some_and(|face| {
                let of_part = self.parts[usize::from(crossing.rank)].facet(crossing.triangle);
                let of_cutter = self.mesh_of_cutter(root.surface).facet(face.triangle);
                cutter::lies_in(of_part.points, of_cutter.points)
            })
    }

    /// Whether both triangles of a coincidence are still met when the sample moves a little.
    fn goes_on(&self, at: DVec2, root: &Root, crossing: &Crossing) -> bool {
        root.face.is_none_or(|face| {
            let of_cutter = self.mesh_of_cutter(root.surface).corners(face.triangle);
            let of_part = self.parts[usize::from(crossing.rank)].corners(crossing.triangle);
            cutter::share_the_sample(at, [of_cutter, of_part])
        })
    }
}
