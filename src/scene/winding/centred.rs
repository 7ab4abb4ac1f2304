//! A tree of a mesh's triangles about the centre of their box, where `f32` is precise wherever the mesh is.

use glam::DVec3;

use super::WindingTree;
use crate::scene::Bounds;

/// Largest error of the approximation of a ball of faces, as a share of a whole turn.
const TOLERANCE: f64 = 1e-5;

/// Winding numbers of triangles around points that are given relative to the centre of their box.
#[derive(Debug)]
pub(crate) struct CentredTree {
    /// Box of the triangles.
    pub(crate) bounds: Bounds,
    tree: WindingTree,
}

impl CentredTree {
    /// Builds the tree of triangles given by vertex indices.
    pub(crate) fn of(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let in_use = triangles.iter().flatten();
        let bounds = Bounds::from_points(in_use.map(|i| positions[*i as usize]));
        let centre = bounds.centre();
        let near = positions.iter().map(|p| (*p - centre).as_vec3());
        let tree = WindingTree::of(&near.collect::<Vec<_>>(), triangles);
        Self { bounds, tree }
    }

    /// The winding number around a point.
    pub(crate) fn winding(&self, from_centre: DVec3) -> f64 {
        self.tree.winding(from_centre, TOLERANCE).0
    }
}
