//! Blending of two offset maps into one.

use glam::DVec2;
use rayon::prelude::*;

use crate::scene::{OffsetMap, Wrap};

/// Operation that combines two heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BlendOp {
    /// The sum; two maps of 0..=1 give 0..=2.
    Add,
    /// The product.
    Multiply,
    /// The lower one.
    Min,
    /// The higher one.
    Max,
    /// `1 - (1 - a) (1 - b)`: high where either map is high, and never above 1 for maps of 0..=1.
    Screen,
    /// `2 a b` where `a` is below one half, elsewhere `1 - 2 (1 - a) (1 - b)`: the second map deepens and raises the first.
    Overlay,
    /// Absolute difference.
    Difference,
    /// `a (1 - share) + b share`.
    Mix {
        /// Share of the second map, 0..=1.
        share: f64,
    },
}

impl BlendOp {
    /// Names that [`BlendOp::named`] accepts.
    pub const NAMES: [&str; 8] = [
        "add",
        "multiply",
        "min",
        "max",
        "screen",
        "overlay",
        "difference",
        "mix",
    ];

    /// The operation with a given name; `mix` takes one half of each map.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "add" => Self::Add,
            "multiply" => Self::Multiply,
            "min" => Self::Min,
            "max" => Self::Max,
            "screen" => Self::Screen,
            "overlay" => Self::Overlay,
            "difference" => Self::Difference,
            "mix" => Self::Mix { share: 0.5 },
            _ => return None,
        })
    }

    fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Multiply => a * b,
            Self::Min => a.min(b),
            Self::Max => a.max(b),
            Self::Screen => 1.0 - (1.0 - a) * (1.0 - b),
            Self::Overlay if a < 0.5 => 2.0 * a * b,
            Self::Overlay => 1.0 - 2.0 * (1.0 - a) * (1.0 - b),
            Self::Difference => (a - b).abs(),
            Self::Mix { share } => a * (1.0 - share) + b * share,
        }
    }

    /// Blends two maps at the larger width and the larger height; a smaller map is interpolated with repeat addressing.
    /// Returns an error text if a sum or product leaves the range of f32.
    pub fn blend(self, a: &OffsetMap, b: &OffsetMap) -> Result<OffsetMap, String> {
        let size = [a.size()[0].max(b.size()[0]), a.size()[1].max(b.size()[1])];
        let extent = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        let height = |map: &OffsetMap, x: u32, y: u32| {
            if map.size() == size {
                // At texel centres interpolation would give the same texel, except for rounding.
                return map.texel(Wrap::Repeat, i64::from(x), i64::from(y));
            }
            let t = (DVec2::new(f64::from(x), f64::from(y)) + 0.5) / extent;
            map.sample(Wrap::Repeat, t).0
        };
        let texels = (0..size[1])
            .into_par_iter()
            .flat_map_iter(|y| (0..size[0]).map(move |x| (x, y)))
            .map(|(x, y)| self.of(height(a, x, y), height(b, x, y)) as f32)
            .collect();
        OffsetMap::new(size, texels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(size: [u32; 2], texels: &[f32]) -> OffsetMap {
        OffsetMap::new(size, texels.to_vec()).expect("a plain map")
    }

    #[test]
    fn each_operation_is_what_its_name_says() {
        let (a, b) = (map([2, 1], &[0.25, 0.5]), map([2, 1], &[0.5, 0.125]));
        for (name, expected) in [
            ("add", [0.75, 0.625]),
            ("multiply", [0.125, 0.0625]),
            ("min", [0.25, 0.125]),
            ("max", [0.5, 0.5]),
            ("screen", [0.625, 0.5625]),
            ("overlay", [0.25, 0.125]),
            ("difference", [0.25, 0.375]),
            ("mix", [0.375, 0.3125]),
        ] {
            let op = BlendOp::named(name).expect(name);
            let blended = op.blend(&a, &b).expect(name);
            assert_eq!(blended.texels(), expected, "{name}");
        }
    }

    #[test]
    fn the_larger_size_wins_on_each_axis() {
        let (wide, tall) = (
            map([4, 1], &[0.0, 1.0, 2.0, 3.0]),
            map([1, 3], &[0.0, 10.0, 20.0]),
        );
        let sum = BlendOp::Add.blend(&wide, &tall).expect("finite");
        assert_eq!(sum.size(), [4, 3], "size of the sum");
        for (i, height) in sum.texels().iter().enumerate() {
            let expected = (i % 4) as f32 + 10.0 * (i / 4) as f32;
            assert!(
                (height - expected).abs() < 1e-5,
                "texel {i}: {height} is not {expected}"
            );
        }
    }

    #[test]
    fn a_sum_beyond_f32_is_refused() {
        let huge = map([1, 1], &[f32::MAX]);
        let refused = BlendOp::Add.blend(&huge, &huge);
        assert!(refused.is_err(), "infinite heights got through");
    }
}
