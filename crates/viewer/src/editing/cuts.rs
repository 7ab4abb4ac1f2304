//! The cuts of a document: list entries, new cuts, and moves of planes.
//!
//! A moved plane keeps its notation in the document: `z=50%` remains an axis and a percentage; a normal and an origin remain vectors.
//!
//! Cannot: move a surface given in the paper's form (`u`, `v`); its numbers have to be edited.

use cutaway::scene::{Bounds, PlaneSpec, Up};
use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::{CutDraft, Node, Value, cut, section};
use glam::DVec3;

/// Kind of the region that a cut removes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutKind {
    /// One plane.
    Plane,
    /// One plane with a relief.
    Relief,
    /// Several surfaces.
    Surfaces,
    /// A box.
    Box,
    /// A wedge between two half-planes.
    Wedge,
    /// The interior of a mesh.
    Cutter,
    /// An automatically placed wedge.
    Cutout,
    /// Everything that hides the interior.
    Breakaway,
}

impl CutKind {
    /// Name of the kind.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plane => "plane",
            Self::Relief => "relief",
            Self::Surfaces => "surfaces",
            Self::Box => "box",
            Self::Wedge => "wedge",
            Self::Cutter => "cutter",
            Self::Cutout => "cutout",
            Self::Breakaway => "breakaway",
        }
    }
}

/// List entry of a cut.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CutEntry {
    /// Name of the cut, or its number if it has no name.
    pub name: String,
    /// Kind of the region that the cut removes.
    pub kind: CutKind,
    /// True if the cut is enabled.
    pub is_enabled: bool,
}

/// The cuts of a document, in order.
pub fn cuts(document: &Document) -> Vec<CutEntry> {
    let entries = document.root().get("cut").map_or(&[] as &[_], Node::items);
    entries.iter().enumerate().map(entry).collect()
}

fn entry((index, cut): (usize, &Node)) -> CutEntry {
    let has = |key: &str| cut.get(key).is_some();
    let surfaces = cut.get("surfaces").map_or(&[] as &[_], Node::items);
    let kind = match surfaces {
        [one] if one.get("relief").is_some() => CutKind::Relief,
        [_] => CutKind::Plane,
        [_, ..] => CutKind::Surfaces,
        [] if has("box") => CutKind::Box,
        [] if has("wedge") => CutKind::Wedge,
        [] if has("cutout") => CutKind::Cutout,
        [] if has("breakaway") => CutKind::Breakaway,
        [] => CutKind::Cutter,
    };
    let named = cut.get("name").and_then(Node::text);
    CutEntry {
        name: named.map_or_else(|| index.to_string(), str::to_owned),
        kind,
        is_enabled: cut.get("enabled").is_none_or(|n| n.value != false.into()),
    }
}

/// A new cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NewCut {
    /// A plane perpendicular to an axis: 0 is x.
    Plane(usize),
    /// A plane with a relief, perpendicular to an axis: 0 is x.
    Relief(usize),
    /// The octant of the bounding box nearest to the eye.
    Box,
    /// A quarter turn about the up axis.
    Wedge,
    /// An automatically placed wedge.
    Cutout,
    /// Everything that hides the interior.
    Breakaway,
}

impl NewCut {
    /// Creates the cut. It removes the side that faces the eye.
    pub fn draft(self, forward: DVec3, up: Up) -> CutDraft {
        let across = |axis: usize| section(&facing(DVec3::AXES[axis], forward));
        match self {
            Self::Plane(axis) => cut([across(axis)]),
            Self::Relief(axis) => cut([across(axis).relief("fractal:amplitude=4%,seed=7")]),
            Self::Box => {
                let sides = forward.to_array().map(|f| match f < 0.0 {
                    true => ["50%", "100%"],
                    false => ["0%", "50%"],
                });
                let corner = |end: usize| sides.map(|s| s[end]).join(",");
                cut([]).block(&format!("{}:{}", corner(0), corner(1)))
            }
            Self::Wedge => {
                // Angle of the eye's direction: counted from z about +Y, and from x about +Z.
                let (axis, across, along) = match up {
                    Up::PlusY => ("y", forward.x, forward.z),
                    Up::PlusZ => ("z", forward.y, forward.x),
                };
                let middle = (-across).atan2(-along).to_degrees().round();
                let [from, to] = [middle - 45.0, middle + 45.0];
                cut([]).wedge(&format!("{axis}:{from}:{to}"))
            }
            Self::Cutout => cut([]).cutout(""),
            Self::Breakaway => cut([]).breakaway(""),
        }
    }
}

/// The plane through the model's middle whose removed side faces the eye.
fn facing(axis: DVec3, forward: DVec3) -> String {
    let letter = ["x", "y", "z"][(axis.y + 2.0 * axis.z) as usize];
    let minus = if forward.dot(axis) < 0.0 { "-" } else { "" };
    format!("{minus}{letter}=50%")
}

/// A move of a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlaneMove {
    /// Along its normal, in world units.
    Along(f64),
    /// Along its normal, to a distance from the world origin, in world units.
    To(f64),
    /// Along its normal, as a fraction of the model's size.
    Step(f64),
    /// Perpendicular to an axis, through its present position. If it already is perpendicular, it keeps the other side.
    Across(usize),
    /// Keeps the other side.
    Flip,
    /// Turns it about its present position, to a new normal.
    Turn(DVec3),
    /// Through a point, with a normal.
    Through(DVec3, DVec3),
    /// Rotates its relief within the plane, to an angle in degrees.
    Spin(f64),
    /// As [`PlaneMove::Through`], during a drag.
    Tilt(DVec3, DVec3),
}

/// A surface of a cut, and its notation.
struct CutSurface {
    path: String,
    words: SurfaceNotation,
}

enum SurfaceNotation {
    Section(PlaneSpec),
    Vectors { normal: DVec3, origin: DVec3 },
}

impl CutSurface {
    fn find(document: &Document, cut: usize, surface: usize) -> Result<Self> {
        let path = format!("cut.{cut}.surfaces.{surface}");
        let node = document.get(&path)?;
        let vector = |key: &str| node.get(key).and_then(|n| vector(&n.value));
        let section = node.get("section").and_then(Node::text);
        let words = match (section, vector("normal")) {
            (Some(text), _) => SurfaceNotation::Section(PlaneSpec::parse(text)?),
            (None, Some(normal)) => SurfaceNotation::Vectors {
                normal,
                origin: vector("origin").unwrap_or_default(),
            },
            (None, None) => {
                return Err(Error::input(
                    format!("`{path}`"),
                    "a surface given by u and v cannot be moved by dragging",
                    "give it as a section, or as a normal and an origin",
                ));
            }
        };
        Ok(Self { path, words })
    }

    /// The unit normal of the surface's plane, and a point on it.
    fn plane(&self, bounds: &Bounds) -> Result<(DVec3, DVec3)> {
        match &self.words {
            SurfaceNotation::Section(spec) => {
                let surface = spec.surface(bounds, Up::PlusY)?;
                Ok((surface.frame().normal, surface.origin))
            }
            SurfaceNotation::Vectors { normal, origin } => {
                Ok((normal.normalize_or(DVec3::Z), *origin))
            }
        }
    }
}

/// The plane of a cut's first surface: the normal, which points to the kept side, and a point on the plane.
///
/// # Errors
///
/// The surface does not exist, or is invalid for these bounds.
pub fn plane(document: &Document, cut: usize, bounds: &Bounds) -> Result<(DVec3, DVec3)> {
    let surface = CutSurface::find(document, cut, 0)?;
    let (normal, origin) = surface.plane(bounds)?;
    let is_flipped = is_flipped(document, &surface.path);
    Ok((if is_flipped { -normal } else { normal }, origin))
}

/// The axis about which a cut's first surface is rotated, as in the document, and the angle in degrees; `None` for a surface
/// without a relief, where a rotation has no effect.
pub fn spin(document: &Document, cut: usize, bounds: &Bounds) -> Option<(DVec3, f64)> {
    let surface = CutSurface::find(document, cut, 0).ok()?;
    let node = document.get(&surface.path).ok()?;
    node.get("relief")?;
    let degrees = match node.get("spin_deg").map(|n| &n.value) {
        Some(Value::Number(degrees)) => degrees.value,
        _ => 0.0,
    };
    let (normal, _) = surface.plane(bounds).ok()?;
    Some((normal, degrees))
}

/// Returns true if a surface keeps the side opposite to the one that its plane's notation keeps.
fn is_flipped(document: &Document, surface: &str) -> bool {
    let flip = document.get(&format!("{surface}.flip"));
    flip.is_ok_and(|n| n.value == true.into())
}

/// Moves the first plane of a cut.
///
/// # Errors
///
/// The same errors as [`plane`].
pub fn move_plane(
    document: &mut Document,
    cut: usize,
    by: PlaneMove,
    bounds: &Bounds,
) -> Result<()> {
    let was = plane(document, cut, bounds)?;
    let CutSurface { path, words } = CutSurface::find(document, cut, 0)?;
    if let PlaneMove::Spin(degrees) = by {
        return document.set(&format!("{path}.spin_deg"), degrees);
    }
    let mut spec = match &words {
        SurfaceNotation::Section(spec) => spec.clone(),
        SurfaceNotation::Vectors { normal, origin } => PlaneSpec::through(*origin, *normal)?,
    };
    // The new notation gives the kept side, so `flip` is removed.
    let flip = format!("{path}.flip");
    if is_flipped(document, &path) {
        spec = spec.flipped();
    }
    document.remove(&flip)?;
    let moved = match by {
        PlaneMove::Along(distance) => spec.moved(distance, bounds),
        PlaneMove::To(distance) => spec.moved(distance - was.1.dot(was.0), bounds),
        PlaneMove::Step(share) => {
            let extent = (bounds.max - bounds.min).dot(was.0.abs());
            spec.moved(share * extent, bounds)
        }
        PlaneMove::Across(axis) if was.0.dot(DVec3::AXES[axis]).abs() > 1.0 - 1e-9 => {
            spec.flipped()
        }
        PlaneMove::Across(axis) => {
            let towards = DVec3::AXES[axis];
            let sign = if was.0.dot(towards) < 0.0 { -1.0 } else { 1.0 };
            spec.turned(towards * sign, bounds)?
        }
        PlaneMove::Flip => spec.flipped(),
        PlaneMove::Turn(normal) => spec.turned(normal, bounds)?,
        PlaneMove::Spin(_) => spec,
        PlaneMove::Through(point, normal) | PlaneMove::Tilt(point, normal) => {
            PlaneSpec::through(point, normal)?.turned(normal, bounds)?
        }
    };
    match words {
        SurfaceNotation::Section(_) => document.set(&format!("{path}.section"), moved.to_string()),
        SurfaceNotation::Vectors { .. } => {
            let surface = moved.surface(bounds, Up::PlusY)?;
            let list = |v: DVec3| Value::from(v.to_array().to_vec());
            document.set(&format!("{path}.normal"), list(surface.frame().normal))?;
            document.set(&format!("{path}.origin"), list(surface.origin))
        }
    }
}

fn vector(value: &Value) -> Option<DVec3> {
    let Value::List(list) = value else {
        return None;
    };
    let number = |node: &Node| match &node.value {
        Value::Number(number) => Some(number.value),
        _ => None,
    };
    let numbers: Option<Vec<f64>> = list.iter().map(number).collect();
    Some(DVec3::from_array(numbers?.try_into().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway_io::document::part;

    fn document(surface: &str) -> Document {
        let text = format!("[[part]]\nshape = \"cube\"\n\n[[cut]]\nsurfaces = [{{ {surface} }}]\n");
        Document::parse("scene.toml", &text).expect("a scene")
    }

    #[test]
    fn planes_are_moved_in_their_own_words() {
        let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(3.0)]);
        for (surface, by, expected) in [
            (
                "section = \"z=50%\"",
                PlaneMove::Along(1.0),
                "section = \"z=75%\"",
            ),
            (
                "section = \"-x=50%\"",
                PlaneMove::Step(0.1),
                "section = \"-x=40%\"",
            ),
            (
                "section = \"z=50%\"",
                PlaneMove::Flip,
                "section = \"-z=50%\"",
            ),
            (
                "section = \"z=50%\"",
                PlaneMove::Across(0),
                "section = \"x=50%\"",
            ),
            (
                "section = \"-x=25%\"",
                PlaneMove::Across(0),
                "section = \"x=25%\"",
            ),
            (
                "section = \"z=50%\", flip = true",
                PlaneMove::Along(1.0),
                "section = \"-z=25%\"",
            ),
            (
                "normal = [0, 0, 2], origin = [0, 0, 1]",
                PlaneMove::Along(0.5),
                "normal = [0.0, 0.0, 1.0], origin = [0.0, 0.0, 1.5]",
            ),
        ] {
            let mut document = document(surface);
            let before = plane(&document, 0, &bounds).expect(surface);
            move_plane(&mut document, 0, by, &bounds).expect(surface);
            assert!(document.to_string().contains(expected), "{document}");
            let after = plane(&document, 0, &bounds).expect(surface);
            if let PlaneMove::Along(distance) = by {
                let moved = (after.1 - before.1).dot(before.0);
                assert!((moved - distance).abs() < 1e-9, "{surface}: {moved}");
            }
        }
        let mut own = document("u = [1, 0, 0], v = [0, 1, 0]");
        let refused = move_plane(&mut own, 0, PlaneMove::Flip, &bounds);
        assert!(refused.is_err(), "of the paper's form");
    }

    #[test]
    fn new_cuts_open_to_the_eye() {
        let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        for forward in [DVec3::new(-1.0, -0.5, -0.7), DVec3::new(0.3, 0.8, 0.2)] {
            for axis in 0..3 {
                let mut document = Document::new();
                document.add_part(part("shape:cube")).expect("a part");
                let draft = NewCut::Plane(axis).draft(forward, Up::PlusY);
                document.add_cut(draft).expect("a cut");
                let (normal, _) = plane(&document, 0, &bounds).expect("a plane");
                assert!(normal.dot(forward) > 0.0, "{normal} from {forward}");
            }
        }
    }
}
