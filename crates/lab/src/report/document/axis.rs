//! Layout of values along an axis, and choice of the values that are labelled.
//!
//! A logarithmic axis has no position for 0. If some value is 0, a strip with its own tick is added beyond the axis's lower end.

use crate::report::number::tick;

/// Distance in pixels between the strip for 0 and the rest of the axis.
const ZERO_STRIP: f64 = 26.0;

/// Minimum margin on either side of the values, as a share of the axis.
const AXIS_MARGIN: f64 = 0.05;

/// An axis of a chart, laid out.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale {
    is_log: bool,
    /// Minimum and maximum value; their logarithms on a logarithmic axis.
    range: [f64; 2],
    /// Pixel positions of the minimum and the maximum.
    px: [f64; 2],
    /// Pixel position of 0, if it has its own strip.
    pub(super) zero_px: Option<f64>,
}

impl Scale {
    /// Lays out an axis for some values between two pixel positions. With `from_zero`, a linear axis begins at 0.
    pub(super) fn of(values: &[f64], is_log: bool, from_zero: bool, px: [f64; 2]) -> Self {
        let has_zero = is_log && values.iter().any(|v| *v <= 0.0);
        let shown: Vec<f64> = values
            .iter()
            .copied()
            .filter(|v| v.is_finite() && (!is_log || *v > 0.0))
            .map(|v| if is_log { v.log10() } else { v })
            .collect();
        let mut least = shown.iter().copied().fold(f64::INFINITY, f64::min);
        let mut most = shown.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if shown.is_empty() {
            (least, most) = (0.0, 1.0);
        }
        let starts_at_zero = from_zero && !is_log && least >= 0.0;
        if starts_at_zero {
            least = 0.0;
        }
        // If there is only one value, leave room on both sides of it.
        let short = if is_log {
            0.2
        } else {
            0.1 * most.abs().max(1e-9)
        };
        let room =
            ((most - least) * AXIS_MARGIN).max(if most - least < short { short } else { 0.0 });
        let range = [if starts_at_zero { 0.0 } else { least - room }, most + room];
        let toward = (px[1] - px[0]).signum();
        let zero_px = has_zero.then_some(px[0]);
        let from = if has_zero {
            px[0] + toward * ZERO_STRIP
        } else {
            px[0]
        };
        Self {
            is_log,
            range,
            px: [from, px[1]],
            zero_px,
        }
    }

    /// Pixel position of a value.
    pub(super) fn place(&self, value: f64) -> f64 {
        if self.is_log && value <= 0.0 {
            return self.zero_px.unwrap_or(self.px[0]);
        }
        let value = if self.is_log { value.log10() } else { value };
        let share = (value - self.range[0]) / (self.range[1] - self.range[0]);
        self.px[0] + share.clamp(0.0, 1.0) * (self.px[1] - self.px[0])
    }

    /// The values that are labelled on the axis, with their labels.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        let values = if self.is_log {
            self.log_ticks()
        } else {
            linear_ticks(self.range, 6.0)
        };
        let zero = self.zero_px.map(|_| (0.0, "0".to_owned()));
        let others = values.into_iter().map(|v| (v, tick(v)));
        zero.into_iter().chain(others).collect()
    }

    fn log_ticks(&self) -> Vec<f64> {
        let [least, most] = self.range;
        let within = |digits: &[f64], every: i32| -> Vec<f64> {
            let decades = (least.floor() as i32)..=(most.ceil() as i32);
            decades
                .filter(|d| d.rem_euclid(every) == 0)
                .flat_map(|d| digits.iter().map(move |m| m * 10_f64.powi(d)))
                .filter(|v| (least..=most).contains(&v.log10()))
                .collect()
        };
        match most - least {
            ..1.0 => {
                let few = within(&[1.0, 1.5, 2.0, 3.0, 5.0, 7.0], 1);
                if few.len() >= 3 {
                    return few;
                }
                linear_ticks([10_f64.powf(least), 10_f64.powf(most)], 6.0)
            }
            ..2.5 => within(&[1.0, 2.0, 5.0], 1),
            ..3.0 => within(&[1.0, 3.0], 1),
            ..9.0 => within(&[1.0], 1),
            _ => within(&[1.0], 2),
        }
    }
}

/// About `count` round values within the range.
fn linear_ticks([least, most]: [f64; 2], count: f64) -> Vec<f64> {
    let rough = (most - least) / count;
    let unit = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 2.5, 5.0, 10.0]
        .map(|m| m * unit)
        .into_iter()
        .find(|s| *s >= rough)
        .unwrap_or(rough);
    let first = (least / step).ceil() as i64;
    let last = (most / step).floor() as i64;
    (first..=last.min(first + 20))
        .map(|i| i as f64 * step)
        .collect()
}

/// Leaves out ticks so that no two labels touch.
pub(super) fn apart(
    ticks: Vec<(f64, String)>,
    place: impl Fn(f64) -> f64,
    least_px: f64,
) -> Vec<(f64, String)> {
    let mut kept: Vec<(f64, String)> = Vec::new();
    for (value, word) in ticks {
        let at = place(value);
        let is_clear = |(v, _): &(f64, String)| (place(*v) - at).abs() >= least_px;
        if kept.iter().all(is_clear) {
            kept.push((value, word));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_lie_at_even_distances_and_zero_apart() {
        let scale = Scale::of(&[0.0, 1.0, 10.0, 100.0, 1000.0], true, false, [300.0, 0.0]);
        let at = [1.0, 10.0, 100.0, 1000.0].map(|v| scale.place(v));
        let steps: Vec<f64> = at.windows(2).map(|p| p[0] - p[1]).collect();
        assert!(
            steps.iter().all(|s| (s - steps[0]).abs() < 1e-9),
            "{steps:?}"
        );
        assert_eq!(scale.place(0.0), 300.0);
        assert!(at[0] <= 300.0 - ZERO_STRIP, "{at:?}");
        let labels: Vec<String> = scale.ticks().into_iter().map(|(_, t)| t).collect();
        assert_eq!(labels, ["0", "1", "10", "100", "1000"]);
        let without = Scale::of(&[1.0, 10.0], true, false, [300.0, 0.0]);
        assert_eq!(without.zero_px, None);
    }

    #[test]
    fn linear_axes_have_round_ticks() {
        let scale = Scale::of(&[0.3, 9.7], false, true, [0.0, 100.0]);
        assert_eq!(scale.place(0.0), 0.0);
        let labels: Vec<String> = scale.ticks().into_iter().map(|(_, t)| t).collect();
        assert_eq!(labels, ["0", "2", "4", "6", "8", "10"]);
    }

    #[test]
    fn logarithmic_axes_have_at_least_three_ticks() {
        for span in [1.05, 1.3, 2.0, 5.0, 30.0, 400.0, 5e3, 1e6, 1e9, 1e12] {
            for least in [1e-5, 0.37, 1.0, 8.5, 4100.0] {
                let scale = Scale::of(&[least, least * span], true, false, [0.0, 300.0]);
                let ticks = scale.ticks();
                assert!(ticks.len() >= 3, "{least} to {}: {ticks:?}", least * span);
                assert!(ticks.len() <= 12, "{least} to {}: {ticks:?}", least * span);
            }
        }
    }

    #[test]
    fn few_or_no_values_are_laid_out_too() {
        for values in [vec![], vec![0.0], vec![5.0], vec![1e-9, 1e12]] {
            for is_log in [false, true] {
                let scale = Scale::of(&values, is_log, true, [0.0, 100.0]);
                for value in &values {
                    let at = scale.place(*value);
                    assert!((0.0..=100.0).contains(&at), "{values:?} at {at}");
                }
                assert!(!scale.ticks().is_empty(), "{values:?} {is_log}");
            }
        }
    }

    #[test]
    fn ticks_do_not_touch() {
        let ticks = [0.0, 1.0, 2.0, 5.0].map(|v| (v, String::new()));
        let kept = apart(ticks.into(), |v| v * 10.0, 20.0);
        let kept: Vec<f64> = kept.into_iter().map(|(v, _)| v).collect();
        assert_eq!(kept, [0.0, 2.0, 5.0]);
    }
}
