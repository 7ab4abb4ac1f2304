//! Frames for a host: encodes passes into the host's encoder and the picture into its attachments, without blocking.
//!
//! A frame of a static scene in a static view draws one triangle, because its passes have already run. The needed capacities of bounded
//! buffers are copied after the passes and mapped once the host has submitted them. [`Slot::classify`] reads the reports that have arrived,
//! and the next frame gets these capacities. Uploads go through the queue, before the next submission.
//!
//! Cannot: encode two frames of one method into the same submission, or composite a frame twice with different targets, because both would
//! be drawn with the uploads of the second; detect that an encoder was never submitted, in which case the host must call
//! [`Session::forget`](super::Session::forget).

use super::bands::{Band, Slot};
use crate::gpu::{
    BindGroup, ClipTable, ClockSet, CommandEncoder, Compositor, Destination, Gpu, Pick,
};
use crate::passes::{ActiveCuts, Model};
use crate::plan::{Capacities, Recorded};
use crate::scene::View;
use crate::strategies::{Refusal, Unsupported};
use crate::{Error, Result};

/// Maximum number of pending reports; the oldest are dropped if a host never submits.
const MOST_REPORTS: usize = 16;

/// Result of encoding a frame for a host.
#[must_use = "a method may have refused the scene"]
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Encoded {
    /// The frame will be in the attachments once the host has submitted the encoder.
    Drawn {
        /// Number of encoded passes without the compositing pass; 0 if nothing changed.
        passes: usize,
    },
    /// The method cannot draw this scene, and nothing was encoded.
    Refused(Refusal),
}

/// A bounded buffer that was too small for a frame; the affected pixels are marked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Overflow {
    /// Name of the buffer that overflowed, and the capacity that it needed.
    pub what: String,
    /// True if the buffer is large enough for the next frame.
    pub is_mended: bool,
}

/// Frame last encoded.
pub(super) struct Last {
    model: Model,
    view: View,
}

impl Slot {
    /// Encodes the frame that `record` plans, with its picture in the attachments if some are given.
    pub(super) fn encode(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        (model, view): (&Model, &View),
        target: Option<&Destination<'_>>,
        record: impl Fn(&View, &Capacities) -> Result<Recorded, Refusal>,
    ) -> Result<Encoded> {
        let is_last = |l: &Last| l.model.is(model) && l.view == *view;
        let is_still = !self.must_redraw && self.last.as_ref().is_some_and(is_last);
        let mut passes = 0;
        if !is_still {
            self.must_redraw = false;
            self.begin(model, view);
            match self.load_bands(gpu, view, &record)? {
                Ok(clocks) => self.clocks = clocks,
                Err(refusal) => {
                    self.refused = Some(refusal.reason.clone());
                    return Ok(Encoded::Refused(refusal));
                }
            }
            for band in &mut self.bands {
                band.program.clear_needs_of_frame(gpu)?;
                let encoded = band.program.encode_due(gpu, encoder)?;
                passes += encoded.passes;
                self.reports.extend(encoded.report);
            }
            let old = self.reports.len().saturating_sub(MOST_REPORTS);
            self.reports.drain(..old);
            self.refused = None;
            self.last = Some(Last {
                model: model.clone(),
                view: *view,
            });
        }
        if let Some(target) = target {
            let (width, scale) = (view.size_px[0], model.prepared.scale);
            for band in &mut self.bands {
                band.composite(gpu, encoder, target, width, scale)?;
            }
        }
        Ok(Encoded::Drawn { passes })
    }

    /// Requests a pixel of the frame that was last encoded.
    pub(super) fn pick(
        &self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        [x, y]: [u32; 2],
    ) -> Result<Pick> {
        let width = self.size_px[0];
        let owns = |band: &&Band| (band.rows.first..band.rows.first + band.rows.count).contains(&y);
        let band = self.bands.iter().find(owns).filter(|_| x < width);
        let Some(band) = band else {
            let [width, height] = self.size_px;
            return Err(Error::input(
                format!("pixel ({x}, {y})"),
                format!("the frame has {width} x {height}"),
                "give the pixel relative to its upper left corner, from 0",
            ));
        };
        let row = u64::from(y - band.rows.drawn().0);
        let pixel = row * u64::from(width) + u64::from(x);
        band.program.pick(gpu, encoder, pixel)
    }

    /// Bindings of the frame last encoded, for the clip test in a host's shaders.
    pub(super) fn clip_group(&mut self, gpu: &Gpu) -> Result<BindGroup> {
        if let Some(clip) = self.clip.as_ref().filter(|_| self.is_clip_of_last) {
            return Ok(clip.group().clone());
        }
        let none =
            || Error::Plan("no frame has been encoded, so there are no cuts to clip by".to_owned());
        let last = self.last.as_ref().ok_or_else(none)?;
        let [band] = self.bands.as_slice() else {
            return Err(Error::Limit(format!(
                "the frame is drawn in {} bands, each with its own list: use the clip test with a smaller picture",
                self.bands.len()
            )));
        };
        let prepared = &last.model.prepared;
        let active_cuts =
            ActiveCuts::new(prepared, &last.view).map_err(|refusal| Error::Plan(refusal.reason))?;
        let lists = band.program.plan().resource_named("crossing_heads");
        if lists.is_none() && active_cuts.lanes > 0 {
            return Err(Error::input(
                "the method for the clip test",
                "it keeps no list of crossings",
                "use a method that does, for example raycast+mask@list",
            ));
        }
        let table = ClipTable {
            scene_from_world: prepared.scale as f32,
            parts: active_cuts.clips_of_parts(prepared),
        };
        let clip = band.program.clip(gpu, table, self.clip.take())?;
        let group = clip.group().clone();
        (self.clip, self.is_clip_of_last) = (Some(clip), true);
        Ok(group)
    }

    /// Loads the plans of all bands, with as many bands as needed to fit the limits; returns the clocks of the passes to run.
    fn load_bands(
        &mut self,
        gpu: &Gpu,
        view: &View,
        record: &impl Fn(&View, &Capacities) -> Result<Recorded, Refusal>,
    ) -> Result<Result<ClockSet, Refusal>> {
        let mut too_large: Option<String> = None;
        'cut: loop {
            let mut clocks = ClockSet::NONE;
            let capacities = self.capacities.get_or_insert(Capacities::UNKNOWN);
            for band in &mut self.bands {
                let recorded = match record(&band.rows.view(view), capacities) {
                    Ok(recorded) => recorded,
                    Err(refusal) => return Ok(Err(refusal)),
                };
                capacities.pyramids |= recorded.plan.has_pyramids;
                match band.program.load(gpu, recorded) {
                    Ok(due) => {
                        let names = due.passes.clone();
                        let passes = &band.program.plan().passes;
                        let run = passes.iter().filter(|pass| names.contains(&pass.name));
                        clocks = clocks.union(run.map(|pass| pass.clock).collect());
                    }
                    Err(Error::Limit(reason)) => {
                        let first = too_large.get_or_insert(reason).clone();
                        match self.cut_smaller() {
                            true => continue 'cut,
                            false => return Ok(Err(Refusal::new(Unsupported::Limit, first))),
                        }
                    }
                    Err(e) => return Err(e),
                }
            }
            return Ok(Ok(clocks));
        }
    }

    /// Reads the overflow reports that have arrived.
    pub(super) fn classify(&mut self) -> Vec<Overflow> {
        let mut overflows = Vec::new();
        let capacities = self.capacities.get_or_insert(Capacities::UNKNOWN);
        let mut has_grown = false;
        self.reports.retain(|report| {
            for (bounded, need) in report.needs() {
                let is_mended = capacities.learn(bounded, need);
                has_grown |= is_mended;
                if need > bounded.capacity {
                    overflows.push(Overflow {
                        what: bounded.shortage(need),
                        is_mended,
                    });
                }
            }
            report.is_under_way()
        });
        self.must_redraw |= has_grown;
        overflows
    }
}

impl Band {
    /// Composites the rows of the band into a host's attachments.
    fn composite(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        target: &Destination<'_>,
        width: u32,
        scale: f64,
    ) -> Result<()> {
        let generation = self.program.generation();
        let fits = |made: &(u64, Compositor)| made.0 == generation && made.1.fits(target);
        let mut made = match self.compositor.take().filter(fits) {
            Some(made) => made,
            None => (generation, self.program.compositor(gpu, target)?),
        };
        let rows = (self.rows.drawn(), (self.rows.first, self.rows.count));
        (made.1).encode(gpu, encoder, target, rows, width, scale);
        self.compositor = Some(made);
        Ok(())
    }
}
