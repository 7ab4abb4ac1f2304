//! Normals of what is seen. They face the camera's side and decide nothing.

use glam::{DVec3, Vec3};

use super::clip::Root;
use super::raster::{Crossing, Projected};

/// Normal of a cap: down the kept height, out of the kept solid.
pub(super) fn cap_normal(root: &Root) -> Vec3 {
    (-root.gradient).normalize_or_zero().as_vec3()
}

/// Normal of a mesh: the shading normals of the triangle's corners, interpolated; turned round on a back face.
pub(super) fn surface_normal(part: &Projected<'_>, crossing: &Crossing, point: DVec3) -> Vec3 {
    let facet = part.facet(crossing.triangle);
    let shares = barycentric(facet.points, facet.normal, point);
    let Some(shading) = part.shading else {
        return facet.normal.normalize_or_zero().as_vec3();
    };
    let [a, b, c] = shading.triangles[crossing.triangle as usize]
        .map(|vertex| shading.normals[vertex as usize].as_dvec3());
    let normal = (a * shares[0] + b * shares[1] + c * shares[2]).normalize_or(facet.normal);
    let turned = if crossing.back_face { -normal } else { normal };
    turned.as_vec3()
}

/// Shares of the corners at a point of the triangle's plane.
fn barycentric([a, b, c]: [DVec3; 3], normal: DVec3, point: DVec3) -> [f64; 3] {
    let area = normal.length_squared();
    if area == 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let opposite = |p: DVec3, q: DVec3| (q - p).cross(point - p).dot(normal) / area;
    [opposite(b, c), opposite(c, a), opposite(a, b)]
}
