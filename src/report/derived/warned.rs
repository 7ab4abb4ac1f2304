//! Warnings in words, each with what to do about it.

use crate::experiment::Warning;

/// Whose figures a warning concerns; none where it concerns all of a point.
pub(crate) fn concerns(warning: &Warning) -> Option<&str> {
    match warning {
        Warning::Noisy { strategy, .. } | Warning::Overflowed { strategy, .. } => Some(strategy),
        _ => None,
    }
}

/// What is to be known.
pub(crate) fn told(warning: &Warning) -> String {
    match warning {
        Warning::SoftwareAdapter { adapter } => {
            format!("{adapter} draws on the processor: its times say nothing about graphics cards")
        }
        Warning::WallTimes => {
            "times were taken by the clock of the wall around each pass, which adds the cost of waiting".to_owned()
        }
        Warning::Busy { load, cores } => {
            format!("other work was on the machine: {load:.1} processes wanted to run on {cores} cores")
        }
        Warning::Noisy { strategy, spread } => {
            format!("times of {strategy} scatter: the spread of its ratio is {:.0} %", spread * 100.0)
        }
        Warning::Throttled { slowdown } => {
            format!("the machine slowed down during the rounds: plain drawing took {slowdown:.2} times as long at the end")
        }
        Warning::Overflowed { strategy, reason } => {
            format!("a buffer of {strategy} was too small: {reason}")
        }
        Warning::Undecided { share } => {
            format!("the reference is not sure of {:.1} % of the covered pixels", share * 100.0)
        }
        Warning::FewRounds { rounds } => {
            format!("{rounds} rounds are too few for their spread to mean much")
        }
    }
}

/// What to do about it.
pub(crate) fn remedy(warning: &Warning) -> &'static str {
    match warning {
        Warning::SoftwareAdapter { .. } => {
            "compare ratios and errors only, or measure on a graphics card (--adapter)"
        }
        Warning::WallTimes => "compare ratios; prefer an adapter with timestamps",
        Warning::Busy { .. } => "measure again when the machine has nothing else to do",
        Warning::Noisy { .. } => "measure again with more --rounds on a quiet machine",
        Warning::Throttled { .. } => "let the machine cool, or fix its clocks, and measure again",
        Warning::Overflowed { .. } => {
            "its wrong pixels are marked; give it a larger parameter, or a strategy without bounded buffers"
        }
        Warning::Undecided { .. } => {
            "errors are counted outside those pixels; a higher --resolution leaves fewer of them"
        }
        Warning::FewRounds { .. } => "measure without --quick, or with more --rounds",
    }
}
