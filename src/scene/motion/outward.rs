//! Outward directions of positions: what inflating goes along.
//!
//! The direction at a position is the mean of the normals of the triangles around it, each weighted by its angle there, so
//! that it does not depend on how flat faces are cut into triangles (Thürmer and Wüthrich 1998). It is of the rest mesh.
//! Cost: once per mesh, in proportion to its triangles; 24 bytes a position. A mesh whose triangles are turned inside out
//! gets inward directions; a position that only flat triangles use, or none, gets zero.

use glam::DVec3;

use crate::scene::Mesh;

impl Mesh {
    /// The unit vectors out of the mesh at its positions; zero where there is none.
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
