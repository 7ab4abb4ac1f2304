//! The outward direction of each position, along which inflating moves the position.
//!
//! The direction at a position is the mean of the adjacent triangles' normals, weighted by their angles there, so that it
//! does not depend on how flat faces are triangulated (Thürmer and Wüthrich 1998). It is computed from the rest mesh.
//! Cost: once per mesh, proportional to its triangles; 24 bytes per position. A mesh that is inside out gets inward
//! directions; a position that only degenerate triangles use, or none, gets zero.

use glam::DVec3;

use crate::scene::Mesh;

impl Mesh {
    /// Unit vectors that point out of the mesh, per position; zero where there is none.
    pub fn outward(&self) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        for (index, triangle) in self.triangles.iter().enumerate() {
            let corners = self.corners(index);
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a).normalize_or_zero();
            for i in 0..3 {
                let at = corners[i];
                let [to, from] = [corners[(i + 1) % 3] - at, corners[(i + 2) % 3] - at];
                let angle = to.cross(from).length().atan2(to.dot(from));
                sums[triangle[i] as usize] += normal * angle;
            }
        }
        sums.into_iter().map(DVec3::normalize_or_zero).collect()
    }
}
