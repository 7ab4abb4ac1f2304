//! Points that are judged by the exact image of another scene: broken meshes, judged by the exact image of the intact mesh.
//!
//! No strategy can be expected to be exact at these points, so counts of exact points leave them out. The questions are how many pixels
//! are wrong, relative to the exact cap, and how many wrong pixels the strategy marks as unreliable. Marks are a cost too: a marked pixel
//! is useless, wrong or not. A strategy is not usable if its lost pixels, marked or wrong, are [`TOO_MUCH`] of the cap or more.

use cutaway_io::document::Node;

use super::totals::names;
use super::{Spread, StrategyTotals};
use crate::Comparison;
use crate::experiment::{Parameter, Record};

/// Returns true if a point is judged by the exact image of another scene.
pub(crate) fn has_other_truth(record: &Record) -> bool {
    record.truth.is_some()
}

/// Returns true if the scene has a defect. A defect of amount 0, with which a sweep may begin, is none.
pub(crate) fn has_defect(record: &Record) -> bool {
    let amounts = |part: &Node| -> Vec<Option<f64>> {
        let defects = part.get("defects").map_or(&[] as &[_], Node::items);
        let amount = |defect: &Node| Parameter::of(&defect.get("amount")?.value)?.number();
        defects.iter().map(amount).collect()
    };
    let parts = record
        .scene
        .root()
        .get("part")
        .map_or(&[] as &[_], Node::items);
    let mut amounts = parts.iter().flat_map(amounts);
    // A defect without an amount has its default amount, which is not 0.
    has_other_truth(record) && amounts.any(|a| a != Some(0.0))
}

/// Errors and marks of a strategy on broken meshes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Harm {
    /// Numbers of points requested and drawn, and the cost of a frame.
    pub totals: StrategyTotals,
    /// Number of wrong pixels divided by the number of pixels of the exact cap.
    pub wrong: Option<Spread>,
    /// Number of wrong pixels that are not marked.
    pub unmarked_px: Option<Spread>,
    /// Number of unmarked wrong pixels divided by the number of pixels of the exact cap.
    pub unmarked: Option<Spread>,
    /// Number of marked pixels, wrong or not, divided by the number of pixels of the exact cap.
    pub marked: Option<Spread>,
    /// Number of pixels that are marked or wrong, divided by the number of pixels of the exact cap.
    pub lost: Option<Spread>,
}

/// A strategy is not usable if the median share of the exact cap that it loses is this or more.
pub(crate) const TOO_MUCH: f64 = 0.5;

impl Harm {
    /// Returns true if the strategy drew at all points and its lost share is below [`TOO_MUCH`].
    pub(crate) fn is_usable(&self) -> bool {
        self.totals.refused() == 0 && self.lost.is_some_and(|l| l.median < TOO_MUCH)
    }
}

/// The result of each strategy over some points. Usable strategies come first, sorted by their wrong pixels, then by their
/// unmarked wrong pixels, then by cost.
pub(crate) fn harms(records: &[&Record]) -> Vec<Harm> {
    let all = names(records).into_iter();
    let mut all: Vec<Harm> = all.map(|name| harm(name, records)).collect();
    let key = |h: &Harm| {
        let median = |s: Option<Spread>| s.map_or(f64::INFINITY, |s| s.median);
        let most = |s: Option<Spread>| s.map_or(f64::INFINITY, |s| s.most);
        [
            f64::from(u8::from(!h.is_usable())),
            median(h.wrong),
            most(h.wrong),
            median(h.unmarked),
            most(h.unmarked),
            median(h.totals.ratio),
        ]
    };
    all.sort_by(|a, b| {
        let pairs = key(a).into_iter().zip(key(b));
        pairs.fold(std::cmp::Ordering::Equal, |order, (a, b)| {
            order.then(a.total_cmp(&b))
        })
    });
    all
}

fn harm(name: &str, records: &[&Record]) -> Harm {
    let drawn: Vec<(Comparison, f64)> = (records.iter())
        .flat_map(|record| {
            let cap_px = record.measurement.exact.cap_px.max(1) as f64;
            let found = record.measurement.strategies.iter();
            let of_it = found.filter(|s| s.name == name);
            of_it.filter_map(move |s| Some((s.comparison?, cap_px)))
        })
        .collect();
    let share = |px: fn(&Comparison) -> usize| {
        let shares = drawn.iter().map(|(c, cap_px)| px(c) as f64 / cap_px);
        Spread::of(shares.collect())
    };
    let unmarked_px = drawn.iter().map(|(c, _)| c.unmarked_wrong_px as f64);
    Harm {
        totals: StrategyTotals::of(name, records.iter().copied()),
        wrong: share(|c| c.decided_wrong_px),
        unmarked_px: Spread::of(unmarked_px.collect()),
        unmarked: share(|c| c.unmarked_wrong_px),
        marked: share(|c| c.odd_parity_px),
        lost: share(|c| c.odd_parity_px + c.unmarked_wrong_px),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::{Ending, example};
    use crate::report::derived::totals::tests::record_of;
    use cutaway_io::document::{Document, part};

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
        let mut scene = Document::new();
        let defect = format!("holes:amount={amount},patch=1");
        scene.add_part(part("shape:cube").defect(&defect)).unwrap();
        record.scene = scene;
        record.truth = Some(Document::new());
        record
    }

    #[test]
    fn the_least_wrong_comes_first() {
        let [a, b] = [broken([10, 4], "1%"), broken([2, 6], "5%")];
        let harms = harms(&[&a, &b, &b]);
        let found: Vec<(&str, f64, f64)> = (harms.iter())
            .map(|h| {
                (
                    h.totals.name.as_str(),
                    h.wrong.unwrap().median,
                    h.wrong.unwrap().most,
                )
            })
            .collect();
        assert_eq!(found, [("parity", 0.01, 0.05), ("winding", 0.03, 0.03)]);
        assert_eq!(harms[1].unmarked_px.unwrap().most, 3.0);
        assert_eq!(harms[1].unmarked.unwrap().most, 0.015);
    }

    #[test]
    fn what_refuses_comes_last() {
        let mut a = broken([0, 4], "1%");
        let refused = &mut a.measurement.strategies[0];
        (refused.outcome, refused.comparison) = (Ending::Refused, None);
        let b = broken([0, 4], "1%");
        assert_eq!(harms(&[&b])[0].totals.name, "parity", "the control");
        assert_eq!(harms(&[&a, &b])[0].totals.name, "winding");
    }

    #[test]
    fn what_marks_nearly_everything_comes_last() {
        let mut a = broken([2, 4], "1%");
        let marked = |record: &mut Record, px| {
            let comparison = &mut record.measurement.strategies[0].comparison;
            comparison.as_mut().unwrap().odd_parity_px = px;
        };
        marked(&mut a, 98);
        assert_eq!(harms(&[&a])[0].totals.name, "parity", "the control");
        // Half of the 200 pixels of the cap: 99 marked, and 1 wrong and unmarked.
        marked(&mut a, 99);
        assert_eq!(harms(&[&a])[0].totals.name, "winding");
        assert!(!harms(&[&a])[1].is_usable());
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
