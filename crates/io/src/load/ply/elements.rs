//! What the rows of the elements of a PLY become: vertices, and triangles of faces and strips.

use cutaway::scene::weld::has_three;
use cutaway::scene::{Mesh, TexturedTriangle, VertexPaint};
use glam::{DVec3, Vec3};
use ply_rs_bw::ply::{ElementDef, PropertyDef, PropertyType, ScalarType};

/// Properties of a vertex, in the order in which they are kept. Of colours, red comes first.
const VERTEX_PROPERTIES: [&str; 9] = ["x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"];

/// Name used here for the property that lists the corners of a face or a strip.
pub(super) const CORNERS: &str = "vertex_indices";

/// Returns true for the property that lists the corners of a face or a strip.
pub(super) fn lists_corners(property: &PropertyDef) -> bool {
    property.name == CORNERS && matches!(property.data_type, PropertyType::List(..))
}

/// Receiver of the rows of an element, or of a share of them.
pub(super) trait Rows: Send + Sized {
    /// Begins a row.
    fn begin(&mut self);

    /// Returns true if the property in this column is used.
    fn wants(&self, column: usize) -> bool;

    /// Takes the values of a property that is used: one of a scalar, any number of a list. The error's text says what is wrong.
    fn property(&mut self, column: usize, kind: &ScalarType, values: &[f64]) -> Result<(), String>;

    /// Joins receivers of consecutive rows.
    fn joined(shares: Vec<Self>) -> Self;
}

/// The element `vertex`.
#[derive(Clone, Debug, Default)]
pub(super) struct Vertices {
    /// For each column, its place in [`VERTEX_PROPERTIES`].
    property_of_column: Vec<Option<usize>>,
    has_normals: bool,
    has_colors: bool,
    positions: Vec<DVec3>,
    /// Without entries if a vertex has no complete normal.
    normals: Vec<Vec3>,
    /// Colours in sRGB, without entries if a vertex has no complete colour. In the file, integer channels range from 0 to the largest value
    /// of their type, and others from 0 to 1.
    colors: Vec<[u8; 4]>,
}

impl Vertices {
    pub(super) fn of(element: &ElementDef) -> Self {
        let place = |property: &PropertyDef| {
            let is_scalar = matches!(property.data_type, PropertyType::Scalar(_));
            let place = VERTEX_PROPERTIES
                .iter()
                .position(|known| *known == property.name);
            place.filter(|_| is_scalar)
        };
        let property_of_column: Vec<_> = element.properties.values().map(place).collect();
        let has = |places: [usize; 3]| {
            let mut places = places.into_iter();
            places.all(|place| property_of_column.contains(&Some(place)))
        };
        Self {
            has_normals: has([3, 4, 5]),
            has_colors: has([6, 7, 8]),
            property_of_column,
            ..Self::default()
        }
    }

    pub(super) fn len(&self) -> usize {
        self.positions.len()
    }
}

impl Rows for Vertices {
    fn begin(&mut self) {
        self.positions.push(DVec3::ZERO);
        if self.has_normals {
            self.normals.push(Vec3::ZERO);
        }
        if self.has_colors {
            self.colors.push([0; 4]);
        }
    }

    fn wants(&self, column: usize) -> bool {
        self.property_of_column[column].is_some()
    }

    fn property(&mut self, column: usize, kind: &ScalarType, values: &[f64]) -> Result<(), String> {
        let (Some(place), [value]) = (self.property_of_column[column], values) else {
            return Ok(());
        };
        match place {
            0..3 => {
                if let Some(position) = self.positions.last_mut() {
                    position[place] = *value;
                }
            }
            3..6 => {
                if let Some(normal) = self.normals.last_mut() {
                    normal[place - 3] = *value as f32;
                }
            }
            _ => {
                if let (Some(color), Some(value)) = (self.colors.last_mut(), channel(kind, *value))
                {
                    color[place - 6] = value;
                }
            }
        }
        Ok(())
    }

    fn joined(shares: Vec<Self>) -> Self {
        let count: usize = shares.iter().map(Self::len).sum();
        let mut shares = shares.into_iter();
        let mut all = shares.next().unwrap_or_default();
        all.positions.reserve_exact(count - all.positions.len());
        for share in shares {
            all.positions.extend(share.positions);
            all.normals.extend(share.normals);
            all.colors.extend(share.colors);
        }
        all
    }
}

/// A channel of a colour, or `None` for number types in which no colours are written.
fn channel(kind: &ScalarType, value: f64) -> Option<u8> {
    match kind {
        ScalarType::UChar => Some(value as u8),
        ScalarType::UShort => Some((value as u16 >> 8) as u8),
        ScalarType::Float | ScalarType::Double => {
            Some((value.clamp(0.0, 1.0) * 255.0).round() as u8)
        }
        _ => None,
    }
}

/// Elements made of corners: `face` or `tristrips`.
#[derive(Debug, Default)]
pub(super) struct Polygons {
    kind: PolygonKind,
    corners_column: Option<usize>,
    /// Number of rows that have begun, in this share and before it.
    begun: usize,
    /// Indices of the vertices. They are not checked.
    triangles: Vec<[u32; 3]>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum PolygonKind {
    #[default]
    Face,
    Strip,
}

impl Polygons {
    /// The receiver of the rows after the first `before`.
    pub(super) fn of(element: &ElementDef, kind: PolygonKind, before: usize) -> Self {
        let mut columns = element.properties.values();
        Self {
            kind,
            corners_column: columns.position(lists_corners),
            begun: before,
            triangles: Vec::new(),
        }
    }

    fn strips(&mut self, corners: &[f64]) -> Result<(), String> {
        // A negative index ends a strip.
        for strip in corners.split(|corner| *corner < 0.0 && *corner == corner.floor()) {
            self.check(strip)?;
            for (k, corners) in strip.windows(3).enumerate() {
                let [a, b, c] = [0, 1, 2].map(|i| corners[i] as u32);
                let triangle = if k % 2 == 0 { [a, b, c] } else { [b, a, c] };
                // Strips are joined by degenerate triangles, which have repeated corners and are dropped here.
                self.triangles.extend(Some(triangle).filter(has_three));
            }
        }
        Ok(())
    }

    /// Splits a polygon into a triangle fan from its first corner.
    fn fan(&mut self, corners: &[f64]) -> Result<(), String> {
        self.check(corners)?;
        for k in 2..corners.len() {
            let triangle = [0, k - 1, k].map(|i| corners[i] as u32);
            self.triangles.push(triangle);
        }
        Ok(())
    }

    /// Refuses corners that are not indices.
    fn check(&self, corners: &[f64]) -> Result<(), String> {
        let is_wrong = |corner: &&f64| f64::from(**corner as u32) != **corner;
        let Some(corner) = corners.iter().find(is_wrong) else {
            return Ok(());
        };
        let name = match self.kind {
            PolygonKind::Face => "face",
            PolygonKind::Strip => "strip",
        };
        let number = self.begun - 1;
        Err(match *corner == corner.floor() {
            true => format!("{name} {number} refers to vertex {corner}"),
            false => format!("the corners of {name} {number} are not whole numbers"),
        })
    }
}

impl Rows for Polygons {
    fn begin(&mut self) {
        self.begun += 1;
    }

    fn wants(&self, column: usize) -> bool {
        self.corners_column == Some(column)
    }

    fn property(&mut self, _: usize, _: &ScalarType, values: &[f64]) -> Result<(), String> {
        match self.kind {
            PolygonKind::Face => self.fan(values),
            PolygonKind::Strip => self.strips(values),
        }
    }

    fn joined(shares: Vec<Self>) -> Self {
        let count = shares.iter().map(|share| share.triangles.len()).sum();
        let mut triangles = Vec::with_capacity(count);
        for share in shares {
            triangles.extend(share.triangles);
        }
        Self {
            triangles,
            ..Self::default()
        }
    }
}

/// Rows that are dropped.
pub(super) struct Dropped;

impl Rows for Dropped {
    fn begin(&mut self) {}

    fn wants(&self, _: usize) -> bool {
        false
    }

    fn property(&mut self, _: usize, _: &ScalarType, _: &[f64]) -> Result<(), String> {
        Ok(())
    }

    fn joined(_: Vec<Self>) -> Self {
        Self
    }
}

/// Elements of a mesh.
#[derive(Default)]
pub(super) struct Elements {
    pub(super) vertices: Vertices,
    pub(super) faces: Polygons,
    pub(super) strips: Polygons,
    /// Number of faces and strips.
    pub(super) polygons: usize,
}

impl Elements {
    pub(super) fn into_mesh(self) -> Mesh {
        let Vertices {
            positions,
            normals,
            colors,
            ..
        } = self.vertices;
        let mut triangles = self.faces.triangles;
        triangles.extend(self.strips.triangles);
        // The later mesh check refuses indices that are out of range. Normals are only looked up if all indices are in range.
        let in_range = (triangles.iter().flatten()).all(|i| (*i as usize) < positions.len());
        let corner_normals = (!normals.is_empty() && in_range).then(|| {
            let normal = |i: u32| normals[i as usize].normalize_or_zero();
            triangles.iter().map(|t| t.map(normal)).collect()
        });
        let vertex_paint = (!colors.is_empty() && in_range).then(|| {
            let textured = triangles.iter().map(|t: &[u32; 3]| TexturedTriangle {
                colors: t.map(|i| colors[i as usize]),
                ..TexturedTriangle::default()
            });
            VertexPaint {
                images: Vec::new(),
                triangles: textured.collect(),
            }
        });
        Mesh {
            vertex_paint,
            positions,
            triangles,
            corner_normals,
        }
    }
}
