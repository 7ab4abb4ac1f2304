//! Points of caps that lie on no edge of the mesh: relief heights within a cap's rim, corners where three cuts meet inside a solid, and
//! corners of boxes.

use glam::{DVec2, DVec3};

use super::region::{Regions, RemovedSide};
use crate::scene::Bounds;

/// Number of points along each side of the grid on which a relief is sampled.
const RISEN_GRID: u32 = 96;

/// Points of the cap along a relief, within the hull of its rim.
pub(super) fn risen(regions: &Regions, side: usize, rim: &[DVec3], least: f64) -> Vec<DVec3> {
    let RemovedSide::Surface {
        surface, normal, ..
    } = &regions.sides[side]
    else {
        return Vec::new();
    };
    let Some(map) = &surface.relief else {
        return Vec::new();
    };
    let frame = surface.frame();
    let flat = |p: &DVec3| {
        let d = *p - surface.origin;
        DVec2::new(d.dot(frame.u_hat), d.dot(frame.v_hat))
    };
    let ring = ring(rim.iter().map(flat).collect());
    // If the relief misses the part, the rim has no points.
    if ring.len() < 3 {
        return Vec::new();
    }
    let (least_corner, most_corner) = ring.iter().fold(
        (DVec2::INFINITY, DVec2::NEG_INFINITY),
        |(least, most), p| (least.min(*p), most.max(*p)),
    );
    let mut points = Vec::new();
    for (i, j) in (0..RISEN_GRID).flat_map(|j| (0..RISEN_GRID).map(move |i| (i, j))) {
        let share = (DVec2::new(f64::from(i), f64::from(j)) + 0.5) / f64::from(RISEN_GRID);
        let at = least_corner + (most_corner - least_corner) * share;
        if !holds(&ring, at) {
            continue;
        }
        let foot = surface.origin + frame.u_hat * at.x + frame.v_hat * at.y;
        let height = map.sample(surface.wrap, surface.map_from_world(foot)).0;
        let point = foot - *normal * (height * surface.scale.z);
        let is_over = |other: usize| other == side || regions.sides[other].height(point) > -least;
        if regions.keep(is_over) {
            points.push(point);
        }
    }
    points
}

/// Corners of the boxes outside which nothing is kept; each box is first clipped to the box around `placed`.
pub(super) fn corners_of_boxes(regions: &Regions, placed: &[DVec3], least: f64) -> Vec<DVec3> {
    let around = Bounds::from_points(placed.iter().copied());
    let mut corners = Vec::new();
    for (side, own) in regions.sides.iter().enumerate() {
        let RemovedSide::Outside(own) = own else {
            continue;
        };
        let common = Bounds {
            min: own.min.max(around.min),
            max: own.max.min(around.max),
        };
        let is_over = |point: DVec3| {
            move |other: usize| other == side || regions.sides[other].height(point) > -least
        };
        let is_kept = |corner: &DVec3| !common.is_empty() && regions.keep(is_over(*corner));
        corners.extend(common.corners().into_iter().filter(is_kept));
    }
    corners
}

/// Points where planes of three cuts meet inside the solid that the triangles bound.
pub(super) fn inner_corners(
    regions: &Regions,
    placed: &[DVec3],
    triangles: &[[u32; 3]],
    least: f64,
) -> Vec<DVec3> {
    let planes: Vec<(usize, usize, DVec3, DVec3)> = (0..regions.sides.len())
        .filter_map(|side| {
            let (origin, normal) = regions.sides[side].plane()?;
            Some((side, regions.cut_of(side)?, origin, normal))
        })
        .collect();
    let mut corners = Vec::new();
    for (k, c) in planes.iter().enumerate() {
        for (j, b) in planes[..k].iter().enumerate() {
            for a in &planes[..j] {
                if a.1 == b.1 || b.1 == c.1 || a.1 == c.1 {
                    continue;
                }
                let volume = a.3.dot(b.3.cross(c.3));
                if volume.abs() < 1e-9 {
                    continue;
                }
                let point = (b.3.cross(c.3) * a.2.dot(a.3)
                    + c.3.cross(a.3) * b.2.dot(b.3)
                    + a.3.cross(b.3) * c.2.dot(c.3))
                    / volume;
                let is_over = |side: usize| {
                    [a.0, b.0, c.0].contains(&side) || regions.sides[side].height(point) > -least
                };
                if regions.keep(is_over) && is_inside(point, placed, triangles) {
                    corners.push(point);
                }
            }
        }
    }
    corners
}

/// Returns true if a ray from a point crosses triangles an odd number of times. The ray is not parallel to any axis, so it hits no edge of
/// axis-aligned geometry.
fn is_inside(point: DVec3, placed: &[DVec3], triangles: &[[u32; 3]]) -> bool {
    let ray = DVec3::new(0.913_545, 0.287_361, 0.287_918);
    let crossed = triangles.iter().filter(|triangle| {
        let [a, b, c] = triangle.map(|i| placed[i as usize] - point);
        let sides = [a.cross(b), b.cross(c), c.cross(a)].map(|n| n.dot(ray));
        let is_met = sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0);
        // Only triangles in front of the point count.
        let normal = (b - a).cross(c - a);
        is_met && (a.dot(normal) > 0.0) == (ray.dot(normal) > 0.0)
    });
    crossed.count() % 2 == 1
}

/// The convex hull of points in a plane, counter-clockwise (Andrew 1979).
fn ring(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut half: Vec<DVec2> = Vec::new();
        for p in points {
            while let [.., a, b] = half[..]
                && (b - a).perp_dot(*p - b) <= 0.0
            {
                half.pop();
            }
            half.push(*p);
        }
        half.pop();
        half
    };
    let mut all = half(&mut points.iter());
    all.extend(half(&mut points.iter().rev()));
    all
}

/// Returns true if a point lies within a convex polygon.
fn holds(ring: &[DVec2], point: DVec2) -> bool {
    let edges = ring.iter().zip(ring.iter().cycle().skip(1));
    edges
        .into_iter()
        .all(|(a, b)| (*b - *a).perp_dot(point - *a) >= 0.0)
}
