//! Boxes and wedges: removed regions given by a few numbers, as unions of intersections of half spaces.
//!
//! A region is converted to faces: planes that keep the outside. A wedge of up to 180 degrees is the intersection of two half spaces, which
//! at 180 degrees coincide except for their reliefs; a wider one is their union: two alternatives, with no wall between them. Angles are
//! counter-clockwise about the axis, seen from its tip; about a world axis, multiples of 90 degrees give planes without rounding. An empty
//! region still has its faces, so that clip-surfaces keep their numbers while it opens; a cut with such a region should be switched off.

use glam::DVec3;

use crate::scene::{ClipSurface, Up};

/// Intersection of two removed regions. Regions are unions of intersections of removed sides, and so is the result.
pub fn in_common(a: &[Vec<ClipSurface>], b: &[Vec<ClipSurface>]) -> Vec<Vec<ClipSurface>> {
    let pairs = a
        .iter()
        .flat_map(|x| b.iter().map(move |y| [x.as_slice(), y.as_slice()].concat()));
    pairs.collect()
}

/// A face of a region.
#[derive(Clone, Debug)]
pub struct RegionFace {
    /// `-x` to `+z` of a box; `from`, `to`, `min` or `max` of a wedge.
    pub name: &'static str,
    /// Its plane, which keeps the outside.
    pub plane: ClipSurface,
}

/// A box along the world axes; sides that are `None` are unbounded.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Block {
    /// Least coordinates.
    pub min: [Option<f64>; 3],
    /// Greatest coordinates.
    pub max: [Option<f64>; 3],
}

impl Block {
    /// The first axis along which the box's maximum is below its minimum.
    pub fn inverted_axis(&self) -> Option<usize> {
        (0..3).find(|i| matches!((self.min[*i], self.max[*i]), (Some(a), Some(b)) if a > b))
    }

    /// Returns true if it has no inside.
    pub fn is_empty(&self) -> bool {
        (0..3).any(|i| matches!((self.min[i], self.max[i]), (Some(a), Some(b)) if a >= b))
    }

    /// The box's faces, upright with respect to an up axis. The origin of each plane is its point nearest to `middle`.
    pub fn faces(&self, middle: DVec3, up: Up) -> Vec<RegionFace> {
        let faces = (0..6).filter_map(|i| {
            let (axis, upper) = (i / 2, i % 2 == 1);
            let at = if upper { self.max } else { self.min }[axis]?;
            let mut origin = middle;
            origin[axis] = at;
            let outward = DVec3::AXES[axis] * if upper { 1.0 } else { -1.0 };
            Some(RegionFace {
                name: ["-x", "+x", "-y", "+y", "-z", "+z"][i],
                plane: ClipSurface::upright(origin, outward, up),
            })
        });
        faces.collect()
    }
}

/// A wedge around an axis, like a slice of a pie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge {
    /// A point on the axis.
    pub origin: DVec3,
    /// Direction of the axis, of length 1.
    pub along: DVec3,
    /// Direction of 0 degrees, of length 1, at a right angle to the axis.
    pub zero: DVec3,
    /// Start angle.
    pub from_deg: f64,
    /// End angle, at most a full turn after the start.
    pub to_deg: f64,
    /// Lower end along the axis: the coordinate `P . along` of its lower face.
    pub min: Option<f64>,
    /// Upper end along the axis: the coordinate `P . along` of its upper face.
    pub max: Option<f64>,
}

impl Wedge {
    /// Returns true if it has no inside.
    pub fn is_empty(&self) -> bool {
        let is_flat = matches!((self.min, self.max), (Some(a), Some(b)) if a >= b);
        is_flat || self.to_deg <= self.from_deg
    }

    /// Its faces as one list, or as two lists (a union of two regions) for more than half a turn. A full turn has only the end faces
    /// along the axis. For half a turn, `from` and `to` have the same plane, which is listed once unless the two are `ragged` and
    /// their reliefs may differ. The planes are upright with respect to an up axis.
    pub fn alternatives(&self, ragged: bool, up: Up) -> Vec<Vec<RegionFace>> {
        let turn_deg = self.to_deg - self.from_deg;
        let across = self.along.cross(self.zero);
        // The wedge lies beyond `from` and before `to` in the direction of growing angles; the other side of each plane is kept.
        let tangent = |degrees: f64| {
            let [cosine, sine] = cosine_and_sine(degrees);
            across * cosine - self.zero * sine
        };
        let face = |name, outward| RegionFace {
            name,
            plane: ClipSurface::upright(self.origin, outward, up),
        };
        let from = face("from", -tangent(self.from_deg));
        let to = face("to", tangent(self.to_deg));
        let mut alternatives = if turn_deg >= 360.0 {
            vec![Vec::new()]
        } else if turn_deg > 180.0 {
            vec![vec![from], vec![to]]
        } else if turn_deg == 180.0 && !ragged {
            vec![vec![from]]
        } else {
            vec![vec![from, to]]
        };
        let end = |name, at: f64, sign: f64| RegionFace {
            name,
            plane: ClipSurface::upright(
                self.origin + self.along * (at - self.origin.dot(self.along)),
                self.along * sign,
                up,
            ),
        };
        for faces in &mut alternatives {
            faces.extend(self.min.map(|at| end("min", at, -1.0)));
            faces.extend(self.max.map(|at| end("max", at, 1.0)));
        }
        alternatives
    }
}

/// Direction of 0 degrees: the axis after the one nearest to `along` (y for x, z for y, x for z), made perpendicular to `along`.
pub fn next_axis(along: DVec3) -> DVec3 {
    let nearest = (0..3)
        .rev()
        .max_by(|a, b| along[*a].abs().total_cmp(&along[*b].abs()));
    let next = DVec3::AXES[(nearest.unwrap_or(0) + 1) % 3];
    (next - along * next.dot(along)).normalize()
}

/// The cosine and sine of an angle, exact for multiples of 90 degrees.
fn cosine_and_sine(degrees: f64) -> [f64; 2] {
    let quarter = (degrees / 90.0).round();
    let (sine, cosine) = (degrees - quarter * 90.0).to_radians().sin_cos();
    match quarter.rem_euclid(4.0) {
        q if q < 0.5 => [cosine, sine],
        q if q < 1.5 => [-sine, cosine],
        q if q < 2.5 => [-cosine, -sine],
        _ => [sine, -cosine],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns true if a union of intersections removes a point.
    fn removes(alternatives: &[Vec<RegionFace>], point: DVec3) -> bool {
        let inside =
            |faces: &Vec<RegionFace>| faces.iter().all(|f| f.plane.kept_height(point) < 0.0);
        alternatives.iter().any(inside)
    }

    fn wedge(from_deg: f64, to_deg: f64) -> Wedge {
        Wedge {
            origin: DVec3::new(0.3, -0.2, 0.5),
            along: DVec3::Z,
            zero: DVec3::X,
            from_deg,
            to_deg,
            min: None,
            max: None,
        }
    }

    #[test]
    fn a_wedge_removes_the_angles_between_its_faces() {
        for (from, to, count) in [
            (0.0, 90.0, 1),
            (-30.0, 45.0, 1),
            (350.0, 500.0, 1),
            (10.0, 190.0, 1),
            (0.0, 270.0, 2),
            (100.0, 459.0, 2),
            (0.0, 360.0, 1),
            (20.0, 20.0, 1),
        ] {
            let wedge = wedge(from, to);
            let alternatives = wedge.alternatives(false, Up::PlusY);
            assert_eq!(alternatives.len(), count, "{from} to {to}");
            for step in 0..720 {
                let degrees = f64::from(step) * 0.5 + 0.25;
                let turn = degrees.to_radians();
                let point = wedge.origin + DVec3::new(turn.cos(), turn.sin(), 0.7) * 2.0;
                let expected = (degrees - from).rem_euclid(360.0) < to - from;
                assert_eq!(
                    removes(&alternatives, point),
                    expected,
                    "{from} to {to} at {degrees} degrees"
                );
            }
        }
    }

    #[test]
    fn half_a_turn_has_both_faces_where_they_may_differ() {
        let names = |ragged| -> Vec<_> {
            let faces = wedge(30.0, 210.0).alternatives(ragged, Up::PlusY).concat();
            faces.iter().map(|f| f.name).collect()
        };
        assert_eq!(names(false), ["from"]);
        assert_eq!(names(true), ["from", "to"]);
    }

    #[test]
    fn right_angles_give_planes_without_rounding() {
        for (degrees, normal) in [
            (0.0, DVec3::Y),
            (90.0, DVec3::NEG_X),
            (180.0, DVec3::NEG_Y),
            (270.0, DVec3::X),
            (-90.0, DVec3::X),
            (450.0, DVec3::NEG_X),
        ] {
            let faces = wedge(degrees - 40.0, degrees).alternatives(false, Up::PlusY);
            let to = &faces[0][1];
            assert_eq!(to.name, "to");
            assert_eq!(to.plane.frame().normal, normal, "{degrees} degrees");
        }
    }

    #[test]
    fn the_ends_of_a_wedge_are_coordinates_along_its_axis() {
        let ended = Wedge {
            min: Some(-1.0),
            max: Some(0.25),
            ..wedge(0.0, 300.0)
        };
        let alternatives = ended.alternatives(false, Up::PlusY);
        let beside = ended.origin.truncate() + glam::DVec2::new(0.5, 0.5);
        for (z, expected) in [(-1.1, false), (-0.9, true), (0.2, true), (0.3, false)] {
            let found = removes(&alternatives, beside.extend(z));
            assert_eq!(found, expected, "z = {z}");
        }
        // A full turn removes everything around the axis.
        let disc = Wedge {
            to_deg: 360.0,
            ..ended
        };
        assert!(removes(
            &disc.alternatives(false, Up::PlusY),
            DVec3::new(0.0, -3.0, 0.0)
        ));
    }

    #[test]
    fn a_box_removes_what_is_between_its_faces() {
        let block = Block {
            min: [Some(-1.0), Some(0.0), None],
            max: [Some(1.0), None, Some(2.0)],
        };
        let alternatives = [block.faces(DVec3::splat(7.0), Up::PlusY)];
        let names: Vec<_> = alternatives[0].iter().map(|f| f.name).collect();
        assert_eq!(names, ["-x", "+x", "-y", "+z"]);
        for (point, expected) in [
            (DVec3::new(0.0, 9.0, -9.0), true),
            (DVec3::new(1.1, 9.0, -9.0), false),
            (DVec3::new(-1.1, 9.0, -9.0), false),
            (DVec3::new(0.0, -0.1, -9.0), false),
            (DVec3::new(0.0, 9.0, 2.1), false),
        ] {
            assert_eq!(removes(&alternatives, point), expected, "{point}");
        }
        let flat = Block {
            min: [Some(1.0); 3],
            max: [Some(2.0), Some(1.0), Some(2.0)],
        };
        assert!(flat.is_empty() && !block.is_empty(), "it has no inside");
        assert_eq!(flat.inverted_axis(), None);
        let inverted = Block {
            max: [None, None, Some(0.5)],
            ..flat
        };
        assert_eq!(inverted.inverted_axis(), Some(2));
    }
}
