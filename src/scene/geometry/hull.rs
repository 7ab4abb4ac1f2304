//! The convex hull of points, which alone determines their extent in any direction.
//!
//! Quickhull (Barber, Dobkin & Huhdanpaa 1996, *The Quickhull algorithm for convex hulls*, ACM TOMS 22.4). Every undecided point is
//! stored with one facet that it lies in front of; a facet's farthest point joins the hull and replaces all facets visible from it.
//! Visibility is decided by exact signs (Shewchuk 1997), and a facet coplanar with the point is not visible: so the visible region
//! is always a disk, however many points are coplanar, and its border is one ring with no edge collinear with the point.
//!
//! If only extents are needed, points that protrude by less than [`ASIDE`] are left out: of a ball's million corners some ten
//! thousand matter. Cost: proportional to the number of points times the logarithm of the number of corners. Coplanar points have no hull.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;
use robust::{Coord3D, orient3d};

/// Fewest points that a thread takes at once.
const SHARE: usize = 1 << 13;

/// Points that protrude by less than this share of the total thickness are left out: 0.1 px in a picture of 1000 px.
const ASIDE: f64 = 1e-4;

/// A convex hull as a closed mesh.
#[derive(Clone, Debug, Default)]
pub(crate) struct ConvexHull {
    /// The corners, in no particular order.
    pub(crate) corners: Vec<DVec3>,
    /// Counter-clockwise from outside; planar faces may consist of several triangles.
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl ConvexHull {
    /// The hull of all points; `None` if they are coplanar.
    pub(crate) fn of(points: &[DVec3]) -> Option<Self> {
        Hull::around(points, 0.0).map(|hull| hull.as_mesh())
    }

    /// The hull of points; those that protrude by less than a ten-thousandth of the thickness may be left out.
    pub(crate) fn nearly(points: &[DVec3]) -> Option<Self> {
        Self::roughly(points, ASIDE)
    }

    /// The hull of points; those that protrude by less than the share `aside` of the thickness may be left out.
    pub(crate) fn roughly(points: &[DVec3], aside: f64) -> Option<Self> {
        Hull::around(points, aside).map(|hull| hull.as_mesh())
    }

    /// The corner that lies farthest in a direction.
    pub(crate) fn farthest(&self, direction: DVec3) -> DVec3 {
        let all = self.corners.iter().copied();
        all.max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)))
            .unwrap_or_default()
    }

    /// How far the hull reaches in a direction.
    #[cfg(test)]
    pub(crate) fn reach(&self, direction: DVec3) -> f64 {
        self.farthest(direction).dot(direction)
    }

    /// The hull scaled about the origin.
    pub(crate) fn scaled(&self, by: f64) -> Self {
        Self {
            corners: self.corners.iter().map(|c| *c * by).collect(),
            triangles: self.triangles.clone(),
        }
    }

    /// Returns true if a point lies inside or on the hull.
    pub(crate) fn holds(&self, point: DVec3) -> bool {
        self.faces()
            .all(|[a, b, c]| (b - a).cross(c - a).dot(point - a) <= 0.0)
    }

    /// The corners of each face.
    pub(crate) fn faces(&self) -> impl Iterator<Item = [DVec3; 3]> {
        (self.triangles.iter()).map(|t| t.map(|i| self.corners[i as usize]))
    }
}

struct HullFacet {
    /// Counter-clockwise from outside.
    corners: [usize; 3],
    /// The facet across the edge from each corner to the next.
    neighbours: [usize; 3],
    /// Unit normal.
    normal: DVec3,
    /// Undecided points in front of the facet.
    before: Vec<usize>,
    is_gone: bool,
}

struct Hull<'a> {
    points: &'a [DVec3],
    facets: Vec<HullFacet>,
    aside: f64,
}

/// The corners of the convex hull, in no particular order.
pub(in crate::scene) fn hull_corners(points: &[DVec3]) -> Vec<DVec3> {
    match ConvexHull::nearly(points) {
        Some(hull) => hull.corners,
        None => points.to_vec(),
    }
}

impl<'a> Hull<'a> {
    /// The hull of points; those that protrude by less than the share `aside` of the thickness may be left out.
    fn around(points: &'a [DVec3], aside: f64) -> Option<Self> {
        let mut hull = Self::begin(points, aside)?;
        let mut next = 0;
        while next < hull.facets.len() {
            match hull.farthest_before(next) {
                Some(point) => hull.add(point, next),
                None => next += 1,
            }
        }
        hull.facets.retain(|f| !f.is_gone);
        Some(hull)
    }

    fn as_mesh(&self) -> ConvexHull {
        let mut corners: Vec<usize> = self.facets.iter().flat_map(|f| f.corners).collect();
        corners.sort_unstable();
        corners.dedup();
        let place = |point: usize| corners.partition_point(|c| *c < point) as u32;
        ConvexHull {
            triangles: self.facets.iter().map(|f| f.corners.map(place)).collect(),
            corners: corners.iter().map(|i| self.points[*i]).collect(),
        }
    }

    /// The hull of four points that are not coplanar.
    fn begin(points: &'a [DVec3], aside: f64) -> Option<Self> {
        let farthest = |of: &dyn Fn(DVec3) -> f64| {
            let all = points.iter().enumerate().map(|(i, p)| (i, of(*p)));
            all.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
        };
        let a = farthest(&|p| -p.x)?;
        let b = farthest(&|p| p.distance_squared(points[a]))?;
        let along = points[b] - points[a];
        let c = farthest(&|p| along.cross(p - points[a]).length_squared())?;
        let normal = along.cross(points[c] - points[a]).normalize_or_zero();
        let d = farthest(&|p| normal.dot(p - points[a]).abs())?;
        let mut hull = Self {
            points,
            facets: Vec::new(),
            aside: aside * normal.dot(points[d] - points[a]).abs(),
        };
        let side = hull.side([a, b, c], d);
        if side == 0.0 {
            return None;
        }
        let [a, b] = if side > 0.0 { [b, a] } else { [a, b] };
        // The last corner now lies behind the plane of the first three.
        let corners = [[a, b, c], [b, a, d], [c, b, d], [a, c, d]];
        for corners in corners {
            hull.push(corners, [0; 3]);
        }
        for (facet, neighbours) in [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]
            .into_iter()
            .enumerate()
        {
            hull.facets[facet].neighbours = neighbours;
        }
        hull.share_out(0..points.len(), 0);
        Some(hull)
    }

    /// Positive if a point lies in front of the plane of three others; the sign is exact.
    fn side(&self, corners: [usize; 3], point: usize) -> f64 {
        let of = |i: usize| {
            let DVec3 { x, y, z } = self.points[i];
            Coord3D { x, y, z }
        };
        let [a, b, c] = corners.map(of);
        -orient3d(a, b, c, of(point))
    }

    fn push(&mut self, corners: [usize; 3], neighbours: [usize; 3]) {
        let [a, b, c] = corners.map(|i| self.points[i]);
        self.facets.push(HullFacet {
            corners,
            neighbours,
            normal: (b - a).cross(c - a).normalize_or_zero(),
            before: Vec::new(),
            is_gone: false,
        });
    }

    fn distance(&self, facet: usize, point: usize) -> f64 {
        let HullFacet {
            normal, corners, ..
        } = &self.facets[facet];
        normal.dot(self.points[point] - self.points[corners[0]])
    }

    /// Assigns each point to a facet that it lies in front of, among those from `first` on; points without such a facet are decided.
    fn share_out<P>(&mut self, points: P, first: usize)
    where
        P: IntoParallelIterator<Item = usize, Iter: IndexedParallelIterator>,
    {
        let facet_of = |point: usize| {
            let mut all = first..self.facets.len();
            let before = all.find(|f| {
                self.distance(*f, point) > self.aside
                    && self.side(self.facets[*f].corners, point) > 0.0
            });
            before.map(|facet| (facet, point))
        };
        let points = points.into_par_iter().with_min_len(SHARE);
        let shared: Vec<(usize, usize)> = points.filter_map(facet_of).collect();
        for (facet, point) in shared {
            self.facets[facet].before.push(point);
        }
    }

    fn farthest_before(&self, facet: usize) -> Option<usize> {
        let before = &self.facets[facet].before;
        let all = before.par_iter().enumerate().with_min_len(SHARE);
        let all = all.map(|(place, point)| (self.distance(facet, *point), place));
        // Of points at the same distance the last, whatever the number of threads.
        let farthest = all.max_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        farthest.map(|(_, place)| before[place])
    }

    /// Adds a point in front of the facet `seen_first` to the hull.
    fn add(&mut self, point: usize, seen_first: usize) {
        let mut seen = vec![seen_first];
        self.facets[seen_first].is_gone = true;
        // Edges of the ring, keyed by their first corner: the second corner, and the facet beyond the edge.
        let mut ring: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
        let mut looked_at = 0;
        while let Some(facet) = seen.get(looked_at).copied() {
            looked_at += 1;
            for edge in 0..3 {
                let HullFacet {
                    corners,
                    neighbours,
                    ..
                } = &self.facets[facet];
                let (from, to) = (corners[edge], corners[(edge + 1) % 3]);
                let beyond = neighbours[edge];
                if self.facets[beyond].is_gone {
                    continue;
                }
                if self.side(self.facets[beyond].corners, point) > 0.0 {
                    self.facets[beyond].is_gone = true;
                    seen.push(beyond);
                } else {
                    ring.insert(from, (to, beyond));
                }
            }
        }
        let first = self.facets.len();
        let places: BTreeMap<usize, usize> = ring.keys().copied().zip(first..).collect();
        let mut before = BTreeMap::new();
        for (from, (to, _)) in &ring {
            before.insert(*to, places[from]);
        }
        for (from, (to, beyond)) in &ring {
            let own = places[from];
            let after = places.get(to).copied().unwrap_or(own);
            let last = before.get(from).copied().unwrap_or(own);
            self.push([*from, *to, point], [*beyond, after, last]);
            let across = &mut self.facets[*beyond];
            let edge = across.corners.iter().position(|c| c == to);
            if let Some(edge) = edge {
                across.neighbours[edge] = own;
            }
        }
        for facet in seen {
            let mut orphans = std::mem::take(&mut self.facets[facet].before);
            orphans.retain(|orphan| *orphan != point);
            self.share_out(orphans, first);
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Quasi-random points in a cube.
    pub(in crate::scene::geometry) fn scattered(count: u32) -> Vec<DVec3> {
        let step = DVec3::new(0.754_877_666, 0.569_840_291, 0.322_185_355);
        (1..=count)
            .map(|i| (step * f64::from(i)).fract() - 0.5)
            .collect()
    }

    fn reach(points: &[DVec3], direction: DVec3) -> f64 {
        let all = points.iter().map(|p| p.dot(direction));
        all.fold(f64::NEG_INFINITY, f64::max)
    }

    #[track_caller]
    fn holds_all(points: &[DVec3], most_corners: usize) {
        let corners = hull_corners(points);
        assert!(corners.len() <= most_corners, "{} corners", corners.len());
        assert!(corners.iter().all(|c| points.contains(c)), "all are points");
        for direction in scattered(3000) {
            let direction = direction.normalize_or(DVec3::X);
            let short = reach(points, direction) - reach(&corners, direction);
            assert!(
                (0.0..4e-4).contains(&short),
                "short by {short} towards {direction}"
            );
        }
        // Control: without the farthest point in some direction, the hull falls short there.
        let aside = DVec3::new(1.0, 0.3, 0.2).normalize_or(DVec3::X);
        let farthest = reach(&corners, aside);
        let fewer: Vec<DVec3> = corners
            .into_iter()
            .filter(|c| c.dot(aside) < farthest)
            .collect();
        assert!(
            reach(points, aside) > reach(&fewer, aside) + 1e-6,
            "the control"
        );
    }

    #[test]
    fn the_hull_reaches_as_far_as_its_points_in_every_direction() {
        holds_all(&scattered(20_000), 2000);
        let ball: Vec<DVec3> = scattered(20_000)
            .into_iter()
            .map(|p| p.normalize_or(DVec3::X) * 0.5)
            .collect();
        holds_all(&ball, 18_000);
    }

    #[test]
    fn points_in_common_planes_are_no_trouble() {
        // A grid: every face of the hull is full of points, and so is every edge.
        let side = 0..9;
        let grid: Vec<DVec3> = side
            .clone()
            .flat_map(|x| {
                side.clone()
                    .flat_map(move |y| (0..9).map(move |z| [x, y, z]))
            })
            .map(|p| DVec3::from_array(p.map(f64::from)) / 8.0 - 0.5)
            .collect();
        holds_all(&grid, 8);
        // A drum: all corners of each end are coplanar, and every point is duplicated.
        let drum: Vec<DVec3> = (0..720)
            .flat_map(|i| {
                let (sin, cos) = f64::from(i).to_radians().sin_cos();
                [-0.3, 0.1, 0.3].map(|z| DVec3::new(cos, sin, z) * 0.5)
            })
            .collect();
        holds_all(&drum, 1440);
    }

    #[test]
    fn what_lies_in_a_plane_is_all_kept() {
        let flat: Vec<DVec3> = scattered(50).into_iter().map(|p| p.with_z(0.25)).collect();
        assert_eq!(hull_corners(&flat), flat);
        assert!(hull_corners(&[]).is_empty());
        assert_eq!(hull_corners(&[DVec3::ONE; 3]), [DVec3::ONE; 3]);
    }
}
