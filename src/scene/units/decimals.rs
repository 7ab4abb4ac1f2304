//! Rounding of numbers in documents for readability.

/// Rounds to a number of decimals, which may be negative; never returns -0. A value without such a neighbour is returned unchanged.
pub fn to_decimals(value: f64, decimals: i32) -> f64 {
    let unit = 10.0_f64.powi(decimals.abs());
    let rounded = match decimals >= 0 {
        true => (value * unit).round() / unit,
        false => (value / unit).round() * unit,
    };
    match rounded.is_finite() {
        true => rounded + 0.0,
        false => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_to_tenths_and_to_tens() {
        for (value, decimals, expected) in [
            (0.15, 1, 0.2),
            (-0.01, 1, 0.0),
            (1234.0, -2, 1200.0),
            (1.5e300, 20, 1.5e300),
            (f64::INFINITY, 2, f64::INFINITY),
        ] {
            let rounded = to_decimals(value, decimals);
            assert_eq!(rounded, expected, "{value} to {decimals}");
            assert!(rounded != 0.0 || rounded.is_sign_positive(), "-0");
        }
    }
}
