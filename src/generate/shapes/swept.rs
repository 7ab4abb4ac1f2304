//! Tubes: `torus`, `knot`, `conduit`.
//!
//! Each is a vertex grid, periodic in both directions: rows are closed sections, and the last row joins the first.
//! The quads of torus and conduit are planar trapezoids, so their polyhedra have volumes in closed form: for a bend of
//! angle A in m steps around an axis at distance R from the middle of a section of area F, `m sin(A / m) R F`.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::round::icosphere;
use super::spec::{ShapeInfo, ShapeParameter};
use super::{Mesh, Part};
use crate::scene::{Material, Role};

const AROUND: [u32; 2] = [3, 100_000];

/// A ring with a round section, around the y axis.
pub(super) const TORUS: ShapeInfo = ShapeInfo {
    name: "torus",
    summary: "a ring around the y axis",
    parameters: &[
        ShapeParameter::length("major", "from the centre to the middle of the tube", 0.5),
        ShapeParameter::length("minor", "radius of the tube", 0.2),
        ShapeParameter::count("segments", "sections along the tube", 96, AROUND),
        ShapeParameter::count("sides", "corners of a section", 48, AROUND),
    ],
    triangles: |v| 2.0 * v.real("segments") * v.real("sides"),
    build: |v| {
        let (major, minor) = (v.real("major"), v.real("minor"));
        v.require(minor < major, "minor major", "let minor < major")?;
        let (rows, columns) = (v.count("segments"), v.count("sides"));
        let mesh = closed_grid(rows, columns, |i, j| {
            let section = unit(j, columns) * minor;
            let around = unit(i, rows);
            let out = major + section.x;
            DVec3::new(out * around.x, section.y, -out * around.y)
        });
        Ok(vec![Part::new("torus", mesh)])
    },
};

/// A tube along a torus knot.
pub(super) const KNOT: ShapeInfo = ShapeInfo {
    name: "knot",
    summary: "a tube along the torus knot (p, q); the trefoil by default",
    parameters: &[
        ShapeParameter::count("p", "turns around the axis", 2, [1, 12]),
        ShapeParameter::count(
            "q",
            "turns around the ring, without common divisor with p",
            3,
            [1, 12],
        ),
        ShapeParameter::length("major", "from the centre to the middle of the ring", 0.5),
        ShapeParameter::length("minor", "radius of the ring", 0.25),
        ShapeParameter::length("tube", "radius of the tube", 0.1),
        ShapeParameter::count("segments", "sections along the tube", 480, [24, 1_000_000]),
        ShapeParameter::count("sides", "corners of a section", 32, AROUND),
    ],
    triangles: |v| 2.0 * v.real("segments") * v.real("sides"),
    build: |v| {
        let (p, q) = (v.real("p"), v.real("q"));
        let (major, minor, tube) = (v.real("major"), v.real("minor"), v.real("tube"));
        v.require(
            gcd(v.count("p"), v.count("q")) == 1,
            "p q",
            "choose p and q without a common divisor",
        )?;
        v.require(minor < major, "minor major", "let minor < major")?;
        v.require(
            v.real("segments") >= 16.0 * p.max(q),
            "segments p q",
            "use at least 16 segments per turn",
        )?;
        let curve = |t: f64| {
            let out = major + minor * (q * t).cos();
            let (sin, cos) = (p * t).sin_cos();
            DVec3::new(out * cos, out * sin, minor * (q * t).sin())
        };
        let thickest = thickness(curve);
        let help = format!("the tube would intersect itself: let tube < {thickest:.3}");
        v.require(tube < thickest, "tube major minor", help)?;
        let (rows, columns) = (v.count("segments"), v.count("sides"));
        let centres: Vec<DVec3> = (0..rows)
            .map(|i| curve(TAU * i as f64 / rows as f64))
            .collect();
        let frames = closed_frames(&centres);
        let mesh = closed_grid(rows, columns, |i, j| {
            let section = unit(j, columns) * tube;
            let [normal, binormal] = frames[i];
            centres[i] + normal * section.x - binormal * section.y
        });
        Ok(vec![Part::new("knot", mesh)])
    },
};

/// A bent pipe with a wall.
pub(super) const CONDUIT: ShapeInfo = ShapeInfo {
    name: "conduit",
    summary: "a hollow pipe: a straight leg, a bend, a straight leg",
    parameters: &[
        ShapeParameter::length("bend", "radius of the bend, to the middle of the pipe", 0.5),
        ShapeParameter::real("angle", "of the bend, in degrees", 90.0, [1.0, 350.0]),
        ShapeParameter::length("leg", "length of a leg", 0.4),
        ShapeParameter::length("outer", "outer radius of the pipe", 0.2),
        ShapeParameter::length("inner", "inner radius of the pipe", 0.15),
        ShapeParameter::count("segments", "sections along the bend", 48, [1, 100_000]),
        ShapeParameter::count("sides", "corners of a section", 64, AROUND),
        ShapeParameter::count(
            "inside",
            "balls in the bend, parts of their own",
            0,
            [0, 64],
        ),
    ],
    triangles: |v| {
        let balls = v.real("inside") * 20.0 * 4.0_f64.powi(BALL_SUBDIVISIONS as i32);
        4.0 * (v.real("segments") + 3.0) * v.real("sides") + balls
    },
    build: |v| {
        let (bend, outer, inner) = (v.real("bend"), v.real("outer"), v.real("inner"));
        v.require(inner < outer, "inner outer", "let inner < outer")?;
        v.require(outer < bend, "outer bend", "let outer < bend")?;
        let (angle, leg) = (v.real("angle").to_radians(), v.real("leg"));
        v.require(
            v.real("angle") <= 120.0 * v.real("segments"),
            "segments angle",
            "let each segment turn by at most 120 degrees",
        )?;
        // Legs at an angle beyond 180 degrees run towards each other.
        let apart = angle <= std::f64::consts::PI || {
            let cross = bend * (0.5 * angle).tan().abs();
            leg + outer * (0.5 * angle).tan().abs() < cross
        };
        v.require(
            apart,
            "leg bend outer angle",
            "the legs would meet: shorten them",
        )?;
        let (segments, columns) = (v.count("segments"), v.count("sides"));
        let stations = segments + 3;
        // Stations run along the outer wall and back along the inner one; the two turning points are the pipe's ends.
        let mesh = closed_grid(2 * stations, columns, |i, j| {
            let (station, radius) = if i < stations {
                (i, outer)
            } else {
                (2 * stations - 1 - i, inner)
            };
            let step = station.clamp(1, segments + 1) - 1;
            let (sin, cos) = (angle * (step as f64 / segments as f64)).sin_cos();
            let straight = match station {
                0 => -leg,
                s if s == segments + 2 => leg,
                _ => 0.0,
            };
            let section = unit(j, columns) * radius;
            let out = DVec3::new(cos, sin, 0.0);
            let along = DVec3::new(-sin, cos, 0.0);
            out * (bend + section.x) + along * straight + DVec3::Z * section.y
        });
        let mut parts = vec![Part::new("conduit", mesh)];
        let balls = v.count("inside");
        let radius = (0.7 * inner).min(0.4 * bend * angle / (balls as f64).max(1.0));
        parts.extend((0..balls).map(|i| {
            let (sin, cos) = (angle * (i as f64 + 0.5) / balls as f64).sin_cos();
            let mut mesh = icosphere(radius, BALL_SUBDIVISIONS);
            let at = DVec3::new(cos, sin, 0.0) * bend;
            mesh.positions.iter_mut().for_each(|p| *p += at);
            Part {
                role: Role::Interior,
                material: Material::of_index(i + 1),
                ..Part::new(format!("ball {}", i + 1), mesh)
            }
        }));
        Ok(parts)
    },
};

/// Subdivisions of the balls of a conduit.
const BALL_SUBDIVISIONS: usize = 4;

/// A grid that is periodic in both directions. Sections are oriented so that the cross product of row and column directions points outward.
fn closed_grid(rows: usize, columns: usize, at: impl Fn(usize, usize) -> DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    let index = |i: usize, j: usize| ((i % rows) * columns + j % columns) as u32;
    for i in 0..rows {
        for j in 0..columns {
            mesh.positions.push(at(i, j));
            let ring = [
                index(i, j),
                index(i + 1, j),
                index(i + 1, j + 1),
                index(i, j + 1),
            ];
            let [a, b, c, d] = ring;
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// The `j`-th of `n` corners on the unit circle.
fn unit(j: usize, n: usize) -> DVec2 {
    DVec2::from_angle(TAU * j as f64 / n as f64)
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Radius of the thickest tube around a closed curve such that the tube does not intersect itself: the smallest radius of a circle through
/// one point and tangent at another (Gonzalez & Maddocks 1999), which accounts for both curvature and near passes. It is
/// sampled, so the result is about one per cent too small.
fn thickness(curve: impl Fn(f64) -> DVec3) -> f64 {
    const SAMPLES: usize = 720;
    let points: Vec<DVec3> = (0..SAMPLES)
        .map(|i| curve(TAU * i as f64 / SAMPLES as f64))
        .collect();
    let mut least = f64::INFINITY;
    for (i, p) in points.iter().enumerate() {
        let before = points[(i + SAMPLES - 1) % SAMPLES];
        let tangent = (points[(i + 1) % SAMPLES] - before).normalize();
        // For adjacent samples the quotient would be pure rounding error.
        for gap in 3..=SAMPLES - 3 {
            let chord = points[(i + gap) % SAMPLES] - *p;
            least = least.min(chord.length_squared() / (2.0 * chord.cross(tangent).length()));
        }
    }
    least * 0.99
}

/// Normal and binormal along a closed curve: carried along without twist by double reflection (Wang et al. 2008), then
/// turned evenly so that the last frame meets the first.
fn closed_frames(centres: &[DVec3]) -> Vec<[DVec3; 2]> {
    let n = centres.len();
    let tangent = |i: usize| (centres[(i + 1) % n] - centres[(i + n - 1) % n]).normalize();
    let reflect =
        |v: DVec3, across: DVec3| v - across * (2.0 * across.dot(v) / across.length_squared());
    let mut normal = tangent(0).any_orthonormal_vector();
    let mut carried = Vec::with_capacity(n + 1);
    for i in 0..=n {
        carried.push(normal);
        let (here, there) = (i % n, (i + 1) % n);
        let across = centres[there] - centres[here];
        let (mirrored, turned) = (reflect(normal, across), reflect(tangent(here), across));
        let across = tangent(there) - turned;
        // Where the curve is straight, the second reflection is not needed.
        normal = if across.length_squared() < 1e-30 {
            mirrored
        } else {
            reflect(mirrored, across)
        };
    }
    let binormal = |i: usize| tangent(i % n).cross(carried[i]);
    let twist = carried[n].dot(tangent(0).cross(carried[0]));
    let twist = twist.atan2(carried[n].dot(carried[0]));
    (0..n)
        .map(|i| {
            let (sin, cos) = (-twist * i as f64 / n as f64).sin_cos();
            let (u, v) = (carried[i], binormal(i));
            [u * cos + v * sin, v * cos - u * sin]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tube_is_limited_by_curvature_and_by_near_passes() {
        let circle = |t: f64| DVec3::new(t.cos(), t.sin(), 0.0) * 2.0;
        assert!((thickness(circle) / 2.0 - 0.99).abs() < 1e-3, "circle");
        // Two long sides 0.4 apart, joined by wider turns.
        let waist = |t: f64| DVec3::new(t.cos() * 3.0, t.sin() * (0.2 + t.cos().powi(2)), 0.0);
        let limit = thickness(waist);
        assert!((0.15..=0.2).contains(&limit), "waist: {limit}");
    }

    #[test]
    fn frames_are_orthonormal_and_meet_at_the_seam() {
        let knot: Vec<DVec3> = (0..300)
            .map(|i| TAU * f64::from(i) / 300.0)
            .map(|t| DVec3::new((2.0 * t).cos(), (2.0 * t).sin(), 0.4 * (3.0 * t).sin()))
            .collect();
        let frames = closed_frames(&knot);
        for i in 0..300 {
            let ([u, v], [next, _]) = (frames[i], frames[(i + 1) % 300]);
            assert!(
                u.dot(v).abs() < 1e-9 && (u.length() - 1.0).abs() < 1e-9,
                "at {i}"
            );
            assert!(u.dot(next) > 0.99, "jump at {i}: {}", u.dot(next));
        }
    }
}
