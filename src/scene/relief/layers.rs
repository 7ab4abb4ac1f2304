//! Three-dimensional offset maps: layers of the same size, and interpolation between them.
//!
//! Layer `i` lies at the coordinate `i`, as texels lie at their centres; beyond the first and the last, layers continue as the wrap mode
//! defines, so that under `repeat` the first follows the last. The map at a coordinate is the linear interpolation of its two neighbours,
//! in f64 and rounded to f32 once per texel: bilinear interpolation of that map equals trilinear interpolation of the layers, except for
//! this rounding, and the device and the exact reference use the same map. At a whole coordinate it is the layer itself. Cost: one pass
//! over the texels whenever the coordinate changes.

use std::sync::Arc;

use rayon::prelude::*;

use crate::scene::{OffsetMap, Wrap};

/// The map at a coordinate across layers; an error text if the layers define none.
pub fn between_layers(
    layers: &[Arc<OffsetMap>],
    at: f64,
    wrap: Wrap,
) -> Result<Arc<OffsetMap>, String> {
    let count = u32::try_from(layers.len()).unwrap_or(u32::MAX);
    let Some(first) = layers.first() else {
        return Err("it has no layer".into());
    };
    if let Some(odd) = layers.iter().position(|l| l.size() != first.size()) {
        let [[w, h], [other_w, other_h]] = [first.size(), layers[odd].size()];
        return Err(format!(
            "its layers differ in size: layer 0 has {w} x {h} texels, layer {odd} has {other_w} x {other_h}"
        ));
    }
    let below = at.floor();
    let share = at - below;
    let layer = |address: f64| &layers[wrap.texel(address as i64, count) as usize];
    let (low, high) = (layer(below), layer(below + 1.0));
    if share == 0.0 || Arc::ptr_eq(low, high) {
        return Ok(Arc::clone(low));
    }
    let pairs = low.texels().par_iter().zip(high.texels());
    let mixed = pairs.map(|(a, b)| {
        let (a, b) = (f64::from(*a), f64::from(*b));
        (a * (1.0 - share) + b * share) as f32
    });
    OffsetMap::new(first.size(), mixed.collect()).map(Arc::new)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    fn layer(heights: [f32; 4]) -> Arc<OffsetMap> {
        Arc::new(OffsetMap::new([2, 2], heights.to_vec()).expect("finite heights"))
    }

    fn stack() -> Vec<Arc<OffsetMap>> {
        vec![
            layer([0.0, 1.0, 2.0, 3.0]),
            layer([8.0, 1.0, 0.0, -3.0]),
            layer([4.0, 4.0, 4.0, 4.0]),
        ]
    }

    #[test]
    fn whole_coordinates_are_the_layers_themselves() {
        let stack = stack();
        for (wrap, expected) in [
            (Wrap::Repeat, [2, 0, 1, 2, 0]),
            (Wrap::Mirror, [0, 0, 1, 2, 2]),
            (Wrap::Clamp, [0, 0, 1, 2, 2]),
        ] {
            for (at, layer) in [-1.0, 0.0, 1.0, 2.0, 3.0].into_iter().zip(expected) {
                let map = between_layers(&stack, at, wrap).expect("a map");
                assert!(Arc::ptr_eq(&map, &stack[layer]), "{wrap:?} at {at}");
            }
        }
    }

    #[test]
    fn between_them_it_is_the_trilinear_interpolation() {
        let stack = stack();
        for (at, wrap, [low, high], share) in [
            (0.25, Wrap::Clamp, [0, 1], 0.25),
            (1.5, Wrap::Repeat, [1, 2], 0.5),
            (2.75, Wrap::Repeat, [2, 0], 0.75),
            (-0.5, Wrap::Repeat, [2, 0], 0.5),
            (-4.25, Wrap::Mirror, [1, 2], 0.75),
        ] {
            let map = between_layers(&stack, at, wrap).expect("a map");
            for t in [[0.1, 0.7], [0.5, 0.5], [-0.3, 2.2]].map(DVec2::from) {
                let height = |m: &OffsetMap| m.sample(Wrap::Repeat, t).0;
                let expected = height(&stack[low]) * (1.0 - share) + height(&stack[high]) * share;
                let off = (height(&map) - expected).abs();
                assert!(off < 1e-6, "{wrap:?} at {at}: off by {off} at {t}");
            }
        }
    }

    #[test]
    fn what_is_no_stack_is_told() {
        let odd = Arc::new(OffsetMap::new([4, 1], vec![0.0; 4]).expect("finite heights"));
        let describe = |layers: &[Arc<OffsetMap>]| {
            let none = between_layers(layers, 0.0, Wrap::Repeat);
            none.expect_err("no stack")
        };
        assert!(describe(&[]).contains("no layer"));
        let what = describe(&[layer([0.0; 4]), odd]);
        assert!(what.contains("2 x 2") && what.contains("4 x 1"), "{what}");
        for far in [1e300, -1e300] {
            between_layers(&stack(), far, Wrap::Mirror).expect("no address is too far");
        }
    }
}
