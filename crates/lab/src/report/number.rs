//! Numbers as reports write them: one format for each kind, three significant digits, and no exponents.
//!
//! | kind | format |
//! |---|---|
//! | time | `0.0412`, `1.29`, `12.9`, `129`: [`milliseconds`] |
//! | factor | `×0.84`, `×1.29`, `×12.9`, `×129`: [`times`] |
//! | share | `0 %`, `0.04 %`, `1.29 %`, `12 %`: [`percent`] |
//! | any other figure | whole numbers in full, others like a time: [`figure`] |
//! | axis label | as short as possible: `0.5`, `25 k`, `2 M`: [`tick`] |
//!
//! A number too small for six decimals is written with a power of ten.

/// Numbers below this are zero in the first six decimals.
const LEAST: f64 = 1e-6;

/// A number with three significant digits, without an exponent.
pub(super) fn significant(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !value.is_finite() {
        return format!("{value:.0}");
    }
    if size < LEAST {
        return power(value);
    }
    let decimals = (2.0 - size.log10().floor()).clamp(0.0, 8.0) as usize;
    format!("{value:.decimals$}")
}

/// A number with a power of ten: `2·10⁻⁹`.
fn power(value: f64) -> String {
    let exponent = value.abs().log10().floor();
    let digits = value / 10_f64.powf(exponent);
    let raised: String = format!("{exponent:.0}")
        .chars()
        .map(|c| match c.to_digit(10) {
            Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
            None => '⁻',
        })
        .collect();
    let digits = format!("{digits:.1}");
    match digits.trim_end_matches(".0") {
        "1" => format!("10{raised}"),
        digits => format!("{digits}·10{raised}"),
    }
}

/// A time.
pub(super) fn milliseconds(ms: f64) -> String {
    significant(ms)
}

/// A factor.
pub(super) fn times(factor: f64) -> String {
    match factor {
        ..10.0 => format!("×{factor:.2}"),
        ..100.0 => format!("×{factor:.1}"),
        _ => format!("×{factor:.0}"),
    }
}

/// A share in percent, with enough digits to distinguish it from 0.
pub(super) fn percent(share: f64) -> String {
    match share * 100.0 {
        0.0 => "0 %".to_owned(),
        p if p < 0.01 => "< 0.01 %".to_owned(),
        p if p < 10.0 => format!("{p:.2} %"),
        p => format!("{p:.0} %"),
    }
}

/// Bytes in MiB, so that the numbers of a column have the same unit.
pub(super) fn mebibytes(bytes: u64) -> String {
    match bytes {
        0 => "0".to_owned(),
        _ => format!("{:.2}", bytes as f64 / 1_048_576.0),
    }
}

/// A figure of any kind; whole numbers are written in full.
pub(super) fn figure(value: f64) -> String {
    match value.fract() == 0.0 && value.abs() < 1e12 {
        true => format!("{value:.0}"),
        false => significant(value),
    }
}

/// The label of an axis tick, in as few characters as possible.
pub(super) fn tick(value: f64) -> String {
    let size = value.abs();
    if size > 0.0 && size < LEAST {
        return power(value);
    }
    let (value, suffix) = match size {
        1e9.. => (value / 1e9, " G"),
        1e6.. => (value / 1e6, " M"),
        1e4.. => (value / 1e3, " k"),
        _ => (value, ""),
    };
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    format!("{text}{suffix}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_count_and_none_is_an_exponent() {
        for (value, text) in [
            (0.0, "0"),
            (0.00748, "0.00748"),
            (0.702, "0.702"),
            (3.08, "3.08"),
            (35.04, "35.0"),
            (110.2, "110"),
            (12345.6, "12346"),
            (2.5e-9, "2.5·10⁻⁹"),
            (1e-7, "10⁻⁷"),
        ] {
            assert_eq!(significant(value), text);
        }
        assert_eq!([figure(7.0), figure(0.5)], ["7", "0.500"]);
    }

    #[test]
    fn factors_and_shares_have_one_form() {
        let factors = [0.843, 1.294, 12.94, 129.4].map(times);
        assert_eq!(factors, ["×0.84", "×1.29", "×12.9", "×129"]);
        let shares = [0.0, 0.00001, 0.0129, 0.129].map(percent);
        assert_eq!(shares, ["0 %", "< 0.01 %", "1.29 %", "13 %"]);
    }

    #[test]
    fn ticks_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (1.5, "1.5"),
            (1000.0, "1000"),
            (25_000.0, "25 k"),
            (2e6, "2 M"),
            (1e-5, "0.00001"),
            (0.125, "0.125"),
            (2e-9, "2·10⁻⁹"),
        ] {
            assert_eq!(tick(value), text);
        }
    }
}
