//! What has to be drawn anew, and what that costs.
//!
//! Structures are redone on their own clocks. When only the view moves, a frame costs the clock of the frame; when the cut moves, the
//! clock of the cut comes on top; when the mesh moves, all three. Clocks are added round by round.

use crate::experiment::definition::Moves;
use crate::experiment::{Ending, Record, Samples, StrategyMeasurement};

/// What moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Situation {
    /// Only the view.
    View,
    /// The cut, and maybe the view.
    Cut,
    /// The mesh, and maybe the rest.
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
    /// All, the least work first.
    pub(crate) const ALL: [Self; 3] = [Self::View, Self::Cut, Self::Mesh];

    /// In words.
    pub(crate) fn told(self) -> &'static str {
        match self {
            Self::View => "only the view moves",
            Self::Cut => "the cut moves",
            Self::Mesh => "the mesh moves",
        }
    }

    /// The name of its ratio among the figures.
    pub(crate) fn figure(self) -> &'static str {
        match self {
            Self::View => "ratio.view_moves",
            Self::Cut => "ratio.cut_moves",
            Self::Mesh => "ratio.mesh_moves",
        }
    }

    /// Time of a strategy's frame, round by round; none where none was taken.
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
        Some(Samples::of(
            (0..time.frame.samples.len()).map(of_round).collect(),
        ))
    }

    /// That time over drawing the uncut scene, quotient by quotient of the rounds.
    pub(crate) fn ratios(self, record: &Record, found: &StrategyMeasurement) -> Option<Samples> {
        let ratios = self.samples(found)?.over(&record.measurement.draw_only_ms);
        (ratios.median.is_finite() && ratios.median > 0.0).then_some(ratios)
    }

    /// The ratio in the middle.
    pub(crate) fn ratio(self, record: &Record, found: &StrategyMeasurement) -> Option<f64> {
        self.ratios(record, found).map(|r| r.median)
    }
}

/// Whether a strategy drew all of a frame and got no pixel wrong that the reference is sure of.
pub(crate) fn is_exact(found: &StrategyMeasurement) -> bool {
    found.outcome == Ending::Complete && found.comparison.is_some_and(|c| c.decided_wrong_px == 0)
}

/// By what a scene is cut, as far as its words tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// One plane alone.
    Plane,
    /// Several planes, or what is made of planes.
    Planes,
    /// At least one relief.
    Relief,
    /// What a scene file says.
    SceneFile,
}

impl Kind {
    /// All.
    pub(crate) const ALL: [Self; 4] = [Self::Plane, Self::Planes, Self::Relief, Self::SceneFile];

    /// Of the scene of a point.
    pub(crate) fn of(record: &Record) -> Self {
        // The command is of older records; where nothing shorter repeats a point it names the experiment's file, which says nothing.
        let command = record.measurement.command.split_whitespace();
        let words: Vec<&str> = match record.words.is_empty() {
            true => command.collect(),
            false => record.words.iter().map(String::as_str).collect(),
        };
        let is_file = |w: &&str| w.ends_with(".toml") && !w.starts_with("--");
        if words.iter().any(|w| w.starts_with("--relief")) {
            Self::Relief
        } else if words.iter().any(is_file) {
            Self::SceneFile
        } else if words.iter().filter(|w| w.starts_with("--section")).count() == 1 {
            Self::Plane
        } else {
            Self::Planes
        }
    }

    /// In words.
    pub(crate) fn told(self) -> &'static str {
        match self {
            Self::Relief => "reliefs",
            Self::Plane => "one plane",
            Self::Planes => "several planes",
            Self::SceneFile => "scene files",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::{PerClock, Samples, example};

    /// A strategy that has something to do on each clock.
    fn record() -> Record {
        let mut measurement = example();
        let [solid, cut, frame] = [50.0, 3.0, 4.0].map(|ms| Samples::of(vec![ms]));
        measurement.strategies[0].time_ms = PerClock { solid, cut, frame };
        super::super::standing::tests::record_of(measurement)
    }

    #[test]
    fn what_is_paid_depends_on_what_moves() {
        let record = record();
        let ratios = Situation::ALL.map(|s| s.ratio(&record, &record.measurement.strategies[0]));
        // Drawing the uncut scene takes 2 ms.
        assert_eq!(ratios, [Some(2.0), Some(3.5), Some(28.5)]);
    }

    #[test]
    fn words_say_by_what_a_scene_is_cut() {
        let mut record = record();
        record.measurement.command = "cutaway measure experiments/a.toml --only=b".to_owned();
        assert_eq!(Kind::of(&record), Kind::SceneFile, "no words: a guess");
        for (words, kind) in [
            ("shape:crank --section=x=1", Kind::Plane),
            ("shape:crank --section=x=1 --section=y=1", Kind::Planes),
            ("shape:crank --wedge=x", Kind::Planes),
            ("shape:crank --section=x=1 --relief=waves", Kind::Relief),
            ("a/scene.toml --time=1", Kind::SceneFile),
        ] {
            record.words = words.split(' ').map(str::to_owned).collect();
            assert_eq!(Kind::of(&record), kind, "{words:?}");
        }
    }
}
