//! The removed side of a relief as a closed mesh: a sheet of triangles over a block, with walls and a floor beneath it.
//!
//! A relief is bilinear between texel centres. The sheet's corners lie on texel centres and divide the distance between them into equal
//! steps; if texels are smaller than cells, corners lie on every nth centre. Between corners are two triangles, which differ from
//! the relief by up to a quarter of the cell's twist, or by the heights of texels that were skipped.
//!
//! Cost: one map lookup per corner and three per cell.
//!
//! Cannot: follow a relief whose texels are smaller than a cell. The error is measured at the middles of cells and edges.

use glam::{DVec2, DVec3};

use crate::scene::{Bounds, ClipSurface, Mesh};

/// A closed mesh below a relief.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub(super) mesh: Mesh,
    /// Largest measured distance to the relief along `N`, in world units.
    pub(super) off: f64,
}

/// Corners along one axis of the plane.
struct SheetAxis {
    first: f64,
    step: f64,
    cells: usize,
}

impl SheetAxis {
    /// Corners that cover a range, about `step` apart, on texel centres where possible.
    fn covering([low, high]: [f64; 2], texel: f64, step: f64) -> Self {
        let ratio = texel / step;
        let (step, phase) = match (ratio.is_finite() && ratio > 0.0, ratio >= 1.0) {
            (false, _) => (step, 0.0),
            (true, true) => (texel / ratio.ceil(), texel / 2.0),
            (true, false) => (texel * (1.0 / ratio).floor(), texel / 2.0),
        };
        let before = ((low - phase) / step).floor();
        let after = ((high - phase) / step).ceil();
        Self {
            first: phase + before * step,
            step,
            cells: ((after - before) as usize).max(1),
        }
    }

    fn at(&self, place: f64) -> f64 {
        self.first + place * self.step
    }
}

/// Solid below a relief, extending around a block and farther down than it. It has about `cells` cells along the longer side of the block,
/// as seen along `N`.
pub(super) fn below(surface: &ClipSurface, block: &Bounds, cells: u32) -> Sheet {
    let frame = surface.frame();
    let in_frame = |p: DVec3| {
        let d = p - surface.origin;
        DVec3::new(d.dot(frame.u_hat), d.dot(frame.v_hat), d.dot(frame.normal))
    };
    let seen = Bounds::from_points(block.corners().map(in_frame));
    let margin = seen.radius() / 8.0;
    let size = seen.size();
    let step = (size.x.max(size.y) + 2.0 * margin) / f64::from(cells);
    let texels = surface.relief.as_ref().map_or([1; 2], |map| map.size());
    let axis = |i: usize, stretch: f64, repeats: f64| {
        let texel = stretch / (repeats.abs() * f64::from(texels[i]));
        SheetAxis::covering([seen.min[i] - margin, seen.max[i] + margin], texel, step)
    };
    let along = [
        axis(0, surface.u.length(), surface.scale.x),
        axis(1, surface.v.length(), surface.scale.y),
    ];
    let height = |i: f64, j: f64| {
        let (s, t) = (along[0].at(i), along[1].at(j));
        let at = DVec2::new(
            s / surface.u.length() * surface.scale.x,
            t / surface.v.length() * surface.scale.y,
        );
        let map = surface.relief.as_ref();
        -map.map_or(0.0, |map| map.sample(surface.wrap, at).0) * surface.scale.z
    };
    let [columns, rows] = [along[0].cells + 1, along[1].cells + 1];
    let corner = |i: usize, j: usize| j * columns + i;
    let heights: Vec<f64> = (0..rows)
        .flat_map(|j| (0..columns).map(move |i| (i, j)))
        .map(|(i, j)| height(i as f64, j as f64))
        .collect();

    let mut off = 0.0_f64;
    for j in 0..along[1].cells {
        for i in 0..along[0].cells {
            let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                .map(|(i, j)| heights[corner(i, j)]);
            let (i, j) = (i as f64, j as f64);
            for (there, expected) in [
                ((a + c) / 2.0, height(i + 0.5, j + 0.5)),
                ((a + b) / 2.0, height(i + 0.5, j)),
                ((a + d) / 2.0, height(i, j + 0.5)),
            ] {
                off = off.max((there - expected).abs());
            }
        }
    }

    let world = |s: f64, t: f64, h: f64| {
        surface.origin + frame.u_hat * s + frame.v_hat * t + frame.normal * h
    };
    let floor = heights.iter().copied().fold(seen.min.z, f64::min) - margin;
    let place = |n: usize| {
        let (i, j) = (n % columns, n / columns);
        [along[0].at(i as f64), along[1].at(j as f64)]
    };
    let mut positions: Vec<DVec3> = (0..columns * rows)
        .map(|n| {
            let [s, t] = place(n);
            world(s, t, heights[n])
        })
        .collect();
    let mut triangles = Vec::with_capacity(2 * along[0].cells * along[1].cells);
    for j in 0..along[1].cells {
        for i in 0..along[0].cells {
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| corner(i, j) as u32);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    // Counter-clockwise, seen from above.
    let rim: Vec<usize> = ((0..columns).map(|i| corner(i, 0)))
        .chain((1..rows).map(|j| corner(columns - 1, j)))
        .chain((0..columns - 1).rev().map(|i| corner(i, rows - 1)))
        .chain((1..rows - 1).rev().map(|j| corner(0, j)))
        .collect();
    let first = positions.len() as u32;
    for n in &rim {
        let [s, t] = place(*n);
        positions.push(world(s, t, floor));
    }
    let middle = positions.len() as u32;
    let [s, t] = [0, 1].map(|k| along[k].at(along[k].cells as f64 / 2.0));
    positions.push(world(s, t, floor));
    for (k, n) in rim.iter().enumerate() {
        let next = (k + 1) % rim.len();
        let [a, b] = [*n as u32, rim[next] as u32];
        let [below_a, below_b] = [first + k as u32, first + next as u32];
        triangles.extend([
            [a, below_a, below_b],
            [a, below_b, b],
            [middle, below_b, below_a],
        ]);
    }
    Sheet {
        mesh: Mesh {
            positions,
            triangles,
            ..Mesh::default()
        },
        off,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::scene::OffsetMap;

    fn waved(size: [u32; 2]) -> ClipSurface {
        let heights = (0..size[0] * size[1]).map(|i| ((i * 37 + 11) % 101) as f32 / 101.0);
        let mut surface = ClipSurface::plane(DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, 2.0, -0.5));
        surface.scale = DVec3::new(1.7, -0.9, 0.2);
        surface.relief = Some(Arc::new(
            OffsetMap::new(size, heights.collect()).expect("finite heights"),
        ));
        surface
    }

    #[test]
    fn a_sheet_is_closed_and_lies_on_its_relief() {
        let block = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        let surface = waved([5, 7]);
        let mut last = f64::INFINITY;
        for cells in [32, 64, 128] {
            let sheet = below(&surface, &block, cells);
            assert!(sheet.mesh.open_edges().is_empty(), "{cells} cells");
            assert!(sheet.mesh.volume() > 0.0, "outside is out");
            assert!(
                sheet.off < last / 2.0,
                "{cells} cells: {} of {last}",
                sheet.off
            );
            last = sheet.off;
            // Corners are on the relief, wherever the frame is.
            let on_it = |p: &&DVec3| surface.kept_height(**p).abs() < 1e-12;
            let count = sheet.mesh.positions.iter().filter(on_it).count();
            assert!(
                count * 2 > sheet.mesh.positions.len(),
                "{count} on the relief"
            );
            let around = Bounds::from_points(sheet.mesh.positions.iter().copied());
            assert!(
                block
                    .corners()
                    .iter()
                    .all(|c| around.union(Bounds::from_points([*c])) == around)
            );
        }
    }

    #[test]
    fn what_lies_between_cells_is_told() {
        let block = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        let fine = below(&waved([512, 512]), &block, 64);
        assert!(fine.off > 0.05, "{}", fine.off);
    }
}
