//! Shading normals of visible points. They face the camera; nothing else in the answer depends on them.

use glam::{DVec3, Vec3};

use super::clip::{CutterTriangle, Root};
use super::raster::{Crossing, Projected};

/// Normal of a cap: it points out of the kept solid, in the direction in which the kept height decreases.
pub(super) fn cap_normal(root: &Root) -> Vec3 {
    (-root.gradient).normalize_or_zero().as_vec3()
}

/// Normal of a cap on a cutter: the normal of the cutter's mesh, facing the side from which a ray leaves the removed region.
pub(super) fn cutter_normal(
    mesh: &Projected<'_>,
    root: &Root,
    face: CutterTriangle,
    point: DVec3,
) -> Vec3 {
    let outward = mesh.facet(face.triangle).normal;
    let normal = normal_at(mesh, face.triangle, point);
    let is_turned = outward.dot(root.gradient) > 0.0;
    (if is_turned { -normal } else { normal }).as_vec3()
}

/// Normal of a mesh; reversed on a back face.
pub(super) fn surface_normal(part: &Projected<'_>, crossing: &Crossing, point: DVec3) -> Vec3 {
    let normal = normal_at(part, crossing.triangle, point);
    (if crossing.back_face { -normal } else { normal }).as_vec3()
}

/// Normal at a point, interpolated from the shading normals of the corners; the triangle's own normal if there are none.
fn normal_at(mesh: &Projected<'_>, triangle: u32, point: DVec3) -> DVec3 {
    let facet = mesh.facet(triangle);
    let own = facet.normal.normalize_or_zero();
    let Some(shading) = mesh.shading else {
        return own;
    };
    let corners = mesh.triangles[triangle as usize].map(|p| mesh.positions[p as usize].as_dvec3());
    let shares = barycentric(corners, facet.normal, point);
    let [a, b, c] = shading.triangles[triangle as usize]
        .map(|vertex| shading.normals[vertex as usize].as_dvec3());
    (a * shares[0] + b * shares[1] + c * shares[2]).normalize_or(own)
}

/// Barycentric coordinates of a point in the triangle's plane.
fn barycentric([a, b, c]: [DVec3; 3], normal: DVec3, point: DVec3) -> [f64; 3] {
    let area = normal.length_squared();
    if area == 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let opposite = |p: DVec3, q: DVec3| (q - p).cross(point - p).dot(normal) / area;
    [opposite(b, c), opposite(c, a), opposite(a, b)]
}
