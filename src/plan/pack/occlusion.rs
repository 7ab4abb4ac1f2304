//! The numbers of occlusion.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// The search for horizons: `shaders/effects/horizon/find.wgsl`.
    Horizon {
        /// Largest distance at which something hides the sky, in scene units.
        radius: f32,
        /// The greatest distance of a sample in pixels.
        reach_px: f32,
        /// Planes through the line of sight.
        slices: u32,
        /// Samples to each side of each.
        steps: u32,
    }
}

shared! {
    /// Depth and blurred depth: `shaders/lib/effects/depth_blur.wgsl`.
    Unsharp {
        /// The length that is 1, in scene units.
        diagonal: f32,
        /// Standard deviation in pixels.
        sigma_px: f32,
        /// Samples to each side.
        reach_px: i32,
        /// Darkening where depth is greater by 1 than around.
        strength: f32,
    }
}

shared! {
    /// Weights of occlusion on caps of reliefs: `shaders/effects/relief_sky.wgsl`.
    ReliefSky {
        /// Weight of the occlusion found in the picture.
        cap: f32,
        /// Weight of the occlusion by the relief.
        relief: f32,
        /// Unused.
        padding_a: u32,
        /// Unused.
        padding_b: u32,
    }
}

shared! {
    /// A level ground and the map of its shadow: `shaders/effects/ground.wgsl`.
    Ground {
        /// From a point of the scene to the column of the map.
        x_row: [f32; 4],
        /// To the row of the map.
        y_row: [f32; 4],
        /// To the height above the ground.
        up: [f32; 4],
        /// Columns and rows of the map.
        side: u32,
        /// Share of the light missing where it is darkest.
        strength: f32,
        /// Unused.
        padding_a: u32,
        /// Unused.
        padding_b: u32,
    }
}
