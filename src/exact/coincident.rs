//! Faces that lie in a clip-surface: the one tie that is decided as a whole.
//!
//! A crossing with such a face gets the depth of the clip-surface's root bit for bit, so that the walk sees a tie and settles all of
//! the face alike. Only exact zeros count; a face that is merely close is left to rounding, and its pixels to [`super::ambiguity`].

use glam::{DVec2, DVec3};

use super::bench::Bench;
use super::clip::{Ray, Root};
use super::raster::Crossing;
use super::{Lines, ambiguity, cutter};

impl Lines<'_> {
    /// Whether a triangle lies in the clip-surface where a ray crosses it, to the last bit.
    fn holds(&self, root: &Root, points: [DVec3; 3]) -> bool {
        match root.face {
            Some(face) => {
                let facet = self.mesh_of_cutter(root.surface).facet(face.triangle);
                cutter::lies_in(points, facet.points)
            }
            None => self.clips[root.surface as usize].holds(points),
        }
    }

    /// Gives a crossing with a triangle that lies in a clip-surface the depth of the surface's root, bit for bit.
    pub(super) fn snap_coincident(&self, at: DVec2, ray: &Ray, bench: &mut Bench) {
        for root in &bench.roots {
            for (index, crossing) in bench.crossings.iter_mut().enumerate() {
                let close = (crossing.depth - root.depth).abs()
                    <= ambiguity::rounding(self.view, root.depth)
                        + root.depth_change(self.view, ray);
                if !close {
                    continue;
                }
                let points = self.parts[crossing.rank as usize]
                    .facet(crossing.triangle)
                    .points;
                if self.holds(root, points) {
                    crossing.depth = root.depth;
                    if self.goes_on(at, root, crossing) {
                        bench.coincident.push((index as u32, root.surface));
                    }
                }
            }
        }
    }

    /// Whether a crossing in the plane of a root is in it whoever moves the sample a little: a plane goes on, a face ends.
    fn goes_on(&self, at: DVec2, root: &Root, crossing: &Crossing) -> bool {
        root.face.is_none_or(|face| {
            let of_cutter = self.mesh_of_cutter(root.surface).corners(face.triangle);
            let of_part = self.parts[crossing.rank as usize].corners(crossing.triangle);
            cutter::share_the_sample(at, [of_cutter, of_part])
        })
    }
}
