//! Frames with nothing cut, by either rasteriser: what the price of a cut is counted against.

use super::{Drawing, Drawn, Session};
use crate::gpu::{ClockSet, RunTimes};
use crate::passes::Model;
use crate::scene::View;
use crate::strategies::{self, Rasteriser};
use crate::{Error, Result};

impl Session {
    /// Draws a frame with nothing cut by a rasteriser, as [`Session::draw`] draws a strategy's: in bands, where it is too large in one
    /// piece.
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

    /// Runs the last frame with nothing cut by a rasteriser again on some clocks, for its times.
    pub fn repeat_uncut(&self, rasteriser: Rasteriser, clocks: ClockSet) -> Result<RunTimes> {
        let slot = self.slots.get(&Drawing::Uncut(rasteriser));
        let slot = slot.ok_or_else(|| {
            Error::Plan(format!(
                "the {rasteriser} rasteriser has drawn no frame with nothing cut"
            ))
        })?;
        slot.repeat(&self.gpu, clocks)
    }
}
