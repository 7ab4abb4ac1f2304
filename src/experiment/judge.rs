//! Strategies measured on one frame: error against the exact reference, time in turns.
//!
//! First every strategy draws its frame until its buffers are settled, and its layers are compared with exact, which is
//! evaluated once ([`errors`]). Then time is taken ([`times`]): a warm-up round that nobody counts, and rounds in each of which
//! every strategy and the plain drawing of the uncut scene run once, on all clocks. Whoever begins a round ends the next, so that
//! what disturbs the machine disturbs all alike.
//!
//! Where the device has no timestamps to trust, every pass is timed by the wall (see [`crate::gpu`]). What runs on the CPU, as the
//! contender `winding` does, always is.

use image::RgbaImage;

use super::measurement::{
    Ending, Measurement, PassTime, PerClock, Reference, StrategyMeasurement, Timing,
};
use super::{Contender, Samples, Shown, Stopwatch};
use crate::compare::{Comparison, compare, heatmap};
use crate::exact::{Exact, Windings, evaluate};
use crate::gpu::{ClockSet, PassTime as TimeOfPass, RunTimes};
use crate::layers::Layers;
use crate::passes::Model;
use crate::plan::Clock;
use crate::scene::{Prepared, View};
use crate::session::{Outcome, Session};
use crate::strategies::FrameOptions;
use crate::{Error, Result};

/// A frame that is asked for, and what the truth about it is asked of.
pub struct Question<'a> {
    /// Name of the scene.
    pub name: String,
    /// The scene.
    pub shown: &'a Shown,
    /// The view of it.
    pub view: View,
    /// Of another scene, whose exact image is the truth: that of a whole mesh for a broken one. `None` asks the scene itself.
    pub truth: Option<&'a Shown>,
    /// The command line that asks it again.
    pub command: String,
}

impl<'a> Question<'a> {
    /// The scene that holds the truth, in the space of the one that is shown: else their pixels could not be compared.
    fn whole(&self) -> Result<&'a Prepared> {
        let (own, whole) = (self.shown, self.truth.unwrap_or(self.shown));
        let (shown, truth) = (&own.model.prepared, whole.truth()?);
        let places = [shown, truth].map(|p| (p.centre_in_world.to_array(), p.scale));
        if places[0] != places[1] {
            return Err(Error::input(
                format!("the truth about {}", self.name),
                "it is framed in another box than the scene it is to judge",
                "let both have the same parts in the same places, so that one camera and one section mean the same in both",
            ));
        }
        Ok(truth)
    }
}

/// A frame of a strategy.
pub struct Frame {
    /// Who drew it.
    pub contender: Contender,
    /// How it ended.
    pub outcome: Outcome,
    /// What it shows; none if it was refused.
    pub layers: Option<Layers>,
}

/// All that was found of a scene.
pub struct Judgement {
    /// The numbers; times are empty until [`times`] has run.
    pub measurement: Measurement,
    /// The truth.
    pub exact: Exact,
    /// The frames, in the order of the measurement.
    pub frames: Vec<Frame>,
    usual: FrameOptions,
    model: Model,
    view: View,
}

impl Judgement {
    /// Where a frame differs from exact; none if it was refused.
    pub fn heatmap(&self, frame: &Frame) -> Option<RgbaImage> {
        frame.layers.as_ref().map(|l| heatmap(&self.exact, l))
    }

    /// The picture of a frame, at the resolution that was measured: RGBA8, rows from the top.
    pub fn picture(&self, session: &mut Session, frame: &Frame) -> Result<Vec<u8>> {
        session.set_options(frame.contender.options(self.usual));
        let picture = match (frame.contender.strategy(), &frame.layers) {
            (Some(strategy), _) => session.picture(&strategy),
            (None, Some(layers)) => session.shade(&self.model, &self.view, layers),
            (None, None) => Err(Error::Plan(format!("{} drew nothing", frame.contender))),
        };
        session.set_options(self.usual);
        picture
    }
}

/// How many steps [`errors`] tells of.
pub fn error_steps(contenders: usize) -> usize {
    1 + contenders
}

/// How many steps [`times`] tells of.
pub fn timing_steps(rounds: usize) -> usize {
    1 + rounds
}

/// Draws a frame by every contender and compares it with exact. The session's options are those of all that name no others.
pub fn errors(
    session: &mut Session,
    question: &Question<'_>,
    contenders: &[Contender],
    step: &mut dyn FnMut(String),
) -> Result<Judgement> {
    let model = &question.shown.model;
    step("exact".to_owned());
    let watch = Stopwatch::start();
    let exact = evaluate(question.whole()?, &question.view);
    let exact_ms = watch.ms();

    let usual = session.options();
    let mut frames = Vec::with_capacity(contenders.len());
    let mut found = Vec::with_capacity(contenders.len());
    for contender in contenders {
        step(contender.to_string());
        session.set_options(contender.options(usual));
        let drawn = drawn(session, question, contender, &exact);
        session.set_options(usual);
        let (frame, strategy) = drawn?;
        frames.push(frame);
        found.push(strategy);
    }
    let gpu = session.gpu();
    let measurement = Measurement {
        scene: question.name.clone(),
        command: question.command.clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        triangles: model.prepared.triangle_count(),
        resolution: question.view.size_px,
        adapter: gpu.report().clone(),
        timing: if gpu.has_timestamps() {
            Timing::Timestamps
        } else {
            Timing::Wall
        },
        rounds: 0,
        exact: Reference::of(&exact, exact_ms),
        draw_only_ms: Samples::default(),
        strategies: found,
    };
    Ok(Judgement {
        measurement,
        exact,
        frames,
        usual,
        model: model.clone(),
        view: question.view,
    })
}

/// Takes the time of all that was drawn, in turns. Ends early, with nothing taken and `false`, as soon as `goes_on` says no.
pub fn times(
    session: &mut Session,
    question: &Question<'_>,
    judgement: &mut Judgement,
    rounds: usize,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<bool> {
    let usual = judgement.usual;
    draw_uncut(session, question)?;
    let mut runners = vec![Runner::Uncut];
    let drawn = judgement.frames.iter().filter(|f| f.layers.is_some());
    runners.extend(drawn.map(|f| Runner::Contender(f.contender)));
    let runs = in_turns(session, question, usual, &runners, rounds, step, goes_on);
    session.set_options(usual);
    let Some(runs) = runs? else {
        return Ok(false);
    };
    let measurement = &mut judgement.measurement;
    measurement.rounds = rounds;
    measurement.draw_only_ms = samples(&runs[0], Clock::Frame);
    let drawn = (measurement.strategies.iter_mut()).filter(|s| s.was_drawn());
    for (strategy, runs) in drawn.zip(&runs[1..]) {
        strategy.time_ms = PerClock::of(|clock| samples(runs, clock));
        strategy.passes = passes(runs);
        let ratio = strategy.time_ms.frame.over(&measurement.draw_only_ms);
        strategy.frame_over_draw_only = Some(ratio.median).filter(|r| r.is_finite() && *r > 0.0);
        strategy.frame_over_draw_only_mad = Some(ratio.mad).filter(|r| r.is_finite());
    }
    Ok(true)
}

fn drawn(
    session: &mut Session,
    question: &Question<'_>,
    contender: &Contender,
    exact: &Exact,
) -> Result<(Frame, StrategyMeasurement)> {
    let (model, view) = (&question.shown.model, &question.view);
    let (outcome, layers, bytes) = match contender.strategy() {
        Some(strategy) => {
            let outcome = session.draw(model, view, &strategy)?.outcome;
            match outcome {
                Outcome::Refused(_) => (outcome, None, [0; 3]),
                _ => {
                    let layers = session.layers(&strategy)?;
                    (outcome, Some(layers), session.bytes(&strategy)?)
                }
            }
        }
        None => {
            let whole = question.shown.truth()?;
            let windings = Windings::of(whole);
            let layers = windings.layers(whole, view);
            (Outcome::Complete, Some(layers), [windings.bytes(), 0, 0])
        }
    };
    let comparison: Option<Comparison> =
        (layers.as_ref()).map(|l| compare(exact, l, view, model.prepared.scale));
    let found = StrategyMeasurement {
        name: contender.to_string(),
        outcome: Ending::of(&outcome),
        reason: outcome.reason().map(str::to_owned),
        comparison,
        bytes: PerClock::of(|clock| bytes[clock as usize]),
        time_ms: PerClock::default(),
        frame_over_draw_only: None,
        frame_over_draw_only_mad: None,
        passes: Vec::new(),
    };
    let frame = Frame {
        contender: *contender,
        outcome,
        layers,
    };
    Ok((frame, found))
}

/// What runs in turns.
enum Runner {
    /// The scene with nothing cut.
    Uncut,
    /// The last frame of a contender.
    Contender(Contender),
}

impl Runner {
    /// Runs all clocks.
    fn run(
        &self,
        session: &mut Session,
        question: &Question<'_>,
        usual: FrameOptions,
    ) -> Result<RunTimes> {
        match self {
            Self::Uncut => session.repeat_uncut(ClockSet::ALL),
            Self::Contender(contender) => match contender.strategy() {
                Some(strategy) => {
                    session.set_options(contender.options(usual));
                    session.repeat(&strategy, ClockSet::ALL)
                }
                None => wound(question),
            },
        }
    }
}

/// Draws by winding numbers, for the time it takes.
fn wound(question: &Question<'_>) -> Result<RunTimes> {
    let whole = question.shown.truth()?;
    let watch = Stopwatch::start();
    let windings = Windings::of(whole);
    let tree_ms = watch.ms();
    let watch = Stopwatch::start();
    // Not to be left out for having no use.
    std::hint::black_box(windings.layers(whole, &question.view));
    let frame_ms = watch.ms();
    let pass = |name: &str, clock, time_ms| TimeOfPass {
        name: name.to_owned(),
        clock,
        time_ms,
    };
    Ok(RunTimes {
        passes: vec![
            pass("winding: tree (CPU)", Clock::Solid, tree_ms),
            pass("winding (CPU)", Clock::Frame, frame_ms),
        ],
        clocks_ms: [Some(tree_ms), None, Some(frame_ms)],
    })
}

/// Times of each runner, by round; none if it was ended early.
fn in_turns(
    session: &mut Session,
    question: &Question<'_>,
    usual: FrameOptions,
    runners: &[Runner],
    rounds: usize,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<Vec<RunTimes>>>> {
    let mut runs: Vec<Vec<RunTimes>> = runners.iter().map(|_| Vec::new()).collect();
    step("warm-up".to_owned());
    for runner in runners {
        runner.run(session, question, usual)?;
    }
    for round in 0..rounds {
        step(format!("round {} of {rounds}", round + 1));
        for turn in 0..runners.len() {
            if !goes_on() {
                return Ok(None);
            }
            let who = (round + turn) % runners.len();
            runs[who].push(runners[who].run(session, question, usual)?);
        }
    }
    Ok(Some(runs))
}

/// Draws the scene with nothing cut, so that it can run in turns with the contenders.
fn draw_uncut(session: &mut Session, question: &Question<'_>) -> Result<()> {
    let drawn = session.draw_uncut(&question.shown.model, &question.view)?;
    match drawn.outcome {
        Outcome::Refused(reason) => Err(Error::Limit(reason)),
        _ => Ok(()),
    }
}

/// Times of a clock; none where the clock never runs.
fn samples(runs: &[RunTimes], clock: Clock) -> Samples {
    Samples::of(
        runs.iter()
            .filter_map(|r| r.clocks_ms[clock as usize])
            .collect(),
    )
}

fn passes(runs: &[RunTimes]) -> Vec<PassTime> {
    let Some(first) = runs.first() else {
        return Vec::new();
    };
    // All runs are of one plan: the same passes in the same order.
    let of = |i: usize| {
        runs.iter()
            .filter_map(|r| r.passes.get(i))
            .map(|p| p.time_ms)
            .collect()
    };
    (first.passes.iter().enumerate())
        .map(|(i, pass)| PassTime {
            name: pass.name.clone(),
            clock: pass.clock,
            median_ms: Samples::of(of(i)).median,
        })
        .collect()
}
