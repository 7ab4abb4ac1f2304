//! Decides when the slots' frames are drawn, and at which resolution.

use std::time::Duration;

use cutaway::Result;
use cutaway_lab::experiment::{Renderer, Stopwatch};
use eframe::egui::Context;

use super::Viewer;
use crate::picture::pace::{Detail, REST};
use crate::picture::slot::{SlotLayout, SlotSide};

/// Default number of samples along each side of a pixel, for documents that specify none. Exported pictures use the same default.
const USUAL_SAMPLES: u32 = 2;

/// Maximum number of samples along each side: each sample needs a texture layer until all are complete.
const MOST_SAMPLES: u32 = 3;

/// State of the last frame drawn.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct LastFrame {
    revision: u64,
    is_preclassified: bool,
    size_px: [u32; 2],
    pub(super) renderers: [Option<Renderer>; 2],
    detail: Detail,
}

impl Viewer {
    /// Returns true until the present state is drawn at full resolution.
    pub(super) fn is_drawing(&self) -> bool {
        let Some(last) = self.last else {
            return self.state.shown().is_some();
        };
        let is_of_now = (last.revision, last.is_preclassified) == (self.state.revision(), true);
        let is_whole = is_of_now && last.detail.divisor() == 1;
        let is_under_way = self.screen.is_busy() && last.detail.sample().is_none();
        self.state.shown().is_some() && (!is_whole || is_under_way)
    }

    /// Returns true until all samples of the full-resolution picture are drawn.
    pub(super) fn is_refining(&self) -> bool {
        let last = self.last.filter(|_| self.state.shown().is_some());
        let per_side = self.samples_per_side();
        let is_open =
            |last: LastFrame| Detail::next(Some(last.detail), 1, false, per_side).is_some();
        last.is_some_and(is_open) || self.screen.is_busy()
    }

    /// Number of samples along each side of a pixel at rest: the document's number, up to the maximum, or 1 if edges are not smoothed.
    fn samples_per_side(&self) -> u32 {
        let asked = (self.state.shown()).and_then(|s| s.timeline.settings().supersample);
        let drawn = self.last.map_or([None; 2], |last| last.renderers);
        let is_refused = |side: SlotSide| self.screen.refusal(side).is_some();
        let seen = || drawn.iter().flatten();
        // Comparisons use one sample per pixel, as the reference does. A difference compares single samples, not means.
        let is_compared = self.state.layout() == SlotLayout::Difference
            || seen().any(|renderer| renderer.method().is_none());
        let is_idle = seen().next().is_none() || SlotSide::BOTH.into_iter().all(is_refused);
        match self.is_smooth && !is_compared && !is_idle {
            true => asked.unwrap_or(USUAL_SAMPLES).min(MOST_SAMPLES),
            false => 1,
        }
    }

    /// Draws the slots that have changed, at the finest resolution that the time budget allows.
    pub(super) fn draw(&mut self, ctx: &Context) {
        if let Err(error) = self.try_draw(ctx) {
            self.toasts.add(ctx, error.into());
        }
    }

    fn try_draw(&mut self, ctx: &Context) -> Result<()> {
        let (done, must_redraw) = self.screen.classify()?;
        if let Some((divisor, took_ms)) = done {
            self.pace.learn(divisor, took_ms);
        }
        if must_redraw {
            self.last = None;
        }
        let revision = self.state.revision();
        let now = ctx.input(|input| input.time);
        if self.changed.0 != revision {
            self.changed = (revision, now);
        }
        let rested = now - self.changed.1;
        let is_moving = self.last.is_some() && rested < REST.as_secs_f64();
        if !is_moving && self.preclassified != Some(revision) {
            let watch = Stopwatch::start();
            self.state.classify();
            self.cost.scene_ms += watch.ms();
            self.preclassified = Some(revision);
        }
        let Some(shown) = self.state.shown() else {
            return Ok(());
        };
        let is_preclassified = self.preclassified == Some(revision);
        let divisor = self.pace.divisor(is_moving);
        let view = shown.view(self.size_px);
        let mut renderers = [None; 2];
        for side in self.state.layout().sides() {
            let painter = self.state.painter(*side);
            let preclassified = painter.classify(self.screen.gpu(), &shown.at.model, &view);
            renderers[side.index()] = Some(preclassified);
        }
        let about = (self.size_px, renderers, is_preclassified);
        self.judged.ask(ctx, &self.state, &self.screen, about);
        let next = LastFrame {
            revision,
            is_preclassified,
            size_px: self.size_px,
            renderers,
            detail: Detail::WHOLE,
        };
        let is_same = |last: &LastFrame| {
            LastFrame {
                detail: Detail::WHOLE,
                ..*last
            } == next
        };
        let same = self.last.filter(is_same).map(|last| last.detail);
        let detail = Detail::next(same, divisor, is_moving, self.samples_per_side());
        if let Some(detail) = detail.filter(|_| !self.screen.is_busy()) {
            let wants_difference = self.state.layout() == SlotLayout::Difference;
            let watch = Stopwatch::start();
            let drawn = self
                .screen
                .draw(shown, renderers, self.size_px, detail, wants_difference);
            self.cost.picture_ms = Some(watch.ms());
            self.last = Some(LastFrame { detail, ..next });
            drawn?;
        }
        if self.screen.is_busy() || detail.is_some() {
            ctx.request_repaint_after(Duration::from_millis(5));
        } else if !is_preclassified {
            ctx.request_repaint_after(REST);
        }
        Ok(())
    }
}
