//! Sections of the parts of a scene by planes, as data: the JSON of `cutaway section`, and the input of its drawings.
//!
//! Everything is in world units. A drawing shows a plane as it is seen from the side that is removed, as pictures show caps: `u` is
//! to the right and `v` up, and `u` x `v` points against the normal. `v` is as near to the up axis of the scene as the plane
//! allows, in a level plane to what lies behind. The origin is the foot of the world's own, so that across an axis `u` and `v` are
//! coordinates of the model, but for a sign.

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
    /// By plane, in the order of the cuts.
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
    pub plane: Drawn,
    /// True if the other clip-surfaces of the cut, or other cuts, leave less of the section than the plane meets.
    pub trimmed: bool,
    /// Sum over the parts.
    pub area: f64,
    /// Sum over the parts.
    pub perimeter: f64,
    /// Parts that the plane meets. The part with priority at shared points comes last.
    pub parts: Vec<PartReport>,
}

/// One of the planes of a cut.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SectionFace {
    /// Counted from 1, in the order of the scene.
    pub number: usize,
    /// Number of planes of the cut, with those of other cuts of its name.
    pub of: usize,
    /// The plane as `--section` takes it, rounded.
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
    /// Area that they enclose.
    pub area: f64,
    /// Perimeter of the outline of that area.
    pub perimeter: f64,
    /// True if all of the outline is closed and capped.
    pub closed: bool,
    /// Closed curves; of a mesh that faces outward outlines run counter-clockwise and holes clockwise.
    pub loops: Vec<Curve>,
    /// Curves that end where the mesh does.
    pub open_chains: Vec<Curve>,
    /// Defects of the mesh where the plane meets it, in words.
    pub defects: Vec<String>,
    /// Remedy for the first of them that takes something of the section away.
    #[serde(skip)]
    pub help: Option<&'static str>,
}

/// A curve in a plane.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Curve {
    /// Length; of a loop once round.
    pub length: f64,
    /// Coordinates along `u` and `v`.
    pub uv: Vec<[f64; 2]>,
    /// The same points in world space.
    pub world: Vec<[f64; 3]>,
}

/// A plane as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Drawn {
    /// The point of the plane next to the origin of the world.
    #[serde(serialize_with = "as_array")]
    pub origin: DVec3,
    /// Toward the side that is kept.
    #[serde(serialize_with = "as_array")]
    pub normal: DVec3,
    /// To the right.
    #[serde(serialize_with = "as_array")]
    pub u: DVec3,
    /// Up.
    #[serde(serialize_with = "as_array")]
    pub v: DVec3,
}

fn as_array<S: Serializer>(v: &DVec3, serializer: S) -> Result<S::Ok, S::Error> {
    // Adding zero turns -0 into 0, which readers are spared.
    (*v + DVec3::ZERO).to_array().serialize(serializer)
}

impl Drawn {
    /// A plane of a scene with an up axis.
    pub fn of(plane: &SlicePlane, up: Up) -> Self {
        let normal = plane.frame.normal;
        let up = up.axis();
        let upright = (up - normal * up.dot(normal)).try_normalize();
        // In a level plane the right is that of the world, whether it is seen from above or from below.
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

    /// Coordinates of points of the plane that are given in its frame.
    fn uv(&self, plane: &SlicePlane, at: DVec2) -> [f64; 2] {
        let from_origin = plane.point(at) - self.origin;
        [self.u, self.v].map(|axis| from_origin.dot(axis) + 0.0)
    }
}

impl PlaneReport {
    /// The sections of parts by a plane, in the order that they are drawn in.
    pub fn new(
        cut: &str,
        face: SectionFace,
        clip_surface: usize,
        plane: Drawn,
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

    /// The name of the cut, and which of its faces this is where it has several.
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
    pub fn new(part: &Part, section: &Section, plane: &SlicePlane, drawn: &Drawn) -> Self {
        let curve = |points: &[u32], closed| {
            // Seen from the other side loops run the other way round.
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
    fn of(at: &[DVec2], closed: bool, plane: &SlicePlane, drawn: &Drawn) -> Self {
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
