//! The work that is required when the view, the cut or the mesh changes, and its cost.
//!
//! Structures are rebuilt on their own clocks. If only the view moves, a frame costs the time of the frame clock. If the cut moves, the
//! time of the cut clock is added; if the mesh moves, all three clocks are added. Times are added round by round.

use cutaway_io::document::Node;

use crate::experiment::Moves;
use crate::experiment::{Ending, Record, Samples, StrategyMeasurement};

/// Part of the input that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Situation {
    /// Only the view.
    View,
    /// The cut, and possibly the view.
    Cut,
    /// The mesh, and possibly the cut and the view.
    Mesh,
}

impl From<Moves> for Situation {
    fn from(moves: Moves) -> Self {
        match moves {
            Moves::View => Self::View,
            Moves::Cut => Self::Cut,
            Moves::Mesh => Self::Mesh,
        }
    }
}

impl Situation {
    /// All situations, the one with the least work first.
    pub(crate) const ALL: [Self; 3] = [Self::View, Self::Cut, Self::Mesh];

    /// Description of the value.
    pub(crate) fn describe(self) -> &'static str {
        match self {
            Self::View => "only the view moves",
            Self::Cut => "the cut moves",
            Self::Mesh => "the mesh moves",
        }
    }

    /// Name of the figure that holds the ratio in this situation.
    pub(crate) fn figure(self) -> &'static str {
        match self {
            Self::View => "ratio.view_moves",
            Self::Cut => "ratio.cut_moves",
            Self::Mesh => "ratio.mesh_moves",
        }
    }

    /// Time of a strategy's frame in this situation, per round; `None` if no time was taken.
    fn samples(self, found: &StrategyMeasurement) -> Option<Samples> {
        let time = &found.time_ms;
        if !found.was_drawn() || time.frame.samples.is_empty() {
            return None;
        }
        let clocks: &[&Samples] = match self {
            Self::View => &[&time.frame],
            Self::Cut => &[&time.frame, &time.cut],
            Self::Mesh => &[&time.frame, &time.cut, &time.solid],
        };
        let of_round = |round: usize| {
            // A clock that never runs has no samples.
            let of_clock = clocks.iter().filter_map(|c| c.samples.get(round));
            of_clock.sum()
        };
        Some(Samples::new(
            (0..time.frame.samples.len()).map(of_round).collect(),
        ))
    }

    /// The frame time in this situation divided by the time to draw the uncut scene, per round.
    pub(crate) fn ratios(self, record: &Record, found: &StrategyMeasurement) -> Option<Samples> {
        let ratios = self.samples(found)?.over(&record.measurement.draw_only_ms);
        (ratios.median.is_finite() && ratios.median > 0.0).then_some(ratios)
    }

    /// Median of [`Self::ratios`].
    pub(crate) fn ratio(self, record: &Record, found: &StrategyMeasurement) -> Option<f64> {
        self.ratios(record, found).map(|r| r.median)
    }
}

/// Returns true if a strategy drew the whole frame without a decided wrong pixel.
pub(crate) fn is_exact(found: &StrategyMeasurement) -> bool {
    found.outcome == Ending::Complete && found.comparison.is_some_and(|c| c.decided_wrong_px == 0)
}

/// Kind of a scene's cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CutSetKind {
    /// A single plane.
    Plane,
    /// Several planes, or cuts that are made of planes.
    Planes,
    /// At least one relief.
    Relief,
}

impl CutSetKind {
    pub(crate) const ALL: [Self; 3] = [Self::Plane, Self::Planes, Self::Relief];

    /// Classifies the cuts of a point's scene.
    pub(crate) fn of(record: &Record) -> Self {
        let cuts = record.scene.root().get("cut");
        let cuts = cuts.map_or(&[] as &[_], Node::items);
        let regions = |cut: &'_ Node| -> Vec<Node> {
            let keys = ["box", "wedge", "volume"].iter();
            let held = keys.filter_map(|key| cut.get(key));
            // The entry holds one item or a list of items.
            held.flat_map(|node| match node.items() {
                [] => vec![node.clone()],
                several => several.to_vec(),
            })
            .collect()
        };
        let regions: Vec<Node> = cuts.iter().flat_map(regions).collect();
        let surfaces = cuts.iter().filter_map(|cut| cut.get("surfaces"));
        let surfaces: Vec<&Node> = surfaces.flat_map(Node::items).collect();
        let mut faces = surfaces.iter().copied().chain(&regions);
        if faces.any(|face| face.get("relief").is_some()) {
            Self::Relief
        } else if surfaces.len() == 1 && regions.is_empty() {
            Self::Plane
        } else {
            Self::Planes
        }
    }

    /// Description of the value.
    pub(crate) fn describe(self) -> &'static str {
        match self {
            Self::Relief => "reliefs",
            Self::Plane => "one plane",
            Self::Planes => "several planes",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::{PerClock, Samples, example};
    use cutaway_io::document::Value;

    /// A record of a strategy that has work on each clock.
    fn record() -> Record {
        let mut measurement = example();
        let [solid, cut, frame] = [50.0, 3.0, 4.0].map(|ms| Samples::new(vec![ms]));
        measurement.strategies[0].time_ms = PerClock { solid, cut, frame };
        super::super::totals::tests::record_of(measurement)
    }

    #[test]
    fn what_is_paid_depends_on_what_moves() {
        let record = record();
        let ratios = Situation::ALL.map(|s| s.ratio(&record, &record.measurement.strategies[0]));
        // Drawing the uncut scene takes 2 ms.
        assert_eq!(ratios, [Some(2.0), Some(3.5), Some(28.5)]);
    }

    #[test]
    fn a_document_says_by_what_its_scene_is_cut() {
        let mut record = record();
        for (cuts, kind) in [
            (
                "[{ surfaces = [{ section = \"x=1\" }] }]",
                CutSetKind::Plane,
            ),
            (
                "[{ surfaces = [{ section = \"x=1\" }, { section = \"y=1\" }] }]",
                CutSetKind::Planes,
            ),
            (
                "[{ surfaces = [{ section = \"x=1\" }], wedge = { axis = \"x\" } }]",
                CutSetKind::Planes,
            ),
            ("[{ wedge = { axis = \"x\" } }]", CutSetKind::Planes),
            (
                "[{ wedge = { axis = \"x\", relief = \"a\" } }]",
                CutSetKind::Relief,
            ),
            (
                "[{ surfaces = [{ section = \"x=1\", relief = \"a\" }] }]",
                CutSetKind::Relief,
            ),
        ] {
            record.scene.set("cut", Value::read(cuts)).unwrap();
            assert_eq!(CutSetKind::of(&record), kind, "{cuts}");
        }
    }
}
