//! Data types of the writers: solids with their colours, and encoded files.

use cutaway::scene::{Mesh, Part, TexturedTriangle, VertexPaint};
use cutaway::slice::Half;
use glam::Vec3;

use super::painted;

/// A solid to be written.
#[derive(Clone, Debug)]
pub struct Solid<'a> {
    /// Name of the solid.
    pub name: &'a str,
    /// Colour of the faces, in sRGB from 0 to 1.
    pub color: Vec3,
    /// Additional colours and images of the faces, if there are any.
    pub vertex_paint: Option<VertexPaint>,
    /// Colour of the caps.
    pub cap_color: Vec3,
    /// Mesh of the solid, in which the faces come before the caps.
    pub mesh: &'a Mesh,
    /// Number of triangles of the part's own surface; the remaining ones are caps.
    pub faces: usize,
}

impl<'a> Solid<'a> {
    /// Returns one half of a part as a solid with the part's colours.
    pub fn of(part: &'a Part, half: &'a Half) -> Self {
        Self {
            name: &part.name,
            color: part.material.color,
            vertex_paint: painted::vertex_paint_of(part, half),
            cap_color: part.material.cap_color(),
            mesh: &half.mesh,
            faces: half.surface_triangles(),
        }
    }

    /// The colours and images of a face. Returns `None` for a cap, or if the solid has no vertex paint.
    pub(super) fn face(&self, triangle: usize) -> Option<&TexturedTriangle> {
        self.vertex_paint.as_ref()?.triangles.get(triangle)
    }

    /// Returns true if corners have colours, by which images are multiplied.
    pub(super) fn has_colors(&self) -> bool {
        let mut faces = self
            .vertex_paint
            .iter()
            .flat_map(|vertex_paint| &vertex_paint.triangles);
        faces.any(TexturedTriangle::has_colors)
    }
}

/// A mesh file with its companion files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EncodedMesh {
    /// Bytes of the mesh file.
    pub file: Vec<u8>,
    /// Names and bytes of companion files in the same folder. [`MeshFormat::beside`](super::MeshFormat::beside) lists all possible names.
    pub beside: Vec<(String, Vec<u8>)>,
}

impl EncodedMesh {
    pub(super) fn alone(file: Vec<u8>) -> Self {
        let beside = Vec::new();
        Self { file, beside }
    }
}

/// Reason why solids cannot be written in a format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unwritable {
    /// No triangle remains, because there was none or because all have corners that coincide in f32.
    #[error("no triangle is left at the format's precision")]
    Collapsed,
    /// Some coordinates are beyond the f32 range of 3.4e38.
    #[error("some coordinates are too large for the format's 32 bits")]
    Infinite,
    /// Sizes or counts exceed 32 bits.
    #[error("the format holds at most 4 GiB")]
    TooLarge,
    /// An image could not be encoded.
    #[error("an image cannot be encoded: {0}")]
    Image(String),
    /// The 3MF archive could not be created.
    #[error("the 3MF archive cannot be created: {0}")]
    Archive(String),
}

/// The corners of a triangle in f32, or `None` if two of them coincide.
pub(super) fn rounded(positions: &[Vec3], triangle: &[u32; 3]) -> Option<[Vec3; 3]> {
    let [a, b, c] = triangle.map(|i| positions[i as usize]);
    (a != b && b != c && c != a).then_some([a, b, c])
}

/// Converts a colour to three bytes.
pub(super) fn bytes_of(color: Vec3) -> [u8; 3] {
    color
        .to_array()
        .map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)
}
