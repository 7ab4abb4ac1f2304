//! Colour parsing, and conversion between sRGB and linear light per channel (IEC 61966-2-1).

use glam::Vec3;

use super::color_names::COLOR_NAMES;
use crate::error::nearest;

/// Converts an sRGB channel to linear light, both in 0..=1 (IEC 61966-2-1).
pub fn linear_from_srgb(v: f32) -> f32 {
    if v <= 0.040_45 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

/// Converts a channel in linear light to sRGB, both in 0..=1 (IEC 61966-2-1).
pub fn srgb_from_linear(v: f32) -> f32 {
    if v <= 0.003_130_8 {
        12.92 * v
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    }
}

/// Applies a function to each channel.
pub fn map_channels(color: Vec3, of: impl Fn(f32) -> f32) -> Vec3 {
    Vec3::new(of(color.x), of(color.y), of(color.z))
}

/// Parses a colour, `#rrggbb`, `#rgb` or a CSS name, to sRGB in 0..=1.
pub fn parse_color(text: &str) -> Option<Vec3> {
    let Some(digits) = text.strip_prefix('#') else {
        let name = text.to_ascii_lowercase();
        let at = COLOR_NAMES.binary_search_by_key(&name.as_str(), |(known, _)| known);
        return Some(of_bits(COLOR_NAMES[at.ok()?].1, 8));
    };
    if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let value = u32::from_str_radix(digits, 16).ok()?;
    match digits.len() {
        6 => Some(of_bits(value, 8)),
        3 => Some(of_bits(value, 4)),
        _ => None,
    }
}

/// Text of a `help:` line for a string that is not a valid colour.
pub fn color_help(text: &str) -> String {
    let names: Vec<&str> = COLOR_NAMES.iter().map(|(name, _)| *name).collect();
    match nearest(&text.to_ascii_lowercase(), &names) {
        Some(near) => {
            format!("did you mean `{near}`? Colours are #rrggbb or CSS names")
        }
        None => {
            "write #rrggbb, for example #8a94a6, or a CSS name, for example darkorange".to_owned()
        }
    }
}

/// A colour from three channels with `bits` bits each.
fn of_bits(value: u32, bits: u32) -> Vec3 {
    let most = (1 << bits) - 1;
    let channel = |i: u32| ((value >> (bits * i)) & most) as f32 / most as f32;
    Vec3::new(channel(2), channel(1), channel(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_read_by_digits_and_by_names() {
        for (text, expected) in [
            ("#ff8000", [255, 128, 0]),
            ("#f80", [255, 136, 0]),
            ("darkorange", [255, 140, 0]),
            ("DarkOrange", [255, 140, 0]),
            ("aliceblue", [240, 248, 255]),
            ("yellowgreen", [154, 205, 50]),
            ("rebeccapurple", [102, 51, 153]),
        ] {
            let color = parse_color(text).expect(text) * 255.0;
            assert_eq!(
                color.round().to_array(),
                expected.map(|c: u8| f32::from(c)),
                "{text}"
            );
        }
        for text in [
            "",
            "#",
            "#ff",
            "#fffffff",
            "ff8000",
            "#ggg",
            "#+12",
            "darkorang",
            "dark orange",
        ] {
            assert_eq!(parse_color(text), None, "{text}");
        }
        assert!(
            COLOR_NAMES.is_sorted_by(|a, b| a.0 < b.0),
            "they are found by halving"
        );
    }

    #[test]
    fn what_is_no_colour_names_the_nearest() {
        assert!(color_help("darkorang").contains("`darkorange`"));
        assert!(color_help("Tael").contains("`teal`"));
        assert!(color_help("#12").contains("#rrggbb"), "no name is near");
    }
}
