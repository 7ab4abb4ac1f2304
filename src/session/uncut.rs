//! Draws uncut frames by either rasteriser: the baseline for the cost of a cut.

use super::{Drawing, Drawn, Session};
use crate::gpu::{ClockSet, RunTimes};
use crate::passes::Model;
use crate::scene::View;
use crate::strategies::{self, Rasteriser};
use crate::{Error, Result};

impl Session {
    /// Draws an uncut frame by a rasteriser; like [`Session::draw`], in bands if the frame exceeds the device's limits.
    pub fn draw_uncut(
        &mut self,
        model: &Model,
        view: &View,
        rasteriser: Rasteriser,
    ) -> Result<Drawn> {
        let model = model.without_cuts();
        let by = (rasteriser, self.gpu.limits().wide_atomics);
        let slot = self.slots.entry(Drawing::Uncut(rasteriser)).or_default();
        slot.draw(
            &self.gpu,
            self.is_timed,
            &model,
            view,
            |view, capacities| strategies::record_uncut_by(&model, view, by, capacities),
        )
    }

    /// Runs the passes of a rasteriser's last uncut frame on the given clocks again, to time them.
    pub fn repeat_uncut(&self, rasteriser: Rasteriser, clocks: ClockSet) -> Result<RunTimes> {
        let slot = self.slots.get(&Drawing::Uncut(rasteriser));
        let slot = slot.ok_or_else(|| {
            Error::Plan(format!(
                "the {rasteriser} rasteriser has drawn no uncut frame"
            ))
        })?;
        slot.repeat(&self.gpu, clocks)
    }
}
