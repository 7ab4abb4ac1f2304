//! What has to be drawn anew, and who is the fastest exact strategy then.
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

    /// Its time in the middle.
    pub(crate) fn ms(self, found: &StrategyMeasurement) -> Option<f64> {
        self.samples(found).map(|s| s.median)
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

/// Index of the fastest exact strategy of a point; none where none is exact or nothing was timed.
pub(crate) fn winner(record: &Record, situation: Situation) -> Option<usize> {
    let strategies = record.measurement.strategies.iter().enumerate();
    strategies
        .filter(|(_, s)| is_exact(s))
        .filter_map(|(i, s)| Some((i, situation.ms(s)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(i, _)| i)
}

/// By what a scene is cut, as far as its words tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// At least one relief.
    Relief,
    /// Planes alone.
    Planes,
    /// What a scene file says.
    SceneFile,
}

impl Kind {
    /// All.
    pub(crate) const ALL: [Self; 3] = [Self::Planes, Self::Relief, Self::SceneFile];

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
        } else {
            Self::Planes
        }
    }

    /// In words.
    pub(crate) fn told(self) -> &'static str {
        match self {
            Self::Relief => "reliefs",
            Self::Planes => "planes only",
            Self::SceneFile => "scene files",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::{PerClock, Samples, example};

    /// Two exact strategies: one slow in the frame, one with much to build.
    fn record() -> Record {
        let mut measurement = example();
        let mut strategy = |name: &str, [solid, cut, frame]: [f64; 3], wrong: usize| {
            let mut found = measurement.strategies[0].clone();
            found.name = name.to_owned();
            let at = |ms| Samples::of(vec![ms]);
            found.time_ms = PerClock {
                solid: at(solid),
                cut: at(cut),
                frame: at(frame),
            };
            if let Some(c) = &mut found.comparison {
                c.decided_wrong_px = wrong;
            }
            measurement.strategies.push(found);
        };
        strategy("steady", [0.0, 0.0, 8.0], 0);
        strategy("built", [50.0, 3.0, 4.0], 0);
        strategy("wrong", [0.0, 0.0, 1.0], 1);
        measurement.strategies.drain(..2);
        super::super::standing::tests::record_of(measurement)
    }

    #[test]
    fn who_wins_depends_on_what_moves() {
        let record = record();
        assert_eq!(
            Situation::ALL.map(|s| winner(&record, s)),
            [Some(1), Some(1), Some(0)]
        );
        let ratios = Situation::ALL.map(|s| s.ratio(&record, &record.measurement.strategies[1]));
        // Drawing the uncut scene takes 2 ms.
        assert_eq!(ratios, [Some(2.0), Some(3.5), Some(28.5)]);
    }

    #[test]
    fn words_say_by_what_a_scene_is_cut() {
        let mut record = record();
        record.measurement.command = "cutaway measure experiments/a.toml --only=b".to_owned();
        assert_eq!(Kind::of(&record), Kind::SceneFile, "no words: a guess");
        for (words, kind) in [
            (["shape:crank", "--section=x=1"], Kind::Planes),
            (["shape:crank", "--relief=waves"], Kind::Relief),
            (["a/scene.toml", "--time=1"], Kind::SceneFile),
        ] {
            record.words = words.map(str::to_owned).to_vec();
            assert_eq!(Kind::of(&record), kind, "{words:?}");
        }
    }

    #[test]
    fn what_is_wrong_or_overflowed_does_not_win() {
        let mut record = record();
        record.measurement.strategies[0].outcome = Ending::Overflowed;
        record.measurement.strategies[1].outcome = Ending::Overflowed;
        assert_eq!(winner(&record, Situation::View), None);
    }
}
