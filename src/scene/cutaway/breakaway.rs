//! Breakaways: openings through which the eye sees interior parts (Diepstraten, Weiskopf and Ertl 2003, rules R6 and R7).
//!
//! The convex hull of the interior parts, extended by a ball, is swept along a cone of all directions from the hull to the eye. The convex
//! hull of the sweep's two ends is a closed mesh: a cutter like any other, so its walls have caps. The paper instead clips exterior parts
//! in the picture, in front of the extended hull's foremost surface, and can show walls only in part.
//!
//! All points between an interior part and the eye are inside: for a point p of the extended hull and a direction u of the cone, p + t u
//! is in the hull of both ends for all t up to the sweep's length. That hull is the sum of the extended hull and the cone.
//!
//! Cost: the hull of the interior parts' vertices, kept while the camera alone moves, and a sum per opening. Cannot: open towards an eye
//! inside the extended hull; there is no opening then.

use std::sync::LazyLock;

use glam::DVec3;

use crate::error::Result;
use crate::scene::describe::Described;
use crate::scene::geometry::hull::ConvexHull;
use crate::scene::{Amount, Bounds, Cutter, Mesh, View};

/// Sides of the cone.
const SIDES: u32 = 24;
/// The extended hull's corners lie farther out than the ball by this factor, to allow for rounding.
const SLACK: f64 = 1.001;
/// Points that protrude by less than this share of the clearance are left out of the hull; the clearance grows by the same amount.
const LEFT_OUT: f64 = 0.05;
/// The widest half angle of a cone.
const WIDEST_DEG: f64 = 80.0;
/// Length of the opening as a share of the distance to the eye, provided that the opening then ends outside the model.
const NEAR_THE_EYE: f64 = 0.75;
/// Maximum number of steps in the search for the point nearest to the origin in the difference of two hulls.
const MOST_STEPS: usize = 256;

/// An automatically placed opening, determined by the parts that it shows.
#[derive(Clone, Copy, Debug, PartialEq, Described)]
pub struct Breakaway {
    /// Clearance between the opening and the interior parts.
    ///
    /// Percentages refer to the scene's diagonal.
    #[value(range = 0.0.., unit = "units", example = "1%")]
    pub distance: Amount,
    /// Angle by which the opening is wider than the lines of sight.
    ///
    /// At 0 the walls are hardly visible.
    #[value(range = 0.0..=60.0, unit = "degrees", example = 12)]
    pub bevel_deg: f64,
    /// One opening, or one per cluster of interior parts.
    #[value(example = "one")]
    pub clusters: Clusters,
    /// Whether the opening follows the camera or stays open towards the first camera position.
    #[value(example = "first")]
    pub view: BreakawayView,
}

/// Number of openings of a breakaway.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Described)]
pub enum Clusters {
    /// One opening around all interior parts, as in the paper.
    One,
    /// One opening per group of interior parts whose extended hulls intersect.
    #[default]
    Auto,
}

/// The camera position that a breakaway opens towards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Described)]
pub enum BreakawayView {
    /// The camera position of each frame, as in the paper.
    #[default]
    Each,
    /// The camera position of the first frame; the opening stays fixed while the camera moves.
    First,
}

impl Default for Breakaway {
    fn default() -> Self {
        Self {
            distance: Amount::Percent(1.0),
            bevel_deg: 12.0,
            clusters: Clusters::default(),
            view: BreakawayView::default(),
        }
    }
}

impl Breakaway {
    /// Clearance in world units.
    pub(super) fn distance_in(&self, bounds: &Bounds) -> f64 {
        match self.distance {
            Amount::Units(units) => units,
            Amount::Percent(percent) => bounds.size().length() * percent / 100.0,
        }
    }

    /// The hulls of solids, given by their points in world space, extended by a distance; solids whose extended hulls intersect share one.
    pub(super) fn hulls(&self, solids: Vec<Vec<DVec3>>, distance: f64) -> Vec<ConvexHull> {
        let mut apart: Vec<(Vec<DVec3>, ConvexHull)> = Vec::new();
        for mut own in solids {
            // Merge the hulls that it intersects; the merged hull may then intersect further ones.
            while let Some((corners, extended)) = extended(&own, distance) {
                let met = apart.iter().position(|(_, other)| match self.clusters {
                    Clusters::One => true,
                    Clusters::Auto => meet(other, &extended),
                });
                match met {
                    Some(at) => {
                        own = corners;
                        own.extend(apart.swap_remove(at).0);
                    }
                    None => {
                        apart.push((corners, extended));
                        break;
                    }
                }
            }
        }
        apart.into_iter().map(|(_, hull)| hull).collect()
    }

    /// The opening of an extended hull towards the eye of a view in world space; `None` if the eye is inside the hull or too near to it.
    pub(crate) fn cutter(
        &self,
        hull: &ConvexHull,
        view: &View,
        bounds: &Bounds,
    ) -> Result<Option<Cutter>> {
        let centre = hull.corners.iter().sum::<DVec3>() / hull.corners.len() as f64;
        let to_eye = view.eye - centre;
        let axis = match view.orthographic {
            true => -view.forward,
            false => to_eye.normalize_or_zero(),
        };
        let widest = match view.orthographic {
            true => 0.0,
            false => (hull.corners.iter())
                .map(|corner| (view.eye - *corner).angle_between(axis))
                .fold(0.0, f64::max),
        };
        if axis == DVec3::ZERO || widest > WIDEST_DEG.to_radians() || widest.is_nan() {
            return Ok(None);
        }
        let half_angle = (widest + self.bevel_deg.to_radians()).min(WIDEST_DEG.to_radians());
        // The polygonal cone is circumscribed about the round one.
        let spread = half_angle.tan() / (std::f64::consts::PI / f64::from(SIDES)).cos();
        let corners = bounds.corners();
        let out_of_model = corners
            .iter()
            .map(|c| (*c - centre).dot(axis))
            .fold(0.0, f64::max)
            * 1.01;
        let back = hull
            .corners
            .iter()
            .map(|c| (centre - *c).dot(axis))
            .fold(0.0, f64::max);
        let length = match view.orthographic {
            true => out_of_model + back,
            false => match NEAR_THE_EYE * to_eye.length() {
                near if near >= out_of_model + back => near,
                // An eye near or inside the model is inside the opening.
                _ => to_eye.length() + out_of_model + back,
            },
        };
        let (x, y) = axis.any_orthonormal_pair();
        let mut cone = vec![DVec3::ZERO];
        for side in 0..SIDES {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(side) / f64::from(SIDES)).sin_cos();
            cone.push((axis + (x * cos + y * sin) * spread) * length);
        }
        let sweep = match ConvexHull::of(&cone) {
            Some(cone) => hull.sum(&cone),
            // Without a spread, all sides of the cone are the same.
            None => hull_of_sums(&[DVec3::ZERO, cone[1]], &hull.corners),
        };
        let Some(ConvexHull { corners, triangles }) = sweep else {
            return Ok(None);
        };
        let mesh = Mesh {
            positions: corners,
            triangles,
            corner_normals: None,
            vertex_paint: None,
        };
        let mut cutter = Cutter::new("breakaway", mesh)?;
        cutter.is_smooth = true;
        Ok(Some(cutter))
    }
}

/// The sum of the hulls of points, one of which may have no volume.
fn hull_of_sums(a: &[DVec3], b: &[DVec3]) -> Option<ConvexHull> {
    let sums = a.iter().flat_map(|p| b.iter().map(move |q| *p + *q));
    ConvexHull::of(&sums.collect::<Vec<_>>())
}

/// The significant corners, and the hull of a ball around each of them; `None` if that hull has no volume. The ball's radius is enlarged by
/// the protrusion of the corners that were left out.
fn extended(points: &[DVec3], distance: f64) -> Option<(Vec<DVec3>, ConvexHull)> {
    let size = Bounds::from_points(points.iter().copied()).size().length();
    let aside = (LEFT_OUT * distance / size).clamp(1e-6, 1e-3);
    let radius = distance + aside * size;
    let ball = BALL.as_ref()?.scaled(radius);
    Some(match ConvexHull::roughly(points, aside) {
        Some(hull) => {
            let extended = hull.sum(&ball)?;
            (hull.corners, extended)
        }
        None => (points.to_vec(), hull_of_sums(points, &ball.corners)?),
    })
}

static BALL: LazyLock<Option<ConvexHull>> = LazyLock::new(|| ConvexHull::of(&ball()));

/// Points whose hull contains the unit ball: face centres and corners of an icosahedron, moved out until none of the hull's faces cuts it.
fn ball() -> Vec<DVec3> {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let around = |a: f64, b: f64| {
        signs.into_iter().flat_map(move |(s, t)| {
            let (a, b) = (a * s, b * t);
            [
                DVec3::new(0.0, a, b),
                DVec3::new(a, b, 0.0),
                DVec3::new(b, 0.0, a),
            ]
        })
    };
    let corners = around(1.0, golden);
    let cube = [1.0, -1.0]
        .into_iter()
        .flat_map(move |s| signs.into_iter().map(move |(t, u)| DVec3::new(s, t, u)));
    let middles = around(golden, 1.0 / golden).chain(cube);
    let points: Vec<DVec3> = corners
        .chain(middles)
        .map(|p| p.normalize_or(DVec3::X))
        .collect();
    // Distance of the nearest face of their hull.
    let nearest = ConvexHull::of(&points).map_or(1.0, |hull| {
        let distances = hull.faces().map(|[a, b, c]| {
            let normal = (b - a).cross(c - a).normalize_or(DVec3::X);
            normal.dot(a)
        });
        distances.fold(1.0, f64::min)
    });
    points.into_iter().map(|p| p * (SLACK / nearest)).collect()
}

/// Returns true if two hulls intersect. Searches for the point of their difference nearest to the origin (Frank and Wolfe 1956); a
/// separating plane found on the way proves that they do not. If the step limit is reached, as with long solids close together, the planes
/// of their faces are tried; hulls that only a plane parallel to two edges separates then count as intersecting.
fn meet(a: &ConvexHull, b: &ConvexHull) -> bool {
    let Some((first, second)) = a.corners.first().zip(b.corners.first()) else {
        return false;
    };
    let mut nearest = *first - *second;
    for _ in 0..MOST_STEPS {
        let corner = a.farthest(-nearest) - b.farthest(nearest);
        if nearest.dot(corner) > 0.0 {
            return false;
        }
        let way = corner - nearest;
        let size = way.length_squared();
        if size == 0.0 {
            break;
        }
        let share = (-nearest.dot(way) / size).clamp(0.0, 1.0);
        nearest += way * share;
    }
    let is_before_a_face = |of: &ConvexHull, other: &ConvexHull| {
        of.faces().any(|[p, q, r]| {
            let normal = (q - p).cross(r - p);
            let nearest = other.farthest(-normal);
            normal.dot(nearest - p) > 0.0
        })
    };
    !(is_before_a_face(a, b) || is_before_a_face(b, a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Projection};

    fn cube(centre: DVec3, half: f64) -> Vec<DVec3> {
        let corner =
            |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
        (0..8)
            .map(|i| centre + (corner(i) * 2.0 - 1.0) * half)
            .collect()
    }

    /// Directions all around.
    fn directions() -> impl Iterator<Item = DVec3> {
        (0..500).map(|i| {
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / 500.0;
            let flat = glam::DVec2::from_angle(2.399_963 * f64::from(i)) * (1.0 - z * z).sqrt();
            flat.extend(z)
        })
    }

    #[test]
    fn an_extended_hull_is_as_far_away_as_it_is_told_everywhere() {
        let points = cube(DVec3::ZERO, 1.0);
        let (_, extended) = extended(&points, 0.25).unwrap_or_else(|| panic!("a hull"));
        let plain = ConvexHull::of(&points).unwrap_or_else(|| panic!("a hull"));
        let mut most = 0.0_f64;
        for direction in directions() {
            let away = extended.reach(direction) - plain.reach(direction);
            assert!(away >= 0.25, "{away} towards {direction}");
            most = most.max(away);
        }
        assert!(most < 0.34, "{most}");
    }

    #[test]
    fn solids_that_meet_share_an_opening() {
        let bounds = Bounds::from_points(cube(DVec3::ZERO, 10.0));
        let breakaway = Breakaway {
            distance: Amount::Units(0.1),
            ..Breakaway::default()
        };
        let hulls = |xs: &[f64], clusters| {
            let solids = xs.iter().map(|x| cube(DVec3::X * *x, 0.5)).collect();
            let breakaway = Breakaway {
                clusters,
                ..breakaway
            };
            breakaway
                .hulls(solids, breakaway.distance_in(&bounds))
                .len()
        };
        assert_eq!(hulls(&[0.0, 1.1, 5.0], Clusters::Auto), 2);
        assert_eq!(hulls(&[0.0, 1.5, 3.0], Clusters::Auto), 3);
        // The middle one comes last and merges the others.
        assert_eq!(hulls(&[0.0, 2.2, 1.1], Clusters::Auto), 1);
        assert_eq!(hulls(&[0.0, 1.5, 3.0], Clusters::One), 1);
        assert_eq!(hulls(&[], Clusters::Auto), 0);
    }

    #[test]
    fn long_solids_beside_each_other_are_apart() {
        let rod = |x: f64| -> ConvexHull {
            let points: Vec<DVec3> = (0..64)
                .map(|i| {
                    let turn = std::f64::consts::TAU * f64::from(i / 2) / 32.0;
                    let end = if i % 2 == 0 { -4.0 } else { 4.0 };
                    let point = DVec3::new(x + 0.1 * turn.cos(), 0.1 * turn.sin(), end);
                    glam::DMat3::from_rotation_x(0.4) * glam::DMat3::from_rotation_y(0.9) * point
                })
                .collect();
            ConvexHull::of(&points).unwrap_or_else(|| panic!("a hull"))
        };
        for gap in [0.1, 0.02] {
            assert!(!meet(&rod(0.0), &rod(0.2 + gap)), "a gap of {gap}");
        }
        assert!(meet(&rod(0.0), &rod(0.19)), "the control");
    }

    #[test]
    fn all_between_the_hull_and_the_eye_is_in_the_opening() {
        let bounds = Bounds::from_points(cube(DVec3::ZERO, 4.0));
        let [perspective, orthographic] = [
            Camera::default().projection,
            Projection::Orthographic { height: None },
        ];
        for (bevel_deg, projection) in [
            (0.0, perspective),
            (12.0, perspective),
            (0.0, orthographic),
            (12.0, orthographic),
        ] {
            let breakaway = Breakaway {
                bevel_deg,
                ..Breakaway::default()
            };
            let solids = vec![cube(DVec3::new(1.0, 0.5, 0.0), 0.5)];
            let hulls = breakaway.hulls(solids, breakaway.distance_in(&bounds));
            let camera = Camera {
                projection,
                ..Camera::default()
            };
            let view = camera.view(|p| p, 1.0, bounds, [400, 300]);
            let cutter = breakaway.cutter(&hulls[0], &view, &bounds);
            let cutter = cutter.unwrap_or_else(|e| panic!("{e}"));
            let mesh = cutter
                .unwrap_or_else(|| panic!("an opening"))
                .mesh()
                .clone();
            let is_within = |p: DVec3| {
                mesh.triangles.iter().all(|t| {
                    let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
                    (b - a).cross(c - a).dot(p - a) <= 1e-9
                })
            };
            for corner in &hulls[0].corners {
                for share in [0.0, 0.2, 0.5, 0.7] {
                    let to_eye = match view.orthographic {
                        true => -view.forward * 20.0,
                        false => view.eye - *corner,
                    };
                    let between = *corner + to_eye * share;
                    let is_out = !bounds_hold(&bounds, between);
                    assert!(is_out || is_within(between), "{between} of {corner}");
                }
            }
            assert!(!is_within(DVec3::new(-3.0, -3.0, -3.0)), "far beside it");
        }
    }

    fn bounds_hold(bounds: &Bounds, point: DVec3) -> bool {
        point.cmpge(bounds.min).all() && point.cmple(bounds.max).all()
    }

    #[test]
    fn an_eye_within_has_no_opening() {
        let bounds = Bounds::from_points(cube(DVec3::ZERO, 4.0));
        let breakaway = Breakaway::default();
        let hulls = breakaway.hulls(vec![cube(DVec3::ZERO, 1.0)], 0.1);
        let view = View {
            eye: DVec3::splat(0.1),
            ..Camera::default().view(|p| p, 1.0, bounds, [400, 300])
        };
        let cutter = breakaway.cutter(&hulls[0], &view, &bounds);
        assert!(cutter.unwrap_or_else(|e| panic!("{e}")).is_none());
    }
}
