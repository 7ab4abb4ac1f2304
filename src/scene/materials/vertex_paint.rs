//! Vertex paint: a file's own surface colours (vertex colours, and images mapped by texture coordinates), beside the part's colour.

use std::sync::Arc;

use glam::Vec2;

use crate::scene::Texture;

/// The colours of a surface, triangle by triangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexPaint {
    /// Images that triangles refer to.
    pub images: Vec<Arc<Texture>>,
    /// One entry for each triangle of the mesh.
    pub triangles: Vec<TexturedTriangle>,
}

/// The colours of a triangle: its corner colours multiplied by the image.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TexturedTriangle {
    /// Colours of the corners, sRGB.
    pub colors: [[u8; 4]; 3],
    /// Texture coordinates of the corners, in repeats; (0, 0) is the image's upper left.
    pub uv: [Vec2; 3],
    /// Index of the image; `None` leaves the colours unchanged.
    pub image: Option<u32>,
}

impl TexturedTriangle {
    /// Returns true if the corner colours matter: the triangle has no image, or its image is tinted.
    #[doc(hidden)]
    pub fn has_colors(&self) -> bool {
        self.image.is_none() || self.colors != [[255; 4]; 3]
    }
}

impl VertexPaint {
    /// The paint of the given triangles.
    #[must_use]
    pub(crate) fn picked(&self, triangles: &[u32]) -> Self {
        Self {
            images: self.images.clone(),
            triangles: (triangles.iter())
                .map(|t| self.triangles[*t as usize])
                .collect(),
        }
    }

    /// The colour (sRGB) if the vertex paint has no image and a single colour.
    #[doc(hidden)]
    pub fn one_color(&self) -> Option<[u8; 4]> {
        let first = self.triangles.first()?.colors[0];
        let is_it = |t: &TexturedTriangle| t.image.is_none() && t.colors == [first; 3];
        self.triangles.iter().all(is_it).then_some(first)
    }
}
