//! Strategies measured: on one frame, and over the sweeps of an experiment.
//!
//! An experiment is data: a file that holds a question, scenes, what is varied, who is asked, and what is expected. Running one gives
//! a [`Record`] for each point of its sweeps, written as soon as it is found; [`crate::report`] makes pages of records and needs
//! nothing else. Errors are found before any time is taken, and time is taken in turns (see [`judge`]).

mod contender;
mod judge;
mod measurement;
mod record;
mod samples;
mod shown;
mod stopwatch;

pub use contender::Contender;
pub use judge::{Frame, Judgement, Question, error_steps, errors, times, timing_steps};
pub use measurement::{
    Ending, Measurement, PassTime, PerClock, Reference, StrategyMeasurement, Timing,
};
pub use record::{
    Bound, CaseRecord, CaseRecords, Expectation, Machine, Parameters, Picture, Reached, Record,
    Run, Warning,
};
pub use samples::Samples;
pub use shown::Shown;
pub(crate) use stopwatch::Stopwatch;

#[cfg(test)]
pub(crate) use measurement::tests::example;
