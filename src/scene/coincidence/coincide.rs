//! Faces of parts that coincide with faces of a cutter, even if they are triangulated differently.
//!
//! As with planes, depth cannot decide on which side of the cutter such a face lies, so a solid is an open set, without its boundary: where
//! a ray enters the solid through the face, the face is behind the crossing with the cutter; where it leaves, in front of it.
//!
//! Cost: each of the part's triangles in the cutter's box is tested against the cutter's triangles whose planes are equally far from the
//! origin. These are few, except for a finely tessellated ball around the origin.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use robust::{Coord3D, orient3d};

use crate::scene::{Bounds, PreparedVolume};

/// Two planes are compared if their distances from the origin differ by at most this, in scene units; rounding errors are smaller.
const NEAR: f64 = 1e-5;

/// Returns true if three points lie exactly in the plane of a triangle.
pub fn lies_in(points: [DVec3; 3], face: [DVec3; 3]) -> bool {
    let of = |p: DVec3| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    };
    let [a, b, c] = face.map(of);
    points.iter().all(|p| orient3d(a, b, c, of(*p)) == 0.0)
}

impl PreparedVolume {
    /// The triangles of a part that reach into the cutter's box and are coplanar with one of its triangles, in order.
    pub(crate) fn shared_faces(&self, positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<u32> {
        let corners = |of: &[Vec3], t: &[u32; 3]| t.map(|i| of[i as usize].as_dvec3());
        let mut faces: Vec<(f64, [DVec3; 3])> = (self.triangles().iter())
            .map(|t| corners(&self.positions, t))
            .flat_map(|face| {
                let distance = distance_of(face);
                // Both orientations of the plane's normal.
                [(distance, face), (-distance, face)]
            })
            .filter(|(distance, _)| distance.is_finite())
            .collect();
        faces.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_shared = |t: &[u32; 3]| {
            let points = corners(positions, t);
            if !meet(&Bounds::from_points(points), &self.bounds) {
                return false;
            }
            let distance = distance_of(points);
            let first = faces.partition_point(|f| f.0 < distance - NEAR);
            let near = faces[first..].iter().take_while(|f| f.0 <= distance + NEAR);
            near.into_iter().any(|(_, face)| lies_in(points, *face))
        };
        (triangles.par_iter().enumerate().with_min_len(1 << 10))
            .filter(|(_, t)| is_shared(t))
            .map(|(index, _)| index as u32)
            .collect()
    }
}

/// Distance of a triangle's plane from the origin, along its normal; NaN if the triangle has no area.
fn distance_of([a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    a.dot(normal) / normal.length()
}

fn meet(a: &Bounds, b: &Bounds) -> bool {
    a.min.cmple(b.max).all() && b.min.cmple(a.max).all()
}
