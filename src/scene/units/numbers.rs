//! Formatting of numbers for human readers.

/// A number with six significant digits and no more zeros than it needs.
pub fn round(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-5..=9).contains(&magnitude) {
        return format!("{value:.5e}");
    }
    let text = format!("{value:.*}", (5 - magnitude).max(0) as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// A coordinate with enough digits to read it back as `f32`, so that a face there lies in a plane typed with this number.
pub(crate) fn coordinate(value: f64) -> String {
    let short = round(value);
    match short.parse::<f32>() {
        Ok(read) if read != value as f32 && !short.contains('e') => format!("{}", value as f32),
        _ => short,
    }
}

/// Bounds, axis by axis.
pub fn describe_bounds(min: [f64; 3], max: [f64; 3]) -> String {
    let axis = |i: usize| {
        format!(
            "{} {} to {}",
            ["x", "y", "z"][i],
            coordinate(min[i]),
            coordinate(max[i])
        )
    };
    format!("{}, {}, {}", axis(0), axis(1), axis(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_read_back_as_the_same_f32() {
        for (value, text) in [
            (0.25, "0.25"),
            (73.055_328_369_140_62, "73.05533"),
            (5_001.370_117_187_5, "5001.37"),
            (-1_234_567.75, "-1234567.8"),
        ] {
            assert_eq!(coordinate(value), text);
            assert_eq!(text.parse::<f32>(), Ok(value as f32));
        }
    }

    #[test]
    fn numbers_are_written_short() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-0.25, "-0.25"),
            (1_234_567.8, "1234568"),
            (0.000_123_456_7, "0.000123457"),
            (100.0, "100"),
            (1e12, "1.00000e12"),
            (1.0 / 3.0, "0.333333"),
        ] {
            assert_eq!(round(value), text);
        }
    }
}
