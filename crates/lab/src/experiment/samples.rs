//! Samples of a measurement: all samples are kept, and are summarised by their median and spread.
//!
//! Times on a shared machine have a long tail: outliers shift a mean, but hardly a median. The spread is the median absolute
//! deviation (MAD). Median and MAD tolerate outliers in up to half of the samples, and assume no distribution.

use serde::{Deserialize, Serialize};

/// Measured values with their median.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Samples {
    /// The median; for an even number of samples, the mean of the middle two. 0 without samples.
    pub median: f64,
    /// The median of the samples' distances from their median, in the same unit; 0 without samples.
    pub mad: f64,
    /// All samples, in the order in which they were taken.
    pub samples: Vec<f64>,
}

impl Samples {
    /// Stores samples and computes their median and spread.
    pub fn new(samples: Vec<f64>) -> Self {
        let median = median(&samples);
        let distances: Vec<f64> = samples.iter().map(|s| (s - median).abs()).collect();
        Self {
            median,
            mad: self::median(&distances),
            samples,
        }
    }

    /// Minimum and maximum sample; zeros without samples.
    pub fn range(&self) -> [f64; 2] {
        let all = || self.samples.iter().copied();
        if self.samples.is_empty() {
            return [0.0; 2];
        }
        [
            all().fold(f64::INFINITY, f64::min),
            all().fold(0.0, f64::max),
        ]
    }

    /// Adds several clocks round by round; a clock that never ran has no samples and adds nothing.
    pub fn sum(all: &[&Self]) -> Self {
        let rounds = all.iter().map(|s| s.samples.len()).max().unwrap_or(0);
        let of_round = |round| all.iter().filter_map(|s| s.samples.get(round)).sum();
        Self::new((0..rounds).map(of_round).collect())
    }

    /// The quotients of samples taken in the same rounds. A disturbance in a round affects both samples and cancels.
    pub fn over(&self, denominator: &Self) -> Self {
        let pairs = self.samples.iter().zip(&denominator.samples);
        Self::new(pairs.map(|(a, b)| a / b).collect())
    }

    /// The differences of samples taken in the same rounds.
    pub fn less(&self, other: &Self) -> Self {
        let pairs = self.samples.iter().zip(&other.samples);
        Self::new(pairs.map(|(a, b)| a - b).collect())
    }
}

/// The median of values in any order; 0 without values.
fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let half = sorted.len() / 2;
    match sorted.len() {
        0 => 0.0,
        n if n % 2 == 1 => sorted[half],
        _ => (sorted[half - 1] + sorted[half]) * 0.5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_of_the_middle() {
        for (samples, median, mad) in [
            (vec![], 0.0, 0.0),
            (vec![3.0], 3.0, 0.0),
            (vec![5.0, 1.0], 3.0, 2.0),
            (vec![9.0, 1.0, 2.0], 2.0, 1.0),
            (vec![10.0, 10.0, 10.0, 11.0, 1000.0], 10.0, 0.0),
        ] {
            let found = Samples::new(samples);
            assert_eq!([found.median, found.mad], [median, mad]);
        }
        assert_eq!(Samples::new(vec![3.0, 1.0, 2.0]).range(), [1.0, 3.0]);
    }

    #[test]
    fn sums_are_of_rounds() {
        let of = |samples: &[f64]| Samples::new(samples.to_vec());
        let (slow_first, slow_last, none) = (of(&[9.0, 1.0, 1.0]), of(&[1.0, 1.0, 9.0]), of(&[]));
        let sum = Samples::sum(&[&slow_first, &slow_last, &none]);
        assert_eq!(sum.samples, [10.0, 2.0, 10.0]);
        assert_eq!(sum.median, 10.0, "the sum of the medians is 2");
    }

    #[test]
    fn what_slows_a_round_cancels_in_the_quotient() {
        let (calm, load) = ([2.0, 2.0, 2.0], [1.0, 7.0, 1.5]);
        let slowed =
            |base: f64| Samples::new(calm.iter().zip(load).map(|(c, l)| c * l * base).collect());
        let ratio = slowed(3.0).over(&slowed(1.0));
        assert_eq!([ratio.median, ratio.mad], [3.0, 0.0]);
    }
}
