//! Places the eye so that a set of points is centred in the picture and fills it up to its margins.
//!
//! Points are given along the picture's axes: to the right, up, and into it. In perspective each border is a plane through the
//! eye. With the eye at `(x, y, z)` and a half width of `t` at depth 1, a point is on the inner side of the right border if
//! `p.x - t p.z <= x - t z`; so only the greatest `p.x - t p.z` of all points matters. Left and right border together determine
//! the eye's distance, and so do the lower and the upper border; the farther of the two eyes sees all points. This is exact and
//! needs one pass over the points. On the axis with room to spare, the eye is placed where both margins are equal in the picture.

use glam::{DVec2, DVec3};

/// Margin on each side, as a share of the picture's shorter side.
const MARGIN: f64 = 0.06;

/// Minimum distance of the eye from the points, as a share of their extent: otherwise a wide view of a tip could start inside the tip.
const NEAREST: f64 = 0.05;

/// Steps of a bisection, after which the interval is as short as f64 can resolve.
const CENTRING_HALVINGS: u32 = 50;

/// Filled shares of the picture's half width and half height.
fn filled(size_px: [u32; 2]) -> DVec2 {
    let size = DVec2::from_array(size_px.map(f64::from));
    1.0 - 2.0 * MARGIN * size.min_element() / size
}

/// For a parallel view: the centre of the points in the picture, and half the picture's height.
pub(in crate::scene) fn fit_parallel(points: &[DVec3], size_px: [u32; 2]) -> (DVec2, f64) {
    let [least, most] = extent(points);
    let half = (most - least).truncate() / 2.0 / filled(size_px);
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let half_height = (half.x / aspect).max(half.y).max(1e-9);
    ((least + most).truncate() / 2.0, half_height)
}

/// The eye of a perspective view with the given half height at depth 1.
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
        // The position with equal margins lies between the two that put the outermost point of either side on the axis.
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

/// How far the points reach on the positive side of the eye's picture, minus how far they reach on the negative side.
fn lean(points: &[DVec3], axis: usize, at: f64, z: f64) -> f64 {
    let slopes = points.iter().map(|p| (p[axis] - at) / (p.z - z));
    let [least, most] = slopes.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], s| {
        [least.min(s), most.max(s)]
    });
    least + most
}

/// The points' greatest offsets along an axis, relative to each of the two borders.
fn sides(points: &[DVec3], axis: usize, border: f64) -> [f64; 2] {
    let none = [f64::NEG_INFINITY; 2];
    points.iter().fold(none, |[low, high], p| {
        let depth = border * p.z;
        [low.max(-p[axis] - depth), high.max(p[axis] - depth)]
    })
}

/// Distance of a perspective eye that looks at the points' origin; the points are not centred.
pub fn distance_around(points: &[DVec3], half_height: f64, size_px: [u32; 2]) -> f64 {
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let borders = DVec2::new(half_height * aspect, half_height) * filled(size_px);
    let distance = |p: &DVec3| (p.truncate().abs() / borders).max_element() - p.z;
    points.iter().map(distance).fold(1e-6, f64::max)
}

/// Half the height of a parallel view that looks at the points' origin.
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
