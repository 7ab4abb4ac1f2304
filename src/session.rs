//! A device with the programs of some strategies: draws scenes and redraws only what changed.
//!
//! Each strategy keeps its own program, so that several can be measured in turns without a rebuild between them; large
//! uploads are shared. A frame whose bounded buffers were too small is drawn again with the sizes it reported, up to
//! [`MOST_TRIES`] times; what still overflows is the outcome of the frame.

use std::collections::BTreeMap;

use crate::gpu::{ClockSet, Gpu, Program, RunTimes};
use crate::layers::Layers;
use crate::passes::{Model, Recorder};
use crate::plan::{Capacities, Contents, Plan};
use crate::scene::View;
use crate::strategies::{self, FrameOptions, Strategy};
use crate::{Error, Result};

/// How often a frame is drawn until its buffers are large enough.
pub const MOST_TRIES: usize = 4;

/// How a frame ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All of it was drawn.
    Complete,
    /// A bounded buffer was too small; the pixels concerned are marked.
    Overflowed(String),
    /// The strategy does not draw such a scene.
    Refused(String),
}

impl Outcome {
    /// `complete`, `overflowed` or `refused`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Overflowed(_) => "overflowed",
            Self::Refused(_) => "refused",
        }
    }

    /// Why, where it is not complete.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Complete => None,
            Self::Overflowed(reason) | Self::Refused(reason) => Some(reason),
        }
    }
}

/// A frame that was asked for: whether it was drawn, and what that took.
#[must_use = "a strategy may have refused the scene"]
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// How it ended.
    pub outcome: Outcome,
    /// The clocks that ran in the last try.
    pub clocks: ClockSet,
    /// Their times.
    pub times: RunTimes,
}

#[derive(Default)]
struct Slot {
    program: Program,
    capacities: Option<Capacities>,
    size_px: [u32; 2],
    /// The solids that the capacities were learnt from.
    vertices: Option<Contents>,
    /// Why the last call left no frame to read, if it did.
    refused: Option<String>,
}

impl Slot {
    fn refuse(&mut self, reason: String) -> Drawn {
        self.refused = Some(reason.clone());
        Drawn {
            outcome: Outcome::Refused(reason),
            clocks: ClockSet::NONE,
            times: RunTimes::default(),
        }
    }
}

/// A device and the programs on it.
pub struct Session {
    gpu: Gpu,
    options: FrameOptions,
    slots: BTreeMap<String, Slot>,
}

impl Session {
    /// A session on a device, with the usual options.
    pub fn new(gpu: Gpu) -> Self {
        Self::with_options(gpu, FrameOptions::default())
    }

    /// A session on a device.
    pub fn with_options(gpu: Gpu, options: FrameOptions) -> Self {
        Self {
            gpu,
            options,
            slots: BTreeMap::new(),
        }
    }

    /// The options of the frames to come, and of those that are looked at: each keeps frames of its own.
    pub fn set_options(&mut self, options: FrameOptions) {
        self.options = options;
    }

    /// The options in force.
    pub fn options(&self) -> FrameOptions {
        self.options
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Draws a frame. Clocks whose inputs did not change since the last frame of the same strategy do not run.
    pub fn draw(&mut self, model: &Model, view: &View, strategy: &Strategy) -> Result<Drawn> {
        let name = self.slot_name(strategy);
        let mut options = self.options;
        options
            .wide_atomics
            .get_or_insert(self.gpu.limits().wide_atomics);
        let slot = self.slots.entry(name).or_default();
        let same = slot.size_px == view.size_px && slot.vertices.as_ref() == Some(&model.vertices);
        if !same {
            // What one solid needed at one size says nothing of another.
            slot.capacities = None;
            slot.vertices = Some(model.vertices.clone());
        }
        slot.size_px = view.size_px;
        slot.refused = Some("it has drawn no frame".to_owned());
        let mut overflow = String::new();
        let mut last = None;
        let mut owed = ClockSet::NONE;
        for _ in 0..MOST_TRIES {
            let capacities = slot.capacities.get_or_insert(Capacities::UNKNOWN);
            let plan = match strategies::record_with(model, view, strategy, &options, capacities) {
                Ok(plan) => plan,
                Err(refusal) => return Ok(slot.refuse(refusal.reason)),
            };
            let changed = match slot.program.load(&self.gpu, plan) {
                Ok(changed) => changed,
                Err(Error::Limit(reason)) => return Ok(slot.refuse(reason)),
                Err(e) => return Err(e),
            };
            let clocks = changed.union(owed);
            slot.program.clear_needs_of_frame(&self.gpu)?;
            let times = slot.program.run_changed(&self.gpu, clocks)?;
            let needs = slot.program.needs(&self.gpu)?;
            let mut grown = false;
            overflow.clear();
            for (bounded, need) in slot.program.plan().bounded.iter().zip(needs) {
                if need > bounded.capacity || (bounded.exact && need != bounded.capacity) {
                    let before = capacities.clone();
                    if let Some(knob) = bounded.knob {
                        capacities.set(knob, need);
                    }
                    grown |= *capacities != before;
                }
                if need > bounded.capacity {
                    overflow = format!(
                        "{} need {need}, there are {}",
                        bounded.what, bounded.capacity
                    );
                }
            }
            last = Some(Drawn {
                outcome: Outcome::Complete,
                clocks,
                times,
            });
            if !grown {
                break;
            }
            owed = clocks;
        }
        let mut drawn = last.ok_or_else(|| Error::Plan("no frame was drawn".to_owned()))?;
        slot.refused = None;
        if !overflow.is_empty() {
            drawn.outcome = Outcome::Overflowed(overflow);
        }
        Ok(drawn)
    }

    /// Gives back what the programs hold on the device; the next frame of each strategy is built anew.
    pub fn forget(&mut self) {
        self.slots.clear();
    }

    /// Runs the last frame of a strategy again on some clocks, for its times.
    pub fn repeat(&self, strategy: &Strategy, clocks: ClockSet) -> Result<RunTimes> {
        self.slot(strategy)?.program.run(&self.gpu, clocks)
    }

    /// The layers of the last frame of a strategy.
    pub fn layers(&self, strategy: &Strategy) -> Result<Layers> {
        let slot = self.slot(strategy)?;
        slot.program.layers(&self.gpu, slot.size_px)
    }

    /// The picture of the last frame of a strategy: RGBA8, rows from the top.
    pub fn picture(&self, strategy: &Strategy) -> Result<Vec<u8>> {
        self.slot(strategy)?.program.picture(&self.gpu)
    }

    /// The plan of the last frame of a strategy.
    pub fn plan(&self, strategy: &Strategy) -> Result<&Plan> {
        Ok(self.slot(strategy)?.program.plan())
    }

    /// Shades layers that come from elsewhere, by the same pass as a strategy's.
    pub fn shade(&mut self, model: &Model, view: &View, layers: &Layers) -> Result<Vec<u8>> {
        let mut recorder = Recorder::new(model, view).map_err(Error::Plan)?;
        recorder.interference = self.options.interference;
        recorder.given_layers(&crate::gpu::words_from_layers(layers));
        recorder.shade();
        let mut program = Program::default();
        program.load(&self.gpu, recorder.plan)?;
        program.run(&self.gpu, ClockSet::ALL)?;
        program.picture(&self.gpu)
    }

    fn slot_name(&self, strategy: &Strategy) -> String {
        let Some(wide) = self.options.wide_atomics else {
            return format!("{strategy} by {}", self.options.rasteriser);
        };
        let by = self.options.rasteriser;
        format!("{strategy} by {by}, wide atomics: {wide}")
    }

    fn slot(&self, strategy: &Strategy) -> Result<&Slot> {
        let none = |why: &str| Error::Plan(format!("{strategy} has no frame to look at: {why}"));
        let slot = self
            .slots
            .get(&self.slot_name(strategy))
            .ok_or_else(|| none("it was never asked for one"))?;
        match &slot.refused {
            Some(reason) => Err(none(reason)),
            None => Ok(slot),
        }
    }

    /// The words of a buffer of the last frame of a strategy, by name: for tests.
    pub fn words(&self, strategy: &Strategy, buffer: &str) -> Result<Vec<u32>> {
        self.slot(strategy)?.program.words(&self.gpu, buffer)
    }
}
