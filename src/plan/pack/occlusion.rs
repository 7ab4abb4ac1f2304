//! Parameters of occlusion.

use bytemuck::{Pod, Zeroable};

use super::Layout;

shared! {
    /// The search for horizons: `shaders/effects/horizon/find.wgsl`.
    Horizon {
        /// Largest distance at which something hides the sky, in scene units.
        radius: f32,
        /// The greatest distance of a sample in pixels.
        reach_px: f32,
        /// Number of planes through the line of sight.
        slices: u32,
        /// Samples on each side, per plane.
        steps: u32,
    }
}

shared! {
    /// Depth and blurred depth: `shaders/lib/effects/depth_blur.wgsl`.
    Unsharp {
        /// Length that counts as 1, in scene units.
        diagonal: f32,
        /// Standard deviation in pixels.
        sigma_px: f32,
        /// Samples on each side.
        reach_px: i32,
        /// Darkening where the depth exceeds its surroundings by 1.
        strength: f32,
    }
}

shared! {
    /// Weights of occlusion on relief caps: `shaders/effects/relief_sky.wgsl`.
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
        /// Maps a scene point to a column of the map.
        x_row: [f32; 4],
        /// Maps a scene point to a row of the map.
        y_row: [f32; 4],
        /// Maps a scene point to its height above the ground.
        up: [f32; 4],
        /// Number of columns and of rows of the map.
        side: u32,
        /// Share of the light missing at the darkest point.
        strength: f32,
        /// Unused.
        padding_a: u32,
        /// Unused.
        padding_b: u32,
    }
}
