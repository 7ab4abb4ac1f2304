//! Warnings on figures: each warning appears once, with everything that it concerns.

use crate::experiment::Warning;
use crate::report::document::{ReportBlock, Tone};

/// Warnings as notices; warnings with the same remedy share a notice.
pub(super) fn notices<'a>(warnings: impl IntoIterator<Item = &'a Warning>) -> Vec<ReportBlock> {
    let mut groups: Vec<(&str, Vec<&Warning>)> = Vec::new();
    for warning in warnings {
        let remedy = warning.remedy();
        match groups.iter_mut().find(|(r, _)| *r == remedy) {
            Some((_, group)) => group.push(warning),
            None => groups.push((remedy, vec![warning])),
        }
    }
    let groups = groups.into_iter();
    groups
        .map(|(remedy, group)| notice(remedy, &group))
        .collect()
}

fn notice(remedy: &str, group: &[&Warning]) -> ReportBlock {
    let mut texts: Vec<String> = Vec::new();
    let scattered: Vec<String> = (group.iter())
        .filter_map(|w| match w {
            Warning::Noisy { strategy, spread } => {
                Some(format!("{strategy} by {:.0} %", spread * 100.0))
            }
            _ => None,
        })
        .collect();
    for warning in group {
        let text = match warning {
            Warning::Noisy { .. } => {
                format!(
                    "times scatter around their median: {}",
                    scattered.join(", ")
                )
            }
            other => other.text(),
        };
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    let tone = match group.iter().all(|w| w.concerns().is_some()) {
        true => Tone::Plain,
        false => Tone::Fair,
    };
    ReportBlock::Notice(tone, format!("{}. To do: {remedy}.", texts.join("; ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_concerns_several_methods_is_said_once() {
        let noisy = |strategy: &str, spread| Warning::Noisy {
            strategy: strategy.to_owned(),
            spread,
        };
        let all = [noisy("a", 0.25), Warning::WallTimes, noisy("b", 0.5)];
        let found: Vec<String> = (notices(&all).into_iter())
            .map(|b| match b {
                ReportBlock::Notice(_, text) => text,
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(
            found[0]
                .starts_with("times scatter around their median: a by 25 %, b by 50 %. To do: "),
            "{found:?}"
        );
        assert!(found[1].starts_with("times are wall times"), "{found:?}");
    }
}
