//! Warnings about the figures of a record, derived from the measurement alone.
//!
//! Thresholds are conventions: above them, a reader should look at the samples before trusting a median.

use super::measurement::Timing;
use super::{Ending, Machine, Measurement, Reference, Samples, Warning};

/// Times scatter if their median absolute deviation is more than this share of their median.
const NOISY: f64 = 0.10;

/// The same threshold for measurements with too few rounds for a meaningful spread: only a spread this wide is reported.
const NOISY_OF_FEW: f64 = 0.25;

/// The machine slowed down if the last third of the rounds took more than this many times as long as the first third.
const THROTTLED: f64 = 1.15;

/// Minimum number of rounds needed to tell a trend from an outlier.
const ROUNDS_OF_A_TREND: usize = 6;

/// Minimum number of rounds for a meaningful spread.
const ROUNDS_OF_A_SPREAD: usize = 5;

/// The machine is busy if at least this share of its processors had work before the run.
const BUSY: f64 = 0.5;

impl Warning {
    /// All warnings about a measurement on this machine. `is_quick` tells whether `--quick` reduced the number of rounds.
    pub fn all_of(measurement: &Measurement, machine: &Machine, is_quick: bool) -> Vec<Self> {
        let mut all = Vec::new();
        if measurement.adapter.software {
            let adapter = measurement.adapter.name.clone();
            all.push(Self::SoftwareAdapter { adapter });
        }
        if measurement.timing == Timing::Wall {
            all.push(Self::WallTimes);
        }
        if let Some(load) = machine.load.filter(|l| *l >= BUSY * machine.cores as f64) {
            let cores = machine.cores;
            all.push(Self::Busy { load, cores });
        }
        let rounds = measurement.rounds;
        if rounds < ROUNDS_OF_A_SPREAD {
            all.push(Self::FewRounds { rounds, is_quick });
        }
        all.extend(slowdown(&measurement.draw_only_ms));
        if let Some(spread) = spread(&measurement.draw_only_ms) {
            all.push(Self::NoisyDrawOnly { spread });
        }
        all.extend(Self::of_undecided(&measurement.exact));
        for strategy in &measurement.strategies {
            let name = || strategy.name.clone();
            if strategy.outcome == Ending::Overflowed {
                let reason = strategy.reason.clone().unwrap_or_default();
                let strategy = name();
                all.push(Self::Overflowed { strategy, reason });
            }
            // Uses the spread of the time, not of the ratio: if the plain drawing scatters, every strategy's ratio scatters.
            if let Some(spread) = spread(&strategy.time_ms.frame) {
                let strategy = name();
                all.push(Self::Noisy { strategy, spread });
            }
        }
        all
    }

    /// The warning about a reference in which more than [`MOST_UNDECIDED`](super::MOST_UNDECIDED) of the pixels are undecided.
    pub fn of_undecided(exact: &Reference) -> Option<Self> {
        let share = exact.undecided_share();
        exact.is_doubtful().then_some(Self::Undecided { share })
    }

    /// Parses a remark that opening the scene printed on standard error: one or more lines, of which the last may give a remedy.
    pub fn of_opening(said: &str) -> Self {
        let (text, help) = said.split_once("\n  help: ").unwrap_or((said, ""));
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        let words: Vec<&str> = help.split_whitespace().collect();
        Self::Opening {
            text: lines.join("; "),
            help: words.join(" "),
        }
    }

    /// The strategy whose figures the warning concerns; `None` if it concerns the whole point.
    pub fn concerns(&self) -> Option<&str> {
        match self {
            Self::Noisy { strategy, .. } | Self::Overflowed { strategy, .. } => Some(strategy),
            _ => None,
        }
    }

    /// Description of the problem.
    pub fn text(&self) -> String {
        match self {
            Self::SoftwareAdapter { adapter } => {
                format!("{adapter} draws on the CPU: its times do not apply to graphics cards")
            }
            Self::WallTimes => {
                "times are wall times around each pass, and include the time to submit the pass and to \
                 wait for it"
                    .to_owned()
            }
            Self::Busy { load, cores } => {
                format!("the machine was doing other work: load {load:.1} on {cores} processors")
            }
            Self::Noisy { strategy, spread } => {
                format!(
                    "times of {strategy} scatter: {:.0} % around the median",
                    spread * 100.0
                )
            }
            Self::NoisyDrawOnly { spread } => {
                format!(
                    "the times of the plain drawing scatter by {:.0} % around their median, so this point's ratios are unreliable",
                    spread * 100.0
                )
            }
            Self::Opening { text, .. } => text.clone(),
            Self::Throttled { slowdown } => {
                format!(
                    "the machine slowed down: the last third of the rounds took {slowdown:.2} times as long as the first third"
                )
            }
            Self::Overflowed { strategy, reason } => format!("{strategy} overflowed: {reason}"),
            Self::Undecided { share } => {
                format!(
                    "exact leaves {:.1} % of the pixels undecided",
                    share * 100.0
                )
            }
            Self::FewRounds { rounds: 1, .. } => "1 round has no spread".to_owned(),
            Self::FewRounds { rounds, .. } => {
                format!("{rounds} rounds are too few for a spread to mean anything")
            }
        }
    }

    /// Suggested remedy.
    pub fn remedy(&self) -> &str {
        match self {
            Self::SoftwareAdapter { .. } => {
                "measure on a graphics card before you choose by time; errors apply as they are"
            }
            Self::WallTimes => "compare ratios, and frames that take more than a few milliseconds",
            Self::Busy { .. } => "end the other work and measure again with --force",
            Self::Noisy { .. } | Self::NoisyDrawOnly { .. } => {
                "measure again with more --rounds, on a machine that does nothing else"
            }
            Self::Throttled { .. } => {
                "let the machine cool, fix its clock, and measure again with --force"
            }
            Self::Overflowed { .. } => {
                "errors are those of an incomplete frame: lower --resolution, or raise the buffer's limit"
            }
            Self::Undecided { .. } => {
                "choose another view, or move the camera closer: undecided pixels count neither as right nor as wrong"
            }
            Self::FewRounds { is_quick: true, .. } => "leave --quick out, or measure more --rounds",
            Self::FewRounds { .. } => "measure more --rounds",
            Self::Opening { help, .. } if help.is_empty() => {
                "look at the scene with `cutaway render` before you trust its figures"
            }
            Self::Opening { help, .. } => help,
        }
    }
}

/// Spread of times, if it is large enough for a warning.
fn spread(times_ms: &Samples) -> Option<f64> {
    let most = if times_ms.samples.len() < ROUNDS_OF_A_SPREAD {
        NOISY_OF_FEW
    } else {
        NOISY
    };
    let spread = times_ms.mad / times_ms.median;
    (spread > most).then_some(spread)
}

/// Warns if the machine slowed down: drawing the same frame repeatedly takes the same time unless the machine's speed changes.
fn slowdown(draw_only_ms: &Samples) -> Option<Warning> {
    let all = &draw_only_ms.samples;
    if all.len() < ROUNDS_OF_A_TREND {
        return None;
    }
    let third = all.len() / 3;
    let median = |part: &[f64]| Samples::new(part.to_vec()).median;
    let slowdown = median(&all[all.len() - third..]) / median(&all[..third]);
    (slowdown.is_finite() && slowdown > THROTTLED).then_some(Warning::Throttled { slowdown })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;

    fn kinds(measurement: &Measurement, load: f64) -> Vec<String> {
        let machine = Machine {
            cores: 2,
            load: Some(load),
            ..Machine::default()
        };
        let warnings = Warning::all_of(measurement, &machine, false);
        assert!(
            warnings
                .iter()
                .all(|w| !w.text().is_empty() && !w.remedy().is_empty()),
            "each is reported with its remedy"
        );
        let json = serde_json::to_value(warnings).unwrap();
        let kinds = json.as_array().unwrap().iter();
        kinds
            .map(|w| w["kind"].as_str().unwrap().to_owned())
            .collect()
    }

    /// Measured without any fault.
    fn calm() -> Measurement {
        let mut calm = example();
        calm.adapter.software = false;
        calm.rounds = 9;
        calm.exact.undecided_px = 0;
        calm.draw_only_ms = Samples::new(vec![2.0; 9]);
        calm.strategies[0].time_ms.frame = Samples::new(vec![3.0; 9]);
        calm
    }

    #[test]
    fn each_fault_has_its_warning_and_none_without() {
        assert_eq!(kinds(&calm(), 0.1), Vec::<String>::new(), "the control");
        type Fault = (&'static str, fn(&mut Measurement));
        let faults: [Fault; 8] = [
            ("software-adapter", |m| m.adapter.software = true),
            ("wall-times", |m| m.timing = Timing::Wall),
            ("few-rounds", |m| m.rounds = 3),
            ("throttled", |m| {
                m.draw_only_ms = Samples::new([[2.0; 6].as_slice(), &[2.4; 3]].concat());
            }),
            ("noisy", |m| {
                m.strategies[0].time_ms.frame = scattered(0.2, 9)
            }),
            // One bad denominator is one warning, not one for each strategy that is divided by it.
            ("noisy-draw-only", |m| {
                m.draw_only_ms = scattered(0.2, 9);
                m.strategies[0].frame_over_draw_only_mad = Some(0.2);
            }),
            ("overflowed", |m| {
                m.strategies[0].outcome = Ending::Overflowed
            }),
            ("undecided", |m| m.exact.undecided_px = 21),
        ];
        for (kind, plant) in faults {
            let mut planted = calm();
            plant(&mut planted);
            assert_eq!(kinds(&planted, 0.1), [kind]);
        }
        assert_eq!(kinds(&calm(), 1.5), ["busy"]);
    }

    /// Samples whose median absolute deviation is about this share of their median, without a trend.
    fn scattered(share: f64, rounds: usize) -> Samples {
        let sample = |i| 2.0 * (1.0 + share * f64::from([-1, 0, 1][i % 3]));
        Samples::new((0..rounds).map(sample).collect())
    }

    #[test]
    fn few_rounds_are_heard_where_they_are_far_apart() {
        for (share, expected) in [
            (0.2, &["few-rounds"][..]),
            (0.3, &["few-rounds", "noisy-draw-only", "noisy"]),
        ] {
            let mut few = calm();
            few.rounds = 3;
            few.draw_only_ms = scattered(share, 3);
            few.strategies[0].time_ms.frame = scattered(share, 3);
            assert_eq!(kinds(&few, 0.1), expected, "{share}");
        }
        let few = |is_quick| Warning::FewRounds {
            rounds: 3,
            is_quick,
        };
        assert!(few(true).remedy().contains("--quick"));
        assert!(!few(false).remedy().contains("--quick"));
    }

    #[test]
    fn what_was_said_of_opening_keeps_its_help() {
        let of = Warning::of_opening(
            "section z misses the model: all of it\n  bounds: 0 to 1\n  help: give\n   a position",
        );
        assert_eq!(
            of.text(),
            "section z misses the model: all of it; bounds: 0 to 1"
        );
        assert_eq!(of.remedy(), "give a position");
        let bare = Warning::of_opening("nothing moves");
        assert_eq!(bare.text(), "nothing moves");
        assert!(bare.remedy().contains("cutaway render"));
    }

    #[test]
    fn an_outlier_is_no_trend() {
        let mut measurement = calm();
        measurement.draw_only_ms = Samples::new(vec![2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 50.0, 2.0]);
        assert!(kinds(&measurement, 0.0).is_empty(), "one slow round");
    }
}
