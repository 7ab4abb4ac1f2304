//! A strategy at a point: all that was found of it, by name.
//!
//! Names of figures are those of charts and of the columns of the CSV: the fields of a comparison, `ratio` (frame time over that of
//! drawing the uncut scene), `wrong_px` (all wrong pixels), `marked` (those that the strategy does not vouch for), `time_ms.CLOCK` with `.mad`, `bytes.CLOCK` and `bytes` (their sum), `draw_only_ms`, `triangles`, `pixels`, and
//! whatever else the record has figures for. What was not measured is not there.

use std::collections::BTreeMap;

use super::{Situation, number_of};
use crate::experiment::{Record, Samples, StrategyMeasurement};

/// A strategy at a point.
#[derive(Clone, Debug)]
pub(crate) struct Row<'a> {
    /// The point.
    pub record: &'a Record,
    /// Which of its strategies.
    pub index: usize,
    /// Figures by name.
    pub figures: BTreeMap<String, f64>,
}

/// All strategies of a point.
pub(crate) fn rows(record: &Record) -> Vec<Row<'_>> {
    (0..record.measurement.strategies.len())
        .map(|index| Row::of(record, index))
        .collect()
}

impl<'a> Row<'a> {
    fn of(record: &'a Record, index: usize) -> Self {
        let found = &record.measurement.strategies[index];
        let mut figures: BTreeMap<String, f64> = BTreeMap::new();
        let fields = found.comparison.map(serde_json::to_value);
        if let Some(Ok(serde_json::Value::Object(fields))) = fields {
            let numbers = fields
                .into_iter()
                .filter_map(|(name, v)| Some((name, v.as_f64()?)));
            figures.extend(numbers);
        }
        figures.extend(
            record.figures[index]
                .iter()
                .map(|(name, v)| (name.clone(), *v)),
        );
        let mut add = |name: &str, value: Option<f64>| {
            if let Some(value) = value {
                figures.insert(name.to_owned(), value);
            }
        };
        add("triangles", Some(record.measurement.triangles as f64));
        let [width, height] = record.measurement.resolution.map(f64::from);
        add("pixels", Some(width * height));
        add("draw_only_ms", median(&record.measurement.draw_only_ms));
        add("ratio", found.frame_over_draw_only);
        add("ratio.mad", found.frame_over_draw_only_mad);
        if found.was_drawn() {
            let (time, bytes) = (&found.time_ms, &found.bytes);
            let clocks = [
                ("solid", &time.solid, bytes.solid),
                ("cut", &time.cut, bytes.cut),
                ("frame", &time.frame, bytes.frame),
            ];
            for (clock, samples, bytes) in clocks {
                add(&format!("bytes.{clock}"), Some(bytes as f64));
                if !samples.samples.is_empty() {
                    add(&format!("time_ms.{clock}"), Some(samples.median));
                    add(&format!("time_ms.{clock}.mad"), Some(samples.mad));
                }
            }
            let comparison = found.comparison;
            add("wrong_px", comparison.map(|c| c.wrong_px() as f64));
            add("marked", comparison.map(|c| c.odd_parity_px as f64));
            let sum = bytes.solid + bytes.cut + bytes.frame;
            add("bytes", Some(sum as f64));
            for situation in Situation::ALL {
                add(situation.figure(), situation.ratio(record, found));
            }
        }
        Self {
            record,
            index,
            figures,
        }
    }

    /// What was found of the strategy.
    pub(crate) fn found(&self) -> &'a StrategyMeasurement {
        &self.record.measurement.strategies[self.index]
    }

    /// A parameter of the scene or of the strategy, as it is written.
    pub(crate) fn parameter(&self, name: &str) -> Option<&'a str> {
        let of_strategy = self.record.of_strategies[self.index].get(name);
        of_strategy
            .or_else(|| self.record.parameters.get(name))
            .map(String::as_str)
    }

    /// The name of the strategy with its parameters' names for their values: `grid:{cells}+mask`.
    pub(crate) fn family(&self) -> String {
        let mut name = self.found().name.clone();
        for (parameter, value) in &self.record.of_strategies[self.index] {
            name = with_name_for_value(&name, parameter, value);
        }
        name
    }
}

/// Replaces a value that stands alone in a name, however it is written: `0.50` is `0.5`.
fn with_name_for_value(name: &str, parameter: &str, value: &str) -> String {
    let is_same = |word: &str| {
        word == value
            || matches!((number_of(word), number_of(value)), (Some(a), Some(b)) if a.total_cmp(&b).is_eq())
    };
    let mut told = String::new();
    for word in name.split_inclusive([':', '+', '@', ',']) {
        let bare = word.trim_end_matches([':', '+', '@', ',']);
        if !bare.is_empty() && is_same(bare) {
            told.push_str(&format!("{{{parameter}}}"));
        } else {
            told.push_str(bare);
        }
        told.push_str(&word[bare.len()..]);
    }
    told
}

fn median(samples: &Samples) -> Option<f64> {
    (!samples.samples.is_empty()).then_some(samples.median)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_names_are_told_by_their_parameter() {
        for (name, value, told) in [
            ("grid:64+vds:1024", "64", "grid:{n}+vds:1024"),
            ("adaptive:0.5+mask", "0.50", "adaptive:{n}+mask"),
            ("grid:640+mask", "64", "grid:640+mask"),
            (
                "raycast+kbuffer:8@compute",
                "8",
                "raycast+kbuffer:{n}@compute",
            ),
            ("raycast+mask", "mask", "raycast+{n}"),
        ] {
            assert_eq!(with_name_for_value(name, "n", value), told);
        }
    }
}
