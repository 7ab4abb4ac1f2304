//! Offset maps: the heights of a relief over its plane.
//!
//! `f` is bilinear between texel centres, `(i + 0.5) / width`, from four texels; addresses outside 0..width follow the
//! wrap mode. CPU and GPU both interpolate heights only this way: a hardware sampler keeps only about eight bits of the
//! weight, which would tear a cap from the mesh it closes. To measure its error, callers can select the sampler ([`HeightFilter`]).
//!
//! [`HeightFilter`]: crate::scene::HeightFilter

use glam::DVec2;

use crate::scene::describe::Described;

/// Address mode outside the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Described)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize, serde::Serialize),
    serde(rename_all = "kebab-case")
)]
pub enum Wrap {
    /// The map repeats.
    #[default]
    Repeat,
    /// The map repeats, every other copy mirrored.
    Mirror,
    /// The border texels extend indefinitely.
    Clamp,
}

impl Wrap {
    /// The texel that an address refers to, in `0..size`.
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

    /// The mode's code in shaders.
    pub fn code(self) -> u32 {
        match self {
            Self::Repeat => 0,
            Self::Mirror => 1,
            Self::Clamp => 2,
        }
    }
}

/// Finite heights on a grid, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct OffsetMap {
    size: [u32; 2],
    texels: Vec<f32>,
    range: [f32; 2],
}

impl OffsetMap {
    /// Creates a map from heights; returns the reason if they do not form a valid map.
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
        // Some adapters flush denormals to zero and others do not.
        let texels = texels
            .into_iter()
            .map(|h| if h.is_subnormal() { 0.0 } else { h })
            .collect();
        Ok(Self::of_finite(size, texels))
    }

    /// Creates a map from `width * height` heights, all of them finite and none subnormal.
    pub(in crate::scene) fn of_finite(size: [u32; 2], texels: Vec<f32>) -> Self {
        let none = [f32::INFINITY, f32::NEG_INFINITY];
        let range = (texels.iter()).fold(none, |[lo, hi], h| [lo.min(*h), hi.max(*h)]);
        Self {
            size,
            texels,
            range,
        }
    }

    /// Width and height in texels, at least 1.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// `width * height` heights, the first row at `t = 0`.
    pub fn texels(&self) -> &[f32] {
        &self.texels
    }

    /// Least and greatest height; the relief lies in the slab between them.
    pub fn range(&self) -> [f32; 2] {
        self.range
    }

    /// The texel at an address, wrapped.
    pub fn texel(&self, wrap: Wrap, x: i64, y: i64) -> f64 {
        let [w, h] = self.size;
        f64::from(self.texels[(wrap.texel(y, h) * w + wrap.texel(x, w)) as usize])
    }

    /// Height and its gradient with respect to `T`, at texture coordinates `t` (1 = the whole map), by bilinear interpolation in f64.
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
        // Saturating like the cast above: far outside i64 the last cell is its own neighbour.
        let h = [[0, 0], [1, 0], [0, 1], [1, 1]]
            .map(|[i, j]| self.texel(wrap, x.saturating_add(i), y.saturating_add(j)));
        let (bx, by, bxy) = (h[1] - h[0], h[2] - h[0], (h[3] - h[2]) - (h[1] - h[0]));
        (
            h[0] + bx * l.x + by * l.y + bxy * l.x * l.y,
            DVec2::new(bx + bxy * l.y, by + bxy * l.x) * size,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];

    /// Distinct heights, so that a wrong texel shows.
    fn map(w: u32, h: u32) -> OffsetMap {
        let heights = (0..w * h).map(|i| ((i * 37 + 11) % 101) as f32 / 128.0);
        OffsetMap::new([w, h], heights.collect()).expect("finite heights")
    }

    fn centre(map: &OffsetMap, x: i64, y: i64) -> DVec2 {
        (DVec2::new(x as f64, y as f64) + 0.5) / DVec2::from(map.size.map(f64::from))
    }

    #[test]
    fn texels_are_met_at_their_centres() {
        // Powers of two: the centres are exact in f64, so the heights must be exact too.
        for (w, h) in [(1, 1), (1, 8), (4, 2), (8, 8)] {
            let map = map(w, h);
            for wrap in WRAPS {
                for (x, y) in (-20..20).flat_map(|x| (-20..20).map(move |y| (x, y))) {
                    let height = map.sample(wrap, centre(&map, x, y)).0;
                    assert_eq!(
                        height,
                        map.texel(wrap, x, y),
                        "{w} x {h} {wrap:?} ({x}, {y})"
                    );
                }
            }
        }
    }

    #[test]
    fn wrapping_equals_a_map_laid_out_by_hand() {
        for (w, h) in [(1, 1), (1, 5), (5, 1), (3, 4)] {
            let map = &map(w, h);
            let [w, h] = [i64::from(w), i64::from(h)];
            for wrap in WRAPS {
                // Five copies along one axis, written out as the modes are documented; the original map is the third.
                let line = |n: i64| -> Vec<i64> {
                    let there: Vec<i64> = (0..n).collect();
                    let back: Vec<i64> = (0..n).rev().collect();
                    let [first, last] = [0, n - 1].map(|i| vec![i; there.len()]);
                    match wrap {
                        Wrap::Repeat => [&*there, &there, &there, &there, &there].concat(),
                        Wrap::Mirror => [&*there, &back, &there, &back, &there].concat(),
                        Wrap::Clamp => [&*first, &first, &there, &last, &last].concat(),
                    }
                };
                let (columns, rows) = (line(w), line(h));
                let wide: Vec<f32> = rows
                    .iter()
                    .flat_map(|y| {
                        columns
                            .iter()
                            .map(move |x| map.texels[(y * w + x) as usize])
                    })
                    .collect();
                let size = [columns.len() as u32, rows.len() as u32];
                let wide = OffsetMap::new(size, wide).expect("finite heights");
                for i in 0..2000 {
                    let at = DVec2::new(f64::from(i) * 0.618, f64::from(i) * 0.414).fract();
                    // Texels from the low corner of the laid-out map, half a texel off its border.
                    let extent = DVec2::new(f64::from(size[0]), f64::from(size[1]));
                    let texels = 0.5 + at * (extent - 1.0);
                    let own = DVec2::new(w as f64, h as f64);
                    let here = map.sample(wrap, (texels - 2.0 * own) / own);
                    let laid_out = wide.sample(Wrap::Clamp, texels / extent);
                    let error = (here.0 - laid_out.0).abs();
                    assert!(error < 1e-11, "{w} x {h} {wrap:?} at {texels}: {error}");
                }
            }
        }
    }

    #[test]
    fn the_gradient_is_the_slope_of_the_height() {
        let map = map(5, 7);
        for wrap in WRAPS {
            for i in 0..500 {
                let t = DVec2::new(f64::from(i) * 0.0137 - 2.0, f64::from(i) * 0.0091 - 1.0);
                let fraction = (t * DVec2::new(5.0, 7.0) - 0.5).fract().abs();
                if (fraction - 0.5).abs().max_element() > 0.499 {
                    continue;
                }
                let step = 1e-7;
                let slope = |d: DVec2| {
                    (map.sample(wrap, t + d * step).0 - map.sample(wrap, t - d * step).0)
                        / (2.0 * step)
                };
                let gradient = map.sample(wrap, t).1;
                let error = (gradient - DVec2::new(slope(DVec2::X), slope(DVec2::Y))).length();
                assert!(error < 1e-5, "{wrap:?} at {t}: off by {error}");
            }
        }
    }

    #[test]
    fn no_address_is_too_far() {
        let map = map(3, 2);
        for far in [1e18, 1e19, 1e300, -1e19, -1e300] {
            for wrap in WRAPS {
                let height = map.sample(wrap, DVec2::splat(far)).0;
                let [lo, hi] = map.range().map(f64::from);
                assert!(
                    (lo..=hi).contains(&height),
                    "{height} at {far} with {wrap:?}"
                );
            }
        }
    }

    #[test]
    fn what_is_no_map_is_refused_by_its_texel() {
        for (texel, phrase) in [
            (f32::NAN, "(1, 2) is NaN"),
            (f32::NEG_INFINITY, "(1, 2) is -inf"),
        ] {
            let mut texels = vec![0.0; 9];
            texels[7] = texel;
            let reason = OffsetMap::new([3, 3], texels).expect_err("not finite");
            assert!(reason.contains(phrase), "{reason}");
        }
        assert!(OffsetMap::new([0, 4], vec![]).is_err(), "no texels");
        assert!(
            OffsetMap::new([2, 2], vec![0.0; 3]).is_err(),
            "a texel is missing"
        );
        let map = OffsetMap::new([2, 1], vec![1e-40, 0.5]).expect("denormals are taken as 0");
        assert_eq!(map.texels, [0.0, 0.5], "denormal heights");
    }
}
