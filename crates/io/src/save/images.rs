//! The images that the faces of some solids show, each once, as PNGs.
//!
//! Cost: a pass over the painted triangles, and the packing of each image at its full size.

use std::collections::BTreeMap;
use std::sync::Arc;

use cutaway::scene::{Texture, TexturedTriangle};
use glam::Vec2;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use super::solid::{Solid, Unwritable};

/// Images by their numbers, in the order in which faces show them first.
pub(super) struct Images {
    all: Vec<Arc<Texture>>,
    /// For each solid and each image of its vertex paint its number; none where no face shows it.
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

    /// The number of the image of a face of a solid, where it has one.
    pub(super) fn number(&self, solid: usize, face: &TexturedTriangle) -> Option<usize> {
        self.numbers[solid][face.image? as usize]
    }

    /// The faces of a solid, which is one of several, by the numbers of their images; those without come first.
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

    /// The bytes of each as a PNG.
    pub(super) fn pngs(&self) -> Result<Vec<Vec<u8>>, Unwritable> {
        self.all.iter().map(|image| png(image)).collect()
    }

    /// Returns each image as a file for the folder of the mesh file, whose name without extension is `stem`.
    pub(super) fn files(&self, stem: &str) -> Result<Vec<(String, Vec<u8>)>, Unwritable> {
        let pngs = self.pngs()?.into_iter().enumerate();
        Ok(pngs.map(|(i, png)| (file_name(stem, i), png)).collect())
    }
}

/// A place in an image as a key.
pub(super) fn bits(place: Vec2) -> [u32; 2] {
    place.to_array().map(f32::to_bits)
}

/// A place in an image as most formats have it: upwards, where rows of texels go down.
pub(super) fn upwards(place: Vec2) -> [f64; 2] {
    [f64::from(place.x), 1.0 - f64::from(place.y)]
}

/// The name of the file of an image, as formats of lines can hold it.
pub(super) fn file_name(stem: &str, number: usize) -> String {
    format!("{}.{number}.png", word_of(stem))
}

/// Text as one word of a line: without blanks, without what begins a comment or goes on in the next line, and no option.
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
