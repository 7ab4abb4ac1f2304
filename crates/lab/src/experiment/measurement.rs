//! Measurements of strategies on one frame: the JSON of `cutaway compare`, and the core of every record.
//!
//! Every number is a measurement: medians come with their samples, and what was not measured is `null`, never 0.

use cutaway::gpu::AdapterReport;
use cutaway::layers::Kind;
use cutaway::plan::Clock;
use cutaway::session::Outcome;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};

use super::Samples;
use crate::compare::Comparison;
use crate::exact::Exact;

/// One value for each clock.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PerClock<T> {
    /// Value of the clock that runs when the mesh changes.
    pub solid: T,
    /// Value of the clock that runs when a clip-surface changes.
    pub cut: T,
    /// Value of the clock that runs in every frame, as when the view changes.
    pub frame: T,
}

impl<T> PerClock<T> {
    /// Computes the value of each clock.
    pub fn from_fn(mut value: impl FnMut(Clock) -> T) -> Self {
        let [solid, cut, frame] = Clock::ALL.map(&mut value);
        Self { solid, cut, frame }
    }
}

/// A comparison is conclusive only if the ratio of undecided to covered pixels is at most this.
pub const MOST_UNDECIDED: f64 = 1e-3;

/// Up to this many undecided pixels are accepted at any share: in a small picture, outlines alone can cause that many.
const FEW_UNDECIDED_PX: usize = 20;

/// The exact reference of a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Pixels that show a cap.
    pub cap_px: usize,
    /// Pixels that show the mesh.
    pub surface_px: usize,
    /// Pixels that show nothing.
    pub background_px: usize,
    /// Pixels where sampling is ambiguous, so that no result there can be called wrong.
    pub undecided_px: usize,
    /// Covered pixels that are decided; `None` in records older than this field.
    #[serde(default)]
    pub judged_px: Option<usize>,
    /// Pixels whose cap belongs to several solids.
    pub overlap_px: usize,
    /// Time of the evaluation on the CPU.
    pub time_ms: f64,
}

impl Reference {
    /// Summary of a reference.
    pub fn new(exact: &Exact, time_ms: f64) -> Self {
        Self {
            cap_px: exact.layers.count(Kind::Cap),
            surface_px: exact.layers.count(Kind::Surface),
            background_px: exact.layers.count(Kind::Background),
            undecided_px: exact.undecided_px(),
            judged_px: Some(exact.judged_px()),
            overlap_px: exact.layers.overlap_px(),
            time_ms,
        }
    }

    /// Number of undecided pixels divided by that of covered pixels.
    pub fn undecided_share(&self) -> f64 {
        self.share(self.undecided_px)
    }

    /// A number of pixels divided by the number of covered pixels.
    fn share(&self, px: usize) -> f64 {
        px as f64 / (self.cap_px + self.surface_px).max(1) as f64
    }

    /// Returns true if too many pixels are undecided to trust the rest: more than a few, and a share above [`MOST_UNDECIDED`].
    pub fn is_doubtful(&self) -> bool {
        self.is_doubtful_with(self.undecided_px)
    }

    /// [`Self::is_doubtful`] for another number of undecided pixels, for example with a less precise rasteriser.
    pub fn is_doubtful_with(&self, undecided_px: usize) -> bool {
        undecided_px > FEW_UNDECIDED_PX && self.share(undecided_px) > MOST_UNDECIDED
    }
}

/// Outcome of a frame, without the reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ending {
    /// The whole frame was drawn.
    Complete,
    /// A bounded buffer was too small.
    Overflowed,
    /// The strategy does not support the scene.
    Refused,
}

impl Ending {
    /// Converts an outcome.
    pub fn from_outcome(outcome: &Outcome) -> Self {
        match outcome {
            Outcome::Complete => Self::Complete,
            Outcome::Overflowed(_) => Self::Overflowed,
            Outcome::Refused(_) => Self::Refused,
        }
    }

    /// Lower-case name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Overflowed => "overflowed",
            Self::Refused => "refused",
        }
    }
}

/// Method of timing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Timing {
    /// Timestamps of the device around each pass.
    Timestamps,
    /// The wall clock around each pass, where the device has no reliable timestamps.
    Wall,
}

/// Time of one pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MedianPassTime {
    /// Name of the pass.
    pub name: String,
    /// Clock on which the pass runs.
    pub clock: Clock,
    /// Median over the rounds.
    pub median_ms: f64,
}

/// Cost of a cut alone: the time of a frame compared with that of the uncut scene. Both are drawn by the same rasteriser, so that
/// a faster rasteriser is not mistaken for a cheaper cap. The paper reports +0.366 ms at 1024 x 768, or 0.47 ns per pixel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Price {
    /// Frame time divided by that of the uncut scene: the median of the per-round quotients.
    pub over_uncut: f64,
    /// Frame time minus that of the uncut scene: the median of the per-round differences. Negative if cutting saves more than it costs.
    pub ms: f64,
    /// The difference per covered pixel, in nanoseconds.
    pub ns_per_px: Option<f64>,
    /// The difference per triangle of the scene, in nanoseconds.
    pub ns_per_triangle: Option<f64>,
}

impl Price {
    /// Computes the price from a frame and the uncut scene, measured in the same rounds.
    pub(super) fn of(
        frame: &Samples,
        uncut: &Samples,
        covered_px: usize,
        triangles: usize,
    ) -> Option<Self> {
        let ms = frame.less(uncut).median;
        let over_uncut = frame.over(uncut).median;
        let each = |count: usize| (count > 0).then(|| ms * 1e6 / count as f64);
        (ms.is_finite() && over_uncut.is_finite() && over_uncut > 0.0).then(|| Self {
            over_uncut,
            ms,
            ns_per_px: each(covered_px),
            ns_per_triangle: each(triangles),
        })
    }
}

/// One strategy on one frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrategyMeasurement {
    /// Name of the strategy.
    pub name: String,
    /// Outcome of the frame.
    pub outcome: Ending,
    /// Why the frame is not complete; `None` if it is.
    pub reason: Option<String>,
    /// Error against exact. If no frame was drawn, every field is written as `null`.
    #[serde(
        flatten,
        serialize_with = "or_nulls",
        deserialize_with = "all_or_nulls"
    )]
    pub comparison: Option<Comparison>,
    /// Undecided pixels of exact for this strategy, if their number differs from that in [`Measurement::exact`]. It differs if the
    /// adapter's rasteriser drew the frame and places triangles less exactly than usual ([`Precision`](cutaway::scene::Precision)).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub undecided_px: Option<usize>,
    /// Size in bytes of the structures that are built on each clock.
    pub bytes: PerClock<u64>,
    /// Time of each clock.
    pub time_ms: PerClock<Samples>,
    /// Frame time divided by the time to draw the same scene uncut: the median of the per-round quotients.
    pub frame_over_draw_only: Option<f64>,
    /// Median absolute deviation of `frame_over_draw_only` over the rounds.
    pub frame_over_draw_only_mad: Option<f64>,
    /// Cost of the cut alone; `null` in records older than this field, and if no time was taken.
    #[serde(default)]
    pub cut: Option<Price>,
    /// Times of the passes.
    pub passes: Vec<MedianPassTime>,
}

impl StrategyMeasurement {
    /// Returns true if the strategy drew a frame, complete or not.
    pub fn was_drawn(&self) -> bool {
        self.comparison.is_some()
    }
}

/// Result of comparing strategies on one frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// Name of the scene.
    pub scene: String,
    /// The command line that repeats the measurement.
    pub command: String,
    /// Version of cutaway.
    pub version: String,
    /// Number of triangles in all parts together.
    pub triangles: usize,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// The device.
    pub adapter: AdapterReport,
    /// Method of timing.
    pub timing: Timing,
    /// Number of measured rounds, without the warm-up.
    pub rounds: usize,
    /// The reference.
    pub exact: Reference,
    /// Times to draw the same scene uncut with the GPU's own rasteriser, in the same rounds.
    pub draw_only_ms: Samples,
    /// Times to draw the uncut scene with the compute rasteriser; `null` if no strategy used it, and in records older than this field.
    #[serde(default)]
    pub draw_only_compute_ms: Option<Samples>,
    /// One entry per strategy, in the order in which the strategies were requested.
    pub strategies: Vec<StrategyMeasurement>,
}

/// Writes the fields of a comparison. Without a comparison, each is written as `null`, as a 0 would mean "no error".
fn or_nulls<S: Serializer>(
    comparison: &Option<Comparison>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match comparison {
        Some(comparison) => comparison.serialize(serializer),
        None => {
            let fields = serde_json::to_value(Comparison::default());
            let names = match fields {
                Ok(Value::Object(map)) => map.into_iter().map(|(name, _)| (name, Value::Null)),
                _ => return Err(serde::ser::Error::custom("a comparison is not an object")),
            };
            names.collect::<Map<_, _>>().serialize(serializer)
        }
    }
}

/// Reads a comparison, or `None` if all its fields are `null`. A field that is missing or not a number makes the record invalid, as
/// an error that was measured must not be read as not measured.
fn all_or_nulls<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Comparison>, D::Error> {
    let fields = Map::<String, Value>::deserialize(deserializer)?;
    let of_comparison = serde_json::to_value(Comparison::default()).map_err(D::Error::custom)?;
    let mut names = of_comparison.as_object().into_iter().flat_map(Map::keys);
    if names.all(|name| fields.get(name) == Some(&Value::Null)) {
        return Ok(None);
    }
    let comparison = serde_json::from_value(Value::Object(fields)).map_err(D::Error::custom)?;
    Ok(Some(comparison))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A measurement of two strategies, one that drew and one that refused.
    pub(crate) fn example() -> Measurement {
        let drawn = StrategyMeasurement {
            name: "raycast+mask".to_owned(),
            outcome: Ending::Complete,
            reason: None,
            comparison: Some(Comparison {
                missed_cap_px: 3,
                edge_wrong_px: 3,
                ..Comparison::default()
            }),
            undecided_px: None,
            bytes: PerClock {
                solid: 0,
                cut: 2048,
                frame: 1 << 20,
            },
            time_ms: PerClock {
                frame: Samples::new(vec![4.0, 2.0, 3.0]),
                ..PerClock::default()
            },
            frame_over_draw_only: Some(1.5),
            cut: Some(Price {
                over_uncut: 1.25,
                ms: 0.5,
                ns_per_px: Some(0.47),
                ns_per_triangle: None,
            }),
            frame_over_draw_only_mad: Some(0.25),
            passes: vec![MedianPassTime {
                name: "shade".to_owned(),
                clock: Clock::Frame,
                median_ms: 0.5,
            }],
        };
        let refused = StrategyMeasurement {
            name: "planar+<mask>".to_owned(),
            outcome: Ending::Refused,
            reason: Some("a relief | is no plane".to_owned()),
            comparison: None,
            undecided_px: None,
            bytes: PerClock::default(),
            time_ms: PerClock::default(),
            frame_over_draw_only: None,
            frame_over_draw_only_mad: None,
            cut: None,
            passes: Vec::new(),
        };
        Measurement {
            scene: "crank".to_owned(),
            command: "cutaway compare shape:crank".to_owned(),
            version: "0.1.0".to_owned(),
            triangles: 12,
            resolution: [64, 48],
            adapter: AdapterReport {
                name: "A & B".to_owned(),
                backend: "vulkan".to_owned(),
                driver: "d 1".to_owned(),
                software: true,
                sub_pixel_bits: Some(8),
            },
            timing: Timing::Timestamps,
            rounds: 3,
            exact: Reference {
                cap_px: 10,
                surface_px: 20,
                background_px: 3042,
                undecided_px: 1,
                judged_px: Some(0),
                overlap_px: 0,
                time_ms: 5.0,
            },
            draw_only_ms: Samples::new(vec![2.0]),
            draw_only_compute_ms: None,
            strategies: vec![drawn, refused],
        }
    }

    #[test]
    fn what_was_not_measured_is_null() {
        let json = serde_json::to_value(example()).unwrap();
        let [drawn, refused] = [0, 1].map(|i| &json["strategies"][i]);
        assert_eq!(drawn["missed_cap_px"], 3);
        assert_eq!(drawn["outcome"], "complete");
        assert_eq!(refused["outcome"], "refused");
        let fields = refused.as_object().unwrap();
        for name in ["missed_cap_px", "decided_wrong_px", "normal_error_deg_mean"] {
            assert_eq!(fields.get(name), Some(&Value::Null), "{name}");
        }
        assert_eq!(
            drawn.as_object().unwrap().len(),
            fields.len(),
            "both have the same fields"
        );
    }

    #[test]
    fn what_is_written_is_read_again() {
        let text = serde_json::to_string(&example()).unwrap();
        assert_eq!(
            serde_json::from_str::<Measurement>(&text).unwrap(),
            example()
        );
    }

    #[test]
    fn a_field_that_is_broken_is_not_taken_for_a_frame_that_was_refused() {
        let whole = serde_json::to_value(example()).unwrap();
        let field = "crack_px";
        for fault in ["null", "missing"] {
            let mut broken = whole.clone();
            let drawn = broken["strategies"][0].as_object_mut().unwrap();
            match fault {
                "null" => drawn[field] = Value::Null,
                _ => drop(drawn.remove(field)),
            }
            let read = serde_json::from_value::<Measurement>(broken).map(|m| m.strategies);
            assert!(read.is_err(), "{fault}: {read:?}");
        }
        let read: Measurement = serde_json::from_value(whole).unwrap();
        assert_eq!(read.strategies[1].comparison, None, "refused");
    }
}
