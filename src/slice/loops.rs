//! Joins the pieces of a section into closed and open curves.
//!
//! A piece has two halves, one at each end. Halves on the same mesh edge are partners: at an ordinary edge there are two of them;
//! at an edge of more triangles, the two that bound one wedge of the solid, found by angle, are partners. Halves left over at points
//! with equal coordinates are paired in the same way, which closes meshes that repeat vertices. Then curves are walked from
//! partner to partner. Angles only choose among pairings that all close. Lengths matter in one case: of an odd number of
//! halves at an edge, the one left over belongs to a piece without length, if there is one, because that has no angle.
//!
//! Cost: two sorts of the halves.

use glam::DVec2;

/// Segment in which a plane cuts one triangle: from one crossed mesh edge to another, each as its two vertices, lesser first.
#[derive(Clone, Copy, Debug)]
pub(super) struct CutSegment {
    pub(super) from: [u32; 2],
    pub(super) to: [u32; 2],
}

/// Points, and curves as indices of points.
#[derive(Debug, Default)]
pub(super) struct Curves {
    /// Distinct points, sorted by coordinates.
    pub(super) points: Vec<DVec2>,
    /// Closed curves of at least three points; consecutive points differ.
    pub(super) loops: Vec<Vec<u32>>,
    /// Curves that do not close; consecutive points differ.
    pub(super) open: Vec<Vec<u32>>,
    /// Number of pieces whose curve passes them backwards.
    pub(super) turned: usize,
}

/// A piece this much shorter than another at its edge is considered a rounding error without an angle: its triangle has no area.
const NO_LENGTH: f64 = 1e-9;

/// No partner.
const NONE: u32 = u32::MAX;

/// Joins pieces; `locate` returns the point at which a mesh edge is crossed.
pub(super) fn join(pieces: &[CutSegment], locate: impl Fn([u32; 2]) -> DVec2) -> Curves {
    // Half 2i starts piece i, half 2i + 1 ends it.
    let mut halves: Vec<([u32; 2], u32)> = (0_u32..)
        .zip(pieces)
        .flat_map(|(i, p)| [(p.from, 2 * i), (p.to, 2 * i + 1)])
        .collect();
    halves.sort_unstable();
    let by_edge = || halves.chunk_by(|a, b| a.0 == b.0);
    let crossings: Vec<DVec2> = by_edge().map(|run| locate(run[0].0)).collect();
    let (points, point_of_crossing) = distinct(&crossings);

    let mut points_of_halves = vec![0; halves.len()];
    for (crossing, run) in by_edge().enumerate() {
        for (_, half) in run {
            points_of_halves[*half as usize] = point_of_crossing[crossing];
        }
    }
    let mut joints = Joints {
        partners: vec![NONE; halves.len()],
        points: &points,
        points_of_halves: &points_of_halves,
    };
    let mut left: Vec<(u32, u32)> = Vec::new();
    let mut run_of_halves = Vec::new();
    for run in by_edge() {
        run_of_halves.clear();
        run_of_halves.extend(run.iter().map(|(_, half)| *half));
        let odd = joints.pair(&mut run_of_halves);
        left.extend(odd.map(|half| (points_of_halves[half as usize], half)));
    }
    left.sort_unstable();
    for run in left.chunk_by(|a, b| a.0 == b.0) {
        run_of_halves.clear();
        run_of_halves.extend(run.iter().map(|(_, half)| *half));
        joints.pair(&mut run_of_halves);
    }
    let partners = joints.partners;
    walk(points, &points_of_halves, &partners)
}

/// Points without repeats, sorted, and the index among them of each given point.
fn distinct(given: &[DVec2]) -> (Vec<DVec2>, Vec<u32>) {
    let mut order: Vec<u32> = (0..given.len() as u32).collect();
    let at = |i: &u32| given[*i as usize];
    order.sort_unstable_by(|a, b| {
        let (p, q) = (at(a), at(b));
        p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y))
    });
    let mut points: Vec<DVec2> = Vec::new();
    let mut places = vec![0; given.len()];
    for i in order {
        let p = at(&i);
        if points.last() != Some(&p) {
            points.push(p);
        }
        places[i as usize] = points.len() as u32 - 1;
    }
    (points, places)
}

struct Joints<'a> {
    partners: Vec<u32>,
    points: &'a [DVec2],
    points_of_halves: &'a [u32],
}

impl Joints<'_> {
    fn marry(&mut self, a: u32, b: u32) {
        self.partners[a as usize] = b;
        self.partners[b as usize] = a;
    }

    /// Vector from a half to the other end of its piece.
    fn way(&self, half: u32) -> DVec2 {
        let [here, there] = [half, half ^ 1].map(|h| self.points_of_halves[h as usize]);
        self.points[there as usize] - self.points[here as usize]
    }

    /// Index of the half that belongs to a piece without length.
    fn speck(&self, halves: &[u32]) -> Option<usize> {
        let mut lengths = halves.iter().map(|h| self.way(*h).length());
        let longest = lengths.clone().fold(0.0, f64::max);
        lengths.position(|length| length <= NO_LENGTH * longest)
    }

    /// Pairs halves that meet; if their number is odd, one is left over.
    fn pair(&mut self, halves: &mut [u32]) -> Option<u32> {
        match *halves {
            [] => return None,
            [one] => return Some(one),
            [a, b] => {
                self.marry(a, b);
                return None;
            }
            _ => {}
        }
        if halves.len() % 2 == 1
            && let Some(speck) = self.speck(halves)
        {
            let last = halves.len() - 1;
            halves.swap(speck, last);
            self.pair(&mut halves[..last]);
            return Some(halves[last]);
        }
        let angle = |half: &u32| self.way(*half).to_angle();
        halves.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        // Solid lies counter-clockwise from a leaving piece to an arriving one: pairing works like brackets around the point, where the
        // first arrival matches the last departure.
        let (mut leaving, mut arriving) = (Vec::new(), Vec::new());
        for half in halves.iter().copied() {
            if half % 2 == 0 {
                leaving.push(half);
            } else if let Some(opened) = leaving.pop() {
                self.marry(opened, half);
            } else {
                arriving.push(half);
            }
        }
        arriving.reverse();
        while let (Some(opened), Some(closed)) = (leaving.last(), arriving.last()) {
            self.marry(*opened, *closed);
            leaving.pop();
            arriving.pop();
        }
        // Left over where triangles disagree about the outside.
        let rest = if leaving.is_empty() {
            arriving
        } else {
            leaving
        };
        let pairs = rest.chunks_exact(2);
        let odd = pairs.remainder().first().copied();
        for pair in pairs {
            self.marry(pair[0], pair[1]);
        }
        odd
    }
}

/// Follows partners, open curves first.
fn walk(points: Vec<DVec2>, points_of_halves: &[u32], partners: &[u32]) -> Curves {
    let mut curves = Curves {
        points,
        ..Curves::default()
    };
    let mut is_done = vec![false; partners.len() / 2];
    let ends = (0..partners.len() as u32).filter(|h| partners[*h as usize] == NONE);
    // Starts first: then a curve of consistently oriented triangles runs forward.
    let (starts, stops): (Vec<u32>, Vec<u32>) = ends.partition(|h| h % 2 == 0);
    let rings = (0..partners.len() as u32).step_by(2);
    for first in starts.into_iter().chain(stops).chain(rings) {
        if is_done[first as usize / 2] {
            continue;
        }
        let is_open = partners[first as usize] == NONE;
        let mut curve = Vec::new();
        let mut backward = 0;
        let mut half = first;
        let mut pieces = 0_usize;
        while half != NONE && !std::mem::replace(&mut is_done[half as usize / 2], true) {
            curve.push(points_of_halves[half as usize]);
            // A piece without length has no direction.
            let has_length =
                points_of_halves[half as usize] != points_of_halves[(half ^ 1) as usize];
            backward += usize::from(has_length && half % 2 == 1);
            pieces += usize::from(has_length);
            if is_open && partners[(half ^ 1) as usize] == NONE {
                curve.push(points_of_halves[(half ^ 1) as usize]);
            }
            half = partners[(half ^ 1) as usize];
        }
        if 2 * backward > pieces {
            curve.reverse();
            backward = pieces - backward;
        }
        curves.turned += backward;
        curve.dedup();
        if is_open {
            curves.open.push(curve);
            continue;
        }
        while curve.len() > 1 && curve.first() == curve.last() {
            curve.pop();
        }
        // Fewer points enclose nothing: the plane touches a vertex or an edge there.
        if curve.len() > 2 {
            curves.loops.push(curve);
        }
    }
    curves
}
