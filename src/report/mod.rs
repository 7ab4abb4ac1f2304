//! What a comparison found, as data and in the forms people read it in.
//!
//! [`Report`] is the JSON of `cutaway compare`; [`text`] makes a table of it for a terminal, [`markdown`] one for a page,
//! and [`html`] one file with the pictures in it, which opens from disk and asks no network.
//!
//! Every number is a measurement: medians come with their samples, and what was not measured is `null`, never 0.

mod html;
mod markdown;
mod section;
mod svg;
mod table;
mod text;

use serde::{Serialize, Serializer};
use serde_json::{Map, Value};

pub use html::{Figure, html};
pub use markdown::markdown;
pub use section::{Curve, Drawn, PartReport, PlaneReport, SectionReport};
pub use svg::{Unit, svg};
pub use table::Table;
pub use text::text;

use crate::compare::Comparison;
use crate::exact::Exact;
use crate::gpu::AdapterReport;
use crate::layers::Kind;
use crate::plan::Clock;
use crate::session::Outcome;

/// Measured times with their median.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Samples {
    /// The middle one; the mean of the two in the middle of an even number.
    pub median: f64,
    /// All, in the order they were taken.
    pub samples: Vec<f64>,
}

impl Samples {
    /// Samples with their median; 0 where there are none.
    pub fn of(samples: Vec<f64>) -> Self {
        let mut sorted = samples.clone();
        sorted.sort_by(f64::total_cmp);
        let half = sorted.len() / 2;
        let median = match sorted.len() {
            0 => 0.0,
            n if n % 2 == 1 => sorted[half],
            _ => (sorted[half - 1] + sorted[half]) * 0.5,
        };
        Self { median, samples }
    }

    /// Least and greatest sample; zeros where there are none.
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
}

/// One value for each clock.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PerClock<T> {
    /// When the mesh changed.
    pub solid: T,
    /// When a clip-surface changed.
    pub cut: T,
    /// When the view changed.
    pub frame: T,
}

impl<T> PerClock<T> {
    /// A value for each clock.
    pub fn of(mut value: impl FnMut(Clock) -> T) -> Self {
        let [solid, cut, frame] = Clock::ALL.map(&mut value);
        Self { solid, cut, frame }
    }
}

/// The exact reference of a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExactReport {
    /// Pixels that show a cap.
    pub cap_px: usize,
    /// Pixels that show the mesh.
    pub surface_px: usize,
    /// Pixels that show nothing.
    pub background_px: usize,
    /// Pixels where sampling is ambiguous, so that no answer can be called wrong.
    pub undecided_px: usize,
    /// Pixels whose cap several solids share.
    pub overlap_px: usize,
    /// Time of the evaluation on the CPU.
    pub time_ms: f64,
}

impl ExactReport {
    /// What there is to say of a reference.
    pub fn of(exact: &Exact, time_ms: f64) -> Self {
        Self {
            cap_px: exact.layers.count(Kind::Cap),
            surface_px: exact.layers.count(Kind::Surface),
            background_px: exact.layers.count(Kind::Background),
            undecided_px: exact.undecided_px(),
            overlap_px: exact.layers.overlap_px(),
            time_ms,
        }
    }
}

/// Time of one pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassReport {
    /// Name of the pass.
    pub name: String,
    /// When it runs.
    pub clock: Clock,
    /// Median over the rounds.
    pub median_ms: f64,
}

/// One strategy on one frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StrategyReport {
    /// Name of the strategy.
    pub name: String,
    /// How the frame ended.
    #[serde(serialize_with = "outcome_name")]
    pub outcome: Outcome,
    /// Why, where it is not complete.
    pub reason: Option<String>,
    /// Error against exact; every field `null` where there was no frame to compare.
    #[serde(flatten, serialize_with = "or_nulls")]
    pub comparison: Option<Comparison>,
    /// Bytes of what each clock produces.
    pub bytes: PerClock<u64>,
    /// Time of each clock.
    pub time_ms: PerClock<Samples>,
    /// Frame time over the time of the same scene drawn without any cut.
    pub frame_over_draw_only: Option<f64>,
    /// Times of the passes.
    pub passes: Vec<PassReport>,
}

impl StrategyReport {
    /// Whether there is a frame to look at.
    pub fn was_drawn(&self) -> bool {
        self.comparison.is_some()
    }
}

/// What a comparison found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Name of the scene.
    pub scene: String,
    /// The command line, to do it again.
    pub command: String,
    /// Version of this crate.
    pub version: &'static str,
    /// Triangles of all parts.
    pub triangles: usize,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// The device.
    pub adapter: AdapterReport,
    /// `timestamps` of the device, or `wall` time where it has none.
    pub timing: &'static str,
    /// Measured rounds, after the warm-up.
    pub rounds: usize,
    /// The reference.
    pub exact: ExactReport,
    /// The same scene drawn by the GPU with no cut at all, in the same rounds.
    pub draw_only_ms: Samples,
    /// The strategies, in the order asked for.
    pub strategies: Vec<StrategyReport>,
}

fn outcome_name<S: Serializer>(outcome: &Outcome, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(outcome.name())
}

/// The fields of a comparison, each `null` where there is none: a 0 would be read as "no error".
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

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A report of one strategy that drew and one that refused.
    pub(crate) fn example() -> Report {
        let drawn = StrategyReport {
            name: "raycast+mask".to_owned(),
            outcome: Outcome::Complete,
            reason: None,
            comparison: Some(Comparison {
                missed_cap_px: 3,
                edge_wrong_px: 3,
                ..Comparison::default()
            }),
            bytes: PerClock {
                solid: 0,
                cut: 2048,
                frame: 1 << 20,
            },
            time_ms: PerClock {
                frame: Samples::of(vec![4.0, 2.0, 3.0]),
                ..PerClock::default()
            },
            frame_over_draw_only: Some(1.5),
            passes: vec![PassReport {
                name: "shade".to_owned(),
                clock: Clock::Frame,
                median_ms: 0.5,
            }],
        };
        let refused = StrategyReport {
            name: "planar+<mask>".to_owned(),
            outcome: Outcome::Refused("a relief | is no plane".to_owned()),
            reason: Some("a relief | is no plane".to_owned()),
            comparison: None,
            bytes: PerClock::default(),
            time_ms: PerClock::default(),
            frame_over_draw_only: None,
            passes: Vec::new(),
        };
        Report {
            scene: "crank".to_owned(),
            command: "cutaway compare shape:crank".to_owned(),
            version: "0.1.0",
            triangles: 12,
            resolution: [64, 48],
            adapter: AdapterReport {
                name: "A & B".to_owned(),
                backend: "vulkan".to_owned(),
                driver: "d 1".to_owned(),
                software: true,
            },
            timing: "timestamps",
            rounds: 3,
            exact: ExactReport {
                cap_px: 10,
                surface_px: 20,
                background_px: 3042,
                undecided_px: 1,
                overlap_px: 0,
                time_ms: 5.0,
            },
            draw_only_ms: Samples::of(vec![2.0]),
            strategies: vec![drawn, refused],
        }
    }

    #[test]
    fn medians_are_of_the_middle() {
        for (samples, median) in [
            (vec![], 0.0),
            (vec![3.0], 3.0),
            (vec![5.0, 1.0], 3.0),
            (vec![9.0, 1.0, 2.0], 2.0),
        ] {
            assert_eq!(Samples::of(samples).median, median);
        }
        assert_eq!(Samples::of(vec![3.0, 1.0, 2.0]).range(), [1.0, 3.0]);
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
}
