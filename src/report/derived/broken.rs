//! Points that are judged by the exact image of another scene: broken meshes, by that of the whole one.
//!
//! Nobody can be expected to be exact there, so that counts of exact points do not hold them. What is asked is who comes nearest, as a
//! share of the cap there should be, and who marks what it cannot vouch for.

use super::{Spread, Standing};
use crate::experiment::Record;

/// Whether the truth of a point is the exact image of another scene.
pub(crate) fn has_other_truth(record: &Record) -> bool {
    record.truth.is_some()
}

/// Whether something is broken: a sweep may begin with a defect of amount 0.
pub(crate) fn has_defect(record: &Record) -> bool {
    let is_none = |word: &String| {
        let mut keys = word.split([':', ',']);
        word.starts_with("--defect") && keys.any(|k| matches!(k, "amount=0%" | "amount=0"))
    };
    has_other_truth(record) && !record.words.iter().any(is_none)
}

/// What a strategy makes of broken meshes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Harm {
    /// Points asked and drawn, and what a frame costs.
    pub standing: Standing,
    /// Pixels that are wrong over those of the exact cap.
    pub wrong: Option<Spread>,
    /// Pixels that are wrong and not marked.
    pub unmarked_px: Option<Spread>,
    /// The same over those of the exact cap.
    pub unmarked: Option<Spread>,
}

/// Each strategy over some points: the least wrong first, those that refuse at some last.
pub(crate) fn harms(records: &[&Record]) -> Vec<Harm> {
    let mut names: Vec<&str> = Vec::new();
    for found in records.iter().flat_map(|r| &r.measurement.strategies) {
        if !names.contains(&found.name.as_str()) {
            names.push(&found.name);
        }
    }
    let mut all: Vec<Harm> = names.iter().map(|name| harm(name, records)).collect();
    all.sort_by(|a, b| {
        let key = |h: &Harm| h.wrong.map_or(f64::INFINITY, |w| w.median);
        let most = |h: &Harm| h.wrong.map_or(f64::INFINITY, |w| w.most);
        (a.standing.refused() > 0)
            .cmp(&(b.standing.refused() > 0))
            .then(key(a).total_cmp(&key(b)))
            .then(most(a).total_cmp(&most(b)))
    });
    all
}

fn harm(name: &str, records: &[&Record]) -> Harm {
    let (mut wrong, mut unmarked, mut unmarked_px) = (Vec::new(), Vec::new(), Vec::new());
    for record in records {
        let cap_px = record.measurement.exact.cap_px.max(1) as f64;
        let found = record.measurement.strategies.iter();
        for c in found
            .filter(|s| s.name == name)
            .filter_map(|s| s.comparison)
        {
            wrong.push(c.decided_wrong_px as f64 / cap_px);
            unmarked.push(c.unmarked_wrong_px as f64 / cap_px);
            unmarked_px.push(c.unmarked_wrong_px as f64);
        }
    }
    Harm {
        standing: Standing::of(name, records.iter().copied()),
        wrong: Spread::of(wrong),
        unmarked_px: Spread::of(unmarked_px),
        unmarked: Spread::of(unmarked),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::{Ending, example};
    use crate::report::derived::standing::tests::record_of;

    fn broken(wrong: [usize; 2], amount: &str) -> Record {
        let mut measurement = example();
        measurement.exact.cap_px = 200;
        let one = measurement.strategies[0].clone();
        let named = ["parity", "winding"].into_iter().zip(wrong);
        let named = named.map(|(name, px)| {
            let mut found = one.clone();
            found.name = name.to_owned();
            if let Some(c) = &mut found.comparison {
                (c.decided_wrong_px, c.unmarked_wrong_px) = (px, px / 2);
            }
            found
        });
        measurement.strategies = named.collect();
        let mut record = record_of(measurement);
        record.words = vec![format!("--defect=holes:amount={amount},patch=1")];
        record.truth = Some(Vec::new());
        record
    }

    #[test]
    fn who_is_wrong_least_comes_first() {
        let [a, b] = [broken([10, 4], "1%"), broken([2, 6], "5%")];
        let harms = harms(&[&a, &b, &b]);
        let told: Vec<(&str, f64, f64)> = (harms.iter())
            .map(|h| {
                (
                    h.standing.name.as_str(),
                    h.wrong.unwrap().median,
                    h.wrong.unwrap().most,
                )
            })
            .collect();
        assert_eq!(told, [("parity", 0.01, 0.05), ("winding", 0.03, 0.03)]);
        assert_eq!(harms[1].unmarked_px.unwrap().most, 3.0);
        assert_eq!(harms[1].unmarked.unwrap().most, 0.015);
    }

    #[test]
    fn who_refuses_does_not_win() {
        let mut a = broken([0, 4], "1%");
        let refused = &mut a.measurement.strategies[0];
        (refused.outcome, refused.comparison) = (Ending::Refused, None);
        let b = broken([0, 4], "1%");
        assert_eq!(harms(&[&b])[0].standing.name, "parity", "the control");
        assert_eq!(harms(&[&a, &b])[0].standing.name, "winding");
    }

    #[test]
    fn a_defect_of_no_amount_is_none() {
        assert!(has_defect(&broken([0, 0], "0.5%")));
        assert!(!has_defect(&broken([0, 0], "0%")));
        let mut sound = broken([0, 0], "1%");
        sound.truth = None;
        assert!(!has_defect(&sound));
    }
}
