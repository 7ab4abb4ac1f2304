//! sRGB and linear light, a channel at a time (IEC 61966-2-1). Colours are mixed in linear light.

use glam::Vec3;

pub(crate) fn linear_from_srgb(v: f32) -> f32 {
    if v <= 0.040_45 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

pub(crate) fn srgb_from_linear(v: f32) -> f32 {
    if v <= 0.003_130_8 {
        12.92 * v
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    }
}

/// A function of each channel.
pub(crate) fn map_channels(color: Vec3, of: impl Fn(f32) -> f32) -> Vec3 {
    Vec3::new(of(color.x), of(color.y), of(color.z))
}
