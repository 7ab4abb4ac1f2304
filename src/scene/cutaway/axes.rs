//! The main axes of a solid, and the choice of a cutout's axis among them (Diepstraten, Weiskopf and Ertl 2003, rule R3).
//!
//! The axes are the eigenvectors of the covariance of the convex hull's surface, integrated in closed form over its triangles as in
//! Gottschalk's oriented boxes. Vertices would not do: mesh vertices are dense where the mesh is finely divided, and hull vertices are
//! distributed arbitrarily. (The paper's sum over n triangles wrongly runs from 0 to n.) Disc-like solids have two equivalent axes of
//! greatest spread; the cutout then goes around the third.
//!
//! Cost: one pass over the hull's faces. Cannot: find axes of a cube, a ball or any solid with equal spreads; this is reported.

use glam::{DMat3, DVec3};

use crate::scene::geometry::hull::ConvexHull;
use crate::scene::{Part, Role, View, next_axis};

/// Two axes are alike if their spreads differ by less than this share of the greatest spread.
const ALIKE: f64 = 0.02;
/// Two axes are interchangeable if their spreads differ by less than this share and the third spread is far from both.
const DISC: f64 = 0.10;
/// Maximum number of sweeps of Jacobi's method, which converges quadratically; a 3 x 3 matrix takes about five.
const SWEEPS: usize = 16;

/// The axes of a convex hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MainAxes {
    /// The centroid of the hull's surface.
    pub centre: DVec3,
    /// Orthonormal axes, the greatest spread first; the largest component of each is positive.
    pub axes: [DVec3; 3],
    /// Variances along the axes, in square units.
    pub spreads: [f64; 3],
}

/// Rule that selects an axis.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum AxisRule {
    /// Axis of the greatest spread; for a disc its axis of symmetry; for a solid without a main axis the up axis.
    #[default]
    Auto,
    /// Axis of the greatest spread, as in the paper.
    Main,
    /// Axis of the least spread.
    Symmetry,
    /// An explicit direction.
    Along(DVec3),
}

impl MainAxes {
    /// The axes of the hull of some points; `None` if the points are coplanar.
    pub fn of(points: &[DVec3]) -> Option<Self> {
        ConvexHull::nearly(points).map(|hull| Self::of_hull(&hull))
    }

    fn of_hull(hull: &ConvexHull) -> Self {
        let faces = || {
            hull.faces().map(|[p, q, r]| {
                let area = (q - p).cross(r - p).length() / 2.0;
                (area, (p + q + r) / 3.0, [p, q, r])
            })
        };
        let whole: f64 = faces().map(|f| f.0).sum();
        let centre = faces().map(|(area, c, _)| c * area).sum::<DVec3>() / whole;
        let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
        let covariance = faces().fold(DMat3::ZERO, |sum, (area, c, corners)| {
            let of_corners = corners.iter().map(|p| outer(*p - centre));
            let of_face = of_corners.fold(outer(c - centre) * 9.0, |sum, m| sum + m);
            sum + of_face * (area / (12.0 * whole))
        });
        let (spreads, axes) = eigen(covariance);
        Self {
            centre,
            axes: axes.map(|axis| {
                let size = axis.abs();
                let greatest = (0..3).fold(0, |i, j| if size[j] > size[i] { j } else { i });
                axis * axis[greatest].signum()
            }),
            spreads,
        }
    }

    /// Returns true if no axis stands out.
    pub fn is_even(&self) -> bool {
        let [a, b, c] = self.spreads;
        (a - b) / a < ALIKE && (b - c) / a < ALIKE
    }

    /// Returns true if the two axes of the greatest spread are equivalent.
    pub fn is_disc(&self) -> bool {
        let [a, b, c] = self.spreads;
        (a - b) / a < DISC && (b - c) / a > DISC
    }

    /// The axis that a rule selects, and two perpendicular axes; the three are right-handed.
    fn by(&self, rule: AxisRule, up: DVec3) -> [DVec3; 3] {
        let [e1, _, e3] = self.axes;
        let along = match rule {
            AxisRule::Along(along) => along.normalize_or(up),
            AxisRule::Main => e1,
            AxisRule::Symmetry => e3,
            AxisRule::Auto if self.is_even() => up,
            AxisRule::Auto if self.is_disc() => e3,
            AxisRule::Auto => e1,
        };
        // The main axis nearest to perpendicular to `along`, unless the second nearest has about the same spread.
        let mut across: Vec<(f64, f64, DVec3)> = (self.axes.iter().zip(self.spreads))
            .map(|(axis, spread)| (axis.dot(along).abs(), spread, *axis))
            .collect();
        across.sort_by(|a, b| a.0.total_cmp(&b.0));
        let alike = (across[0].1 - across[1].1).abs() < ALIKE * self.spreads[0];
        let across = match alike {
            true => next_axis(along),
            false => (across[0].2 - along * across[0].2.dot(along)).normalize_or(next_axis(along)),
        };
        [along, across, along.cross(across)]
    }
}

/// Eigenvalues of a symmetric matrix in descending order, and their eigenvectors, by Jacobi rotations.
fn eigen(mut matrix: DMat3) -> ([f64; 3], [DVec3; 3]) {
    let mut vectors = DMat3::IDENTITY;
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = matrix.col(p)[q];
            if off == 0.0 {
                continue;
            }
            let theta = (matrix.col(q)[q] - matrix.col(p)[p]) / (2.0 * off);
            let tangent = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let cosine = 1.0 / tangent.hypot(1.0);
            let sine = tangent * cosine;
            let mut turn = DMat3::IDENTITY;
            turn.col_mut(p)[p] = cosine;
            turn.col_mut(q)[q] = cosine;
            turn.col_mut(q)[p] = sine;
            turn.col_mut(p)[q] = -sine;
            matrix = turn.transpose() * matrix * turn;
            vectors *= turn;
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| matrix.col(*b)[*b].total_cmp(&matrix.col(*a)[*a]));
    (
        order.map(|i| matrix.col(i)[i]),
        order.map(|i| vectors.col(i).normalize_or(DVec3::AXES[i])),
    )
}

/// Coordinate frame that places the wedge of a cutout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutoutFrame {
    /// A point on the axis.
    pub origin: DVec3,
    /// Direction of the axis, of length 1.
    pub along: DVec3,
    /// Direction of 0 degrees, of length 1.
    pub zero: DVec3,
    /// Direction of the eye, in degrees about the axis.
    pub eye_deg: f64,
    /// True if no axis stands out.
    pub is_even: bool,
}

impl CutoutFrame {
    /// The frame of a cutout through the exterior parts, for a view in world space; `None` if these parts are flat.
    pub fn of<'a>(
        parts: impl Iterator<Item = &'a Part>,
        rule: AxisRule,
        view: &View,
        up: DVec3,
    ) -> Option<Self> {
        let exteriors = parts.filter(|p| p.role == Role::Exterior);
        let points: Vec<DVec3> = exteriors.flat_map(Part::points_in_world).collect();
        let axes = MainAxes::of(&points)?;
        let [along, zero, third] = axes.by(rule, up);
        let to_eye = match view.orthographic {
            true => -view.forward,
            false => view.eye - axes.centre,
        };
        Some(Self {
            origin: axes.centre,
            along,
            zero,
            eye_deg: to_eye.dot(third).atan2(to_eye.dot(zero)).to_degrees(),
            is_even: axes.is_even() && rule == AxisRule::Auto,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn box_of(size: DVec3) -> Vec<DVec3> {
        let corner =
            |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
        (0..8).map(|i| (corner(i) - 0.5) * size).collect()
    }

    /// Variances of the surface of a box, along its sides.
    fn closed_form(size: DVec3) -> [f64; 3] {
        let DVec3 { x, y, z } = size;
        let whole = 2.0 * (x * y + y * z + z * x);
        // Per axis: two faces perpendicular to it at half a side's distance; the others extend along its full length.
        [(x, y * z), (y, z * x), (z, x * y)].map(|(side, face)| {
            side * side * (2.0 * face / 4.0 + (whole - 2.0 * face) / 12.0) / whole
        })
    }

    #[test]
    fn a_box_has_its_closed_form_however_it_is_turned_and_divided() {
        let size = DVec3::new(3.0, 2.0, 1.0);
        let turn = DMat3::from_rotation_z(0.7) * DMat3::from_rotation_x(-0.4);
        let mut points: Vec<DVec3> = box_of(size).into_iter().map(|p| turn * p + 5.0).collect();
        let plain = MainAxes::of(&points).unwrap_or_else(|| panic!("a hull"));
        // Many more points on one face, and some inside.
        points.extend((0..200).map(|i| {
            let t = f64::from(i) / 200.0 - 0.5;
            turn * DVec3::new(1.5, 2.0 * t, (13.0 * t).rem_euclid(1.0) - 0.5) + 5.0
        }));
        let divided = MainAxes::of(&points).unwrap_or_else(|| panic!("a hull"));
        for axes in [plain, divided] {
            for i in 0..3 {
                let wanted = closed_form(size)[i];
                assert!(
                    (axes.spreads[i] - wanted).abs() < 1e-6,
                    "{:?}",
                    axes.spreads
                );
                let along = axes.axes[i].dot(turn.col(i)).abs();
                assert!(along > 1.0 - 1e-12, "axis {i} is off by {along}");
            }
            assert!((axes.centre - 5.0).length() < 1e-6, "{}", axes.centre);
        }
        // The control: the mean of the points is elsewhere.
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        assert!((mean - 5.0).length() > 0.5, "{mean}");
    }

    #[test]
    fn discs_are_cut_around_their_axis_and_even_solids_around_the_upright() {
        let axis = |size: DVec3, rule| {
            let axes = MainAxes::of(&box_of(size)).unwrap_or_else(|| panic!("a hull"));
            let [along, across, third] = axes.by(rule, DVec3::Y);
            assert!(along.dot(across).abs() < 1e-12 && third.dot(along).abs() < 1e-12);
            (along.abs(), axes.is_even())
        };
        let (along, is_even) = axis(DVec3::new(4.0, 4.0, 1.0), AxisRule::Auto);
        assert!(along.abs_diff_eq(DVec3::Z, 1e-9) && !is_even, "{along}");
        let (along, is_even) = axis(DVec3::ONE, AxisRule::Auto);
        assert!(along.abs_diff_eq(DVec3::Y, 1e-9) && is_even, "{along}");
        let (along, _) = axis(DVec3::new(1.0, 5.0, 1.0), AxisRule::Auto);
        assert!(along.abs_diff_eq(DVec3::Y, 1e-9), "{along}");
        // The axes of a cube are rounding error.
        let turned: Vec<DVec3> = box_of(DVec3::ONE)
            .into_iter()
            .map(|p| DMat3::from_rotation_x(0.5) * p)
            .collect();
        let cube = MainAxes::of(&turned).unwrap_or_else(|| panic!("a hull"));
        assert_eq!(cube.by(AxisRule::Auto, DVec3::Y)[0], DVec3::Y);
        let (along, _) = axis(DVec3::new(3.0, 2.0, 1.0), AxisRule::Symmetry);
        assert!(along.abs_diff_eq(DVec3::Z, 1e-9), "{along}");
        let diagonal = DVec3::new(1.0, 1.0, 0.0);
        let (along, _) = axis(DVec3::new(3.0, 2.0, 1.0), AxisRule::Along(diagonal));
        assert!(along.abs_diff_eq(diagonal.normalize(), 1e-9), "{along}");
        assert!(
            MainAxes::of(&[DVec3::ZERO, DVec3::X, DVec3::Y]).is_none(),
            "flat"
        );
    }

    /// Points of a surface around z: rings of `sides` points, by radius and height.
    fn around_z(rings: impl Iterator<Item = (f64, f64)>, sides: u32) -> Vec<DVec3> {
        let ring = |(radius, z): (f64, f64)| {
            let angle = move |i| std::f64::consts::TAU * f64::from(i) / f64::from(sides);
            (0..sides).map(move |i| (DVec2::from_angle(angle(i)) * radius).extend(z))
        };
        rings.flat_map(ring).collect()
    }

    /// Spreads along z and across it, in closed form, and an approximating polyhedron with a given number of sides.
    struct RoundSolid {
        along: f64,
        across: f64,
        points: fn(u32) -> Vec<DVec3>,
    }

    /// A cylinder of radius 1 and length 3 with half a ball at each end.
    fn capsule() -> RoundSolid {
        let (pi, l) = (std::f64::consts::PI, 3.0_f64);
        let h = l / 2.0;
        let area = 2.0 * pi * l + 4.0 * pi;
        RoundSolid {
            along: (2.0 * pi * l.powi(3) / 12.0 + 4.0 * pi * (h * h + h + 1.0 / 3.0)) / area,
            across: (pi * l + 4.0 * pi / 3.0) / area,
            points: |sides| {
                let quarter = sides / 4;
                let rings = (0..=quarter).flat_map(move |i| {
                    let (sin, cos) =
                        (std::f64::consts::FRAC_PI_2 * f64::from(i) / f64::from(quarter)).sin_cos();
                    [(cos, 1.5 + sin), (cos, -1.5 - sin)]
                });
                around_z(rings, sides)
            },
        }
    }

    /// An ellipsoid of half axes 1, 1 and 2: integrals over its surface by Simpson's rule.
    fn ellipsoid() -> RoundSolid {
        let steps = 4000_u32;
        let mut sums = [0.0; 3];
        for i in 0..=steps {
            let t = std::f64::consts::PI * f64::from(i) / f64::from(steps);
            let weight = match i {
                0 => 1.0,
                _ if i == steps => 1.0,
                _ if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let (radius, z) = (t.sin(), 2.0 * t.cos());
            let area = weight * radius * t.cos().hypot(2.0 * t.sin());
            sums = [
                sums[0] + area,
                sums[1] + area * z * z,
                sums[2] + area * radius * radius / 2.0,
            ];
        }
        RoundSolid {
            along: sums[1] / sums[0],
            across: sums[2] / sums[0],
            points: |sides| {
                let half = sides / 2;
                let rings = (0..=half).map(move |i| {
                    let t = std::f64::consts::PI * f64::from(i) / f64::from(half);
                    (t.sin(), 2.0 * t.cos())
                });
                around_z(rings, sides)
            },
        }
    }

    #[test]
    fn spreads_of_round_solids_are_those_of_closed_forms() {
        let turn = DMat3::from_rotation_x(0.7) * DMat3::from_rotation_y(-0.4);
        for (name, solid) in [("capsule", capsule()), ("ellipsoid", ellipsoid())] {
            let of = |sides: u32| {
                let points = (solid.points)(sides).into_iter().map(|p| turn * p);
                MainAxes::of_hull(&ConvexHull::of(&points.collect::<Vec<_>>()).unwrap())
            };
            let off = |axes: &MainAxes| {
                let across = (axes.spreads[1] + axes.spreads[2]) / 2.0;
                [axes.spreads[0] - solid.along, across - solid.across]
            };
            let [coarse, fine] = [64, 128].map(of);
            // A polyhedron's error grows with the square of its edge length, so extrapolation from two of them gives the round solid.
            let limit: Vec<f64> = (off(&coarse).into_iter().zip(off(&fine)))
                .map(|(coarse, fine)| (4.0 * fine - coarse) / 3.0)
                .collect();
            println!(
                "{name}: off by {:?}, {:?}, in the limit {limit:?}",
                off(&coarse),
                off(&fine)
            );
            assert!(limit.iter().all(|l| l.abs() < 2e-6), "{name}: {limit:?}");
            assert!(
                off(&coarse)[0].abs() > 1e-4,
                "{name}: the control is a polyhedron"
            );
            for axes in [coarse, fine] {
                let apart = axes.axes[0].cross(turn * DVec3::Z).length();
                assert!(apart < 1e-7, "{name}: {apart}");
            }
        }
    }
}
