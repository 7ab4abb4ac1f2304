//! Planar holes: the plane of each, groups of coplanar holes, and their triangles.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::super::cover::cover;
use super::{HoleDefect, PLANAR, box_of, points_of};
use crate::scene::Mesh;

/// Coplanar holes are filled together: normals differ by at most this, and offsets by at most this share of the mesh's diagonal.
const SAME_PLANE: f64 = 1e-3;

/// The plane of a hole.
pub(super) struct Plane {
    origin: DVec3,
    /// Normal of the triangles that close the hole.
    normal: DVec3,
}

impl Plane {
    /// The plane of a hole, if it is planar.
    pub(super) fn of(mesh: &Mesh, rim: &[u32]) -> Option<Self> {
        let points = points_of(mesh, rim);
        let bounds = box_of(&points);
        let origin = bounds.centre();
        // Twice the area of the hole as seen along each axis.
        let next = points.iter().cycle().skip(1);
        let area: DVec3 = (points.iter().zip(next))
            .map(|(a, b)| (*a - origin).cross(*b - origin))
            .sum();
        let normal = area.try_normalize()?;
        let middle = points
            .iter()
            .map(|p| (*p - origin).dot(normal))
            .sum::<f64>()
            / points.len() as f64;
        let tolerance = PLANAR * bounds.size().length();
        let is_near = |p: &DVec3| ((*p - origin).dot(normal) - middle).abs() <= tolerance;
        points.iter().all(is_near).then_some(Self {
            origin: origin + normal * middle,
            normal,
        })
    }

    /// The triangles within rims that lie in this plane.
    pub(super) fn triangles(
        &self,
        mesh: &Mesh,
        rims: &[&[u32]],
    ) -> Result<Vec<[u32; 3]>, HoleDefect> {
        if let [[a, b, c]] = rims {
            return Ok(vec![[*a, *b, *c]]);
        }
        let across = self.normal.any_orthonormal_vector();
        let along = self.normal.cross(across);
        let mut vertices: Vec<u32> = rims.iter().copied().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let points: Vec<DVec2> = (vertices.iter())
            .map(|i| mesh.positions[*i as usize] - self.origin)
            .map(|p| DVec2::new(p.dot(across), p.dot(along)))
            .collect();
        let number = |i: &u32| vertices.partition_point(|v| v < i) as u32;
        let loops: Vec<Vec<u32>> = rims
            .iter()
            .map(|rim| rim.iter().map(number).collect())
            .collect();
        let cover = cover(&points, &loops);
        let is_plain = cover.added.is_empty()
            && cover.paths.is_empty()
            && cover.left_out.is_empty()
            && (0..)
                .zip(&cover.stand_ins)
                .all(|(i, stand_in)| i == *stand_in);
        if !is_plain {
            return Err(HoleDefect::Crossing);
        }
        let of_mesh = |t: [u32; 3]| t.map(|i| vertices[i as usize]);
        (cover.triangles.into_iter())
            .map(|(t, winding)| match (of_mesh(t), winding) {
                (t, 1) => Ok(t),
                ([a, b, c], -1) => Ok([a, c, b]),
                _ => Err(HoleDefect::Crossing),
            })
            .collect()
    }
}

/// The indices of planar holes, grouped by plane.
pub(super) fn groups(planes: &[Option<Plane>], diagonal: f64) -> Vec<Vec<usize>> {
    let mut groups: BTreeMap<[i64; 4], Vec<usize>> = BTreeMap::new();
    for (number, plane) in planes.iter().enumerate() {
        let Some(Plane { origin, normal }) = plane else {
            continue;
        };
        let cell = |x: f64| (x / SAME_PLANE).round() as i64;
        let step = cell(origin.dot(*normal) / diagonal);
        let [x, y, z] = normal.to_array().map(cell);
        // A plane is the same seen from either side.
        let key = [x, y, z, step].max([-x, -y, -z, -step]);
        groups.entry(key).or_default().push(number);
    }
    groups.into_values().collect()
}
