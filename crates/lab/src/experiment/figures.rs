//! Figures of a strategy by name: the quantities that expectations refer to and charts show on their axes.
//!
//! Error figures are all fields of [`Comparison`], plus two more: `wrong_px` counts all wrong pixels, and `marked` is another
//! name for `odd_parity_px`, the number of pixels that the strategy marks as unreliable.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{Measurement, Samples};
use crate::compare::Comparison;

/// Figures of a drifting camera's frames, see [`super::drift`].
pub const OF_DRIFT: [&str; 3] = ["flicker_px", "flicker_exact_px", "flicker_excess_px"];

/// Picture flicker under a drifting camera: over all covered pixels, over caps without strokes, and over strokes.
pub const OF_PICTURES: [&str; 3] = ["flicker_rms", "flicker_rms.cap", "flicker_rms.stroke"];

/// Figures of memory and of the input's size.
pub const OF_SIZE: [&str; 6] = [
    "bytes",
    "bytes.solid",
    "bytes.cut",
    "bytes.frame",
    "triangles",
    "pixels",
];

/// Figures of time. They differ between machines, so no expectation uses them.
pub const OF_TIME: [&str; 7] = [
    "ratio",
    "ratio.cut_moves",
    "ratio.mesh_moves",
    "time_ms",
    "time_ms.solid",
    "time_ms.cut",
    "time_ms.frame",
];

/// Names of a frame's error figures.
pub fn of_error() -> Vec<String> {
    let fields = fields(&Comparison::default())
        .into_iter()
        .map(|(name, _)| name);
    let more = ["wrong_px", "marked"].map(str::to_owned);
    fields.chain(more).collect()
}

/// All figures, by name, of the strategy with this index in the measurement. A figure that was not measured is absent, for example
/// because the frame was refused or a clock never ran. `more` holds figures that need more than one frame. Spreads of times end in `.mad`.
pub fn figures(
    measurement: &Measurement,
    strategy: usize,
    more: &BTreeMap<String, f64>,
) -> BTreeMap<String, f64> {
    let mut figures = BTreeMap::new();
    let Some(found) = measurement.strategies.get(strategy) else {
        return figures;
    };
    let mut add = |name: &str, value: Option<f64>| {
        if let Some(value) = value {
            figures.insert(name.to_owned(), value);
        }
    };
    let median = |s: &Samples| (!s.samples.is_empty()).then_some(s.median);
    let mad = |s: &Samples| (!s.samples.is_empty()).then_some(s.mad);
    let [width, height] = measurement.resolution.map(f64::from);
    add("pixels", Some(width * height));
    add("triangles", Some(measurement.triangles as f64));
    add("draw_only_ms", median(&measurement.draw_only_ms));
    let Some(comparison) = &found.comparison else {
        return figures;
    };
    for (name, value) in fields(comparison) {
        add(&name, value);
    }
    add("wrong_px", Some(comparison.wrong_px() as f64));
    add("marked", Some(comparison.odd_parity_px as f64));
    add("ratio", found.frame_over_draw_only);
    add("ratio.mad", found.frame_over_draw_only_mad);
    add("over_uncut", found.cut.map(|c| c.over_uncut));
    add("cut_alone.ms", found.cut.map(|c| c.ms));
    add("cut_alone.ns_per_px", found.cut.and_then(|c| c.ns_per_px));
    add(
        "cut_alone.ns_per_triangle",
        found.cut.and_then(|c| c.ns_per_triangle),
    );
    let (times, bytes) = (&found.time_ms, &found.bytes);
    let clocks = [
        ("solid", &times.solid, bytes.solid),
        ("cut", &times.cut, bytes.cut),
        ("frame", &times.frame, bytes.frame),
    ];
    for (clock, samples, bytes) in clocks {
        add(&format!("bytes.{clock}"), Some(bytes as f64));
        add(&format!("time_ms.{clock}"), median(samples));
        add(&format!("time_ms.{clock}.mad"), mad(samples));
    }
    add(
        "bytes",
        Some((bytes.solid + bytes.cut + bytes.frame) as f64),
    );
    let all = Samples::sum(&[&times.solid, &times.cut, &times.frame]);
    add("time_ms", median(&all));
    add("time_ms.mad", mad(&all));
    figures.extend(more.iter().map(|(name, value)| (name.clone(), *value)));
    figures
}

/// One of the [`figures`].
pub fn figure(
    measurement: &Measurement,
    strategy: usize,
    more: &BTreeMap<String, f64>,
    name: &str,
) -> Option<f64> {
    figures(measurement, strategy, more).get(name).copied()
}

/// The numbers of a comparison, by their JSON field names.
fn fields(comparison: &Comparison) -> Vec<(String, Option<f64>)> {
    match serde_json::to_value(comparison) {
        Ok(Value::Object(fields)) => (fields.into_iter())
            .map(|(name, value)| (name, value.as_f64()))
            .collect(),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::example;

    #[test]
    fn every_name_is_a_figure_or_none() {
        let measurement = example();
        let more = BTreeMap::from([("flicker_px".to_owned(), 7.0)]);
        let of = |strategy, name: &str| figure(&measurement, strategy, &more, name);
        for (name, value) in [
            ("missed_cap_px", Some(3.0)),
            ("wrong_px", Some(3.0)),
            ("marked", Some(0.0)),
            ("bytes", Some(2048.0 + f64::from(1 << 20))),
            ("time_ms.frame", Some(3.0)),
            ("time_ms.cut", None),
            ("time_ms", Some(3.0)),
            ("ratio", Some(1.5)),
            ("triangles", Some(12.0)),
            ("flicker_px", Some(7.0)),
            ("flicker_excess_px", None),
            ("misssed_cap_px", None),
        ] {
            assert_eq!(of(0, name), value, "{name}");
        }
        let drawn = of_error().iter().filter(|n| of(0, n).is_some()).count();
        assert_eq!(drawn, of_error().len(), "every error has a number");
        assert_eq!(of(1, "missed_cap_px"), None, "what was refused has none");
        assert_eq!(of(2, "missed_cap_px"), None, "nobody is there");
    }
}
