//! Measurement of strategies: on one frame, and over the sweeps of an experiment.
//!
//! An experiment is data: a file with a question, scenes, sweep axes, strategies and expectations. Running an experiment gives one
//! [`Record`] for each point of its sweeps, written as soon as the point is measured. [`crate::report`] makes pages from records alone.
//! Errors are measured before any time is taken, and times are taken in interleaved rounds (see [`times`]).

pub mod definition;
pub mod drift;
pub mod expect;
pub mod figures;
mod identity;
mod judge;
mod measurement;
mod memory;
mod parameter;
pub mod picture;
mod picture_flicker;
mod record;
mod renderer;
pub mod run;
mod samples;
mod scene_at_time;
mod stopwatch;
pub mod sweep;
mod synopsis;
mod warnings;

pub use definition::{Definition, Moves};
pub use identity::Identity;
pub use judge::{FrameQuestion, JudgedFrame, Judgement, error_steps, errors, times, timing_steps};
pub use measurement::{
    Ending, MOST_UNDECIDED, Measurement, MedianPassTime, PerClock, Price, Reference,
    StrategyMeasurement, Timing,
};
pub use memory::check_memory;
pub use parameter::{Parameter, Parameters};
pub use record::{
    Bound, CaseRecord, CaseRecords, Expectation, FamilyMember, Invocation, Machine, Reached,
    Record, RecordedPicture, Run, Warning,
};
pub use renderer::{Evaluation, Evaluator, Renderer};
pub use run::Watcher;
pub use samples::Samples;
pub use scene_at_time::{SceneAtTime, draw_options};
pub use stopwatch::Stopwatch;
pub use synopsis::{ChartSynopsis, RunSynopsis, Synopsis};

#[cfg(test)]
pub(crate) use measurement::tests::example;
