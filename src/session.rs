//! A device with the programs of several methods: draws scenes and redraws only what changed.
//!
//! Each method keeps its own program, so that several can be measured in turn without rebuilding; they share large
//! uploads. If bounded buffers were too small for a frame, it is drawn again with the sizes that it reported, up to
//! [`MOST_TRIES`] times; if a buffer still overflows then, the outcome of the frame is an overflow.
//!
//! A picture that exceeds the device's limits is drawn in bands of rows, each by a separate program. This affects
//! only the times. Callers that want less memory draw a picture in [strips](Session::strips), one after another by one program.

use std::collections::BTreeMap;

use crate::gpu::{ClockSet, Gpu, RunTimes};
use crate::layers::Layers;
use crate::passes::{GroundShadow, Model};
use crate::plan::{Capacities, Clock, Plan};
use crate::scene::{Precision, Style, View};
use crate::strategies::{self, Method, Rasteriser, Refusal, Strategy, Unsupported};
use crate::{Error, Result};

mod awaited;
mod bands;
mod encode;
mod finish;
mod host;
mod rows;
mod strips;
mod uncut;

use bands::{Band, Slot};
pub use encode::{Encoded, Overflow};
pub use finish::StyleChannels;
use rows::Rows;
pub use strips::Strip;

/// Maximum number of times that a frame is drawn to make its buffers large enough.
pub const MOST_TRIES: usize = 4;

/// Result of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The whole frame was drawn.
    Complete,
    /// A bounded buffer was too small; the affected pixels are marked.
    Overflowed(String),
    /// The strategy does not support the scene.
    Refused(Refusal),
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

    /// The reason why the frame is not complete; none if it is.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Complete => None,
            Self::Overflowed(reason) => Some(reason),
            Self::Refused(refusal) => Some(&refusal.reason),
        }
    }
}

/// Outcome and cost of a requested frame.
#[must_use = "a strategy may have refused the scene"]
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Outcome of the frame.
    pub outcome: Outcome,
    /// The clocks on which something changed.
    pub clocks: ClockSet,
    /// The passes that ran in the last try; their sum is the whole cost of the frame. With times if the session [measures
    /// them](Session::timed).
    pub times: RunTimes,
}

impl Drawn {
    /// Names of the passes that ran on a clock.
    pub fn ran_on(&self, clock: Clock) -> Vec<&str> {
        let ran = self.times.passes.iter().filter(|p| p.clock == clock);
        ran.map(|p| p.name.as_str()).collect()
    }
}

/// Kind of frames that a slot draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Drawing {
    /// Uncut frames, drawn by a rasteriser.
    Uncut(Rasteriser),
    /// Frames drawn by a method.
    By(Method),
}

/// A device and the programs on it.
pub struct Session {
    gpu: Gpu,
    is_timed: bool,
    strip_bytes: u64,
    slots: BTreeMap<Drawing, Slot>,
}

impl Session {
    /// Makes a session on a device. Measures the device's sub-pixel bits, as [`Gpu::report`] does, so that no frame waits for them.
    pub fn new(gpu: Gpu) -> Self {
        gpu.report();
        Self {
            gpu,
            is_timed: false,
            strip_bytes: strips::STRIP_BYTES,
            slots: BTreeMap::new(),
        }
    }

    /// Makes the session measure the time of every pass. Without reliable device timestamps it must wait for each pass.
    #[must_use]
    pub fn timed(self) -> Self {
        Self {
            is_timed: true,
            ..self
        }
    }

    /// Sets the bytes of a frame's buffers above which [`Session::strips`] divides a picture; 160 MiB by default.
    #[must_use]
    pub fn with_strip_bytes(self, strip_bytes: u64) -> Self {
        Self {
            strip_bytes,
            ..self
        }
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Draws a frame. Passes whose inputs did not change since the last frame by the same method do not run.
    pub fn draw(&mut self, model: &Model, view: &View, method: impl Into<Method>) -> Result<Drawn> {
        let method = method.into();
        let asked = self.asked(method);
        let slot = self.slots.entry(Drawing::By(method)).or_default();
        let record = |view: &View, capacities: &Capacities| {
            strategies::record(model, view, asked, capacities)
        };
        let mut drawn = slot.draw(&self.gpu, self.is_timed, model, view, record)?;
        if let Outcome::Refused(refusal) = &mut drawn.outcome {
            self.name_what_works(refusal, model, view);
        }
        Ok(drawn)
    }

    /// The ground shadow of a scene that a method cuts, for [`Model::on_ground`]. It is computed from small frames that the method draws
    /// from below and above, and that are read back. It depends on every cut and motion, but not on the camera.
    ///
    /// # Errors
    ///
    /// Those of [`Session::draw`], and an error if the method refuses the scene.
    pub fn ground_shadow(
        &self,
        model: &Model,
        method: impl Into<Method>,
    ) -> Result<Result<GroundShadow, Refusal>> {
        let asked = self.asked(method.into());
        let views = GroundShadow::views(&model.prepared);
        let plain = model.in_style(Style::default());
        let mut slot = Slot::default();
        let mut seen = Vec::with_capacity(views.len());
        for view in &views {
            let drawn = slot.draw(&self.gpu, false, &plain, view, |view, capacities| {
                strategies::record(&plain, view, asked, capacities)
            })?;
            match drawn.outcome {
                Outcome::Complete => seen.push(slot.layers(&self.gpu)?),
                Outcome::Refused(refusal) => return Ok(Err(refusal)),
                Outcome::Overflowed(reason) => {
                    return Ok(Err(Refusal::new(Unsupported::Limit, reason)));
                }
            }
        }
        let [below, above] = &seen[..] else {
            return Err(Error::Plan("a view of the ground is missing".into()));
        };
        Ok(Ok(GroundShadow::of(
            &model.prepared,
            &views,
            [below, above],
        )))
    }

    /// Adds to a refusal that the device causes the strategies that it could draw instead.
    fn name_what_works(&self, refusal: &mut Refusal, model: &Model, view: &View) {
        if refusal.unsupported != Unsupported::Limit {
            return;
        }
        let works = |strategy: &Strategy| {
            let plan = strategies::plan(model, view, strategy, &Capacities::UNKNOWN);
            plan.is_ok_and(|plan| plan.check(self.gpu.limits()).is_ok())
        };
        let working: Vec<String> = (Strategy::all().iter().filter(|s| works(s)))
            .map(Strategy::to_string)
            .collect();
        if !working.is_empty() {
            let working = working.join(", ");
            refusal.reason = format!("{}; {working} would work", refusal.reason);
        }
    }

    /// The method, adapted to the features of the device.
    fn asked(&self, mut method: Method) -> Method {
        let wide_atomics = self.gpu.limits().wide_atomics;
        method.options.wide_atomics.get_or_insert(wide_atomics);
        let measured = self.gpu.report().sub_pixel_bits;
        method.options.sub_pixel_bits = method.options.sub_pixel_bits.or(measured);
        method
    }

    /// Releases the device resources of all programs; the next frame of each strategy is built from scratch.
    pub fn forget(&mut self) {
        self.slots.clear();
    }

    /// Runs again those passes of a method's last frame that are on the given clocks, to time them.
    pub fn repeat(&self, method: impl Into<Method>, clocks: ClockSet) -> Result<RunTimes> {
        self.slot(method)?.repeat(&self.gpu, clocks)
    }

    /// The layers of the last frame by a method.
    pub fn layers(&self, method: impl Into<Method>) -> Result<Layers> {
        self.slot(method)?.layers(&self.gpu)
    }

    /// The picture of the last frame by a method: RGBA8, rows from the top.
    pub fn picture(&self, method: impl Into<Method>) -> Result<Vec<u8>> {
        let slot = self.slot(method)?;
        let mut picture = Vec::new();
        for band in &slot.bands {
            let drawn = band.program.picture(&self.gpu)?;
            picture.extend(band.rows.own(&drawn, slot.size_px[0] as usize * 4));
        }
        Ok(picture)
    }

    /// The plan of a method's last frame, or of its first band if there are several.
    pub fn plan(&self, method: impl Into<Method>) -> Result<&Plan> {
        Ok(self.first_band(method)?.program.plan())
    }

    /// Precision of the triangles in a method's last frame: the adapter's if its rasteriser drew any of them, even only caps.
    pub fn precision(&self, method: impl Into<Method>) -> Result<Precision> {
        let method = method.into();
        Ok(match self.plan(method)?.draws_triangles() {
            true => self.asked(method).options.precision(),
            false => Precision::USUAL,
        })
    }

    /// Number of bands in which a method's last frame was drawn.
    pub fn bands(&self, method: impl Into<Method>) -> Result<usize> {
        Ok(self.slot(method)?.bands.len())
    }

    /// Bytes produced by a method's last frame, by clock, as [`Plan::bytes_on`] counts them, over all bands.
    pub fn bytes(&self, method: impl Into<Method>) -> Result<[u64; 3]> {
        let bands = &self.slot(method)?.bands;
        let on = |clock| bands.iter().map(|b| b.program.plan().bytes_on(clock)).sum();
        Ok(Clock::ALL.map(on))
    }

    /// Bytes of device memory that a method's last frame allocated for one clock; see [`crate::gpu::Program::allocated_on`].
    pub fn allocated_on(
        &self,
        method: impl Into<Method>,
        clock: Clock,
        is_scene: bool,
    ) -> Result<u64> {
        let bands = self.slot(method)?.bands.iter();
        Ok(bands.map(|b| b.program.allocated_on(clock, is_scene)).sum())
    }

    fn slot(&self, method: impl Into<Method>) -> Result<&Slot> {
        let method = method.into();
        let none = |why: &str| Error::Plan(format!("{method} has no drawn frame: {why}"));
        let slot = self
            .slots
            .get(&Drawing::By(method))
            .ok_or_else(|| none("none was requested"))?;
        match &slot.refused {
            Some(reason) => Err(none(reason)),
            None => Ok(slot),
        }
    }

    fn first_band(&self, method: impl Into<Method>) -> Result<&Band> {
        let method = method.into();
        let first = self.slot(method)?.bands.first();
        first.ok_or_else(|| Error::Plan(format!("{method} has no band")))
    }

    /// The words of a named buffer of a method's last frame, for tests. If there are several bands, the words of the first, with the rows
    /// below it that its effects read.
    pub fn words(&self, method: impl Into<Method>, buffer: &str) -> Result<Vec<u32>> {
        self.first_band(method)?.program.words(&self.gpu, buffer)
    }
}
