//! Cost of a slot's frame: the clock, time and bytes written of each of its passes.
//!
//! The window's own frames are recorded into egui's encoder and not timed. The judge redraws the same frame on its own device, running all
//! its clocks again.

use cutaway::Result;
use cutaway::gpu::{ClockSet, RunTimes};
use cutaway::plan::{Clock, Plan};
use cutaway::strategies::Method;
use cutaway::{Error, Outcome};
use cutaway_lab::experiment::{PerClock, Renderer};

use super::Subject;
use super::context::JudgeContext;
use crate::picture::slot::SlotSide;

/// Number of timed runs of a frame.
const RUNS: usize = 3;

/// A question about the cost of frames.
#[derive(Clone, Debug)]
pub struct CostQuestion {
    /// Id of the question, repeated in answers.
    pub id: u64,
    /// The picture.
    pub subject: Subject,
    /// Renderers of the slots; `None` for a slot that is not visible.
    pub renderers: [Option<Renderer>; 2],
}

impl CostQuestion {
    /// The visible slots.
    pub(super) fn slots(&self) -> impl Iterator<Item = (SlotSide, Renderer)> + '_ {
        let of = |side: SlotSide| Some((side, self.renderers[side.index()]?));
        SlotSide::BOTH.into_iter().filter_map(of)
    }
}

/// Cost of one frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// Passes and CPU steps of the frame, in order.
    pub passes: Vec<PassCost>,
    /// Bytes produced by the passes of each clock.
    pub bytes: PerClock<u64>,
    /// Bytes of the scene itself, over all clocks.
    pub scene_bytes: u64,
    /// True if times are device time; false if they are wall-clock time, with a wait for the device after each pass.
    pub is_device_time: bool,
    /// Number of row bands in which the frame is drawn; `passes` and `scene_bytes` describe the first band.
    pub bands: usize,
}

/// Cost of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassCost {
    /// Name of the pass.
    pub name: String,
    /// Clock on which it runs.
    pub clock: Clock,
    /// Purpose of the pass.
    pub reason: String,
    /// Time in milliseconds: the minimum of a few runs.
    pub time_ms: f64,
    /// Bytes of the resources that the pass writes; for a CPU step, the bytes uploaded.
    pub bytes: u64,
}

impl Cost {
    /// Total time of the passes of a clock, in milliseconds.
    pub fn time_ms(&self, clock: Clock) -> f64 {
        let of_clock = self.passes.iter().filter(|p| p.clock == clock);
        of_clock.map(|p| p.time_ms).sum()
    }
}

/// Answers a question for a slot.
pub(super) async fn answer(
    context: &mut JudgeContext,
    question: &CostQuestion,
    by: Renderer,
) -> Result<Cost> {
    let subject = &question.subject;
    let Renderer::Method(method) = by else {
        return Err(Error::input(
            by.to_string(),
            "it runs on the CPU and has no passes",
            "choose a method for the slot",
        ));
    };
    let session = context.session().await?;
    let drawn = session.draw(&subject.at.model, &subject.view(), method)?;
    if let Outcome::Refused(refusal) = drawn.outcome {
        return Err(Error::Limit(refusal.reason));
    }
    let runs = (0..RUNS).map(|_| session.repeat(method, ClockSet::ALL));
    let runs = runs.collect::<Result<Vec<_>>>()?;
    let plan = session.plan(method)?;
    let bytes = session.bytes(method)?;
    Ok(Cost {
        passes: passes(plan, &runs),
        bytes: PerClock::from_fn(|clock| bytes[clock as usize]),
        scene_bytes: Clock::ALL.map(|c| plan.scene_bytes_on(c)).iter().sum(),
        is_device_time: session.gpu().has_timestamps(),
        bands: session.bands(Method::from(&method))?,
    })
}

/// The passes of a plan, with their minimum times.
fn passes(plan: &Plan, runs: &[RunTimes]) -> Vec<PassCost> {
    let least_ms = |name: &str| {
        let all = runs.iter().flat_map(|run| &run.passes);
        let own = all.filter(|p| p.name == name).filter_map(|p| p.time_ms);
        own.reduce(f64::min).unwrap_or(0.0)
    };
    let bytes = |ids: Vec<cutaway::plan::ResourceId>| {
        let all = ids.into_iter().map(|id| plan.resource(id).shape.bytes());
        all.sum::<u64>()
    };
    let on_cpu = plan.on_cpu.iter().map(|step| PassCost {
        time_ms: least_ms(&step.name),
        name: format!("{} (CPU)", step.name),
        clock: step.clock,
        reason: step.reason.clone(),
        bytes: bytes(step.makes.clone()),
    });
    let on_device = plan.passes.iter().map(|pass| PassCost {
        time_ms: least_ms(&pass.name),
        name: pass.name.clone(),
        clock: pass.clock,
        reason: pass.reason.clone(),
        bytes: bytes(pass.writes()),
    });
    on_cpu.chain(on_device).collect()
}
