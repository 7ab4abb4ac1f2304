//! Open parts: what their holes add to the crossings that a ray counts.
//!
//! Whether a point is inside an open part is decided by its generalised winding number (Jacobson, Kavan, Sorkine-Hornung 2013): the signed
//! solid angle of all faces as seen from the point, over 4 pi, rounded to the nearest whole number, which the fill rule judges. Along a ray,
//! this number jumps by 1 where the ray crosses a face, exactly as the count of crossings does. The difference of the two is therefore
//! smooth; it is the solid angle of the holes. Rounded, it is added to the count where the ray crosses a clip-surface. Nothing is inside a
//! part outside of its box.
//!
//! Cost: a tree over all faces of each open part per picture; per crossing of such a part's clip-surfaces, one traversal, and a finer
//! one near a half. Closed parts cost a sort of their edges. Limit: numbers nearer to a half than [`ROUNDED`] are undecided.

use cutaway::scene::winding::{Closing, WindingTree};
use cutaway::scene::{Bounds, Prepared};
use glam::DVec3;
use rayon::prelude::*;

use crate::exact::clip::Ray;
use crate::exact::raster::Crossing;
use crate::exact::ray_scratch::RayScratch;
use crate::exact::walk::HoleNumber;

/// A ball of the tree is opened where the bound of its error is greater: at first, and where that leaves open which whole number is nearest.
const TOLERANCES: [f64; 3] = [1e-3, 1e-5, 0.0];

/// A number this near to a half may be rounded either way: an implementation evaluates it in f32, at a point rounded to f32.
const ROUNDED: f64 = 1e-3;

/// Distance before a clip-surface at which the winding number is evaluated, in scene units: a face in the surface is then behind the
/// point, as for the exact reference. Equals half of the last bit of a scene coordinate.
pub(super) const BEFORE: f64 = 1.0 / (1 << 24) as f64;

/// Distances before a point at which numbers are evaluated, in units of [`BEFORE`]. The one farthest from all faces is taken.
const STEPS_BEFORE: [f64; 3] = [1.0, 2.0, 3.0];

/// The open parts of a scene.
#[derive(Default)]
pub(in crate::exact) struct OpenParts {
    /// Their ranks, in order, each with the tree of its faces.
    trees: Vec<(u16, WindingTree)>,
}

impl OpenParts {
    /// Finds the open parts of a scene.
    pub(in crate::exact) fn of(prepared: &Prepared) -> Self {
        let parts = prepared.parts.par_iter().enumerate();
        let trees = parts.filter_map(|(rank, part)| {
            let is_open = !part.is_removed && Closing::of(&part.triangles).is_needed(part.fill);
            let tree = || WindingTree::of(&part.positions, &part.triangles);
            is_open.then(|| (rank as u16, tree()))
        });
        Self {
            trees: trees.collect(),
        }
    }

    /// Ranks of the open parts.
    pub(in crate::exact) fn ranks(&self) -> impl Iterator<Item = u16> {
        self.trees.iter().map(|(rank, _)| *rank)
    }

    /// Returns true if there are none.
    pub(in crate::exact) fn is_empty(&self) -> bool {
        self.trees.is_empty()
    }

    /// The tree of an open part's faces; `None` if the part is closed.
    fn tree(&self, rank: u16) -> Option<&WindingTree> {
        let found = self.trees.binary_search_by_key(&rank, |(rank, _)| *rank);
        found.ok().map(|place| &self.trees[place].1)
    }

    /// Adds the open parts that the ray may enter through a hole to those it meets. Returns the range of depths within their boxes, empty
    /// if there are none.
    pub(in crate::exact) fn meet(
        &self,
        prepared: &Prepared,
        ray: &Ray,
        bench: &mut RayScratch,
    ) -> [f64; 2] {
        let mut reach = [f64::INFINITY, f64::NEG_INFINITY];
        for rank in self.ranks() {
            let bounds = &prepared.parts[usize::from(rank)].bounds;
            if let Some([from, to]) = depths_within(ray, bounds) {
                reach = [reach[0].min(from), reach[1].max(to)];
                if let Err(place) = bench.ranks.binary_search(&rank) {
                    bench.ranks.insert(place, rank);
                }
            }
        }
        reach
    }

    /// Returns true if all parts in which the line of `bench` ends are open.
    pub(in crate::exact) fn explain(&self, bench: &RayScratch) -> bool {
        let mut ranks = bench.ranks.iter().filter(|r| bench.end.is_inside(**r));
        ranks.all(|rank| self.tree(*rank).is_some())
    }

    /// Sets the state of the ray's open parts at its start: what holes add at the near plane.
    pub(in crate::exact) fn start(
        &self,
        prepared: &Prepared,
        ray: &Ray,
        near: f64,
        bench: &mut RayScratch,
    ) {
        for rank in bench.ranks.iter().copied() {
            let Some(tree) = self.tree(rank) else {
                continue;
            };
            let (number, other) = number(tree, (prepared, rank), (ray, near), bench);
            bench.start.through_holes[usize::from(rank)] = number;
            if other.is_some() {
                bench.start.at_clips.push(HoleNumber {
                    source: HoleNumber::AT_NEAR_PLANE,
                    rank,
                    number,
                    other,
                });
            }
        }
    }

    /// Lists what holes add at the crossings with clip-surfaces. Crossings with meshes must not have been moved to clip-surfaces yet.
    pub(in crate::exact) fn list(&self, prepared: &Prepared, ray: &Ray, bench: &mut RayScratch) {
        for rank in bench.ranks.iter().copied() {
            let Some(tree) = self.tree(rank) else {
                continue;
            };
            for (source, root) in bench.roots.iter().enumerate() {
                let cut = prepared.surfaces[usize::from(root.surface)].cut;
                if prepared.parts[usize::from(rank)].cuts.contains(&cut) {
                    let (number, other) = number(tree, (prepared, rank), (ray, root.depth), bench);
                    bench.start.at_clips.push(HoleNumber {
                        source: source as u32,
                        rank,
                        number,
                        other,
                    });
                }
            }
        }
    }
}

/// What the holes of a part add at a depth, and the other whole number that it may be.
fn number(
    tree: &WindingTree,
    (prepared, rank): (&Prepared, u16),
    (ray, depth): (&Ray, f64),
    bench: &RayScratch,
) -> (i32, Option<i32>) {
    let part = &prepared.parts[usize::from(rank)];
    let own = |c: &&Crossing| c.rank == rank;
    let per_unit = 1.0 / ray.direction.length();
    let gap = |at: f64| {
        let gaps = bench
            .crossings
            .iter()
            .filter(own)
            .map(|c| (c.depth - at).abs());
        gaps.fold(f64::INFINITY, f64::min)
    };
    let depths = STEPS_BEFORE.map(|steps| depth - steps * BEFORE * per_unit);
    let at = depths
        .into_iter()
        .max_by(|a, b| gap(*a).total_cmp(&gap(*b)));
    let at = at.unwrap_or(depth);
    let before = bench.crossings.iter().filter(own).filter(|c| c.depth <= at);
    let counted: i32 =
        before.map(|c| i32::from(c.step())).sum::<i32>() + bench.start.winding[usize::from(rank)];
    let point = ray.origin + ray.direction * at;
    // Faces in the sides of the box are near the point on either side.
    let Bounds { min, max } = part.bounds;
    let bounds = Bounds {
        min: min - 4.0 * BEFORE,
        max: max + 4.0 * BEFORE,
    };
    if !holds(&bounds, point) {
        return (-counted, None);
    }
    let mut number = 0.0;
    for tolerance in TOLERANCES {
        let (winding, error) = tree.winding(point, tolerance);
        number = winding - f64::from(counted);
        let from_half = 0.5 - (number - number.round()).abs();
        if from_half > error + ROUNDED {
            return (number.round() as i32, None);
        }
    }
    let nearest = number.round() as i32;
    let other = nearest + if number > number.round() { 1 } else { -1 };
    if 0.5 - (number - number.round()).abs() > ROUNDED {
        return (nearest, None);
    }
    // At a half, a point is outside: a mesh that lies in a plane encloses nothing.
    match part.fill.holds(counted + nearest) {
        true => (other, Some(nearest)),
        false => (nearest, Some(other)),
    }
}

pub(super) fn holds(bounds: &Bounds, point: DVec3) -> bool {
    point.cmpge(bounds.min).all() && point.cmple(bounds.max).all()
}

/// The range of depths in which a ray is in a box.
pub(super) fn depths_within(ray: &Ray, bounds: &Bounds) -> Option<[f64; 2]> {
    let mut range = [f64::NEG_INFINITY, f64::INFINITY];
    for axis in 0..3 {
        let (from, along) = (ray.origin[axis], ray.direction[axis]);
        let ends = [bounds.min[axis], bounds.max[axis]].map(|b| (b - from) / along);
        // A ray within a face of the box gives NaN, and still counts as inside the box.
        range[0] = range[0].max(ends[0].min(ends[1]));
        range[1] = range[1].min(ends[0].max(ends[1]));
    }
    (range[0] <= range[1]).then_some(range)
}
