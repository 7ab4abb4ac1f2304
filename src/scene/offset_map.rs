//! Offset maps: the heights of a relief over its plane.
//!
//! `f` is bilinear between texel centres, `(i + 0.5) / width`, from four texels; addresses outside 0..width follow the
//! wrap mode. Nothing else interpolates heights, on either side: a hardware sampler keeps only about eight bits of the
//! weight, which would tear a cap from the mesh it closes.

use glam::DVec2;

/// How addresses outside the map are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, serde::Deserialize, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Wrap {
    /// The map repeats.
    #[default]
    Repeat,
    /// The map repeats, every other copy mirrored.
    Mirror,
    /// The border texels go on for ever.
    Clamp,
}

impl Wrap {
    /// The texel that an address stands for, in `0..size`.
    pub fn texel(self, address: i64, size: u32) -> u32 {
        let n = i64::from(size);
        let i = match self {
            Self::Repeat => address.rem_euclid(n),
            Self::Mirror => {
                let m = address.rem_euclid(2 * n);
                if m < n { m } else { 2 * n - 1 - m }
            }
            Self::Clamp => address.clamp(0, n - 1),
        };
        u32::try_from(i).unwrap_or(0)
    }

    /// Number in shaders.
    pub fn code(self) -> u32 {
        match self {
            Self::Repeat => 0,
            Self::Mirror => 1,
            Self::Clamp => 2,
        }
    }
}

/// Heights on a grid, finite, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct OffsetMap {
    /// Width and height in texels, at least 1.
    pub size: [u32; 2],
    /// `width * height` heights, the first row at `t = 0`.
    pub texels: Vec<f32>,
}

impl OffsetMap {
    /// A map from heights; the reason if it cannot be one.
    pub fn new(size: [u32; 2], texels: Vec<f32>) -> Result<Self, String> {
        if size[0] == 0 || size[1] == 0 {
            return Err(format!("the map is {} x {} texels", size[0], size[1]));
        }
        if texels.len() != size[0] as usize * size[1] as usize {
            return Err(format!(
                "{} texels do not fill {} x {}",
                texels.len(),
                size[0],
                size[1]
            ));
        }
        if let Some(i) = texels.iter().position(|h| !h.is_finite()) {
            let w = size[0] as usize;
            return Err(format!("texel ({}, {}) is {}", i % w, i / w, texels[i]));
        }
        // Denormals would be flushed on some adapters and not on others.
        let texels = texels
            .into_iter()
            .map(|h| if h.is_subnormal() { 0.0 } else { h })
            .collect();
        Ok(Self { size, texels })
    }

    /// Least and greatest height: the slab that holds the relief.
    pub fn range(&self) -> [f32; 2] {
        self.texels
            .iter()
            .fold([f32::INFINITY, f32::NEG_INFINITY], |[lo, hi], h| {
                [lo.min(*h), hi.max(*h)]
            })
    }

    /// The texel at an address, wrapped.
    pub fn texel(&self, wrap: Wrap, x: i64, y: i64) -> f64 {
        let [w, h] = self.size;
        f64::from(self.texels[(wrap.texel(y, h) * w + wrap.texel(x, w)) as usize])
    }

    /// Height and its gradient by `T`, at texture coordinates `t` (1 = the whole map), by bilinear interpolation in f64.
    pub fn sample(&self, wrap: Wrap, t: DVec2) -> (f64, DVec2) {
        let size = DVec2::new(f64::from(self.size[0]), f64::from(self.size[1]));
        let p = t * size - 0.5;
        let cell = p.floor();
        let l = p - cell;
        #[allow(
            clippy::cast_possible_truncation,
            reason = "cells far outside i64 have no meaning"
        )]
        let (x, y) = (cell.x as i64, cell.y as i64);
        let h = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| self.texel(wrap, x + i, y + j));
        let (bx, by, bxy) = (h[1] - h[0], h[2] - h[0], (h[3] - h[2]) - (h[1] - h[0]));
        (
            h[0] + bx * l.x + by * l.y + bxy * l.x * l.y,
            DVec2::new(bx + bxy * l.y, by + bxy * l.x) * size,
        )
    }
}
