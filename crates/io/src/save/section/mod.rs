//! Sections of the parts of a scene by planes, as data: the JSON of `cutaway section`, and the input of its drawings.
//!
//! Everything is in world units. A drawing shows a plane as seen from the removed side, as pictures show caps: `u` is
//! to the right and `v` up, and `u` x `v` points against the normal. `v` is as close to the scene's up axis as the plane
//! allows; in a level plane it points to the back. The origin is the projection of the world origin, so that for a plane across an axis
//! `u` and `v` are model coordinates, except for their signs.

use cutaway::scene::{Part, Up};
use cutaway::slice::{Section, SlicePlane};
use glam::{DVec2, DVec3};
use serde::{Serialize, Serializer};

mod dxf;
mod svg;

pub use dxf::dxf;
pub use svg::svg;

/// All sections of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SectionReport {
    /// Name of the scene.
    pub scene: String,
    /// Sections by plane, in the order of the cuts.
    pub sections: Vec<PlaneReport>,
}

/// The sections of all parts by one plane.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlaneReport {
    /// Name of the cut.
    pub cut: String,
    /// Face of the cut.
    pub face: SectionFace,
    /// Number of the clip-surface in the scene.
    pub clip_surface: usize,
    /// The plane, with its right and up directions.
    pub plane: DrawingPlane,
    /// True if other clip-surfaces of the cut, or other cuts, remove part of the section.
    pub trimmed: bool,
    /// Total area over all parts.
    pub area: f64,
    /// Total perimeter over all parts.
    pub perimeter: f64,
    /// Parts that the plane meets. At shared points the last part has priority.
    pub parts: Vec<PartReport>,
}

/// One of the planes of a cut.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SectionFace {
    /// Number of the plane in scene order, from 1.
    pub number: usize,
    /// Number of planes in all cuts with this name.
    pub of: usize,
    /// The plane in the notation of `--section`, rounded.
    pub plane: String,
}

/// The section of one part by one plane.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartReport {
    /// Name of the part.
    pub part: String,
    /// Colour of its cap, sRGB, `#rrggbb`.
    pub color: String,
    /// Fill rule of its loops: `even-odd` or `nonzero`.
    pub fill: String,
    /// Area enclosed by the loops.
    pub area: f64,
    /// Perimeter of the outline of that area.
    pub perimeter: f64,
    /// True if the whole outline is closed and capped.
    pub closed: bool,
    /// Closed curves; if the mesh faces outward, outlines run counter-clockwise and holes clockwise.
    pub loops: Vec<Curve>,
    /// Curves that end at open edges of the mesh.
    pub open_chains: Vec<Curve>,
    /// Defects of the mesh where the plane meets it, in words.
    pub defects: Vec<String>,
    /// Remedy for the first defect that removes part of the section.
    #[serde(skip)]
    pub help: Option<&'static str>,
}

/// A curve in a plane.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Curve {
    /// Length; for a loop, its full circumference.
    pub length: f64,
    /// Coordinates along `u` and `v`.
    pub uv: Vec<[f64; 2]>,
    /// The same points in world space.
    pub world: Vec<[f64; 3]>,
}

/// A plane with its drawing axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DrawingPlane {
    /// The point of the plane nearest to the world origin.
    #[serde(serialize_with = "as_array")]
    pub origin: DVec3,
    /// Direction to the kept side.
    #[serde(serialize_with = "as_array")]
    pub normal: DVec3,
    /// Direction to the right.
    #[serde(serialize_with = "as_array")]
    pub u: DVec3,
    /// Direction up.
    #[serde(serialize_with = "as_array")]
    pub v: DVec3,
}

fn as_array<S: Serializer>(v: &DVec3, serializer: S) -> Result<S::Ok, S::Error> {
    // Adding zero turns -0 into 0, for readers.
    (*v + DVec3::ZERO).to_array().serialize(serializer)
}

impl DrawingPlane {
    /// A plane of a scene with an up axis.
    pub fn of(plane: &SlicePlane, up: Up) -> Self {
        let normal = plane.frame.normal;
        let up = up.axis();
        let upright = (up - normal * up.dot(normal)).try_normalize();
        // In a level plane `u` is the same whether the plane is seen from above or from below.
        let level = || {
            let right = DVec3::X - normal * normal.x;
            -normal.cross(right.normalize_or(plane.frame.u_hat))
        };
        let is_level = normal.dot(up).abs() > 1.0 - 1e-12;
        let v = upright.filter(|_| !is_level).unwrap_or_else(level);
        Self {
            origin: plane.seen_from(DVec3::ZERO).zero,
            normal,
            u: normal.cross(v),
            v,
        }
    }

    /// Converts points in the plane's frame to `u` and `v`.
    fn uv(&self, plane: &SlicePlane, at: DVec2) -> [f64; 2] {
        let from_origin = plane.point(at) - self.origin;
        [self.u, self.v].map(|axis| from_origin.dot(axis) + 0.0)
    }
}

impl PlaneReport {
    /// The sections of parts by a plane, in drawing order.
    pub fn new(
        cut: &str,
        face: SectionFace,
        clip_surface: usize,
        plane: DrawingPlane,
        parts: Vec<PartReport>,
    ) -> Self {
        let total = |of: fn(&PartReport) -> f64| parts.iter().map(of).sum::<f64>() + 0.0;
        Self {
            cut: cut.to_owned(),
            face,
            trimmed: false,
            clip_surface,
            plane,
            area: total(|p| p.area),
            perimeter: total(|p| p.perimeter),
            parts,
        }
    }

    /// The name of the cut, with the number of the face if the cut has several.
    pub fn name(&self) -> String {
        let SectionFace { number, of, plane } = &self.face;
        if *of == 1 {
            self.cut.clone()
        } else {
            format!("{}, face {number} of {of} ({plane})", self.cut)
        }
    }
}

impl PartReport {
    /// Creates the report of the section of a part.
    pub fn new(part: &Part, section: &Section, plane: &SlicePlane, drawn: &DrawingPlane) -> Self {
        let curve = |points: &[u32], closed| {
            // Seen from the other side, loops run in the opposite direction.
            let seen = points.iter().rev();
            let at: Vec<DVec2> = seen.map(|i| section.points[*i as usize]).collect();
            Curve::of(&at, closed, plane, drawn)
        };
        let [r, g, b] = part.material.cap_color().to_array();
        let byte = |c: f32| (c.clamp(0.0, 1.0) * 255.0).round() as u8;
        Self {
            part: part.name.clone(),
            color: format!("#{:02x}{:02x}{:02x}", byte(r), byte(g), byte(b)),
            fill: part.fill.to_string(),
            area: section.area() + 0.0,
            perimeter: section.perimeter(),
            closed: section.is_whole(),
            loops: (section.loops.iter())
                .map(|l| curve(&l.points, true))
                .collect(),
            open_chains: section.open.iter().map(|c| curve(c, false)).collect(),
            defects: section.defects.iter().map(ToString::to_string).collect(),
            help: (section.defects.iter().find(|d| d.loses_cap())).map(|d| d.help()),
        }
    }
}

impl Curve {
    fn of(at: &[DVec2], closed: bool, plane: &SlicePlane, drawn: &DrawingPlane) -> Self {
        let steps = at.windows(2).map(|w| w[0].distance(w[1]));
        let back = match at {
            [first, .., last] if closed => first.distance(*last),
            _ => 0.0,
        };
        Self {
            length: steps.sum::<f64>() + back,
            uv: at.iter().map(|p| drawn.uv(plane, *p)).collect(),
            world: at.iter().map(|p| plane.point(*p).to_array()).collect(),
        }
    }
}
