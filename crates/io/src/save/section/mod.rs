//! Plane sections of a scene's parts as data, which are the JSON of `cutaway section` and the input of its drawings.
//!
//! Everything is in world units. A drawing shows a plane from the removed side, as pictures show caps. In it, `u` points right, `v` points
//! up, and `u` x `v` points against the normal. `v` is as close to the scene's up axis as the plane allows. In a level plane, `v` points to
//! the back. The origin is the projection of the world origin, so in a plane perpendicular to an axis, `u` and `v` are model coordinates,
//! except for their signs.

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
    /// The sections, one for each plane, in the order of the cuts.
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
    /// The plane, with the directions right and up of its drawing.
    pub plane: DrawingPlane,
    /// True if part of the section is removed by other clip-surfaces of the same cut or by other cuts.
    pub trimmed: bool,
    /// Total area over all parts.
    pub area: f64,
    /// Total perimeter over all parts.
    pub perimeter: f64,
    /// Parts that the plane meets. Where parts overlap, the last one has priority.
    pub parts: Vec<PartReport>,
}

/// One of the planes of a cut.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SectionFace {
    /// Number of the plane in scene order, from 1.
    pub number: usize,
    /// Number of planes in all cuts with this name.
    pub of: usize,
    /// The plane in the notation of `--section`, with rounded numbers.
    pub plane: String,
}

/// The section of one part by one plane.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartReport {
    /// Name of the part.
    pub part: String,
    /// Cap colour of the part, in sRGB as `#rrggbb`.
    pub color: String,
    /// Fill rule of the loops, either `even-odd` or `nonzero`.
    pub fill: String,
    /// Area enclosed by the loops.
    pub area: f64,
    /// Perimeter of the area enclosed by the loops.
    pub perimeter: f64,
    /// True if the whole outline is closed and capped.
    pub closed: bool,
    /// Closed curves. If the mesh faces outward, outlines run counter-clockwise and holes clockwise.
    pub loops: Vec<Curve>,
    /// Curves that end at open edges of the mesh.
    pub open_chains: Vec<Curve>,
    /// Straight lines of the loops, where the mesh is open and winding numbers decide what is inside.
    pub bridges: Vec<Curve>,
    /// Descriptions of the mesh defects that the plane meets.
    pub defects: Vec<String>,
    /// Remedy for the first defect because of which part of the section is missing.
    #[serde(skip)]
    pub help: Option<&'static str>,
}

/// A curve in a plane.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Curve {
    /// Length of the curve, which for a loop is its whole circumference.
    pub length: f64,
    /// Points of the curve, in coordinates `u` and `v`.
    pub uv: Vec<[f64; 2]>,
    /// Points of the curve, in world space.
    pub world: Vec<[f64; 3]>,
}

/// A plane with its drawing axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DrawingPlane {
    /// The point of the plane nearest to the world origin.
    #[serde(serialize_with = "as_array")]
    pub origin: DVec3,
    /// Normal of the plane, which points to the kept side.
    #[serde(serialize_with = "as_array")]
    pub normal: DVec3,
    /// Direction that points to the right in the drawing.
    #[serde(serialize_with = "as_array")]
    pub u: DVec3,
    /// Direction that points up in the drawing.
    #[serde(serialize_with = "as_array")]
    pub v: DVec3,
}

fn as_array<S: Serializer>(v: &DVec3, serializer: S) -> Result<S::Ok, S::Error> {
    // Adding zero turns -0 into 0, which is easier to read.
    (*v + DVec3::ZERO).to_array().serialize(serializer)
}

impl DrawingPlane {
    /// Creates the drawing axes of a plane in a scene with this up axis.
    pub fn of(plane: &SlicePlane, up: Up) -> Self {
        let normal = plane.frame.normal;
        let up = up.axis();
        let upright = (up - normal * up.dot(normal)).try_normalize();
        // In a level plane, `u` is the same direction whether the plane is seen from above or from below.
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
            // The points are reversed, because loops run in the opposite direction if seen from the other side.
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
            bridges: section.bridges.iter().map(|b| curve(b, false)).collect(),
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
