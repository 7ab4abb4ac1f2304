//! The images that the faces of solids show, as PNGs. Each image is written once.
//!
//! Cost: one pass over the painted triangles, and PNG encoding of each image at full size.

use std::collections::BTreeMap;
use std::sync::Arc;

use cutaway::scene::{Texture, TexturedTriangle};
use glam::Vec2;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use super::solid::{Solid, Unwritable};

/// Numbered images, in the order of their first use by a face.
pub(super) struct Images {
    all: Vec<Arc<Texture>>,
    /// For each solid, the number of each image of its vertex paint, or `None` if no face shows the image.
    numbers: Vec<Vec<Option<usize>>>,
}

impl Images {
    pub(super) fn of(solids: &[Solid<'_>]) -> Self {
        let mut all = Vec::new();
        let numbers = solids.iter().map(|solid| {
            let Some(vertex_paint) = &solid.vertex_paint else {
                return Vec::new();
            };
            let mut numbers = vec![None; vertex_paint.images.len()];
            for image in vertex_paint.triangles.iter().filter_map(|t| t.image) {
                let image = image as usize;
                numbers[image].get_or_insert_with(|| {
                    Texture::number_among(&mut all, &vertex_paint.images[image])
                });
            }
            numbers
        });
        let numbers = numbers.collect();
        Self { all, numbers }
    }

    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    /// The number of the image on a face of a solid, if the face has one.
    pub(super) fn number(&self, solid: usize, face: &TexturedTriangle) -> Option<usize> {
        self.numbers[solid][face.image? as usize]
    }

    /// The faces of solid number `index`, grouped by image number. Faces without an image come first.
    pub(super) fn faces(
        &self,
        index: usize,
        solid: &Solid<'_>,
    ) -> BTreeMap<Option<usize>, Vec<usize>> {
        let mut faces: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for face in 0..solid.faces {
            let image = solid.face(face).and_then(|of| self.number(index, of));
            faces.entry(image).or_default().push(face);
        }
        faces
    }

    /// Each image as the bytes of a PNG.
    pub(super) fn pngs(&self) -> Result<Vec<Vec<u8>>, Unwritable> {
        self.all.iter().map(|image| png(image)).collect()
    }

    /// Returns the name and bytes of each image file. `stem` is the name of the mesh file without its extension.
    pub(super) fn files(&self, stem: &str) -> Result<Vec<(String, Vec<u8>)>, Unwritable> {
        let pngs = self.pngs()?.into_iter().enumerate();
        Ok(pngs.map(|(i, png)| (file_name(stem, i), png)).collect())
    }
}

/// The bits of a texture coordinate, for use as a key.
pub(super) fn bits(place: Vec2) -> [u32; 2] {
    place.to_array().map(f32::to_bits)
}

/// Flips V, because it points up in most formats, whereas rows of texels go down.
pub(super) fn upwards(place: Vec2) -> [f64; 2] {
    [f64::from(place.x), 1.0 - f64::from(place.y)]
}

/// File name of an image, safe for line-based formats.
pub(super) fn file_name(stem: &str, number: usize) -> String {
    format!("{}.{number}.png", word_of(stem))
}

/// Turns text into one word, without blanks, comment characters or line continuations, that cannot be mistaken for an option.
pub(super) fn word_of(text: &str) -> String {
    let is_plain = |c: char| !(c.is_whitespace() || c.is_control() || c == '#' || c == '\\');
    let word = text.chars().map(|c| if is_plain(c) { c } else { '_' });
    let word: String = word.collect();
    match word.strip_prefix('-') {
        Some(rest) => format!("_{rest}"),
        None => word,
    }
}

fn png(image: &Texture) -> Result<Vec<u8>, Unwritable> {
    let ([width, height], texels) = image.level_on(0);
    let texels = &texels[..width as usize * height as usize];
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(
            texels.as_flattened(),
            width,
            height,
            ExtendedColorType::Rgba8,
        )
        .map_err(|e| Unwritable::Image(e.to_string()))?;
    Ok(bytes)
}
