//! Converts layers from and to the words that shaders write (`shaders/lib/layers.wgsl`).

use crate::layers::{Kind, Layer, Layers};
use crate::plan::pack::{pack_normal, unpack_normal};

/// Bytes of one pixel.
pub(super) const LAYER_BYTES: u64 = 12;

/// Decodes the words of one pixel; `shaders/lib/layers.wgsl` encodes them.
pub(super) fn layer_from_words(words: &[u32; 3]) -> Layer {
    let [word, normal, depth] = *words;
    let kind = match word & 3 {
        1 => Kind::Surface,
        2 => Kind::Cap,
        _ => Kind::Background,
    };
    if kind == Kind::Background {
        return Layer {
            depth: f64::INFINITY,
            unreliable: word & 8 != 0,
            ..Layer::default()
        };
    }
    Layer {
        kind,
        part: (word >> 16) as u16,
        clip_surface: if kind == Kind::Cap {
            (word >> 8) as u8
        } else {
            0
        },
        back_face: word & 4 != 0,
        unreliable: word & 8 != 0,
        overlap: word & 16 != 0,
        depth: f64::from(f32::from_bits(depth)),
        normal: unpack_normal(normal),
    }
}

/// Decodes pixels from three words each: the inverse of [`words_from_layers`].
pub fn layers_from_words(words: &[u32]) -> Vec<Layer> {
    words
        .as_chunks::<3>()
        .0
        .iter()
        .map(layer_from_words)
        .collect()
}

/// Encodes layers in the shaders' format, three words a pixel, to be shaded like a strategy's layers or sent elsewhere. Depths are
/// rounded to single precision, and normals to two 16-bit numbers.
pub fn words_from_layers(layers: &Layers) -> Vec<u32> {
    let words = layers.pixels.iter().map(|p| {
        let flags =
            u32::from(p.back_face) << 2 | u32::from(p.unreliable) << 3 | u32::from(p.overlap) << 4;
        let what = p.kind as u32 | flags | u32::from(p.clip_surface) << 8 | u32::from(p.part) << 16;
        [what, pack_normal(p.normal), (p.depth as f32).to_bits()]
    });
    words.flatten().collect()
}
