//! A tree of bounding boxes, eight neighbouring triangles per box, to find the triangles that a plane or a ray can cross.
//!
//! Triangles are sorted along a Z-order curve through their centres (Morton 1966) and grouped in that order, level by level.
//! Cost: one parallel sort; boxes take about 7 bytes per triangle. If triangles are small, a plane then tests a few boxes per
//! triangle that it crosses; a mesh of needles in all directions gains little.

use glam::DVec3;
use rayon::prelude::*;

use crate::scene::Bounds;

/// Triangles per box, and boxes per box of the next level.
pub(crate) const BRANCHES: usize = 8;

/// A tree of boxes over groups of triangles in order.
#[derive(Debug, Default)]
pub(crate) struct Tree {
    /// Levels of boxes, from those around triangles up to a level of at most [`BRANCHES`] boxes.
    levels: Vec<Vec<Bounds>>,
}

impl Tree {
    /// The tree over triangles that are sorted by [`sort`].
    pub(crate) fn over(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let of_triangles = triangles.par_chunks(BRANCHES).map(|some| {
            let corners = some.iter().flatten().map(|i| positions[*i as usize]);
            Bounds::from_points(corners)
        });
        let mut levels: Vec<Vec<Bounds>> = vec![of_triangles.collect()];
        while let Some(below) = levels.last().filter(|l| l.len() > BRANCHES) {
            let over = below.par_chunks(BRANCHES);
            let over = over.map(|some| some.iter().copied().fold(Bounds::EMPTY, Bounds::union));
            let over: Vec<Bounds> = over.collect();
            levels.push(over);
        }
        Self { levels }
    }

    /// Indices, in order, of the groups whose boxes `misses` does not rule out.
    pub(crate) fn groups(&self, misses: impl Fn(&Bounds) -> bool) -> Vec<usize> {
        let Some(top) = self.levels.last() else {
            return Vec::new();
        };
        let mut met: Vec<usize> = (0..top.len()).collect();
        for (level, boxes) in self.levels.iter().enumerate().rev() {
            met.retain(|i| !misses(&boxes[*i]));
            if level > 0 {
                let count = self.levels[level - 1].len();
                let below = met.iter().flat_map(|i| i * BRANCHES..(i + 1) * BRANCHES);
                met = below.take_while(|i| *i < count).collect();
            }
        }
        met
    }
}

/// Sorts triangles so that consecutive ones lie near each other; the sort is stable.
pub(crate) fn sort(positions: &[DVec3], triangles: &mut Vec<[u32; 3]>) {
    *triangles = (order(positions, triangles).par_iter())
        .map(|i| triangles[*i as usize])
        .collect();
}

/// The indices of triangles in the order produced by [`sort`].
pub(crate) fn order(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<u32> {
    let middle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| positions[i as usize] / 3.0);
        a + b + c
    };
    let bounds = triangles
        .par_chunks(1 << 14)
        .map(|some| Bounds::from_points(some.iter().map(middle)))
        .reduce(|| Bounds::EMPTY, Bounds::union);
    let size = bounds.size().max(DVec3::splat(f64::MIN_POSITIVE));
    let mut order: Vec<(u64, u32)> = (triangles.par_iter().enumerate())
        .map(|(i, t)| {
            let share = (middle(t) - bounds.min) / size;
            (place_on_curve(share), i as u32)
        })
        .collect();
    order.par_sort_unstable();
    order.into_par_iter().map(|(_, i)| i).collect()
}

/// Position of a point in the unit cube on a Z-order curve: the leading 21 bits of each coordinate, interleaved.
fn place_on_curve(share: DVec3) -> u64 {
    let steps = (share * f64::from(1 << 21)).to_array();
    let spread = |step: f64| {
        let mut x = (step as u64).min((1 << 21) - 1);
        for (shift, mask) in [
            (32, 0x001f_0000_0000_ffff),
            (16, 0x001f_0000_ff00_00ff),
            (8, 0x100f_00f0_0f00_f00f),
            (4, 0x10c3_0c30_c30c_30c3),
            (2, 0x1249_2492_4924_9249),
        ] {
            x = (x | (x << shift)) & mask;
        }
        x
    };
    spread(steps[0]) | (spread(steps[1]) << 1) | (spread(steps[2]) << 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tree_finds_every_group_that_is_not_missed() {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        let step = DVec3::new(0.754_877, 0.569_840, 0.322_185);
        for i in 0..3001_u32 {
            let at = (step * f64::from(i)).fract();
            positions.extend([at, at + DVec3::X * 0.01, at + DVec3::Y * 0.02]);
            triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let before = triangles.len();
        sort(&positions, &mut triangles);
        assert_eq!(triangles.len(), before, "a triangle was lost");
        let tree = Tree::over(&positions, &triangles);
        let misses = |b: &Bounds| b.max.z < 0.5 || b.min.z > 0.5;
        let met = tree.groups(misses);
        let all = tree.groups(|_| false);
        assert_eq!(all.len(), before.div_ceil(BRANCHES), "groups in all");
        let wanted = all.iter().filter(|i| !misses(&tree.levels[0][**i]));
        assert_eq!(met, wanted.copied().collect::<Vec<_>>(), "groups met");
        assert!(met.len() < all.len() / 2, "the curve does not gather");
    }

    #[test]
    fn the_curve_orders_octants_before_their_parts() {
        let at = |x: f64, y: f64, z: f64| place_on_curve(DVec3::new(x, y, z));
        assert!(at(0.4, 0.4, 0.4) < at(0.6, 0.0, 0.0), "x is the least bit");
        assert!(at(0.9, 0.9, 0.4) < at(0.0, 0.0, 0.6), "z is the greatest");
        assert_eq!(at(1.0, 1.0, 1.0), (1 << 63) - 1, "the far corner");
    }
}
