//! Builds vertex paint from the corner and material attributes of OBJ, glTF and 3MF files.

use std::sync::Arc;

use cutaway::scene::{
    Material, Texture, TexturedTriangle, VertexPaint, linear_from_srgb, map_channels,
    srgb_from_linear,
};
use glam::{Vec2, Vec3};

/// The colour of a group of triangles, and the image by which it is multiplied.
#[derive(Clone, Debug, Default)]
pub(super) struct Paint {
    /// Colour in sRGB. `None` means white if there is an image or vertex colours, and the default colour otherwise.
    pub(super) color: Option<Vec3>,
    pub(super) image: Option<Arc<Texture>>,
    /// True if the group transmits light.
    pub(super) is_transparent: bool,
}

/// Attributes of the corners of a triangle.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PaintedTriangle {
    /// Index of the group's [`Paint`].
    pub(super) group: u32,
    /// Texture coordinates, where (0, 0) is the upper left corner of the image.
    pub(super) uv: Option<[Vec2; 3]>,
    /// Colours of the corners, in sRGB.
    pub(super) colors: Option<[Vec3; 3]>,
}

/// Builds the vertex paint of a mesh. Returns `None` if all groups have the same plain colour. If `may_have_colors` is false, no corner has
/// a colour.
pub(super) fn vertex_paint(
    paints: &[Paint],
    may_have_colors: bool,
    triangles: impl Iterator<Item = PaintedTriangle> + Clone,
) -> Option<VertexPaint> {
    let has_images = paints.iter().any(|paint| paint.image.is_some());
    let has_colors = may_have_colors && triangles.clone().any(|t| t.colors.is_some());
    let is_colored = paints.windows(2).any(|pair| pair[0].color != pair[1].color);
    if !has_images && !has_colors && !is_colored {
        return None;
    }
    let mut images: Vec<Arc<Texture>> = Vec::new();
    let numbers: Vec<Option<u32>> = (paints.iter())
        .map(|paint| {
            let image = paint.image.as_ref()?;
            Some(Texture::number_among(&mut images, image) as u32)
        })
        .collect();
    let textured = triangles.map(|t| {
        let paint = &paints[t.group as usize];
        let image = numbers[t.group as usize].filter(|_| t.uv.is_some());
        let plain = match image.is_some() || t.colors.is_some() {
            true => Vec3::ONE,
            false => Material::default().color,
        };
        let factor = map_channels(paint.color.unwrap_or(plain), linear_from_srgb);
        let colors = t.colors.unwrap_or([Vec3::ONE; 3]).map(|color| {
            let mixed = map_channels(color, linear_from_srgb) * factor;
            let [r, g, b] = (map_channels(mixed, srgb_from_linear) * 255.0)
                .round()
                .to_array();
            [r as u8, g as u8, b as u8, 255]
        });
        TexturedTriangle {
            colors,
            uv: t.uv.unwrap_or_default(),
            image,
        }
    });
    Some(VertexPaint {
        triangles: textured.collect(),
        images,
    })
}
