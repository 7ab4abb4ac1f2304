//! The viewport of a draw. It is larger than the target, so that no triangle is clipped at the borders of the picture.
//!
//! Clipping a needle triangle at a border leaves an even thinner needle, whose depth can be any value between those of its ends (regression
//! 0007). `shaders/lib/rasterise/viewport.wgsl` transforms clip space to the same viewport.
//!
//! Limits: a target of 8192 px has no margin, and the near plane has none either.

/// Side of the largest viewport that every core WebGPU device supports.
const VIEWPORT_PX: u32 = 8192;

/// Corner and size of a target's viewport, in pixels from the target's upper left corner.
pub(super) fn viewport_px(target_px: [u32; 2]) -> [[f32; 2]; 2] {
    let size = target_px.map(|n| n << (VIEWPORT_PX / n).max(1).ilog2());
    let corner = [0, 1].map(|i| -((size[i] - target_px[i]) as f32) / 2.0);
    [corner, size.map(|n| n as f32)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_viewport_is_about_its_target_and_within_what_devices_take() {
        for (target, corner, size) in [
            ([1024, 768], [-3584.0, -2688.0], [8192.0, 6144.0]),
            ([1, 3], [-4095.5, -3070.5], [8192.0, 6144.0]),
            ([8192, 8000], [0.0, 0.0], [8192.0, 8000.0]),
            ([16384, 4096], [0.0, -2048.0], [16384.0, 8192.0]),
        ] {
            assert_eq!(viewport_px(target), [corner, size], "{target:?}");
        }
    }
}
