//! Places the eye so that some points are centred in its picture, as large as its borders allow.
//!
//! Points are given along the axes of the picture: to the right, up, and into it. In perspective each border is a plane through the
//! eye. A point is on the inner side of the right one, at eye `(x, y, z)` and with half a width of `t` at depth 1, if
//! `p.x - t p.z <= x - t z`; so the greatest `p.x - t p.z` is all that matters of the points. Left and right together determine
//! the eye's distance, as do the lower and the upper border; of the two the farther eye sees all. That is exact, and in
//! one pass over the points. On the axis that has room to spare the eye is put where the margins are equal in the picture.

use glam::{DVec2, DVec3};

/// Share of the picture's shorter side that is left on each side.
const MARGIN: f64 = 0.06;

/// The eye keeps so far from the points, as a share of their extent: a wide view of a tip would begin in it.
const NEAREST: f64 = 0.05;

/// Steps of a bisection, after which a span is as short as f64 tells.
const CENTRING_HALVINGS: u32 = 50;

/// Shares of half the width and of half the height that are filled.
fn filled(size_px: [u32; 2]) -> DVec2 {
    let size = DVec2::from_array(size_px.map(f64::from));
    1.0 - 2.0 * MARGIN * size.min_element() / size
}

/// Centre of the points in the picture and half the picture's height, of a parallel view.
pub(in crate::scene) fn fit_parallel(points: &[DVec3], size_px: [u32; 2]) -> (DVec2, f64) {
    let [least, most] = extent(points);
    let half = (most - least).truncate() / 2.0 / filled(size_px);
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let half_height = (half.x / aspect).max(half.y).max(1e-9);
    ((least + most).truncate() / 2.0, half_height)
}

/// The eye, in perspective with so much of half a height at depth 1.
pub(in crate::scene) fn fit_perspective(
    points: &[DVec3],
    half_height: f64,
    size_px: [u32; 2],
) -> DVec3 {
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let borders = DVec2::new(half_height * aspect, half_height) * filled(size_px);
    let [least, most] = extent(points);
    let nearest = least.z - NEAREST * (most - least).length().max(1e-6);
    let farthest_back = |axis: usize| {
        let [low, high] = sides(points, axis, borders[axis]);
        -(low + high) / (2.0 * borders[axis])
    };
    let z = nearest.min(farthest_back(0)).min(farthest_back(1));
    let middle = |axis: usize| {
        // Where the margins are equal lies between where what sticks out farthest on either side would touch the axis.
        let (mut low, mut high) = (least[axis], most[axis]);
        for _ in 0..CENTRING_HALVINGS {
            let at = (low + high) / 2.0;
            match lean(points, axis, at, z) > 0.0 {
                true => low = at,
                false => high = at,
            }
        }
        (low + high) / 2.0
    };
    DVec3::new(middle(0), middle(1), z)
}

/// Excess of the points' reach on the greater side of the picture over that on the lesser, from an eye.
fn lean(points: &[DVec3], axis: usize, at: f64, z: f64) -> f64 {
    let slopes = points.iter().map(|p| (p[axis] - at) / (p.z - z));
    let [least, most] = slopes.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], s| {
        [least.min(s), most.max(s)]
    });
    least + most
}

/// The greatest offsets of points from the two borders along an axis.
fn sides(points: &[DVec3], axis: usize, border: f64) -> [f64; 2] {
    let none = [f64::NEG_INFINITY; 2];
    points.iter().fold(none, |[low, high], p| {
        let depth = border * p.z;
        [low.max(-p[axis] - depth), high.max(p[axis] - depth)]
    })
}

/// Distance of an eye that looks at the origin of the points, in perspective: nothing is centred.
pub fn distance_around(points: &[DVec3], half_height: f64, size_px: [u32; 2]) -> f64 {
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let borders = DVec2::new(half_height * aspect, half_height) * filled(size_px);
    let distance = |p: &DVec3| (p.truncate().abs() / borders).max_element() - p.z;
    points.iter().map(distance).fold(1e-6, f64::max)
}

/// Half the height of a parallel view of the origin of the points.
pub fn half_height_around(points: &[DVec3], size_px: [u32; 2]) -> f64 {
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let half =
        |p: &DVec3| (p.truncate().abs() / filled(size_px) / DVec2::new(aspect, 1.0)).max_element();
    points.iter().map(half).fold(1e-9, f64::max)
}

fn extent(points: &[DVec3]) -> [DVec3; 2] {
    let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    points
        .iter()
        .fold(none, |[least, most], p| [least.min(*p), most.max(*p)])
}
