//! Finds points that have the same convex hull as a part's kept geometry.

use glam::DVec3;
use rayon::prelude::*;

use super::region::Regions;
use super::rim;
use crate::scene::{Mesh, Part};

/// Number of steps along an edge that meets a relief.
const EDGE_STEPS: u32 = 24;

/// Number of bisections within a step.
const CROSSING_HALVINGS: u32 = 24;

/// Number of steps in the search for a point where two reliefs meet.
const MEETING_STEPS: u32 = 8;

/// A point counts as on a triangle's edge if a barycentric coordinate is negative by at most this.
const ON_EDGE: f64 = 1e-9;

/// Triangles that one thread takes at a time.
const CHUNK: usize = 4096;

/// A height up to this, as a share of the part's size, counts as on the clip-surface; a face there is not kept.
const FLUSH: f64 = 1e-9;

/// Points with the same convex hull as the part's kept geometry, in world space.
pub(super) fn kept_of(part: &Part, regions: &Regions) -> Vec<DVec3> {
    let mesh = part.posed_mesh();
    let placed: Vec<DVec3> = (mesh.positions.iter())
        .map(|p| part.world_from_part.transform_point3(*p))
        .collect();
    if regions.cuts.is_empty() {
        return used(&mesh, &placed).collect();
    }
    let most = placed
        .iter()
        .fold(0.0, |most: f64, p| most.max(p.distance(placed[0])));
    let gather = Gather {
        regions,
        brackets: (placed.iter())
            .flat_map(|p| regions.sides.iter().map(|s| s.bracket(*p)))
            .collect(),
        placed,
        least: FLUSH * most,
    };
    let chunks = mesh.triangles.par_chunks(CHUNK);
    let found: Vec<GatheredPoints> = chunks.map(|chunk| gather.found(chunk)).collect();
    let Gather { placed, least, .. } = gather;
    let (mut more, mut is_taken) = (Vec::new(), vec![false; placed.len()]);
    let mut rims = vec![Vec::new(); regions.sides.len()];
    for found in found {
        more.extend(found.more);
        found.taken.iter().for_each(|v| is_taken[*v] = true);
        for (rim, more) in rims.iter_mut().zip(found.rims) {
            rim.extend(more);
        }
    }
    for (side, rim) in rims.iter().enumerate() {
        more.extend(rim::risen(regions, side, rim, least));
    }
    more.extend(rim::corners_of_boxes(regions, &placed, least));
    more.extend(rim::inner_corners(regions, &placed, &mesh.triangles, least));
    let whole = placed.into_iter().zip(is_taken);
    more.extend(whole.filter(|(_, is_taken)| *is_taken).map(|(p, _)| p));
    more
}

/// The vertices that triangles use.
fn used<'a>(mesh: &'a Mesh, placed: &'a [DVec3]) -> impl Iterator<Item = DVec3> + 'a {
    let mut is_used = vec![false; placed.len()];
    for corner in mesh.triangles.iter().flatten() {
        is_used[*corner as usize] = true;
    }
    let all = placed.iter().zip(is_used);
    all.filter(|(_, is_used)| *is_used).map(|(p, _)| *p)
}

struct Gather<'a> {
    regions: &'a Regions,
    placed: Vec<DVec3>,
    /// Lower and upper bound of each vertex's height over each side.
    brackets: Vec<[f64; 2]>,
    least: f64,
}

/// Points found in some of the triangles.
struct GatheredPoints {
    /// Indices of kept vertices; an index may occur more than once.
    taken: Vec<usize>,
    more: Vec<DVec3>,
    /// Per side: the points where it crosses edges.
    rims: Vec<Vec<DVec3>>,
}

impl Gather<'_> {
    fn bracket(&self, vertex: usize, side: usize) -> [f64; 2] {
        self.brackets[vertex * self.regions.sides.len() + side]
    }

    /// Returns true if the height bounds of a simplex's corners prove that the whole simplex is kept.
    fn is_whole(&self, corners: &[usize]) -> bool {
        let over = |side| {
            corners
                .iter()
                .all(|v| self.bracket(*v, side)[0] > self.least)
        };
        self.regions.keep(over)
    }

    /// Returns true if the whole simplex is below every side of one cut. A cut with a box side never qualifies: a box has no single plane.
    fn is_gone(&self, corners: &[usize]) -> bool {
        let is_under = |side: usize| {
            let under = corners
                .iter()
                .all(|v| self.bracket(*v, side)[1] <= self.least);
            under && self.regions.sides[side].plane().is_some()
        };
        let mut cuts = self.regions.cuts.iter();
        cuts.any(|[first, end]| (*first..*end).all(is_under))
    }

    /// Finds points of the kept geometry in some of the triangles.
    fn found(&self, triangles: &[[u32; 3]]) -> GatheredPoints {
        let mut found = GatheredPoints {
            taken: Vec::new(),
            more: Vec::new(),
            rims: vec![Vec::new(); self.regions.sides.len()],
        };
        for triangle in triangles {
            self.take_triangle(triangle.map(|i| i as usize), &mut found);
        }
        found
    }

    fn take_triangle(&self, corners: [usize; 3], found: &mut GatheredPoints) {
        if self.is_whole(&corners) {
            found.taken.extend(corners);
            return;
        }
        if self.is_gone(&corners) {
            return;
        }
        let [a, b, c] = corners;
        for [a, b] in [[a, b], [b, c], [c, a]] {
            self.take_edge(a, b, found);
        }
        self.take_meetings(corners, found);
    }

    /// Adds the ends of the kept sections of an edge.
    fn take_edge(&self, a: usize, b: usize, found: &mut GatheredPoints) {
        if self.is_gone(&[a, b]) {
            return;
        }
        let mut crossings: Vec<(f64, Option<usize>)> = vec![(0.0, None), (1.0, None)];
        for side in 0..self.regions.sides.len() {
            self.cross(side, [a, b], &mut crossings);
        }
        crossings.sort_by(|x, y| x.0.total_cmp(&y.0));
        let (from, to) = (self.placed[a], self.placed[b]);
        for ends in crossings.windows(2) {
            let middle = from.lerp(to, (ends[0].0 + ends[1].0) / 2.0);
            if !self.regions.keep_point(middle, self.least) {
                continue;
            }
            for (share, side) in ends {
                let point = from.lerp(to, *share);
                match side {
                    Some(side) => {
                        found.rims[*side].push(point);
                        found.more.push(point);
                    }
                    None => found.taken.push(if *share == 0.0 { a } else { b }),
                }
            }
        }
    }

    /// Finds crossings of an edge with a side.
    fn cross(&self, side: usize, [a, b]: [usize; 2], found: &mut Vec<(f64, Option<usize>)>) {
        let [low, high] = [a, b].map(|v| self.bracket(v, side));
        let surface = &self.regions.sides[side];
        if !surface.is_rough() {
            let [from, to] = [low[0], high[0]];
            if (from > 0.0) != (to > 0.0) {
                found.push(((from / (from - to)).clamp(0.0, 1.0), Some(side)));
            }
            return;
        }
        let is_under = low[1] <= 0.0 && high[1] <= 0.0 && surface.plane().is_some();
        if (low[0] > 0.0 && high[0] > 0.0) || is_under {
            return;
        }
        let (from, to) = (self.placed[a], self.placed[b]);
        let is_over = |share: f64| surface.height(from.lerp(to, share)) > 0.0;
        let mut last = (0.0, is_over(0.0));
        for step in 1..=EDGE_STEPS {
            let share = f64::from(step) / f64::from(EDGE_STEPS);
            let now = (share, is_over(share));
            if now.1 != last.1 {
                let (mut low, mut high) = (last.0, now.0);
                for _ in 0..CROSSING_HALVINGS {
                    let middle = (low + high) / 2.0;
                    match is_over(middle) == last.1 {
                        true => low = middle,
                        false => high = middle,
                    }
                }
                found.push(((low + high) / 2.0, Some(side)));
            }
            last = now;
        }
    }

    /// Adds the points where sides of two different cuts meet in a triangle.
    fn take_meetings(&self, corners: [usize; 3], found: &mut GatheredPoints) {
        let regions = self.regions;
        for second in 0..regions.sides.len() {
            for first in 0..second {
                if regions.cut_of(first) == regions.cut_of(second)
                    || [first, second]
                        .iter()
                        .any(|s| regions.sides[*s].plane().is_none())
                {
                    continue;
                }
                let Some(point) = self.meeting([first, second], corners) else {
                    continue;
                };
                let is_over = |side: usize| {
                    side == first || side == second || {
                        regions.sides[side].height(point) > -self.least
                    }
                };
                if regions.keep(is_over) {
                    found.more.push(point);
                }
            }
        }
    }

    /// Point at which two sides meet in a triangle. For reliefs, each step intersects the planes at the last point's heights.
    fn meeting(&self, sides: [usize; 2], corners: [usize; 3]) -> Option<DVec3> {
        let [a, b, c] = corners.map(|v| self.placed[v]);
        let of_planes = sides.map(|side| {
            let low = |v: &usize| self.bracket(*v, side)[0];
            DVec3::from_array([0, 1, 2].map(|i| low(&corners[i])))
        });
        let lows = sides.map(|side| self.regions.sides[side].least_relief());
        let mut reliefs = sides.map(|side| self.regions.sides[side].middle_relief());
        let is_rough = sides.iter().any(|s| self.regions.sides[*s].is_rough());
        for step in 0..=MEETING_STEPS {
            // The corners' heights over the planes that stand for the reliefs at the last point.
            let [one, other] = [0, 1].map(|i| of_planes[i] - lows[i] + reliefs[i]);
            let shares = one.cross(other);
            let shares = shares / shares.element_sum();
            let is_last = step == MEETING_STEPS || !is_rough;
            let is_out = |share: &f64| !(-ON_EDGE..).contains(share);
            if !shares.is_finite() || (is_last && shares.to_array().iter().any(is_out)) {
                return None;
            }
            let point = a * shares.x + b * shares.y + c * shares.z;
            if is_last {
                return Some(point);
            }
            reliefs = sides.map(|side| self.regions.sides[side].relief_at(point));
        }
        None
    }
}
