//! `adaptive:TAU`: errors are what brute force finds, triangles meet without a crack whatever the view, and no point of a cap is
//! farther from where it belongs than TAU pixels.

use crate::common;

mod conforming;
mod displaced;
mod frames;
mod measured;
mod plans;
use crate::common::refined;

use cutaway::scene::{OffsetMap, Scene, Wrap};
use glam::DVec3;

use common::numbers::Numbers;
use common::{meshes, scenes};

const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];

/// Heights without a pattern.
fn noise(size: [u32; 2], seed: u64) -> OffsetMap {
    let mut numbers = Numbers(seed);
    let heights: Vec<f32> = (0..size[0] * size[1])
        .map(|_| numbers.unit() as f32)
        .collect();
    OffsetMap::new(size, heights).expect("finite heights")
}

/// A ball cut by a tilted relief: `period` is the length of one repeat of the map.
fn cut_ball(map: OffsetMap, period: f64, height: f64, wrap: Wrap) -> Scene {
    let surface = scenes::mapped(
        DVec3::new(0.02, -0.03, 0.05),
        DVec3::new(-0.3, -0.8, -0.6),
        map,
        (period, height),
        wrap,
    );
    scenes::scene(
        "ball",
        meshes::shape("sphere?subdivisions=3"),
        vec![surface],
    )
}
