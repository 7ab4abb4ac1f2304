//! Reads parameter values as numbers where possible: `4%`, `20 k`, `1024,768`.

use std::cmp::Ordering;

/// Suffixes of numbers, and the factor of each.
const SUFFIXES: [(&str, f64); 8] = [
    ("", 1.0),
    ("%", 1.0),
    ("px", 1.0),
    ("deg", 1.0),
    ("°", 1.0),
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
];

/// The number that a value stands for. A pair, such as a size in pixels, stands for its product.
fn number_of(text: &str) -> Option<f64> {
    let side = |t: &str| t.trim().parse::<u32>().ok().map(f64::from);
    let pair = text.split_once([',', 'x']);
    if let Some((Some(a), Some(b))) = pair.map(|(a, b)| (side(a), side(b))) {
        return Some(a * b);
    }
    let text = text.trim();
    let end = text
        .char_indices()
        .find(|(_, c)| !matches!(c, '0'..='9' | '.' | '-' | '+' | 'e' | 'E'))
        .map_or(text.len(), |(at, _)| at);
    let (digits, suffix) = text.split_at(end);
    let (_, factor) = SUFFIXES.iter().find(|(s, _)| *s == suffix.trim())?;
    let number: f64 = digits.parse().ok()?;
    (number.is_finite()).then_some(number * factor)
}

/// Order of values: numbers come before words, numbers sorted by size and words alphabetically.
pub(crate) fn natural(a: &str, b: &str) -> Ordering {
    match (number_of(a), number_of(b)) {
        (Some(x), Some(y)) => x.total_cmp(&y).then_with(|| a.cmp(b)),
        (Some(_), None) => Ordering::Less,
        (None, Some(_)) => Ordering::Greater,
        (None, None) => a.cmp(b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stand_for_numbers() {
        for (text, number) in [
            ("4%", Some(4.0)),
            ("20 k", Some(20e3)),
            ("1 M", Some(1e6)),
            ("-0.5", Some(-0.5)),
            ("1e-3", Some(1e-3)),
            ("512,384", Some(512.0 * 384.0)),
            ("12px", Some(12.0)),
            ("crank", None),
            ("32-bit", None),
            ("", None),
            ("1,2,3", None),
        ] {
            assert_eq!(number_of(text), number, "{text}");
        }
    }

    #[test]
    fn values_are_ordered_as_people_do() {
        let mut values = ["wide", "10%", "2%", "narrow", "1%"];
        values.sort_by(|a, b| natural(a, b));
        assert_eq!(values, ["1%", "2%", "10%", "narrow", "wide"]);
    }
}
