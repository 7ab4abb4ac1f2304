//! The filters. They decode unit vectors in octahedral coding, unit quaternions from their three smaller components, floating-point numbers
//! with an explicit exponent, and colours from luma and two colour differences.
//!
//! Arithmetic is in f64. Results are off by at most half a unit, and the specification allows one unit.

use std::f64::consts::FRAC_1_SQRT_2;

/// Decodes unit vectors in octahedral coding, with four components of one or two bytes. The fourth component is not changed.
pub(super) fn octahedral(bytes: &mut [u8], stride: usize) {
    if stride == 4 {
        for element in bytes.chunks_exact_mut(4) {
            let [x, y, one] = [0, 1, 2].map(|i| f64::from(element[i] as i8));
            let unit = unit(x / one, y / one);
            for (byte, c) in element.iter_mut().zip(unit) {
                *byte = (c * f64::from(i8::MAX)).round() as i8 as u8;
            }
        }
    } else {
        for element in bytes.chunks_exact_mut(8) {
            let [x, y, one, _] = words(element).map(f64::from);
            for (word, c) in element.chunks_exact_mut(2).zip(unit(x / one, y / one)) {
                word.copy_from_slice(&in_16_bits(c));
            }
        }
    }
}

fn unit(x: f64, y: f64) -> [f64; 3] {
    let z = 1.0 - x.abs() - y.abs();
    let folded = z.min(0.0);
    let (x, y) = (x - folded.copysign(x), y - folded.copysign(y));
    let length = (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|c| c / length)
}

/// Decodes unit quaternions from three components and a scale, of two bytes each. The scale's lowest bits tell which component is missing.
pub(super) fn quaternion(bytes: &mut [u8]) {
    for element in bytes.chunks_exact_mut(8) {
        let [x, y, z, scale] = words(element);
        let one = f64::from(scale | 3);
        let [x, y, z] = [x, y, z].map(|c| f64::from(c) / one * FRAC_1_SQRT_2);
        let w = (1.0 - x * x - y * y - z * z).max(0.0).sqrt();
        let greatest = usize::from(scale as u16 & 3);
        for (step, c) in [w, x, y, z].into_iter().enumerate() {
            let at = 2 * ((greatest + step) % 4);
            element[at..at + 2].copy_from_slice(&in_16_bits(c));
        }
    }
}

/// Decodes floating-point numbers with an 8-bit exponent and a 24-bit mantissa, both signed.
pub(super) fn exponential(bytes: &mut [u8]) {
    for word in bytes.as_chunks_mut::<4>().0 {
        let packed = i32::from_le_bytes(*word);
        let (exponent, mantissa) = (packed >> 24, packed << 8 >> 8);
        let number = 2_f64.powi(exponent) * f64::from(mantissa);
        *word = (number as f32).to_le_bytes();
    }
}

/// Decodes colours with alpha from four components of one or two bytes: luma, the orange and green differences, and alpha. The highest set
/// bit of alpha gives the bit depth of all four components.
pub(super) fn colour(bytes: &mut [u8], stride: usize) {
    if stride == 4 {
        for element in bytes.as_chunks_mut::<4>().0 {
            let [luma, orange, green, alpha] = *element;
            let differences = [orange, green].map(|c| i32::from(c as i8));
            *element = red_green_blue(luma.into(), differences, alpha.into(), u8::MAX.into())
                .map(|c| c as u8);
        }
    } else {
        for element in bytes.chunks_exact_mut(8) {
            let [luma, orange, green, alpha] = words(element);
            let differences = [orange, green].map(i32::from);
            let [luma, alpha] = [luma, alpha].map(|c| i32::from(c as u16));
            let colour = red_green_blue(luma, differences, alpha, u16::MAX.into());
            for (word, c) in element.chunks_exact_mut(2).zip(colour) {
                word.copy_from_slice(&(c as u16).to_le_bytes());
            }
        }
    }
}

fn red_green_blue(luma: i32, [orange, green]: [i32; 2], alpha: i32, most: i32) -> [i32; 4] {
    let below_mark = alpha.checked_ilog2().map_or(0, |bit| (1 << bit) - 1);
    let one = 2 * below_mark + 1;
    let short = alpha & below_mark;
    // Alpha has one bit less than the other components, so its lowest bit is repeated.
    let alpha = short << 1 | short & 1;
    let colour = [
        luma + orange - green,
        luma + green,
        luma - orange - green,
        alpha,
    ];
    colour.map(|c| (f64::from(c) * f64::from(most) / f64::from(one)).round() as i32)
}

fn words(element: &[u8]) -> [i16; 4] {
    std::array::from_fn(|i| i16::from_le_bytes([element[2 * i], element[2 * i + 1]]))
}

fn in_16_bits(share: f64) -> [u8; 2] {
    ((share * f64::from(i16::MAX)).round() as i16).to_le_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn octants_fold_to_unit_vectors() {
        // In 8-bit components of which 7 bits are used, 63 stands for 1.
        let mut bytes = [0, 0, 63, 5, 63_i8 as u8, 0, 63, 0, -63_i8 as u8, 63, 63, 0];
        octahedral(&mut bytes, 4);
        let found = bytes.map(|b| b as i8);
        assert_eq!(found[..4], [0, 0, 127, 5]);
        assert_eq!(found[4..8], [127, 0, 0, 0]);
        // The corner of the octahedral square is the lower pole.
        assert_eq!(found[8..], [0, 0, -127, 0]);
        let mut wide: Vec<u8> = [16_383_i16, -16_384, 32_767, 9]
            .iter()
            .flat_map(|w| w.to_le_bytes())
            .collect();
        octahedral(&mut wide, 8);
        let [x, y, z, w] = words(&wide);
        assert!(
            (x - 23_169).abs() <= 2 && (y + 23_171).abs() <= 2,
            "{x}, {y}"
        );
        assert!(z.abs() <= 2 && w == 9, "{z}, {w}");
    }

    #[test]
    fn the_missing_component_is_the_greatest() {
        for greatest in 0..4_i16 {
            let scale = (2047 & !3) | greatest;
            let mut bytes: Vec<u8> = [0, 1024, 0, scale]
                .iter()
                .flat_map(|w: &i16| w.to_le_bytes())
                .collect();
            quaternion(&mut bytes);
            let q = words(&bytes).map(|c| f64::from(c) / 32_767.0);
            let at = |step: i16| q[((greatest + step) % 4) as usize];
            assert!(
                (at(2) - 1024.0 / 2047.0 * FRAC_1_SQRT_2).abs() < 1e-4,
                "{q:?}"
            );
            assert!((at(0) - (1.0 - at(2) * at(2)).sqrt()).abs() < 1e-4, "{q:?}");
            assert_eq!((at(1), at(3)), (0.0, 0.0), "{q:?}");
        }
    }

    #[test]
    fn exponents_are_signed() {
        for (exponent, mantissa, number) in [(0, 5, 5.0_f32), (-3, -12, -1.5), (10, 1, 1024.0)] {
            let packed: i32 = (exponent << 24) | (mantissa & 0xff_ffff);
            let mut bytes = packed.to_le_bytes();
            exponential(&mut bytes);
            assert_eq!(f32::from_le_bytes(bytes), number);
        }
    }
}
