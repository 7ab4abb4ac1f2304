//! Measures strategies on one frame: first their error against the exact reference, then their times, in interleaved rounds.
//!
//! First every strategy draws its frame until its buffer sizes no longer change; its layers are then compared with exact, which is
//! evaluated once ([`errors`]). Then times are taken ([`times`]): after a warm-up round that is not counted, every strategy and the plain
//! drawing of the uncut scene run once per round, on all clocks. The order rotates by one from round to round, so that a disturbance of
//! the machine affects all alike.
//!
//! Where the device has no reliable timestamps, every pass is timed by the wall clock (see [`cutaway::gpu`]). Renderers that run on the
//! CPU, such as `winding`, are always timed that way.

use std::sync::Arc;

use cutaway::gpu::{ClockSet, PassTime as TimeOfPass, RunTimes};
use cutaway::layers::Layers;
use cutaway::passes::Model;
use cutaway::plan::Clock;
use cutaway::scene::{Precision, Prepared, View};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{DrawOptions, Rasteriser};
use cutaway::{Error, Result};
use image::RgbaImage;

use super::measurement::{
    Ending, Measurement, MedianPassTime, PerClock, Price, Reference, StrategyMeasurement, Timing,
};
use super::{Evaluator, Renderer, Samples, SceneAtTime, Stopwatch};
use crate::compare::{Comparison, compare, heatmap};
use crate::exact::{Exact, Truth};

/// Frame to measure, and the source of its exact reference.
pub struct FrameQuestion<'a> {
    /// Name of the scene.
    pub name: String,
    /// The scene.
    pub shown: &'a SceneAtTime,
    /// The camera view.
    pub view: View,
    /// Another scene, whose exact image is the reference: for a broken mesh, the intact one. `None` uses the scene itself.
    pub truth: Option<&'a SceneAtTime>,
    /// The command line that repeats the measurement.
    pub command: String,
    /// Draw options for renderers that do not name their own.
    pub options: DrawOptions,
}

impl<'a> FrameQuestion<'a> {
    /// The scene whose exact image is the reference. It must have the same bounds as the shown scene, so that their pixels can be compared.
    fn whole(&self) -> Result<&'a Prepared> {
        let (own, whole) = (self.shown, self.truth.unwrap_or(self.shown));
        let (shown, truth) = (&own.model.prepared, whole.truth()?);
        let places = [shown, truth].map(|p| (p.centre_in_world.to_array(), p.scale));
        if places[0] != places[1] {
            return Err(Error::input(
                format!("the reference scene of {}", self.name),
                "its bounds differ from those of the measured scene",
                "give both scenes the same bounds, so that cameras and sections mean the same in both",
            ));
        }
        Ok(truth)
    }
}

/// A frame of a renderer.
pub struct JudgedFrame {
    /// Renderer of the frame.
    pub renderer: Renderer,
    /// Outcome of the drawing.
    pub outcome: Outcome,
    /// Layers of the frame; none if it was refused.
    pub layers: Option<Layers>,
    /// Exact reference; its undecided pixels are those that follow from this renderer's vertex snapping.
    exact: Arc<Exact>,
}

/// All results for a scene.
pub struct Judgement {
    /// The numbers; times are empty until [`times`] has run.
    pub measurement: Measurement,
    /// The exact reference.
    pub exact: Arc<Exact>,
    /// One frame per strategy, in the order of the measurement.
    pub frames: Vec<JudgedFrame>,
    options: DrawOptions,
    model: Model,
    view: View,
}

impl Judgement {
    /// Heat map of a frame's differences from exact; `None` if the frame was refused.
    pub fn heatmap(&self, frame: &JudgedFrame) -> Option<RgbaImage> {
        (frame.layers.as_ref()).map(|l| heatmap(&frame.exact, l))
    }

    /// The picture of a frame at the measured resolution, as RGBA8 rows from top to bottom.
    pub fn picture(&self, session: &mut Session, frame: &JudgedFrame) -> Result<Vec<u8>> {
        match (frame.renderer.or(self.options), &frame.layers) {
            (Renderer::Method(method), _) => session.picture(method),
            (_, Some(layers)) => session.shade(&self.model, &self.view, layers),
            (_, None) => Err(Error::Plan(format!("{} drew nothing", frame.renderer))),
        }
    }
}

/// Number of steps that [`errors`] reports.
pub fn error_steps(renderers: usize) -> usize {
    1 + renderers
}

/// Number of steps that [`times`] reports.
pub fn timing_steps(rounds: usize) -> usize {
    1 + rounds
}

/// Draws a frame with every renderer and compares each frame with exact.
pub fn errors(
    session: &mut Session,
    question: &FrameQuestion<'_>,
    renderers: &[Renderer],
    step: &mut dyn FnMut(String),
) -> Result<Judgement> {
    let model = &question.shown.model;
    step("exact".to_owned());
    let watch = Stopwatch::start();
    let truth = Truth::new(question.whole()?, question.view);
    let exact_ms = watch.ms();

    let mut frames = Vec::with_capacity(renderers.len());
    let mut found = Vec::with_capacity(renderers.len());
    for renderer in renderers {
        step(renderer.to_string());
        let (frame, strategy) = draw_by(session, question, renderer, &truth)?;
        frames.push(frame);
        found.push(strategy);
    }
    let exact = truth.at(Precision::USUAL);
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
        exact: Reference::new(&exact, exact_ms),
        draw_only_ms: Samples::default(),
        draw_only_compute_ms: None,
        strategies: found,
    };
    Ok(Judgement {
        measurement,
        exact,
        frames,
        options: question.options,
        model: model.clone(),
        view: question.view,
    })
}

/// Times all frames that were drawn, in interleaved rounds. Returns `false`, without times, as soon as `goes_on` returns false.
pub fn times(
    session: &mut Session,
    question: &FrameQuestion<'_>,
    judgement: &mut Judgement,
    rounds: usize,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<bool> {
    let drawn = judgement.frames.iter().filter(|f| f.layers.is_some());
    let drawn: Vec<Renderer> = drawn.map(|f| f.renderer.or(question.options)).collect();
    let by_compute = |r: &Renderer| rasteriser_of(r) == Rasteriser::Compute;
    let rasterisers: &[Rasteriser] = match drawn.iter().any(by_compute) {
        true => &[Rasteriser::Hardware, Rasteriser::Compute],
        false => &[Rasteriser::Hardware],
    };
    for rasteriser in rasterisers {
        draw_uncut(session, question, *rasteriser)?;
    }
    let uncut = rasterisers.iter().map(|r| Runner::Uncut(*r));
    let runners: Vec<Runner> = uncut.chain(drawn.iter().map(|r| Runner::Of(*r))).collect();
    let Some(runs) = in_turns(session, question, &runners, rounds, step, goes_on)? else {
        return Ok(false);
    };
    let measurement = &mut judgement.measurement;
    measurement.rounds = rounds;
    let (uncut, runs) = runs.split_at(rasterisers.len());
    let uncut: Vec<Samples> = uncut.iter().map(|r| samples(r, Clock::Frame)).collect();
    measurement.draw_only_ms = uncut[0].clone();
    measurement.draw_only_compute_ms = uncut.get(1).cloned();
    let covered_px = measurement.exact.cap_px + measurement.exact.surface_px;
    let triangles = measurement.triangles;
    let found = (measurement.strategies.iter_mut()).filter(|s| s.was_drawn());
    for ((strategy, renderer), runs) in found.zip(&drawn).zip(runs) {
        strategy.time_ms = PerClock::from_fn(|clock| samples(runs, clock));
        strategy.passes = passes(runs);
        let own = match rasteriser_of(renderer) {
            Rasteriser::Hardware => &uncut[0],
            Rasteriser::Compute => &uncut[1],
        };
        strategy.cut = Price::of(&strategy.time_ms.frame, own, covered_px, triangles);
        let ratio = strategy.time_ms.frame.over(&measurement.draw_only_ms);
        strategy.frame_over_draw_only = Some(ratio.median).filter(|r| r.is_finite() && *r > 0.0);
        strategy.frame_over_draw_only_mad = Some(ratio.mad).filter(|r| r.is_finite());
    }
    Ok(true)
}

fn draw_by(
    session: &mut Session,
    question: &FrameQuestion<'_>,
    renderer: &Renderer,
    truth: &Truth<&Prepared>,
) -> Result<(JudgedFrame, StrategyMeasurement)> {
    let (model, view) = (&question.shown.model, &question.view);
    let (outcome, layers, bytes) = match renderer.or(question.options) {
        Renderer::Method(method) => {
            let outcome = session.draw(model, view, method)?.outcome;
            match outcome {
                Outcome::Refused(_) => (outcome, None, [0; 3]),
                _ => {
                    let layers = session.layers(method)?;
                    (outcome, Some(layers), session.bytes(method)?)
                }
            }
        }
        Renderer::Cpu(evaluator) => {
            let evaluated = evaluator.evaluate(question.shown.truth()?, view);
            let bytes = [evaluated.bytes, 0, 0];
            (Outcome::Complete, Some(evaluated.layers), bytes)
        }
    };
    let precision = match (&layers, renderer.or(question.options)) {
        (Some(_), Renderer::Method(method)) => session.precision(method)?,
        _ => Precision::USUAL,
    };
    let exact = truth.at(precision);
    let comparison: Option<Comparison> =
        (layers.as_ref()).map(|l| compare(&exact, l, view, model.prepared.scale));
    let is_usual = Arc::ptr_eq(&exact, &truth.at(Precision::USUAL));
    let own_doubt = comparison.is_some() && !is_usual;
    let found = StrategyMeasurement {
        name: renderer.to_string(),
        outcome: Ending::from_outcome(&outcome),
        reason: outcome.reason().map(str::to_owned),
        comparison,
        undecided_px: own_doubt.then(|| exact.undecided_px()),
        bytes: PerClock::from_fn(|clock| bytes[clock as usize]),
        time_ms: PerClock::default(),
        frame_over_draw_only: None,
        frame_over_draw_only_mad: None,
        cut: None,
        passes: Vec::new(),
    };
    let frame = JudgedFrame {
        renderer: *renderer,
        outcome,
        layers,
        exact,
    };
    Ok((frame, found))
}

/// The rasteriser that a renderer uses; the default one if its options name none.
fn rasteriser_of(renderer: &Renderer) -> Rasteriser {
    renderer.options().rasteriser.unwrap_or_default()
}

/// Work that is timed once in each round.
enum Runner {
    /// The uncut scene, drawn with this rasteriser.
    Uncut(Rasteriser),
    /// The frame of a renderer.
    Of(Renderer),
}

impl Runner {
    /// Does the work once, on all clocks, and returns its times.
    fn run(&self, session: &mut Session, question: &FrameQuestion<'_>) -> Result<RunTimes> {
        match self {
            Self::Uncut(rasteriser) => session.repeat_uncut(*rasteriser, ClockSet::ALL),
            Self::Of(Renderer::Method(method)) => session.repeat(method, ClockSet::ALL),
            Self::Of(Renderer::Cpu(evaluator)) => times_of(*evaluator, question),
        }
    }
}

/// Evaluates a frame on the CPU and returns its times.
fn times_of(evaluator: Evaluator, question: &FrameQuestion<'_>) -> Result<RunTimes> {
    let evaluated = evaluator.evaluate(question.shown.truth()?, &question.view);
    // Keeps the optimiser from removing the evaluation.
    std::hint::black_box(&evaluated.layers);
    let pass = |name: String, clock, time_ms: f64| TimeOfPass {
        name,
        clock,
        time_ms: Some(time_ms),
    };
    let (solid_ms, frame_ms) = (evaluated.solid_ms, evaluated.frame_ms);
    Ok(RunTimes {
        passes: vec![
            pass(format!("{evaluator}: tree (CPU)"), Clock::Solid, solid_ms),
            pass(format!("{evaluator} (CPU)"), Clock::Frame, frame_ms),
        ],
        clocks_ms: [Some(solid_ms), None, Some(frame_ms)],
    })
}

/// Times of each runner in each round; `None` if the rounds were ended early.
fn in_turns(
    session: &mut Session,
    question: &FrameQuestion<'_>,
    runners: &[Runner],
    rounds: usize,
    step: &mut dyn FnMut(String),
    goes_on: &dyn Fn() -> bool,
) -> Result<Option<Vec<Vec<RunTimes>>>> {
    let mut runs: Vec<Vec<RunTimes>> = runners.iter().map(|_| Vec::new()).collect();
    step("warm-up".to_owned());
    for runner in runners {
        runner.run(session, question)?;
    }
    for round in 0..rounds {
        step(format!("round {} of {rounds}", round + 1));
        for turn in 0..runners.len() {
            if !goes_on() {
                return Ok(None);
            }
            let who = (round + turn) % runners.len();
            runs[who].push(runners[who].run(session, question)?);
        }
    }
    Ok(Some(runs))
}

/// Draws the uncut scene, so that it can be timed in the same rounds as the renderers.
fn draw_uncut(
    session: &mut Session,
    question: &FrameQuestion<'_>,
    rasteriser: Rasteriser,
) -> Result<()> {
    let drawn = session.draw_uncut(&question.shown.model, &question.view, rasteriser)?;
    match drawn.outcome {
        Outcome::Refused(refusal) => Err(Error::Limit(refusal.reason)),
        _ => Ok(()),
    }
}

/// Times of a clock; empty if the clock never runs.
fn samples(runs: &[RunTimes], clock: Clock) -> Samples {
    Samples::new(
        runs.iter()
            .filter_map(|r| r.clocks_ms[clock as usize])
            .collect(),
    )
}

fn passes(runs: &[RunTimes]) -> Vec<MedianPassTime> {
    let Some(first) = runs.first() else {
        return Vec::new();
    };
    // All runs come from the same plan, so they have the same passes in the same order.
    let of = |i: usize| {
        runs.iter()
            .filter_map(|r| r.passes.get(i))
            .filter_map(|p| p.time_ms)
            .collect()
    };
    (first.passes.iter().enumerate())
        .map(|(i, pass)| MedianPassTime {
            name: pass.name.clone(),
            clock: pass.clock,
            median_ms: Samples::new(of(i)).median,
        })
        .collect()
}
