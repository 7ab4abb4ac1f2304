//! The colours of a GIF: one palette of at most 255 colours for all frames, so that colours do not flicker between frames.
//!
//! Up to 255 colours are kept unchanged. More are reduced by a self-organising map, trained on a sample of all frames (NeuQuant, from
//! the crate `color_quant`), and frames are dithered by a fixed 8 x 8 pattern, scaled by the distance between colours: a pattern
//! that depends on the picture, as in error diffusion, would crawl where nothing moves.

use std::collections::BTreeSet;

use color_quant::NeuQuant;
use rayon::prelude::*;

/// Maximum number of colours; one of the 256 palette entries of a GIF stands for "as before".
pub(super) const MOST_COLORS: usize = 255;

/// Number of sampled pixels, over all frames.
const SAMPLES: usize = 1 << 18;

/// Cells along each side of the search grid over the colour cube.
const CELLS: usize = 32;

/// Channel values per cell.
const CELL: usize = 256 / CELLS;

/// Collects colours from frames.
pub(super) struct Sampler {
    /// Mean distance between a frame's sampled pixels.
    stride: usize,
    sampled: Vec<[u8; 3]>,
    /// All distinct colours, until there are too many for a palette.
    distinct: BTreeSet<[u8; 3]>,
    state: u32,
}

impl Sampler {
    /// Returns a sampler for `pixels` pixels in total.
    pub(super) fn new(pixels: usize) -> Self {
        Self {
            stride: pixels.div_ceil(SAMPLES).max(1),
            sampled: Vec::new(),
            distinct: BTreeSet::new(),
            state: 1,
        }
    }

    /// Samples the opaque pixels of a frame.
    pub(super) fn look(&mut self, rgba: &[u8]) {
        let mut skip = 0;
        let mut last = None;
        for pixel in rgba.chunks_exact(4).filter(|p| is_opaque(p)) {
            let color = [pixel[0], pixel[1], pixel[2]];
            if self.distinct.len() <= MOST_COLORS && last != Some(color) {
                self.distinct.insert(color);
                last = Some(color);
            }
            if skip == 0 {
                self.sampled.push(color);
                // At uneven distances, to avoid a regular pattern across rows.
                self.state = self
                    .state
                    .wrapping_mul(1_664_525)
                    .wrapping_add(1_013_904_223);
                skip = (self.state >> 8) as usize % (2 * self.stride - 1) + 1;
            }
            skip -= 1;
        }
    }

    /// The palette that fits the sampled pixels best.
    pub(super) fn palette(self) -> Palette {
        if self.distinct.len() <= MOST_COLORS {
            return Palette::of(self.distinct.into_iter().collect(), 0.0);
        }
        let rgba: Vec<u8> = (self.sampled.iter())
            .flat_map(|c| [c[0], c[1], c[2], 255])
            .collect();
        let learnt = NeuQuant::new(1, MOST_COLORS, &rgba).color_map_rgb();
        let colors = learnt.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        let plain = Palette::of(colors, 0.0);
        let colors = refined(&plain, &self.sampled);
        let plain = Palette::of(colors, 0.0);
        let error: f64 = (self.sampled.par_iter())
            .map(|c| f64::from(distance(*c, plain.colors[usize::from(plain.nearest(*c))])))
            .sum();
        let rms = (error / self.sampled.len() as f64 / 3.0).sqrt();
        Palette {
            dither: 3.0 * rms,
            ..plain
        }
    }
}

/// Moves every colour to the mean of the pixels it represents.
fn refined(palette: &Palette, sampled: &[[u8; 3]]) -> Vec<[u8; 3]> {
    let mut sums = vec![([0_u64; 3], 0_u64); palette.colors.len()];
    for color in sampled {
        let (sum, count) = &mut sums[usize::from(palette.nearest(*color))];
        for (sum, v) in sum.iter_mut().zip(color) {
            *sum += u64::from(*v);
        }
        *count += 1;
    }
    let means = sums
        .iter()
        .zip(&palette.colors)
        .map(|((sum, count), was)| match count {
            0 => *was,
            count => sum.map(|s| ((s + count / 2) / count) as u8),
        });
    means.collect()
}

/// Returns true if a pixel counts as opaque: GIF has no partial transparency.
pub(super) fn is_opaque(rgba: &[u8]) -> bool {
    rgba[3] >= 128
}

/// The palette of all frames, with a lookup from any colour to the nearest entry.
pub(super) struct Palette {
    /// sRGB.
    pub(super) colors: Vec<[u8; 3]>,
    /// Range of the dither pattern added before the nearest entry is looked up.
    dither: f64,
    /// Per cell of the colour cube, the entries that can be nearest to a colour in it.
    candidates: Vec<Vec<u8>>,
}

impl Palette {
    fn of(colors: Vec<[u8; 3]>, dither: f64) -> Self {
        let cells = 0..CELLS * CELLS * CELLS;
        let candidates = cells
            .into_par_iter()
            .map(|cell| candidates(cell, &colors))
            .collect();
        Self {
            colors,
            dither,
            candidates,
        }
    }

    /// Index of the nearest entry.
    fn nearest(&self, color: [u8; 3]) -> u8 {
        let [r, g, b] = color.map(|v| usize::from(v) / CELL);
        let near = &self.candidates[(r * CELLS + g) * CELLS + b];
        let best = near
            .iter()
            .min_by_key(|i| distance(color, self.colors[usize::from(**i)]));
        best.copied().unwrap_or(0)
    }

    /// Palette index of every pixel; `empty` for transparent pixels.
    pub(super) fn indices(&self, rgba: &[u8], width: u32, empty: u8) -> Vec<u8> {
        let width = width as usize;
        let rows = rgba.par_chunks_exact(width * 4).enumerate();
        rows.flat_map_iter(|(y, row)| {
            row.chunks_exact(4).enumerate().map(move |(x, pixel)| {
                if !is_opaque(pixel) {
                    return empty;
                }
                let off = (self.dither * pattern(x, y)).round() as i32;
                let lit = |v: u8| (i32::from(v) + off).clamp(0, 255) as u8;
                self.nearest([lit(pixel[0]), lit(pixel[1]), lit(pixel[2])])
            })
        })
        .collect()
    }
}

fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    let off = |i: usize| u32::from(a[i].abs_diff(b[i]));
    off(0) * off(0) + off(1) * off(1) + off(2) * off(2)
}

/// Entries that can be the nearest to some colour of a cell: their minimum distance from the cell does not exceed the smallest of all
/// entries' maximum distances.
fn candidates(cell: usize, colors: &[[u8; 3]]) -> Vec<u8> {
    let low = [cell / CELLS / CELLS, cell / CELLS % CELLS, cell % CELLS].map(|c| c * CELL);
    let range = |color: &[u8; 3]| {
        let (mut least, mut most) = (0, 0);
        for (low, v) in low.iter().zip(color) {
            let (v, high) = (usize::from(*v), low + CELL - 1);
            let outside = low.saturating_sub(v).max(v.saturating_sub(high));
            let across = v.abs_diff(*low).max(v.abs_diff(high));
            least += outside * outside;
            most += across * across;
        }
        (least, most)
    };
    let bound = colors.iter().map(|c| range(c).1).min().unwrap_or(0);
    let near = colors
        .iter()
        .enumerate()
        .filter(|(_, c)| range(c).0 <= bound);
    near.map(|(i, _)| i as u8).collect()
}

/// Bayer pattern: values from -1/2 to 1/2, each occurring once in every 8 x 8 pixels.
fn pattern(x: usize, y: usize) -> f64 {
    let mut rank = 0;
    for bit in 0..3 {
        let (x, y) = (x >> bit & 1, y >> bit & 1);
        rank = rank * 4 + ((x ^ y) * 2 + y);
    }
    (f64::from(rank as u32) + 0.5) / 64.0 - 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rgba(colors: impl Iterator<Item = [u8; 3]>) -> Vec<u8> {
        colors.flat_map(|[r, g, b]| [r, g, b, 255]).collect()
    }

    /// Colours all over the cube.
    fn many() -> Vec<u8> {
        rgba(
            (0..64 * 64_u32)
                .map(|i| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, (i * 37 % 256) as u8]),
        )
    }

    #[test]
    fn few_colors_are_kept() {
        let frame = rgba((0..=254).map(|v| [v, 255 - v, v / 3]));
        let mut sampler = Sampler::new(255);
        sampler.look(&frame);
        let palette = sampler.palette();
        assert_eq!(palette.colors.len(), 255);
        let indices = palette.indices(&frame, 255, 255);
        let shown = rgba(indices.iter().map(|i| palette.colors[usize::from(*i)]));
        assert_eq!(shown, frame, "nothing is lost");
    }

    #[test]
    fn the_nearest_is_the_nearest() {
        let frame = many();
        let mut sampler = Sampler::new(64 * 64);
        sampler.look(&frame);
        let palette = sampler.palette();
        assert!(
            palette.dither > 1.0,
            "colours are apart: {}",
            palette.dither
        );
        for i in 0..5000_u32 {
            let color = [7919, 104_729, 1_299_709].map(|k| (i.wrapping_mul(k) >> 4) as u8);
            let found = palette.colors[usize::from(palette.nearest(color))];
            let least = palette.colors.iter().map(|c| distance(color, *c)).min();
            assert_eq!(Some(distance(color, found)), least, "{color:?}");
        }
    }

    #[test]
    fn what_is_transparent_is_not_looked_at() {
        let mut sampler = Sampler::new(3);
        sampler.look(&[1, 2, 3, 255, 9, 9, 9, 127, 4, 5, 6, 128]);
        let palette = sampler.palette();
        assert_eq!(palette.colors, [[1, 2, 3], [4, 5, 6]]);
        let indices = palette.indices(&[4, 5, 6, 255, 9, 9, 9, 0], 2, 255);
        assert_eq!(indices, [1, 255]);
    }

    #[test]
    fn the_pattern_has_each_value_once() {
        let mut values: Vec<i32> = (0..64)
            .map(|i| (pattern(i % 8, i / 8) * 64.0 + 31.5) as i32)
            .collect();
        values.sort_unstable();
        assert_eq!(values, (0..64).collect::<Vec<_>>());
    }
}
