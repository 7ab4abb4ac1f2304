//! Strategies measured on one frame: error against the exact reference, time in turns.
//!
//! First every strategy draws its frame until its buffers are settled, and its layers are compared with exact, which is
//! evaluated once. Then time is taken: a warm-up round that nobody counts, and rounds in each of which every strategy and
//! the plain drawing of the uncut scene run once, on all clocks. Whoever begins a round ends the next, so that what
//! disturbs the machine disturbs all alike.
//!
//! Where the device has no timestamps to trust, every pass is timed by the wall (see [`crate::gpu`]).

use image::RgbaImage;

use super::console::Console;
use super::open::Opened;
use super::picture;
use super::shown::Shown;
use super::stopwatch::Stopwatch;
use crate::compare::{Comparison, compare, heatmap};
use crate::exact::{Exact, evaluate};
use crate::gpu::{ClockSet, Program, RunTimes};
use crate::layers::Layers;
use crate::passes::Model;
use crate::plan::{Capacities, Clock};
use crate::report::{ExactReport, PassReport, PerClock, Report, Samples, StrategyReport};
use crate::session::{Outcome, Session};
use crate::strategies::{self, Strategy};
use crate::{Error, Result};

/// A frame of a strategy.
pub(super) struct Frame {
    /// Who drew it.
    pub(super) strategy: Strategy,
    /// How it ended.
    pub(super) outcome: Outcome,
    /// What it shows; none if it was refused.
    pub(super) layers: Option<Layers>,
    comparison: Option<Comparison>,
}

/// All that was found of a scene.
pub(super) struct Judgement {
    /// The numbers.
    pub(super) report: Report,
    /// The truth.
    pub(super) exact: Exact,
    /// The frames, in the order of the report.
    pub(super) frames: Vec<Frame>,
}

impl Judgement {
    /// Where a frame differs from exact; none if it was refused.
    pub(super) fn heatmap(&self, frame: &Frame) -> Option<RgbaImage> {
        frame.layers.as_ref().map(|l| heatmap(&self.exact, l))
    }
}

/// How many steps [`judge`] tells the console of.
pub(super) fn steps(strategies: usize, rounds: usize) -> usize {
    1 + strategies + 1 + rounds
}

/// Judges strategies on a scene.
pub(super) fn judge(
    session: &mut Session,
    shown: &Shown,
    opened: &Opened,
    strategies: &[Strategy],
    rounds: usize,
    console: &Console,
) -> Result<Judgement> {
    let model = &shown.model;
    let view = opened.view(&model.prepared);
    console.step("exact");
    let watch = Stopwatch::start();
    let exact = evaluate(shown.truth()?, &view);
    let exact_ms = watch.ms();

    let mut frames = Vec::with_capacity(strategies.len());
    for strategy in strategies {
        console.step(strategy.to_string());
        let outcome = session.draw(model, &view, strategy)?.outcome;
        let drawn = !matches!(outcome, Outcome::Refused(_));
        let layers = drawn.then(|| session.layers(strategy)).transpose()?;
        let comparison = (layers.as_ref()).map(|l| compare(&exact, l, &view, model.prepared.scale));
        frames.push(Frame {
            strategy: *strategy,
            outcome,
            layers,
            comparison,
        });
    }

    let uncut = uncut(session, model, opened)?;
    let mut runners = vec![Runner::Uncut(&uncut)];
    let drawn = frames.iter().filter(|f| f.layers.is_some());
    runners.extend(drawn.map(|f| Runner::Strategy(f.strategy)));
    let runs = measure(session, &runners, rounds, console)?;

    let draw_only_ms = samples(&runs[0], Clock::Frame);
    let mut runs_of_drawn = runs[1..].iter();
    let none = Vec::new();
    let mut reports = Vec::with_capacity(frames.len());
    for frame in &frames {
        let runs = match frame.layers {
            Some(_) => runs_of_drawn.next().unwrap_or(&none),
            None => &none,
        };
        reports.push(report_of(session, frame, runs, draw_only_ms.median)?);
    }
    let report = Report {
        scene: opened.scene.name.clone(),
        command: command_line(),
        version: env!("CARGO_PKG_VERSION"),
        triangles: model.prepared.triangle_count(),
        resolution: view.size_px,
        adapter: session.gpu().report().clone(),
        timing: if session.gpu().has_timestamps() {
            "timestamps"
        } else {
            "wall"
        },
        rounds,
        exact: ExactReport::of(&exact, exact_ms),
        draw_only_ms,
        strategies: reports,
    };
    Ok(Judgement {
        report,
        exact,
        frames,
    })
}

/// The picture of a strategy's last frame, at the resolution that was measured.
pub(super) fn picture_of(session: &Session, frame: &Frame, size_px: [u32; 2]) -> Result<RgbaImage> {
    Ok(picture::plain(&session.picture(&frame.strategy)?, size_px))
}

/// What runs in turns.
enum Runner<'a> {
    /// The scene with nothing cut.
    Uncut(&'a Program),
    /// The last frame of a strategy.
    Strategy(Strategy),
}

impl Runner<'_> {
    /// Runs all clocks.
    fn run(&self, session: &Session) -> Result<RunTimes> {
        match self {
            Self::Uncut(program) => program.run(session.gpu(), ClockSet::ALL),
            Self::Strategy(strategy) => session.repeat(strategy, ClockSet::ALL),
        }
    }
}

/// Times of each runner, by round.
fn measure(
    session: &Session,
    runners: &[Runner<'_>],
    rounds: usize,
    console: &Console,
) -> Result<Vec<Vec<RunTimes>>> {
    let mut runs: Vec<Vec<RunTimes>> = runners.iter().map(|_| Vec::new()).collect();
    console.step("warm-up");
    for runner in runners {
        runner.run(session)?;
    }
    for round in 0..rounds {
        console.step(format!("round {} of {rounds}", round + 1));
        for turn in 0..runners.len() {
            let who = (round + turn) % runners.len();
            runs[who].push(runners[who].run(session)?);
        }
    }
    Ok(runs)
}

/// The program that draws the scene with nothing cut: where there is nothing to cut, all strategies record the same plan.
fn uncut(session: &Session, model: &Model, opened: &Opened) -> Result<Program> {
    let uncut = model.without_cuts();
    let view = opened.view(&uncut.prepared);
    let plan = strategies::record(&uncut, &view, &Strategy::RAYCAST_MASK, &Capacities::UNKNOWN)
        .map_err(|refusal| Error::Plan(refusal.to_string()))?;
    let mut program = Program::default();
    program.load(session.gpu(), plan)?;
    program.run(session.gpu(), ClockSet::ALL)?;
    Ok(program)
}

fn report_of(
    session: &Session,
    frame: &Frame,
    runs: &[RunTimes],
    draw_only_ms: f64,
) -> Result<StrategyReport> {
    let mut report = StrategyReport {
        name: frame.strategy.to_string(),
        outcome: frame.outcome.clone(),
        reason: frame.outcome.reason().map(str::to_owned),
        comparison: frame.comparison,
        bytes: PerClock::default(),
        time_ms: PerClock::of(|clock| samples(runs, clock)),
        frame_over_draw_only: None,
        passes: Vec::new(),
    };
    if frame.layers.is_some() {
        let bytes = session.bytes(&frame.strategy)?;
        report.bytes = PerClock::of(|clock| bytes[clock as usize]);
        report.passes = passes(runs);
        let ratio = report.time_ms.frame.median / draw_only_ms;
        report.frame_over_draw_only = Some(ratio).filter(|r| r.is_finite());
    }
    Ok(report)
}

/// Times of a clock; none where the clock never runs.
fn samples(runs: &[RunTimes], clock: Clock) -> Samples {
    Samples::of(
        runs.iter()
            .filter_map(|r| r.clocks_ms[clock as usize])
            .collect(),
    )
}

fn passes(runs: &[RunTimes]) -> Vec<PassReport> {
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
        .map(|(i, pass)| PassReport {
            name: pass.name.clone(),
            clock: pass.clock,
            median_ms: Samples::of(of(i)).median,
        })
        .collect()
}

/// The command line as one could type it again.
fn command_line() -> String {
    let words = std::env::args().skip(1).map(|word| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_=+,.:/%@".contains(c);
        if !word.is_empty() && word.chars().all(plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    });
    std::iter::once("cutaway".to_owned())
        .chain(words)
        .collect::<Vec<_>>()
        .join(" ")
}
