//! Writes binary STL. Each triangle takes fifty bytes and has its normal and corners in f32.
//!
//! Normals are computed from the rounded corners. A triangle without area has the normal 0.

use glam::Vec3;

use super::solid::{Solid, Unwritable, rounded};

const HEADER: &[u8] = b"binary STL written by cutaway";

pub(super) fn encoded(solids: &[Solid<'_>]) -> Result<Vec<u8>, Unwritable> {
    let count: usize = solids.iter().map(|s| s.mesh.triangles.len()).sum();
    let mut bytes = Vec::with_capacity(84 + 50 * count);
    bytes.extend_from_slice(HEADER);
    bytes.resize(84, 0);
    for solid in solids {
        let positions: Vec<Vec3> = solid.mesh.positions.iter().map(|p| p.as_vec3()).collect();
        let corners = |t: &[u32; 3]| rounded(&positions, t);
        for [a, b, c] in solid.mesh.triangles.iter().filter_map(corners) {
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
    let written = match (bytes.len() - 84) / 50 {
        0 => return Err(Unwritable::Collapsed),
        written => u32::try_from(written).map_err(|_| Unwritable::TooLarge)?,
    };
    bytes[80..84].copy_from_slice(&written.to_le_bytes());
    Ok(bytes)
}
