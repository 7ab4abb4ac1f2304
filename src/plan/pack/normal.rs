//! Unit vectors in one word, as `shaders/lib/layers.wgsl` reads and writes them.

use glam::Vec3;

/// A unit vector as two 16-bit signed fractions, octahedral: the counterpart of `pack_normal` in `shaders/lib/layers.wgsl`; a
/// test compares the two word by word.
pub fn pack_normal(n: Vec3) -> u32 {
    let sum = n.x.abs() + n.y.abs() + n.z.abs();
    let (mut x, mut y) = if sum > 0.0 {
        (n.x / sum, n.y / sum)
    } else {
        (0.0, 0.0)
    };
    if n.z < 0.0 {
        let sign = |c: f32| if c >= 0.0 { 1.0 } else { -1.0 };
        (x, y) = ((1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y));
    }
    let snorm =
        |c: f32| u32::from(((c.clamp(-1.0, 1.0) * 32_767.0).round() as i16).cast_unsigned());
    snorm(x) | (snorm(y) << 16)
}

/// Inverse of [`pack_normal`]: the unit vector that a word encodes.
pub fn unpack_normal(word: u32) -> Vec3 {
    let part =
        |shift: u32| (f32::from(((word >> shift) & 0xffff) as u16 as i16) / 32_767.0).max(-1.0);
    let (x, y) = (part(0), part(16));
    let z = 1.0 - x.abs() - y.abs();
    let sign = |c: f32| if c >= 0.0 { 1.0 } else { -1.0 };
    let (x, y) = if z < 0.0 {
        ((1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y))
    } else {
        (x, y)
    };
    Vec3::new(x, y, z).normalize_or_zero()
}
