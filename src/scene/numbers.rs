//! Numbers for readers.

use super::Bounds;

/// A number with six significant digits and no more zeros than it needs.
pub(crate) fn round(value: f64) -> String {
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

/// Bounds, axis by axis.
pub(super) fn describe_bounds(bounds: &Bounds) -> String {
    let (min, max) = (bounds.min.to_array(), bounds.max.to_array());
    let axis = |i: usize| {
        format!(
            "{} {} to {}",
            ["x", "y", "z"][i],
            round(min[i]),
            round(max[i])
        )
    };
    format!("{}, {}, {}", axis(0), axis(1), axis(2))
}

#[cfg(test)]
mod tests {
    use super::*;

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
