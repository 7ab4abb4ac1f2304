//! Decides for whole triangles on which side of a clip-surface their crossings lie, where rounding would decide for each crossing alone.
//!
//! A triangle close to a flat clip-surface is assigned to one side of it ([`PreclassifiedTriangle`]). If rounding has put a crossing on
//! the other side of the surface's root, it gets exactly the root's depth, and an order before or behind the root. So a face in a
//! clip-surface is kept or removed as a whole, in every view. A sample near the rim of such faces may, if moved a little, hit a
//! triangle assigned to the other side: there the order is left to [`super::ambiguity`].
//!
//! If several parts have faces in one plane that face the same way, crossings with all of them get the depth of the plane, and the
//! first part in rank is seen ([`SharedPlanes`](cutaway::scene::SharedPlanes)).
//!
//! A part's face that coincides with a cutter's face comes before the cutter if the ray leaves the part through the face, and after
//! the cutter if the ray enters. Only exact coincidence counts; faces that are merely close are left to [`super::ambiguity`].

use std::collections::BTreeMap;
use std::sync::Arc;

use cutaway::scene::{PreclassifiedTriangle, Prepared, PreparedPart, Side, lies_in};
use glam::DVec2;

use super::clip::{Ray, Root};
use super::raster::Crossing;
use super::ray_scratch::RayScratch;
use super::walk::Event;
use super::{BandedScene, ambiguity, cutter};

/// The preclassified triangles of a part.
pub(super) struct PreclassifiedFaces {
    /// Triangles in planes shared by several parts, each with the number of its plane.
    shared: Arc<[(u32, u16)]>,
    /// Per entry of `shared`: for each edge, indexed by its first corner, true if it is at the rim of the faces in the plane.
    shared_rims: Vec<[bool; 3]>,
    /// Preclassified triangles, ordered by triangle index.
    all: Vec<PreclassifiedTriangle>,
    /// Per entry of `all`: for each edge, indexed by its first corner, true if the adjacent triangle is, or may be, on another side.
    rims: Vec<[bool; 3]>,
}

impl PreclassifiedFaces {
    /// Collects the preclassified faces of a part.
    pub(super) fn of(prepared: &Prepared, (rank, part): (usize, &PreparedPart)) -> Self {
        let all = prepared.preclassified(part);
        let shared = prepared.shared.faces(rank);
        let alike = all.iter().map(|s| (s.triangle, (s.surface, s.side)));
        Self {
            rims: rims(part, alike),
            shared_rims: rims(part, shared.iter().copied()),
            all,
            shared,
        }
    }

    /// Number of the plane that a triangle shares with other parts, and which of its edges are at the rim.
    fn plane_of(&self, triangle: u32) -> Option<(u16, [bool; 3])> {
        let at = self.shared.binary_search_by_key(&triangle, |s| s.0).ok()?;
        Some((self.shared[at].1, self.shared_rims[at]))
    }

    /// Preclassified sides of a triangle, each with its rim edges.
    fn by(&self, triangle: u32) -> impl Iterator<Item = (&PreclassifiedTriangle, [bool; 3])> {
        let first = self.all.partition_point(|s| s.triangle < triangle);
        let after = self.all[first..].partition_point(|s| s.triangle == triangle);
        let range = first..first + after;
        self.all[range.clone()]
            .iter()
            .zip(self.rims[range].iter().copied())
    }
}

/// Per triangle: for each edge, indexed by its first corner, true if it is at the rim of the triangles with the same key.
fn rims<K: Ord + Copy>(
    part: &PreparedPart,
    alike: impl Iterator<Item = (u32, K)> + Clone,
) -> Vec<[bool; 3]> {
    let edges = |(triangle, key): (u32, K)| {
        let corners = part.triangles[triangle as usize];
        [0, 1, 2].map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            (a.min(b), a.max(b), key)
        })
    };
    let mut uses: BTreeMap<_, u32> = BTreeMap::new();
    for edge in alike.clone().flat_map(edges) {
        *uses.entry(edge).or_default() += 1;
    }
    alike.map(|s| edges(s).map(|e| uses[&e] != 2)).collect()
}

/// Returns true if two crossings are with coplanar faces of parts and still have equal depths: a clip-surface may have moved one.
/// `shared` lists the crossings in shared planes, each with the number of its plane.
pub(super) fn share_plane(shared: &[(u32, u16)], events: [&Event; 2]) -> bool {
    let of = |event: &Event| {
        let at = shared.iter().find(|(source, _)| *source == event.source);
        at.map(|(_, plane)| *plane)
    };
    let [a, b] = events.map(of);
    let is_at_once = events[0].depth == events[1].depth && events[0].place == events[1].place;
    is_at_once && a.is_some() && a == b
}

impl BandedScene<'_> {
    /// Sets the depth of a crossing in a shared plane to the plane's depth, so that the rank of the parts decides their order.
    fn share(&self, at: DVec2, index: u32, bench: &mut RayScratch) {
        let crossing = &mut bench.crossings[index as usize];
        let rank = usize::from(crossing.rank);
        let Some((plane, rim)) = self.preclassified[rank].plane_of(crossing.triangle) else {
            return;
        };
        let Some([right, down, corner]) = self.shared_in_view[usize::from(plane)] else {
            return;
        };
        let buffer = corner + right * at.x + down * at.y;
        crossing.depth = self.view.depth_from_buffer(buffer);
        let corners = self.parts[rank].corners(crossing.triangle);
        if !(0..3).any(|e| rim[e] && cutter::is_by_edge(self.view.doubt_px(), at, corners, e)) {
            bench.shared.push((index, plane));
        }
    }

    /// Puts each crossing on the side of the clip-surface to which its triangle is preclassified.
    pub(super) fn classify(&self, at: DVec2, ray: &Ray, bench: &mut RayScratch) {
        for index in 0..bench.crossings.len() {
            self.share(at, index as u32, bench);
        }
        for (index, crossing) in bench.crossings.iter_mut().enumerate() {
            let rank = usize::from(crossing.rank);
            for (preclassified, rim) in self.preclassified[rank].by(crossing.triangle) {
                let corners = self.parts[rank].corners(crossing.triangle);
                let is_by_the_rim = (0..3)
                    .any(|e| rim[e] && cutter::is_by_edge(self.view.doubt_px(), at, corners, e));
                let mut roots = bench.roots.iter();
                if let Some(root) = roots.find(|r| r.surface == preclassified.surface) {
                    let is_behind = (preclassified.side == Side::Kept) == root.to_kept;
                    if !is_by_the_rim {
                        let place = if is_behind { 1 } else { -1 };
                        bench
                            .preclassified
                            .push((index as u32, preclassified.surface, place));
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
                        bench
                            .preclassified
                            .push((index as u32, root.surface, place));
                    }
                }
            }
        }
    }

    /// Returns true if a crossing's face lies exactly in a face of a cutter.
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

    /// Returns true if the sample, moved a little, still hits both of the two coincident triangles.
    fn goes_on(&self, at: DVec2, root: &Root, crossing: &Crossing) -> bool {
        root.face.is_none_or(|face| {
            let of_cutter = self.mesh_of_cutter(root.surface).corners(face.triangle);
            let of_part = self.parts[usize::from(crossing.rank)].corners(crossing.triangle);
            cutter::share_the_sample(self.view.doubt_px(), at, [of_cutter, of_part])
        })
    }
}
