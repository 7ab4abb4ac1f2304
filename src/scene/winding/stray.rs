//! How far the winding numbers of an open mesh are from whole numbers: those of a closed mesh are whole, and an open mesh is read the more
//! surely the nearer they are.
//!
//! The numbers are sampled at the centres of a grid of cells in the mesh's box, from a tree over all faces ([`CentredTree`]). Cost: building
//! the tree, then some hundred nodes per point. Cannot: find a small doubtful place between two points.

use glam::DVec3;
use rayon::prelude::*;

use super::CentredTree;
use crate::scene::Mesh;

/// Cells along an axis of the box.
const CELLS: usize = 12;

/// Distances of the winding numbers of a mesh from the nearest whole number.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stray {
    /// Number of points.
    pub points: usize,
    /// Mean distance.
    pub mean: f64,
    /// Greatest distance, at most a half.
    pub largest: f64,
}

impl Stray {
    /// Samples a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let tree = CentredTree::of(&mesh.positions, &mesh.triangles);
        let (bounds, centre) = (tree.bounds, tree.bounds.centre());
        let step = bounds.size() / CELLS as f64;
        let at = |i: usize| {
            let cell = [i % CELLS, i / CELLS % CELLS, i / CELLS / CELLS].map(|c| c as f64 + 0.5);
            bounds.min - centre + DVec3::from(cell) * step
        };
        let points = CELLS.pow(3);
        let distances: Vec<f64> = (0..points)
            .into_par_iter()
            .map(|i| {
                let number = tree.winding(at(i));
                (number - number.round()).abs()
            })
            .collect();
        Self {
            points,
            mean: distances.iter().sum::<f64>() / points as f64,
            largest: distances.iter().copied().fold(0.0, f64::max),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;

    #[test]
    fn numbers_stray_with_the_size_of_the_hole() {
        let sphere = shape("sphere?subdivisions=4").unwrap().remove(0).mesh;
        // Some hundred balls, each with an error of at most 1e-5.
        assert!(Stray::of(&sphere).largest < 0.01);
        let with_hole = |height: f64| {
            let mut mesh = Mesh::clone(&sphere);
            let top = mesh.positions.iter().map(|p| p.z).fold(0.0, f64::max);
            let is_kept = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|i| mesh.positions[i as usize].z);
                a.max(b).max(c) < height * top
            };
            mesh.triangles = mesh
                .triangles
                .iter()
                .filter(|t| is_kept(t))
                .copied()
                .collect();
            Stray::of(&mesh)
        };
        let [small, large] = [0.98, 0.0].map(with_hole);
        assert!(small.mean < 0.01, "{small:?}");
        // In the opening of half a sphere, half of all directions are open.
        assert!(large.mean > 0.1 && large.largest > 0.45, "{large:?}");
        assert!(large.largest <= 0.5, "{large:?}");
    }
}
