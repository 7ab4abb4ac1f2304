//! The theoretical error of the depth sprite: a point is tested up to half a texel's diagonal away from its position, so a
//! cap pixel can be wrong only if its point is that near to a mesh.

use cutaway::layers::Kind;
use cutaway::scene::Prepared;
use glam::{DVec2, DVec3};

use super::{Judged, Question, tolerances};

/// Half of a texel's diagonal in scene space, for the largest part. The texel size includes the margin of two texels that the sprite
/// leaves on either side.
pub(super) fn reach(prepared: &Prepared, resolution: u32) -> f64 {
    let extent = prepared
        .parts
        .iter()
        .map(|p| p.bounds.size().max_element())
        .fold(0.0, f64::max);
    let texels = f64::from(resolution);
    extent / (texels - 4.0) * std::f64::consts::SQRT_2 * 0.5
}

/// Describes the first decided wrong pixel that is farther from any mesh than [`reach`] allows.
pub(super) fn fault(question: &Question, judged: &Judged, resolution: u32) -> Option<String> {
    let allowed = reach(&question.model.prepared, resolution) + tolerances::ROUNDING_OF_POINTS;
    judged.decided_wrong().find_map(|pixel| {
        let width = question.view.size_px[0] as usize;
        let at = DVec2::new((pixel % width) as f64 + 0.5, (pixel / width) as f64 + 0.5);
        let (origin, direction) = question.view.ray(at);
        let nearest = [&judged.exact.layers, &judged.layers]
            .map(|l| l.pixels[pixel])
            .into_iter()
            .filter(|l| l.kind == Kind::Cap)
            .map(|l| distance(&question.model.prepared, origin + direction * l.depth))
            .fold(f64::INFINITY, f64::min);
        (nearest > allowed).then(|| {
            format!(
                "{nearest:.5} from any mesh, at most {allowed:.5}: {}",
                judged.describe(pixel)
            )
        })
    })
}

/// Distance from a point to the nearest triangle of any part.
fn distance(prepared: &Prepared, point: DVec3) -> f64 {
    let squared = |p: &cutaway::scene::PreparedPart| {
        p.triangles
            .iter()
            .map(|t| to_triangle(point, t.map(|i| p.positions[i as usize].as_dvec3())))
            .fold(f64::INFINITY, f64::min)
    };
    prepared
        .parts
        .iter()
        .map(squared)
        .fold(f64::INFINITY, f64::min)
}

/// Distance to a triangle: to its plane if the point projects into the triangle, else to the nearest edge.
fn to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    let edges = [(a, b), (b, c), (c, a)];
    let inside = edges
        .iter()
        .all(|(from, to)| (*to - *from).cross(p - *from).dot(normal) >= 0.0);
    if inside && normal != DVec3::ZERO {
        return (p - a).dot(normal.normalize()).abs();
    }
    edges
        .iter()
        .map(|(from, to)| {
            let along = *to - *from;
            let share =
                ((p - *from).dot(along) / along.length_squared().max(1e-300)).clamp(0.0, 1.0);
            (*from + along * share).distance(p)
        })
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_a_triangle() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        for (point, expected) in [
            (DVec3::new(0.2, 0.2, -3.0), 3.0),
            (DVec3::new(0.5, -2.0, 0.0), 2.0),
            (DVec3::new(1.0, 1.0, 0.0), 0.5_f64.sqrt()),
            (DVec3::new(4.0, 0.0, 4.0), 5.0),
        ] {
            let found = to_triangle(point, triangle);
            assert!((found - expected).abs() < 1e-12, "{point} is {found} away");
        }
    }
}
