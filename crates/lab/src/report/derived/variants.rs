//! Runs that draw one scene with one method in several ways. They show the cost of a cutaway relative to the same picture without one,
//! and of a style relative to plain light.
//!
//! The varied axis is `cutaway` or, if there is none, `style`; the other values of the axis are compared with its first value,
//! at the same values of all other axes. The time is the sum of all clocks, as such a picture is redrawn for every eye position.

use crate::experiment::{Record, Samples};

/// Axes whose values are compared; if a run has both, the first is used.
const AXES: [&str; 2] = ["cutaway", "style"];

/// A run whose points are variants of each other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variants {
    /// The name of the axis.
    pub axis: &'static str,
    /// The value with which all other values are compared.
    pub base: String,
    /// The other values of the axis, in order.
    pub values: Vec<String>,
    /// One row for each combination of values of the other axes.
    pub rows: Vec<VariantRow>,
}

/// The variants that share the same values of the other axes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VariantRow {
    /// Values of the other axes: `size = 512, style = ink`; empty if there are no other axes.
    pub of: String,
    /// Time of the base value, in milliseconds.
    pub base_ms: f64,
    /// Time divided by that of the base value, for each of the other values; `None` if not measured.
    pub ratios: Vec<Option<f64>>,
}

/// The variants of a run; `None` if it compares methods.
pub(crate) fn variants(records: &[&Record]) -> Option<Variants> {
    let first = records.first()?;
    let axis = *(AXES.iter()).find(|a| records.iter().all(|r| r.parameters.contains_key(**a)))?;
    let is_alone = |r: &&Record| match r.measurement.strategies.as_slice() {
        [only] => only.name == first.measurement.strategies[0].name && only.was_drawn(),
        _ => false,
    };
    if !records.iter().all(is_alone) {
        return None;
    }
    let value = |r: &Record| r.parameters[axis].to_string();
    let base = value(first);
    let mut values: Vec<String> = Vec::new();
    let mut rows: Vec<VariantRow> = Vec::new();
    for record in records {
        let value = value(record);
        if value == base {
            rows.push(VariantRow {
                of: others(record, axis),
                base_ms: time_ms(record),
                ratios: Vec::new(),
            });
        } else if !values.contains(&value) {
            values.push(value);
        }
    }
    if values.is_empty() {
        return None;
    }
    for row in &mut rows {
        row.ratios = (values.iter())
            .map(|v| {
                let is_it = |r: &&&Record| value(r) == *v && others(r, axis) == row.of;
                records.iter().find(is_it).map(|r| time_ms(r) / row.base_ms)
            })
            .collect();
    }
    Some(Variants {
        axis,
        base,
        values,
        rows,
    })
}

fn others(record: &Record, axis: &str) -> String {
    let others = record.parameters.iter().filter(|(name, _)| *name != axis);
    let words: Vec<String> = others.map(|(name, v)| format!("{name} = {v}")).collect();
    words.join(", ")
}

fn time_ms(record: &Record) -> f64 {
    let time = &record.measurement.strategies[0].time_ms;
    Samples::sum(&[&time.solid, &time.cut, &time.frame]).median
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::{Parameter, PerClock, example};
    use crate::report::derived::totals::tests::record_of;

    fn point(style: &str, cutaway: Option<&str>, ms: f64) -> Record {
        let mut measurement = example();
        measurement.strategies.truncate(1);
        measurement.strategies[0].time_ms = PerClock {
            frame: Samples::new(vec![ms]),
            ..PerClock::default()
        };
        let mut record = record_of(measurement);
        let mut set = |name: &str, value: &str| {
            let value = Parameter::Text(value.to_owned());
            record.parameters.insert(name.to_owned(), value);
        };
        set("style", style);
        cutaway.into_iter().for_each(|c| set("cutaway", c));
        record
    }

    #[test]
    fn a_cutaway_is_compared_with_the_same_picture_without_one() {
        let all = [
            point("ink", Some("none"), 2.0),
            point("ink", Some("cutout"), 3.0),
            point("toon", Some("none"), 10.0),
            point("toon", Some("cutout"), 11.0),
            point("toon", Some("breakaway"), 20.0),
        ];
        let found = variants(&all.iter().collect::<Vec<_>>()).unwrap();
        assert_eq!((found.axis, found.base.as_str()), ("cutaway", "none"));
        assert_eq!(found.values, ["cutout", "breakaway"]);
        let rows: Vec<(&str, Vec<Option<f64>>)> = (found.rows.iter())
            .map(|r| (r.of.as_str(), r.ratios.clone()))
            .collect();
        assert_eq!(
            rows,
            [
                ("style = ink", vec![Some(1.5), None]),
                ("style = toon", vec![Some(1.1), Some(2.0)]),
            ]
        );
    }

    #[test]
    fn styles_are_compared_with_the_first() {
        let all = [point("lit", None, 2.0), point("ink", None, 5.0)];
        let found = variants(&all.iter().collect::<Vec<_>>()).unwrap();
        assert_eq!(found.axis, "style");
        assert_eq!(found.rows[0].ratios, [Some(2.5)]);
        // A run that compares several methods has no variants.
        let several = record_of(example());
        assert_eq!(variants(&[&several]), None);
    }
}
