//! Crossings along axis-parallel rays, exactly consistent between neighbours.
//!
//! Vertices are snapped to integers. Tie rule, with u and v perpendicular to the ray: a ray at a vertex's v passes on the side
//! of larger v; a ray that still meets an edge passes on the side of smaller u. Both depend on the edge alone, so no ray slips
//! through between triangles or is counted twice.

use glam::DVec3;
use rayon::prelude::*;

use crate::scene::{Bounds, Mesh};

/// Number of rays along each side of the bounds, per axis.
const GRID: usize = 256;
/// Integer steps between adjacent rays: with [`GRID`] they keep products of two extents below 2^48.
const STEPS: i64 = 1 << 15;
/// Sums over rays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rays {
    pub(super) largest: u32,
    pub(super) crossings: u64,
    pub(super) hit: u64,
    pub(super) odd: u64,
}

impl Rays {
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            largest: self.largest.max(other.largest),
            crossings: self.crossings + other.crossings,
            hit: self.hit + other.hit,
            odd: self.odd + other.odd,
        }
    }

    pub(super) fn through(mesh: &Mesh, bounds: Bounds) -> Self {
        let size = bounds.size();
        let steps_per_unit = DVec3::from(size.to_array().map(|s| {
            if s > 0.0 {
                (GRID as i64 * STEPS) as f64 / s
            } else {
                0.0
            }
        }));
        let snapped: Vec<[i32; 3]> = mesh
            .positions
            .par_iter()
            .map(|p| {
                let steps = ((*p - bounds.min) * steps_per_unit).round();
                steps.to_array().map(|c| c as i32)
            })
            .collect();
        let empty = || vec![0_i32; (GRID + 1) * GRID];
        let along = |axis: usize| {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let grid = mesh
                .triangles
                .par_chunks(1 << 15)
                .fold(empty, |mut grid, some| {
                    for t in some {
                        let corners = t.map(|i| {
                            let p = snapped[i as usize];
                            [i64::from(p[u]), i64::from(p[v])]
                        });
                        add_crossings(corners, &mut grid);
                    }
                    grid
                })
                .reduce(empty, |mut sum, other| {
                    sum.iter_mut().zip(&other).for_each(|(s, o)| *s += o);
                    sum
                });
            Self::counted(&grid)
        };
        (0..3).map(along).fold(Self::default(), Self::and)
    }

    fn counted(grid: &[i32]) -> Self {
        let mut sum = Self::default();
        for row in grid.chunks_exact(GRID + 1) {
            let mut depth = 0_i32;
            for step in &row[..GRID] {
                depth += step;
                sum.largest = sum.largest.max(depth.unsigned_abs());
                sum.crossings += u64::from(depth.unsigned_abs());
                sum.hit += u64::from(depth != 0);
                sum.odd += u64::from(depth % 2 != 0);
            }
        }
        sum
    }
}

/// Adds 1 for every ray that a triangle covers, as differences along the grid's rows. In each row, the column where an edge
/// is crossed depends on the edge alone, so triangles that share it leave neither gap nor overlap.
fn add_crossings(corners: [[i64; 2]; 3], grid: &mut [i32]) {
    // The first ray at or beyond a coordinate; rays go through the centres of their cells.
    let first_from = |c: i64| (c + STEPS / 2 - 1).div_euclid(STEPS).clamp(0, GRID as i64);
    let [low, high] = {
        let [a, b, c] = corners.map(|p| p[1]);
        [a.min(b).min(c), a.max(b).max(c)].map(first_from)
    };
    for row in low..high {
        let y = row * STEPS + STEPS / 2;
        let start = row as usize * (GRID + 1);
        let (mut first, mut last) = (GRID, 0);
        for (p, q) in [(0, 1), (1, 2), (2, 0)] {
            let (mut a, mut b) = (corners[p], corners[q]);
            if (a[1] <= y) == (b[1] <= y) {
                continue;
            }
            if a[1] > b[1] {
                (a, b) = (b, a);
            }
            let passed = a[0] + ((b[0] - a[0]) * (y - a[1])).div_euclid(b[1] - a[1]);
            let column = first_from(passed + 1) as usize;
            first = first.min(column);
            last = last.max(column);
        }
        // A row between the lowest and the highest corner crosses exactly two edges.
        grid[start + first] += 1;
        grid[start + last] -= 1;
    }
}
