//! Sections: planes written as one word on the command line or in the scene file.
//!
//! ```text
//! z=10          the plane at z = 10, keeping z > 10; -z=10 keeps z < 10
//! z=50%         halfway through the bounds
//! nx,ny,nz@px,py,pz   through a point; each coordinate may be a percentage of the bounds
//! nx,ny,nz,d    nx x + ny y + nz z = d
//! ```
//!
//! The side that the normal points to is kept. Normals may have any length; a normal along an axis gives the surface's frame without
//! rounding.

use std::fmt;

use glam::DVec3;

use crate::error::{Error, Result};
use crate::scene::units::amount::Amount;
use crate::scene::units::decimals::to_decimals;
use crate::scene::units::range::LARGEST;
use crate::scene::{Bounds, ClipSurface, Up};

const EXAMPLES: &str =
    "write for example `z=10`, `-x=50%`, `0,1,1@0,0,5` (normal @ point) or `0,1,1,5` (ax+by+cz=d)";

#[derive(Clone, Copy, Debug, PartialEq)]
enum PlaneNotation {
    Axis { axis: usize, sign: f64, at: Amount },
    Point { normal: DVec3, point: [Amount; 3] },
    Offset { normal: DVec3, offset: f64 },
}

/// A section as the user wrote it; percentages are resolved once the bounds are known.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneSpec {
    text: String,
    plane: PlaneNotation,
}

impl PlaneSpec {
    /// Reads a spec.
    pub fn parse(text: &str) -> Result<Self> {
        parse_plane(text.trim())
            .map(|plane| Self {
                text: text.to_owned(),
                plane,
            })
            .map_err(|what| Error::input(format!("section `{text}`"), what, EXAMPLES))
    }

    /// The plane through a point; the normal points to the kept side and may have any length.
    pub fn through(point: DVec3, normal: DVec3) -> Result<Self> {
        let text = format!("{}@{}", listed(normal), listed(point));
        if normal == DVec3::ZERO {
            let help = "give it a direction, for example [0, 0, 1]";
            return Err(Error::input(
                format!("section `{text}`"),
                "the normal is zero",
                help,
            ));
        }
        let point = point.to_array().map(Amount::Units);
        let plane = PlaneNotation::Point { normal, point };
        Ok(Self { text, plane })
    }

    /// The plane in world space, upright with respect to an up axis. If the spec gives no origin, the plane's point nearest to the centre
    /// of the bounds is used.
    pub fn surface(&self, bounds: &Bounds, up: Up) -> Result<ClipSurface> {
        let percent = |a: &Amount| matches!(a, Amount::Percent(_));
        let relative = match &self.plane {
            PlaneNotation::Axis { at, .. } => percent(at),
            PlaneNotation::Point { point, .. } => point.iter().any(percent),
            PlaneNotation::Offset { .. } => false,
        };
        let fault = |what: &str, help: &str| {
            Err(Error::input(format!("section `{}`", self.text), what, help))
        };
        if relative && bounds.is_empty() {
            return fault(
                "a percentage needs bounds, but there is no part",
                "give the position in scene units, or add a part",
            );
        }
        let middle = bounds.centre();
        let (origin, normal) = match self.plane {
            PlaneNotation::Axis { axis, sign, at } => {
                let mut origin = middle;
                origin[axis] = at.between(bounds.min[axis], bounds.max[axis]);
                (origin, DVec3::AXES[axis] * sign)
            }
            PlaneNotation::Point { normal, point } => {
                let at = |i: usize| point[i].between(bounds.min[i], bounds.max[i]);
                (DVec3::new(at(0), at(1), at(2)), unit(normal))
            }
            PlaneNotation::Offset { normal, offset } => {
                (foot(middle, normal, offset), unit(normal))
            }
        };
        // Written so that NaN fails, too.
        if !origin.to_array().iter().all(|c| c.abs() <= LARGEST) {
            return fault(
                "the plane is too far away to compute with",
                "use a longer normal or a smaller distance",
            );
        }
        Ok(ClipSurface::upright(origin, normal, up))
    }
}

/// Number of decimals of a moved plane's percentages.
const PERCENT_DECIMALS: i32 = 3;
/// The lengths that describe a moved plane are rounded to this share of the model's size.
const FINEST_SHARE: f64 = 1e-6;

impl PlaneSpec {
    /// The same plane, moved along its normal by a distance in world units. Percentages stay percentages, rounded to steps that a user
    /// can notice.
    #[must_use]
    pub fn moved(&self, distance: f64, bounds: &Bounds) -> Self {
        let moved = |at: Amount, by: f64, axis: usize| match at {
            Amount::Units(v) => Amount::Units(rounded(v + by, bounds)),
            Amount::Percent(p) => {
                let share = by / (bounds.max[axis] - bounds.min[axis]);
                let percent = p + 100.0 * if share.is_finite() { share } else { 0.0 };
                Amount::Percent(to_decimals(percent, PERCENT_DECIMALS))
            }
        };
        Self::new(match self.plane {
            PlaneNotation::Axis { axis, sign, at } => PlaneNotation::Axis {
                axis,
                sign,
                at: moved(at, sign * distance, axis),
            },
            PlaneNotation::Point { normal, point } => {
                let by = unit(normal) * distance;
                let at = |i: usize| moved(point[i], by[i], i);
                PlaneNotation::Point {
                    normal,
                    point: [at(0), at(1), at(2)],
                }
            }
            PlaneNotation::Offset { normal, offset } => PlaneNotation::Offset {
                normal,
                offset: rounded(offset + distance * normal.length(), bounds),
            },
        })
    }

    /// The same plane, keeping the other side.
    #[must_use]
    pub fn flipped(&self) -> Self {
        Self::new(match self.plane {
            PlaneNotation::Axis { axis, sign, at } => PlaneNotation::Axis {
                axis,
                sign: -sign,
                at,
            },
            PlaneNotation::Point { normal, point } => PlaneNotation::Point {
                // Zero is written without a sign.
                normal: DVec3::ZERO - normal,
                point,
            },
            PlaneNotation::Offset { normal, offset } => PlaneNotation::Offset {
                normal: DVec3::ZERO - normal,
                offset: 0.0 - offset,
            },
        })
    }

    /// A plane with another normal, through the point of this one nearest to the centre of the bounds. Along an axis its position is
    /// given in percent.
    ///
    /// # Errors
    ///
    /// If the plane is invalid for these bounds.
    pub fn turned(&self, normal: DVec3, bounds: &Bounds) -> Result<Self> {
        let through = self.surface(bounds, Up::PlusY)?.origin;
        let normal = unit(normal);
        let axis = (0..3).find(|i| normal[*i].abs() > 1.0 - 1e-9);
        let extent = bounds.max - bounds.min;
        Ok(Self::new(match axis.filter(|i| extent[*i] > 0.0) {
            Some(axis) => {
                let percent = (through[axis] - bounds.min[axis]) / extent[axis] * 100.0;
                let at = Amount::Percent(to_decimals(percent, PERCENT_DECIMALS));
                let sign = normal[axis].signum();
                PlaneNotation::Axis { axis, sign, at }
            }
            None => PlaneNotation::Point {
                normal: DVec3::from_array(normal.to_array().map(|c| to_decimals(c, 6))),
                point: through
                    .to_array()
                    .map(|c| Amount::Units(rounded(c, bounds))),
            },
        }))
    }

    fn new(plane: PlaneNotation) -> Self {
        let text = plane.to_string();
        Self { text, plane }
    }
}

/// Writes the plane in the form that `--section` accepts.
impl fmt::Display for PlaneSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl fmt::Display for PlaneNotation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Axis { axis, sign, at } => {
                let minus = if *sign < 0.0 { "-" } else { "" };
                write!(f, "{minus}{}={at}", ["x", "y", "z"][*axis])
            }
            Self::Point { normal, point } => {
                let [x, y, z] = point;
                write!(f, "{}@{x},{y},{z}", listed(*normal))
            }
            Self::Offset { normal, offset } => write!(f, "{},{offset}", listed(*normal)),
        }
    }
}

/// A length rounded to the smallest step that matters in a model of this size.
fn rounded(length: f64, bounds: &Bounds) -> f64 {
    let finest = (bounds.max - bounds.min).max_element() * FINEST_SHARE;
    match finest > 0.0 && finest.is_finite() {
        true => to_decimals(length, -(finest.log10().floor() as i32)),
        false => length,
    }
}

impl ClipSurface {
    /// The plane of a spec, as accepted by `--section`, with +Y up: [`PlaneSpec::parse`] and [`PlaneSpec::surface`] in one. Percentages
    /// refer to `bounds`, the box of the geometry that is cut.
    ///
    /// # Errors
    ///
    /// If the text is invalid, or uses percentages and `bounds` is empty.
    pub fn parse(text: &str, bounds: &Bounds) -> Result<Self> {
        PlaneSpec::parse(text)?.surface(bounds, Up::PlusY)
    }

    /// Returns true if the surface, at every height its relief can have, misses a box: then it removes nothing or everything in the
    /// box. A surface that only touches the box does not miss it.
    pub fn misses(&self, bounds: &Bounds) -> bool {
        if bounds.is_empty() {
            return true;
        }
        let normal = self.frame().normal;
        let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
        for corner in bounds.corners() {
            let height = (corner - self.origin).dot(normal);
            least = least.min(height);
            most = most.max(height);
        }
        let slab = self.relief.as_ref().map_or([0.0; 2], |map| {
            map.range().map(|h| f64::from(h) * self.scale.z)
        });
        least + slab[0].min(slab[1]) > 0.0 || most + slab[0].max(slab[1]) < 0.0
    }
}

fn parse_plane(text: &str) -> Result<PlaneNotation, String> {
    if let Some((axis, at)) = text.split_once('=') {
        let axis = axis.trim();
        let (sign, letter) = match axis.strip_prefix('-') {
            Some(letter) => (-1.0, letter),
            None => (1.0, axis.strip_prefix('+').unwrap_or(axis)),
        };
        let axis = match letter {
            "x" | "X" => 0,
            "y" | "Y" => 1,
            "z" | "Z" => 2,
            _ => return Err(format!("`{axis}` is not an axis")),
        };
        let at = Amount::parse(at)?;
        return Ok(PlaneNotation::Axis { axis, sign, at });
    }
    if let Some((normal, point)) = text.split_once('@') {
        let point = list(point)?;
        let [x, y, z] = point[..] else {
            return Err(format!("the point has {} coordinates, not 3", point.len()));
        };
        return Ok(PlaneNotation::Point {
            normal: direction(&list(normal)?)?,
            point: [x, y, z],
        });
    }
    let numbers = list(text)?;
    let [.., Amount::Units(offset)] = numbers[..] else {
        return Err("the distance of a plane cannot be a percentage".into());
    };
    if numbers.len() != 4 {
        return Err(format!(
            "a plane without `=` and `@` has 4 numbers, not {}",
            numbers.len()
        ));
    }
    Ok(PlaneNotation::Offset {
        normal: direction(&numbers[..3])?,
        offset,
    })
}

fn listed(v: DVec3) -> String {
    v.to_array().map(|c| c.to_string()).join(",")
}

fn list(text: &str) -> Result<Vec<Amount>, String> {
    text.split(',').map(Amount::parse).collect()
}

fn direction(numbers: &[Amount]) -> Result<DVec3, String> {
    let [Amount::Units(x), Amount::Units(y), Amount::Units(z)] = *numbers else {
        return Err("a normal is 3 numbers, not percentages".into());
    };
    let normal = DVec3::new(x, y, z);
    if normal == DVec3::ZERO {
        return Err("the normal is zero".into());
    }
    Ok(normal)
}

/// Normalises any finite vector except zero. The largest component is scaled to 1 first, so nothing overflows.
fn unit(v: DVec3) -> DVec3 {
    (v / v.abs().max_element()).normalize()
}

/// The point of a plane nearest to `p`. If the normal is an axis, the coordinate along it is exactly the plane's.
fn foot(p: DVec3, normal: DVec3, offset: f64) -> DVec3 {
    for axis in 0..3 {
        if normal == DVec3::AXES[axis] * normal[axis] {
            let mut foot = p;
            foot[axis] = offset / normal[axis];
            return foot;
        }
    }
    let greatest = normal.abs().max_element();
    let n = normal / greatest;
    p + n * ((offset / greatest - p.dot(n)) / n.length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds() -> Bounds {
        Bounds {
            min: DVec3::new(-1.0, 0.1, 2.0),
            max: DVec3::new(3.0, 0.7, 12.0),
        }
    }

    fn surface(text: &str) -> ClipSurface {
        ClipSurface::parse(text, &bounds()).expect(text)
    }

    #[test]
    fn every_form_gives_the_plane_it_says() {
        for (text, point, normal) in [
            ("z=10", DVec3::new(5.0, 5.0, 10.0), DVec3::Z),
            (" Z = 1e1 ", DVec3::new(5.0, 5.0, 10.0), DVec3::Z),
            ("-z=10", DVec3::new(5.0, 5.0, 10.0), DVec3::NEG_Z),
            ("x=-0.5", DVec3::new(-0.5, 9.0, 9.0), DVec3::X),
            ("x=50%", DVec3::new(1.0, 9.0, 9.0), DVec3::X),
            ("y=0%", DVec3::new(0.0, 0.1, 0.0), DVec3::Y),
            ("y=100%", DVec3::new(0.0, 0.7, 0.0), DVec3::Y),
            ("0,0,-2,-10", DVec3::new(1.0, 1.0, 5.0), DVec3::NEG_Z),
            ("0,3,0@1,2,3", DVec3::new(7.0, 2.0, 8.0), DVec3::Y),
            ("0,0,1@50%,50%,25%", DVec3::new(0.0, 0.0, 4.5), DVec3::Z),
        ] {
            let s = surface(text);
            assert_eq!(s.frame().normal, normal, "normal of {text}");
            assert_eq!(s.kept_height(point), 0.0, "{point} is on {text}");
            assert!(
                s.kept_height(point + normal) > 0.0,
                "{text} keeps its normal's side"
            );
            assert!(
                s.kept_height(point - normal) < 0.0,
                "{text} removes the other side"
            );
        }
        for text in [
            "1,2,3,4",
            "1,2,3@4,0,0",
            "1e200,2e200,3e200,4e200",
            "1e-200,2e-200,3e-200,4e-200",
        ] {
            let s = surface(text);
            for p in [DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 2.0, 0.0)] {
                assert!(s.kept_height(p).abs() < 1e-14, "{p} is on {text}");
            }
            assert!(
                s.kept_height(DVec3::splat(9.0)) > 0.0,
                "{text} keeps its normal's side"
            );
        }
    }

    #[test]
    fn a_plane_misses_what_it_does_not_touch() {
        for (text, misses) in [
            ("z=1.999", true),
            ("z=2", false),
            ("z=7", false),
            ("z=100%", false),
            ("z=120%", true),
            ("-z=12.001", true),
            ("1,1,1,-100", true),
        ] {
            assert_eq!(surface(text).misses(&bounds()), misses, "{text}");
        }
    }

    #[test]
    fn a_relief_reaches_as_far_as_its_heights() {
        let map = crate::scene::OffsetMap::new([2, 1], vec![0.0, 1.0]).expect("a plain map");
        // The surface lies between z = 1 - Sz and z = 1; the box begins at 2.
        for (height, misses) in [(3.0, true), (-0.9, true), (-1.1, false), (-20.0, false)] {
            let mut s = surface("z=1");
            s.relief = Some(std::sync::Arc::new(map.clone()));
            s.scale.z = height;
            assert_eq!(s.misses(&bounds()), misses, "height {height}");
        }
    }

    #[test]
    fn planes_are_moved_flipped_and_turned_in_their_own_words() {
        let bounds = bounds();
        for (text, distance, moved, flipped) in [
            ("z=50%", 1.0, "z=60%", "-z=60%"),
            ("-z=50%", 1.0, "-z=40%", "z=40%"),
            ("x=0.5", 0.25, "x=0.75", "-x=0.75"),
            ("0,0,-2,-10", 1.0, "0,0,-2,-8", "0,0,2,8"),
            (
                "0,0,1@50%,50%,25%",
                0.5,
                "0,0,1@50%,50%,30%",
                "0,0,-1@50%,50%,30%",
            ),
            ("0,3,0@1,2,3", -0.5, "0,3,0@1,1.5,3", "0,-3,0@1,1.5,3"),
        ] {
            let spec = PlaneSpec::parse(text).expect(text);
            let other = spec.moved(distance, &bounds);
            assert_eq!(other.to_string(), moved, "{text}");
            let [was, is] = [text, moved].map(surface);
            let normal = was.frame().normal;
            let apart = (is.origin - was.origin).dot(normal);
            assert!((apart - distance).abs() < 1e-9, "{text} moved by {apart}");
            assert_eq!(is.frame().normal, normal, "{text}");
            assert_eq!(other.flipped().to_string(), flipped, "{text}");
            let back = surface(flipped);
            assert_eq!(back.frame().normal, -normal, "{text}");
            assert!(back.kept_height(is.origin).abs() < 1e-12, "{text}");
        }
        for (text, normal, turned) in [
            ("z=50%", DVec3::X, "x=50%"),
            ("z=25%", DVec3::NEG_Z, "-z=25%"),
            (
                "x=0",
                DVec3::new(1.0, 1.0, 0.0),
                "0.707107,0.707107,0@0,0.4,7",
            ),
        ] {
            let spec = PlaneSpec::parse(text).expect(text);
            let turned_to = spec.turned(normal, &bounds).expect(text);
            assert_eq!(turned_to.to_string(), turned, "{text}");
        }
        let third = PlaneSpec::parse("x=0%").expect("a plane");
        let third = third.moved(4.0 / 3.0, &bounds);
        assert_eq!(third.to_string(), "x=33.333%", "what a hand can tell");
    }

    #[test]
    fn percentages_without_bounds_are_refused() {
        assert!(
            ClipSurface::parse("z=50%", &Bounds::EMPTY).is_err(),
            "percent of nothing"
        );
        assert!(
            ClipSurface::parse("z=50", &Bounds::EMPTY).is_ok(),
            "no bounds are needed"
        );
    }
}
