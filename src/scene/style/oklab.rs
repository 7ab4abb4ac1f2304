//! OKLab, a colour space in which equal steps look equal (Björn Ottosson, "A perceptual color space for image processing", 2020).

use glam::{Mat3, Vec3};

use crate::scene::materials::color::{linear_from_srgb, map_channels, srgb_from_linear};

/// From linear sRGB to the responses of the three cones, by columns.
const CONES_FROM_LINEAR: Mat3 = Mat3::from_cols(
    Vec3::new(0.412_221_47, 0.211_903_5, 0.088_302_46),
    Vec3::new(0.536_332_54, 0.680_699_5, 0.281_718_84),
    Vec3::new(0.051_445_993, 0.107_396_96, 0.629_978_7),
);

/// From the cube roots of the cone responses to lightness and the two colour axes, by columns.
const LAB_FROM_ROOTS: Mat3 = Mat3::from_cols(
    Vec3::new(0.210_454_26, 1.977_998_5, 0.025_904_037),
    Vec3::new(0.793_617_8, -2.428_592_2, 0.782_771_77),
    Vec3::new(-0.004_072_047, 0.450_593_7, -0.808_675_77),
);

/// Lightness, green-red axis, blue-yellow axis.
pub(super) fn oklab_from_srgb(color: Vec3) -> Vec3 {
    let cones = CONES_FROM_LINEAR * map_channels(color, linear_from_srgb);
    LAB_FROM_ROOTS * map_channels(cones, f32::cbrt)
}

/// Converts to sRGB; each channel of a colour outside sRGB is clamped.
pub(super) fn srgb_from_oklab(lab: Vec3) -> Vec3 {
    let roots = LAB_FROM_ROOTS.inverse() * lab;
    let linear = CONES_FROM_LINEAR.inverse() * (roots * roots * roots);
    map_channels(linear, |v| srgb_from_linear(v.clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_survive_a_round_trip() {
        for color in [Vec3::ZERO, Vec3::ONE, Vec3::X, Vec3::new(0.2, 0.5, 0.9)] {
            let again = srgb_from_oklab(oklab_from_srgb(color));
            assert!(again.abs_diff_eq(color, 1e-3), "{color} becomes {again}");
        }
    }

    #[test]
    fn white_and_red_are_where_the_author_puts_them() {
        assert!(
            oklab_from_srgb(Vec3::ONE).abs_diff_eq(Vec3::X, 1e-3),
            "white"
        );
        // XYZ of linear red gives L 0.628, a 0.225, b 0.126.
        let red = Vec3::new(0.628, 0.225, 0.126);
        assert!(oklab_from_srgb(Vec3::X).abs_diff_eq(red, 1e-3), "red");
    }
}
