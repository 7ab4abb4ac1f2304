//! Measures the error and the time of every method on one picture, one method at a time.
//!
//! A method draws the picture until its buffers are large enough, is compared with the reference, runs once unmeasured, and then runs a few
//! measured frames. Its time is the median, over these, of the frame clock's passes. Its device memory is released before the next method.
//!
//! Cannot: interleave the methods' timed frames, as `cutaway compare` does; other load on the machine can therefore bias the comparison.

use std::sync::Arc;

use cutaway::gpu::ClockSet;
use cutaway::plan::Clock;
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use cutaway::{Outcome, Result, Session};
use cutaway_lab::Exact;
use cutaway_lab::compare::compare;
use cutaway_lab::experiment::{Samples, Stopwatch};

use super::Subject;
use super::context::JudgeContext;

/// Maximum number of frames measured per method.
const MOST_FRAMES: usize = 7;

/// Minimum number of frames measured per method, however long they take.
const FEWEST_FRAMES: usize = 3;

/// Total measuring time per method after which no further frame is begun, once there are enough.
const LONG_ENOUGH_MS: f64 = 1000.0;

/// A request for a survey.
#[derive(Clone, Debug)]
pub struct SurveyQuestion {
    /// Id of the question, repeated in answers.
    pub id: u64,
    /// The picture.
    pub subject: Subject,
}

/// Result for a method.
#[derive(Clone, Debug, PartialEq)]
pub struct Surveyed {
    /// Number of methods in the survey.
    pub total: usize,
    /// The method measured.
    pub method: Method,
    /// The result.
    pub found: Found,
}

/// Result of a measurement.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    /// The method draws the picture.
    SurveyPoint(SurveyPoint),
    /// The method refuses the scene, or failed.
    Refused(String),
}

/// Error and time of a method.
#[derive(Clone, Debug, PartialEq)]
pub struct SurveyPoint {
    /// Time of the passes of the frame clock, in milliseconds: the median.
    pub time_ms: f64,
    /// True if `time_ms` is device time; false if it is wall-clock time.
    pub is_device_time: bool,
    /// Number of wrong pixels, counting only pixels that the reference decides.
    pub wrong_px: usize,
    /// Number of wrong pixels that the method does not mark as unreliable.
    pub unmarked_px: usize,
    /// Name of the bounded buffer that was too small, if one was.
    pub overflow: Option<String>,
}

/// A survey in progress.
pub(super) struct Survey {
    question: SurveyQuestion,
    methods: Vec<Method>,
    done: usize,
    exact: Option<Arc<Exact>>,
}

impl Survey {
    /// Creates a survey.
    pub(super) fn new(question: SurveyQuestion) -> Self {
        Self {
            question,
            methods: methods(),
            done: 0,
            exact: None,
        }
    }

    /// Id of the survey's question.
    pub(super) fn id(&self) -> u64 {
        self.question.id
    }

    /// Returns true if all methods were measured.
    pub(super) fn is_done(&self) -> bool {
        self.done == self.methods.len()
    }

    /// Begins the next step, and returns its method; [`Self::is_done`] must be false.
    pub(super) fn begin_step(&mut self) -> Method {
        let method = self.methods[self.done];
        self.done += 1;
        method
    }

    /// Makes the result for a method.
    pub(super) fn surveyed(&self, method: Method, found: Found) -> Surveyed {
        Surveyed {
            total: self.methods.len(),
            method,
            found,
        }
    }

    /// Measures a method.
    pub(super) async fn step(
        &mut self,
        context: &mut JudgeContext,
        method: Method,
    ) -> Result<Found> {
        let subject = &self.question.subject;
        let exact = match &self.exact {
            Some(exact) => exact.clone(),
            None => self.exact.insert(context.exact(subject)?).clone(),
        };
        let measured = context.retried(async |context| {
            let session = context.session().await?;
            let measured = measure(session, subject, &exact, method);
            session.forget();
            measured
        });
        measured.await
    }
}

/// Every combination of a strategy and a rasteriser that can draw it.
pub fn methods() -> Vec<Method> {
    let by_each = |strategy: Strategy| {
        let by_compute = Method::new(strategy, DrawOptions::by(Rasteriser::Compute));
        let by_compute = strategy.can().compute.then_some(by_compute);
        [Some(Method::from(strategy)), by_compute]
            .into_iter()
            .flatten()
    };
    Strategy::all().into_iter().flat_map(by_each).collect()
}

fn measure(
    session: &mut Session,
    subject: &Subject,
    exact: &Exact,
    method: Method,
) -> Result<Found> {
    let (model, view) = (&subject.at.model, subject.view());
    let overflow = match session.draw(model, &view, method)?.outcome {
        Outcome::Refused(refusal) => return Ok(Found::Refused(refusal.reason)),
        Outcome::Overflowed(reason) => Some(reason),
        Outcome::Complete => None,
    };
    let layers = session.layers(method)?;
    let comparison = compare(exact, &layers, &view, model.prepared.scale);
    session.repeat(method, ClockSet::FRAME)?;
    let watch = Stopwatch::start();
    let mut times_ms = Vec::new();
    while times_ms.len() < FEWEST_FRAMES
        || times_ms.len() < MOST_FRAMES && watch.ms() < LONG_ENOUGH_MS
    {
        let times = session.repeat(method, ClockSet::FRAME)?;
        times_ms.push(times.clock_ms(Clock::Frame));
    }
    Ok(Found::SurveyPoint(SurveyPoint {
        time_ms: Samples::new(times_ms).median,
        is_device_time: session.gpu().has_timestamps(),
        wrong_px: comparison.decided_wrong_px,
        unmarked_px: comparison.unmarked_wrong_px,
        overflow,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_strategy_is_measured_by_each_rasteriser_that_it_has() {
        let methods = methods();
        let names: Vec<String> = methods.iter().map(Method::to_string).collect();
        for (name, is_there) in [
            ("raycast+mask", true),
            ("raycast+mask@compute", true),
            ("grid:256+vds:1024", true),
            ("grid:256+vds:1024@compute", false),
        ] {
            assert_eq!(names.contains(&name.to_owned()), is_there, "{name}");
        }
        let mut once = names.clone();
        once.dedup();
        assert_eq!(names, once, "each once");
    }
}
