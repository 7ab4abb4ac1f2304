//! Classifies parts as visible from outside, or visible only once other parts are removed: Diepstraten, Weiskopf and Ertl (2003, rule R1)
//! leave this classification to the scene's author.
//!
//! All parts are viewed from 26 sides, uncut. A part is inside if its visible share is less than [`LEAST_SEEN`] of that expected from its
//! area; parts visible once all outer parts are removed are one level deeper. Cost: rasterising all triangles in 26 pictures of 256 x 256,
//! on all cores. Cannot: classify parts much smaller than a pixel, or recognise interior parts that show through an opening.

use glam::DVec3;
use rayon::prelude::*;

use crate::scene::{Bounds, Part};

/// Pixels along each side of a picture.
const SIDE_PX: usize = 256;
/// A part counts as seen if its share of all pixels, divided by its share of the total area, is at least this.
const LEAST_SEEN: f64 = 0.15;
/// A part is not classified if its expected pixel count, summed over all pictures, is below this.
const FEWEST_PX: f64 = 40.0;
/// Maximum number of levels; deeper nesting does not matter in practice.
const MOST_LEVELS: u32 = 16;

/// Visibility of a part from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Ratio of the part's share of all pixels to its share of the total area; 1 is the expected value.
    pub seen: f64,
    /// 0 for a part seen from outside, 1 for one seen once level 0 is removed, and so on; `None` if the part is too small to classify.
    pub level: Option<u32>,
}

/// The triangles of a part in world space, and their area.
struct PartTriangles {
    corners: Vec<[DVec3; 3]>,
    area: f64,
}

/// Visibility of each part.
pub fn sights(parts: &[Part]) -> Vec<Sight> {
    let shapes: Vec<PartTriangles> = parts.par_iter().map(PartTriangles::of).collect();
    let mut left: Vec<usize> = (0..parts.len()).collect();
    let nothing = Sight {
        seen: 0.0,
        level: None,
    };
    let mut sights = vec![nothing; parts.len()];
    for level in 0..MOST_LEVELS {
        let seen = seen_of(&shapes, &left);
        let mut stays = Vec::new();
        for (part, ShapeVisibility { share, expected_px }) in left.iter().zip(seen) {
            let sight = &mut sights[*part];
            if level == 0 {
                sight.seen = share;
            }
            let is_told = expected_px >= FEWEST_PX;
            match share >= LEAST_SEEN {
                true if is_told => sight.level = Some(level),
                _ if is_told => stays.push(*part),
                _ => {}
            }
        }
        let before = left.len();
        left = stays;
        if left.is_empty() || left.len() == before {
            break;
        }
    }
    sights
}

impl PartTriangles {
    fn of(part: &Part) -> Self {
        let mesh = part.posed_mesh();
        let place = |i: &u32| {
            part.world_from_part
                .transform_point3(mesh.positions[*i as usize])
        };
        let corners: Vec<[DVec3; 3]> = (mesh.triangles.iter())
            .map(|[a, b, c]| [a, b, c].map(place))
            .collect();
        let areas = corners
            .iter()
            .map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0);
        Self {
            area: areas.sum(),
            corners,
        }
    }
}

/// Visibility of a shape in the pictures.
struct ShapeVisibility {
    /// Ratio of the share of pixels to the share of area.
    share: f64,
    expected_px: f64,
}

/// Visibility of the shapes in `of`, with all others removed.
fn seen_of(shapes: &[PartTriangles], of: &[usize]) -> Vec<ShapeVisibility> {
    let corners = of.iter().flat_map(|i| &shapes[*i].corners).flatten();
    let bounds = Bounds::from_points(corners.copied());
    let sides: Vec<DVec3> = (0..27)
        .map(|i| DVec3::new(f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9)) - 1.0)
        .filter(|side| *side != DVec3::ZERO)
        .collect();
    let counts = sides
        .par_iter()
        .map(|side| counts_from(shapes, of, &bounds, side.normalize()));
    let counts = counts.reduce(
        || vec![0_u64; of.len()],
        |a, b| a.iter().zip(&b).map(|(a, b)| a + b).collect(),
    );
    let all_px = counts.iter().sum::<u64>() as f64;
    let all_area: f64 = of.iter().map(|i| shapes[*i].area).sum();
    let seen = |(part, count): (&usize, &u64)| {
        let expected_px = shapes[*part].area / all_area * all_px;
        let is_there = expected_px > 0.0;
        ShapeVisibility {
            share: if is_there {
                *count as f64 / expected_px
            } else {
                0.0
            },
            expected_px,
        }
    };
    of.iter().zip(&counts).map(seen).collect()
}

/// Number of visible pixels of each shape in a parallel projection.
fn counts_from(
    shapes: &[PartTriangles],
    of: &[usize],
    bounds: &Bounds,
    forward: DVec3,
) -> Vec<u64> {
    let (right, up) = forward.any_orthonormal_pair();
    let centre = bounds.centre();
    let per_unit = SIDE_PX as f64 / (2.0 * bounds.radius()).max(f64::MIN_POSITIVE);
    let mut depths = vec![f64::INFINITY; SIDE_PX * SIDE_PX];
    let mut shown = vec![u32::MAX; SIDE_PX * SIDE_PX];
    for (number, part) in (0_u32..).zip(of) {
        for corners in &shapes[*part].corners {
            let seen = corners.map(|c| {
                let d = (c - centre) * per_unit;
                DVec3::new(d.dot(right), d.dot(up), d.dot(forward)) + SIDE_PX as f64 / 2.0
            });
            draw(seen, |pixel, depth| {
                if depth < depths[pixel] {
                    (depths[pixel], shown[pixel]) = (depth, number);
                }
            });
        }
    }
    let mut counts = vec![0; of.len()];
    for number in shown.into_iter().filter(|n| *n != u32::MAX) {
        counts[number as usize] += 1;
    }
    counts
}

/// Calls `at` for the pixels whose centres a triangle covers, with the triangle's depth there.
fn draw([a, b, c]: [DVec3; 3], mut at: impl FnMut(usize, f64)) {
    let twice = (b - a).truncate().perp_dot((c - a).truncate());
    if twice == 0.0 {
        return;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let range = |low: f64, high: f64| {
        let first = (low - 0.5).ceil().max(0.0) as usize;
        first..((high - 0.5).floor() + 1.0).clamp(0.0, SIDE_PX as f64) as usize
    };
    for y in range(low.y, high.y) {
        for x in range(low.x, high.x) {
            let p = glam::DVec2::new(x as f64, y as f64) + 0.5;
            let side = |from: DVec3, to: DVec3| {
                (to - from).truncate().perp_dot(p - from.truncate()) / twice
            };
            let [of_c, of_a, of_b] = [side(a, b), side(b, c), side(c, a)];
            if of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 {
                at(y * SIDE_PX + x, of_a * a.z + of_b * b.z + of_c * c.z);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;
    use glam::DAffine3;

    #[test]
    fn nested_balls_lie_one_level_below_the_other() {
        let ball = shape("sphere?subdivisions=3").unwrap_or_else(|e| panic!("{e}"));
        let parts: Vec<Part> = [1.0, 0.3, 0.6, 2.0]
            .into_iter()
            .map(|size| {
                let mut part = ball[0].clone();
                part.world_from_part = DAffine3::from_scale(DVec3::splat(size));
                part
            })
            .collect();
        let levels: Vec<Option<u32>> = sights(&parts).iter().map(|s| s.level).collect();
        assert_eq!(levels, [1, 3, 2, 0].map(Some));
        let beside: Vec<Part> = (0..3)
            .map(|i| {
                let mut part = ball[0].clone();
                part.world_from_part = DAffine3::from_translation(DVec3::X * 3.0 * f64::from(i));
                part
            })
            .collect();
        for sight in sights(&beside) {
            assert!(
                sight.level == Some(0) && (0.7..1.4).contains(&sight.seen),
                "{sight:?}"
            );
        }
        assert!(sights(&[]).is_empty());
    }
}
