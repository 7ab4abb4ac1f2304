//! The frame of one strategy: drawn by one program, or by several, one per band of rows.
//!
//! A per-pixel list of crossings exceeds the storage binding limit before a picture exceeds the memory. If a plan exceeds a limit, the
//! picture is split into twice as many bands until it fits, down to [`Capacities::FEWEST_ROWS`] rows. Every band is a view with the same
//! rays, so all pixels match those of an unsplit picture, except where the rounding of a rasteriser matters. Each band has its own
//! structures: sprites and posed vertices are computed, and the mesh is read, once per band.

use super::encode::Last;
use super::rows::Rows;
use super::{Drawn, MOST_TRIES, Outcome};
use crate::effects;
use crate::gpu::{ClipBindGroup, ClockSet, Compositor, Gpu, Program, Report, RunTimes};
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
    /// Compositor for a host's attachments, with the generation of the program for which it was made.
    pub(super) compositor: Option<(u64, Compositor)>,
}

impl Band {
    /// Width and height of the area that the band draws, in a picture of the given width.
    pub(super) fn drawn_px(&self, width: u32) -> [u32; 2] {
        [width, self.rows.drawn().1]
    }
}

/// State that a strategy keeps from frame to frame.
#[derive(Default)]
pub(super) struct Slot {
    /// Bands, from the top.
    pub(super) bands: Vec<Band>,
    pub(super) size_px: [u32; 2],
    /// Number of rows on each side of a band that its effects read.
    halo_rows: u32,
    pub(super) capacities: Option<Capacities>,
    /// The model from whose frames the capacities were learned.
    model: Option<Model>,
    /// The reason why the last call left no frame to read, if so.
    pub(super) refused: Option<String>,
    /// The frame last encoded for a host, if still valid.
    pub(super) last: Option<Last>,
    /// The clocks of the passes of the frame that was last encoded.
    pub(super) clocks: ClockSet,
    /// True if a bounded buffer has grown since that frame.
    pub(super) must_redraw: bool,
    /// Bindings of an encoded frame for a host's shaders. The flag is true if that frame is the last one.
    pub(super) clip: Option<ClipBindGroup>,
    pub(super) is_clip_of_last: bool,
    pub(super) reports: Vec<Report>,
}

/// Reason why the bands are not drawn.
enum Stop {
    /// The strategy refuses the scene.
    Refused(Refusal),
    /// The plan exceeds a limit of the device.
    TooLarge(String),
}

impl Slot {
    /// Draws the frame that `record` plans.
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

    /// Prepares for a frame: discards capacities learned from another solid or picture size.
    pub(super) fn begin(&mut self, model: &Model, view: &View) {
        let kin = self.model.as_ref().is_some_and(|m| m.is_kin_of(model));
        if self.size_px != view.size_px || !kin {
            // Capacities learned from one solid at one size do not apply to others.
            self.capacities = None;
        }
        let halo_rows = effects::halo_rows(model, view);
        if self.size_px != view.size_px || self.bands.is_empty() {
            (self.size_px, self.halo_rows) = (view.size_px, halo_rows);
            match &mut self.bands[..] {
                // The program is kept, with the resources that do not depend on the view.
                [band] => band.rows = Rows::whole(view.size_px[1]),
                _ => self.cut_into(1),
            }
        } else if self.halo_rows != halo_rows {
            self.halo_rows = halo_rows;
            // A single band has no rows around it.
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

    /// Splits the picture into twice as many bands, if the minimum height permits.
    pub(super) fn cut_smaller(&mut self) -> bool {
        if self
            .bands
            .iter()
            .any(|b| b.rows.count <= Capacities::FEWEST_ROWS)
        {
            // The next frame starts unsplit, because this one does not reveal how many bands would suffice.
            self.cut_into(1);
            return false;
        }
        if let Some(capacities) = &mut self.capacities {
            // Buffers with the capacities of the whole picture would be too large for a band.
            capacities.fragments = None;
            capacities.triangles = None;
            capacities.sheets = None;
        }
        self.cut_into(2 * self.bands.len() as u32);
        true
    }

    /// Runs the passes of the last frame on the given clocks again, to time them.
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

    /// Draws all bands; returns the worst outcome and the summed times.
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
                    all.add(drawn);
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
            // The last attempt runs every pass of the frame, so that its times are complete.
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
