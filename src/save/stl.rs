//! Binary STL: fifty bytes a triangle, its normal and its corners in f32.
//!
//! A normal is computed from the rounded corners, and is 0 where they have no area.

use glam::Vec3;

use super::Solid;

const HEADER: &[u8] = b"binary STL written by cutaway";

pub(super) fn encoded(solids: &[Solid<'_>]) -> Vec<u8> {
    let count: usize = solids.iter().map(|s| s.mesh.triangles.len()).sum();
    let mut bytes = Vec::with_capacity(84 + 50 * count);
    bytes.extend_from_slice(HEADER);
    bytes.resize(84, 0);
    for solid in solids {
        let rounded: Vec<Vec3> = solid.mesh.positions.iter().map(|p| p.as_vec3()).collect();
        for triangle in &solid.mesh.triangles {
            let [a, b, c] = triangle.map(|i| rounded[i as usize]);
            if a == b || b == c || c == a {
                continue;
            }
            let edges = [b - a, c - a].map(Vec3::as_dvec3);
            let normal = edges[0].cross(edges[1]).normalize_or_zero().as_vec3();
            for corner in [normal, a, b, c] {
                for coordinate in corner.to_array() {
                    bytes.extend_from_slice(&coordinate.to_le_bytes());
                }
            }
            bytes.extend_from_slice(&[0, 0]);
        }
    }
    let written = (bytes.len() - 84) / 50;
    bytes[80..84].copy_from_slice(&(written as u32).to_le_bytes());
    bytes
}
