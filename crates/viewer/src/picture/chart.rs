//! Positions in a chart of error against time. Both axes are logarithmic; the error axis has an extra position for zero.

/// Position on the error axis for zero wrong pixels: half a decade below one wrong pixel.
pub const NONE_WRONG: f64 = -0.5;

/// Position of a time on the time axis.
pub fn place_of_time(time_ms: f64) -> f64 {
    // Times below a nanosecond are measured as zero, which has no logarithm.
    time_ms.max(1e-6).log10()
}

/// Position of a number of wrong pixels on the error axis.
pub fn place_of_wrong(wrong_px: usize) -> f64 {
    match wrong_px {
        0 => NONE_WRONG,
        count => (count as f64).log10(),
    }
}

/// Label of the time axis at a position, in milliseconds.
pub fn time_label(place: f64) -> String {
    number(place)
}

/// Label of the error axis at a position, in pixels.
pub fn wrong_label(place: f64) -> String {
    let is_none = (place - NONE_WRONG).abs() < 1e-9;
    match place < 0.0 {
        true if is_none => "0".to_owned(),
        true => String::new(),
        false => number(place),
    }
}

/// The number at a position, if it is one, two or five times a power of ten; otherwise an empty text.
fn number(place: f64) -> String {
    let power = (place + 1e-6).floor();
    let times = 10f64.powf(place - power);
    let labelled = [1.0, 2.0, 5.0].into_iter();
    let labelled = labelled.filter(|label| (label - times).abs() < 1e-4);
    // Parsed from decimal digits, because a product of two floats may not print as a short number.
    let shown = labelled.map(|label| format!("{label}e{power}").parse::<f64>());
    shown.flatten().map(|number| number.to_string()).collect()
}

/// Grid lines between two positions, at one to nine times the powers of ten; each with a spacing that ranks it: 1, 0.3 or 0.1.
pub fn lines(from: f64, to: f64) -> Vec<(f64, f64)> {
    let powers = from.floor() as i32..=to.ceil() as i32;
    let around = |power: i32| {
        (1..10).map(move |times| {
            let place = f64::from(power) + f64::from(times).log10();
            let to_next = match times {
                1 => 1.0,
                2 | 5 => 0.3,
                _ => 0.1,
            };
            (place, to_next)
        })
    };
    let all = powers.flat_map(around);
    all.filter(|(place, _)| (from..=to).contains(place))
        .collect()
}

/// The nearest labelled position at or below `least`, and the nearest one at or above `greatest`.
pub fn labels_around(least: f64, greatest: f64) -> [f64; 2] {
    let all = lines(least - 1.0, greatest + 1.0).into_iter();
    let labelled = all.filter_map(|(place, to_next)| (to_next > 0.2).then_some(place));
    let (below, above): (Vec<f64>, Vec<f64>) = labelled.partition(|place| *place <= least);
    let above = above.into_iter().find(|place| *place >= greatest);
    [
        below.last().copied().unwrap_or(least),
        above.unwrap_or(greatest),
    ]
}

/// Grid lines of the error axis. There are none between zero and one wrong pixel.
pub fn lines_of_wrong(from: f64, to: f64) -> Vec<(f64, f64)> {
    let none = (from..=to).contains(&NONE_WRONG);
    let none = none.then_some((NONE_WRONG, 1.0));
    none.into_iter().chain(lines(from.max(0.0), to)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_error_has_a_place_below_one() {
        let places = [0, 1, 2, 10, 1000].map(place_of_wrong);
        assert!(places.is_sorted_by(|a, b| a < b), "{places:?}");
        assert_eq!(wrong_label(places[0]), "0");
        assert_eq!(wrong_label(places[1]), "1");
        assert_eq!(wrong_label(places[4]), "1000");
        assert_eq!(wrong_label(places[2]), "2");
        assert_eq!(wrong_label(place_of_wrong(3)), "", "between two labels");
        assert_eq!(wrong_label(-1.0), "", "there is no tenth of a pixel");
    }

    #[test]
    fn times_are_told_at_one_two_and_five_times_a_power_of_ten() {
        assert_eq!(place_of_time(100.0), 2.0);
        assert!(place_of_time(0.0).is_finite(), "a clock that stood still");
        assert_eq!([-1.0, 0.0, 2.0].map(time_label), ["0.1", "1", "100"]);
        let fives = [0.05, 5.0, 500.0].map(|ms| time_label(place_of_time(ms)));
        assert_eq!(fives, ["0.05", "5", "500"]);
    }

    #[test]
    fn lines_are_those_of_logarithmic_paper() {
        let all = lines(-1.0, 1.0);
        assert_eq!(all.len(), 19, "{all:?}");
        assert!(all.is_sorted_by(|a, b| a.0 < b.0), "{all:?}");
        let thick = all.iter().filter(|(_, step)| *step == 1.0).count();
        assert_eq!(thick, 3, "a tenth, one and ten");
        let around = labels_around(place_of_time(430.0), place_of_time(1010.0));
        assert_eq!(around.map(time_label), ["200", "2000"]);
        let alone = labels_around(place_of_time(100.0), place_of_time(100.0));
        assert_eq!(alone.map(time_label), ["100", "200"]);
        let wrong = lines_of_wrong(-1.0, 1.0);
        assert_eq!(wrong[0].0, NONE_WRONG);
        assert_eq!(wrong[1].0, 0.0, "nothing between none and one");
    }
}
