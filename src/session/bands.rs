//! The frame of one strategy: one program, or several that draw a band of rows each.
//!
//! A list of crossings per pixel outgrows a storage binding before a picture outgrows the memory. Where a plan breaks a limit,
//! the picture is cut into twice as many bands until it fits, down to [`Capacities::FEWEST_ROWS`] rows. Every band is a view with the same
//! rays, so all pixels are the same as in one piece, except those that depend on the rounding of a rasteriser. Each band has
//! structures of its own: sprites and posed vertices are made once for each, and the mesh is read once for each.

use super::encode::Last;
use super::rows::Rows;
use super::{Drawn, MOST_TRIES, Outcome};
use crate::effects;
use crate::gpu::{Clip, ClockSet, Compositor, Gpu, Program, Report, RunTimes};
use crate::layers::Layers;
use crate::passes::Model;
use crate::plan::{Capacities, Due, Recorded};
use crate::scene::View;
use crate::strategies::{Refusal, Unsupported};
use crate::{Error, Result};

/// Some rows of the frame.
pub(super) struct Band {
    pub(super) program: Program,
    pub(super) rows: Rows,
    /// Compositor into the attachments of a host, with the generation of the program that it was made for.
    pub(super) compositor: Option<(u64, Compositor)>,
}

impl Band {
    /// Width and height of what it draws, in a picture of a width.
    pub(super) fn drawn_px(&self, width: u32) -> [u32; 2] {
        [width, self.rows.drawn().1]
    }
}

/// State that a strategy keeps from frame to frame.
#[derive(Default)]
pub(super) struct Slot {
    /// From the top.
    pub(super) bands: Vec<Band>,
    pub(super) size_px: [u32; 2],
    /// Rows around a band that its effects look at.
    halo_rows: u32,
    pub(super) capacities: Option<Capacities>,
    /// The model that the capacities were learnt from.
    model: Option<Model>,
    /// Why the last call left no frame to read, if it did.
    pub(super) refused: Option<String>,
    /// Frame last encoded for a host, if it is still valid.
    pub(super) last: Option<Last>,
    /// The clocks of the passes of the frame that was last encoded.
    pub(super) clocks: ClockSet,
    /// A bounded buffer has grown since.
    pub(super) must_redraw: bool,
    /// Bindings of an encoded frame for the shaders of a host. The flag is true if that frame is the last one.
    pub(super) clip: Option<Clip>,
    pub(super) is_clip_of_last: bool,
    pub(super) reports: Vec<Report>,
}

/// Why bands are not drawn.
enum Stop {
    /// The strategy refuses.
    Refused(Refusal),
    /// The plan breaks a limit of the device.
    TooLarge(String),
}

impl Slot {
    /// Draws a frame that `record` plans.
    pub(super) fn draw(
        &mut self,
        gpu: &Gpu,
        is_timed: bool,
        model: &Model,
        view: &View,
        record: impl Fn(&View, &Capacities) -> Result<Recorded, Refusal>,
    ) -> Result<Drawn> {
        self.begin(model, view);
        let mut too_large = None;
        loop {
            let reason = match self.draw_bands(gpu, is_timed, view, &record)? {
                Ok(drawn) => {
                    self.refused = None;
                    return Ok(drawn);
                }
                Err(Stop::Refused(refusal)) => return Ok(self.refuse(refusal)),
                Err(Stop::TooLarge(reason)) => too_large.get_or_insert(reason).clone(),
            };
            if !self.cut_smaller() {
                return Ok(self.refuse(Refusal::new(Unsupported::Limit, reason)));
            }
        }
    }

    /// Makes ready for a frame: what another solid or another size has taught is forgotten.
    pub(super) fn begin(&mut self, model: &Model, view: &View) {
        let kin = self.model.as_ref().is_some_and(|m| m.is_kin_of(model));
        if self.size_px != view.size_px || !kin {
            // What one solid needed at one size says nothing of another.
            self.capacities = None;
        }
        let halo_rows = effects::halo_rows(model, view);
        if self.size_px != view.size_px || self.bands.is_empty() {
            (self.size_px, self.halo_rows) = (view.size_px, halo_rows);
            match &mut self.bands[..] {
                // Resources that depend on no view are kept.
                [band] => band.rows = Rows::whole(view.size_px[1]),
                _ => self.cut_into(1),
            }
        } else if self.halo_rows != halo_rows {
            self.halo_rows = halo_rows;
            // One band has nothing around it.
            if self.bands.len() > 1 {
                self.cut_into(self.bands.len() as u32);
            }
        }
        self.model = Some(model.clone());
        self.refused = Some("it has drawn no frame".to_owned());
        self.last = None;
        self.is_clip_of_last = false;
    }

    /// The layers of the last frame.
    pub(super) fn layers(&self, gpu: &Gpu) -> Result<Layers> {
        let width = self.size_px[0];
        if let [band] = self.bands.as_slice() {
            return band.program.layers(gpu, self.size_px);
        }
        let mut pixels = Vec::new();
        for band in &self.bands {
            let layers = band.program.layers(gpu, band.drawn_px(width))?;
            pixels.extend(band.rows.own(&layers.pixels, width as usize));
        }
        Ok(Layers {
            size_px: self.size_px,
            pixels,
        })
    }

    /// Cuts the picture into twice as many bands, if they may be smaller.
    pub(super) fn cut_smaller(&mut self) -> bool {
        if self
            .bands
            .iter()
            .any(|b| b.rows.count <= Capacities::FEWEST_ROWS)
        {
            // The next frame begins in one piece: this one says nothing of how many pieces would do.
            self.cut_into(1);
            return false;
        }
        if let Some(capacities) = &mut self.capacities {
            // What all rows needed together would make every band too large.
            capacities.fragments = None;
            capacities.triangles = None;
            capacities.sheets = None;
        }
        self.cut_into(2 * self.bands.len() as u32);
        true
    }

    /// Runs the last frame again on some clocks, for its times.
    pub(super) fn repeat(&self, gpu: &Gpu, clocks: ClockSet) -> Result<RunTimes> {
        let mut times = RunTimes::default();
        for band in &self.bands {
            times.add(band.program.run(gpu, clocks)?);
        }
        Ok(times)
    }

    fn cut_into(&mut self, count: u32) {
        let bands = Rows::bands(self.size_px[1], count, self.halo_rows).map(|rows| Band {
            program: Program::default(),
            rows,
            compositor: None,
        });
        self.bands = bands.collect();
    }

    fn refuse(&mut self, refusal: Refusal) -> Drawn {
        self.refused = Some(refusal.reason.clone());
        Drawn {
            outcome: Outcome::Refused(refusal),
            clocks: ClockSet::NONE,
            times: RunTimes::default(),
        }
    }

    /// All bands: the worst outcome, and the times of all together.
    fn draw_bands(
        &mut self,
        gpu: &Gpu,
        is_timed: bool,
        view: &View,
        record: &impl Fn(&View, &Capacities) -> Result<Recorded, Refusal>,
    ) -> Result<Result<Drawn, Stop>> {
        let capacities = self.capacities.get_or_insert(Capacities::UNKNOWN);
        let mut all = Drawn {
            outcome: Outcome::Complete,
            clocks: ClockSet::NONE,
            times: RunTimes::default(),
        };
        for band in &mut self.bands {
            let view = band.rows.view(view);
            match band.draw(gpu, is_timed, capacities, |capacities| {
                record(&view, capacities)
            })? {
                Ok(drawn) => {
                    if all.outcome == Outcome::Complete {
                        all.outcome = drawn.outcome;
                    }
                    all.clocks = all.clocks.union(drawn.clocks);
                    all.times.add(drawn.times);
                }
                Err(stop) => return Ok(Err(stop)),
            }
        }
        Ok(Ok(all))
    }
}

impl Band {
    /// Draws until the bounded buffers are large enough.
    fn draw(
        &mut self,
        gpu: &Gpu,
        is_timed: bool,
        capacities: &mut Capacities,
        record: impl Fn(&Capacities) -> Result<Recorded, Refusal>,
    ) -> Result<Result<Drawn, Stop>> {
        let mut owed = Due::default();
        let mut tries = 1;
        loop {
            let recorded = match record(capacities) {
                Ok(recorded) => recorded,
                Err(refusal) => return Ok(Err(Stop::Refused(refusal))),
            };
            capacities.pyramids |= recorded.plan.has_pyramids;
            // The last try does all that the frame takes, so that its times are those of the frame.
            match self.program.load(gpu, recorded) {
                Ok(due) => owed.add(due),
                Err(Error::Limit(reason)) => return Ok(Err(Stop::TooLarge(reason))),
                Err(e) => return Err(e),
            }
            self.program.clear_needs_of_frame(gpu)?;
            let times = self.program.run_due(gpu, &owed, is_timed)?;
            let needs = self.program.needs(gpu)?;
            let (mut grown, mut overflow) = (false, None);
            for (bounded, need) in self.program.plan().bounded.iter().zip(needs) {
                grown |= capacities.learn(bounded, need);
                if need > bounded.capacity {
                    overflow = Some(bounded.shortage(need));
                }
            }
            if !grown || tries == MOST_TRIES {
                return Ok(Ok(Drawn {
                    outcome: overflow.map_or(Outcome::Complete, Outcome::Overflowed),
                    clocks: owed.clocks.into_iter().collect(),
                    times,
                }));
            }
            tries += 1;
        }
    }
}
