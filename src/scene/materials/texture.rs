//! Textures: images of colours or data with all their mip levels, as shaders read them.
//!
//! Mip levels are computed once, each texel as the mean of the texels that it covers: colours in linear light, data unconverted. They take
//! a third more memory. Cannot: store more than 8 bits per channel.

use std::sync::Arc;

use glam::Vec3;

use crate::scene::{linear_from_srgb, map_channels, srgb_from_linear};

/// Meaning of a texture's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureKind {
    /// Colours, sRGB.
    Color,
    /// Normals or shares, without colour conversion.
    Data,
}

/// An image that repeats on all sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    size: [u32; 2],
    kind: TextureKind,
    /// RGBA of all mip levels, the largest first, rows from the top.
    texels: Vec<[u8; 4]>,
}

/// Maximum number of texels along a side.
pub const MOST_TEXELS_ALONG: u32 = 8192;

impl Texture {
    /// Index of a texture in `known`; the texture is appended if `known` does not contain the same object.
    #[doc(hidden)]
    pub fn number_among(known: &mut Vec<Arc<Self>>, texture: &Arc<Self>) -> usize {
        let number = known.iter().position(|k| Arc::ptr_eq(k, texture));
        number.unwrap_or_else(|| {
            known.push(texture.clone());
            known.len() - 1
        })
    }

    /// Creates a texture from the texels of an image, rows from the top.
    ///
    /// # Errors
    ///
    /// If a side is 0 or more than [`MOST_TEXELS_ALONG`], or the number of texels does not match the size.
    pub fn new(size: [u32; 2], texels: Vec<[u8; 4]>, kind: TextureKind) -> Result<Self, String> {
        let [width, height] = size;
        if !(1..=MOST_TEXELS_ALONG).contains(&width) || !(1..=MOST_TEXELS_ALONG).contains(&height) {
            return Err(format!(
                "{width} x {height} texels: each side must have from 1 to {MOST_TEXELS_ALONG}"
            ));
        }
        if texels.len() as u64 != u64::from(width) * u64::from(height) {
            let count = texels.len();
            return Err(format!("{count} texels do not fill {width} x {height}"));
        }
        let mut texture = Self { size, kind, texels };
        let (mut first, mut size) = (0, size);
        while size != [1, 1] {
            let smaller = texture.halved(first, size);
            first = texture.texels.len();
            texture.texels.extend(smaller);
            size = half(size);
        }
        Ok(texture)
    }

    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Meaning of its values.
    pub fn kind(&self) -> TextureKind {
        self.kind
    }

    /// Columns and rows of a mip level, and the texels of this and all smaller levels; level 0 is the image itself.
    #[doc(hidden)]
    pub fn level_on(&self, level: u32) -> ([u32; 2], &[[u8; 4]]) {
        let (mut size, mut first) = (self.size, 0);
        for _ in 0..level {
            if size == [1, 1] {
                break;
            }
            first += size[0] as usize * size[1] as usize;
            size = half(size);
        }
        (size, &self.texels[first..])
    }

    /// The next mip level after the one that starts at `first`: each texel is the mean of the two or three that it covers along each axis.
    fn halved(&self, first: usize, [width, height]: [u32; 2]) -> Vec<[u8; 4]> {
        let [columns, rows] = half([width, height]);
        let span = |i: u32, of: u32, into: u32| i * of / into..((i + 1) * of).div_ceil(into);
        let mut smaller = Vec::with_capacity(columns as usize * rows as usize);
        for row in 0..rows {
            for column in 0..columns {
                let (mut sum, mut alpha, mut count) = (Vec3::ZERO, 0.0, 0.0);
                for y in span(row, height, rows) {
                    for x in span(column, width, columns) {
                        let at = first + y as usize * width as usize + x as usize;
                        let [rgb @ .., a] = self.texels[at].map(|c| f32::from(c) / 255.0);
                        sum += self.decoded(Vec3::from(rgb));
                        alpha += a;
                        count += 1.0;
                    }
                }
                let [r, g, b] = self.encoded(sum / count).to_array();
                smaller.push([r, g, b, alpha / count].map(|c| (c * 255.0).round() as u8));
            }
        }
        smaller
    }

    fn decoded(&self, color: Vec3) -> Vec3 {
        match self.kind {
            TextureKind::Color => map_channels(color, linear_from_srgb),
            TextureKind::Data => color,
        }
    }

    fn encoded(&self, color: Vec3) -> Vec3 {
        match self.kind {
            TextureKind::Color => map_channels(color, srgb_from_linear),
            TextureKind::Data => color,
        }
    }
}

fn half(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| (side / 2).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checks(kind: TextureKind) -> Texture {
        let texels = (0..15).map(|i| [if i % 2 == 0 { 0 } else { 255 }, 0, 0, 255]);
        Texture::new([5, 3], texels.collect(), kind).expect("a texture")
    }

    #[test]
    fn sizes_go_down_to_one_texel() {
        let texture = checks(TextureKind::Data);
        // 5 x 3, 2 x 1, 1 x 1.
        assert_eq!(texture.texels.len(), 15 + 2 + 1);
    }

    #[test]
    fn colours_are_averaged_in_linear_light() {
        let [color, data] = [TextureKind::Color, TextureKind::Data].map(|kind| {
            let texels = vec![[0, 0, 0, 255], [255, 255, 255, 255]];
            let texture = Texture::new([2, 1], texels, kind).expect("a texture");
            texture.texels[2][0]
        });
        assert_eq!(data, 128);
        assert_eq!(color, 188, "half of the light");
    }

    #[test]
    fn what_is_no_image_is_refused() {
        for (size, count) in [([0, 1], 0), ([2, 2], 3), ([9000, 1], 9000)] {
            let texels = vec![[0; 4]; count];
            assert!(
                Texture::new(size, texels, TextureKind::Color).is_err(),
                "{size:?}"
            );
        }
    }
}
