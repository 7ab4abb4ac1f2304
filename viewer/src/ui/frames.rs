//! Frames of the slots: when they are drawn, and how finely.

use std::time::Duration;

use cutaway::Result;
use cutaway::experiment::Renderer;
use eframe::egui::Context;

use super::Viewer;
use crate::pace::REST;
use crate::slot::Layout;

/// What was last drawn.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Last {
    revision: u64,
    is_settled: bool,
    size_px: [u32; 2],
    pub(super) renderers: [Option<Renderer>; 2],
    divisor: u32,
}

impl Viewer {
    /// Whether a whole picture of what the state is now is still to come.
    pub(super) fn is_drawing(&self) -> bool {
        let last = self.last.map(|l| (l.revision, l.is_settled, l.divisor));
        let whole = Some((self.state.revision(), true, 1));
        let is_drawn = self.state.shown().is_none() || last == whole;
        !is_drawn || self.screen.is_busy()
    }

    /// Draws what has changed, as finely as there is time for.
    pub(super) fn draw(&mut self, ctx: &Context) {
        if let Err(error) = self.try_draw(ctx) {
            self.toasts.add(ctx, error.into());
        }
    }

    fn try_draw(&mut self, ctx: &Context) -> Result<()> {
        let (done, must_redraw) = self.screen.settle()?;
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
        if !is_moving && self.settled != Some(revision) {
            self.state.settle();
            self.settled = Some(revision);
        }
        let Some(shown) = self.state.shown() else {
            return Ok(());
        };
        let is_settled = self.settled == Some(revision);
        let divisor = self.pace.divisor(is_moving);
        let view = shown.view(self.size_px);
        let mut renderers = [None; 2];
        for side in self.state.layout().sides() {
            let painter = self.state.painter(*side);
            let settled = painter.settle(self.screen.gpu(), &shown.at.model, &view);
            renderers[side.index()] = Some(settled);
        }
        let about = (self.size_px, renderers, is_settled);
        self.judged.ask(ctx, &self.state, &self.screen, about);
        let next = Last {
            revision,
            is_settled,
            size_px: self.size_px,
            renderers,
            divisor,
        };
        // A picture as fine or finer of the same is good enough.
        let is_drawn = self.last.is_some_and(|last| {
            last == Last {
                divisor: last.divisor,
                ..next
            } && last.divisor <= divisor
        });
        if !is_drawn && !self.screen.is_busy() {
            let wants_difference = self.state.layout() == Layout::Difference;
            let drawn = self
                .screen
                .draw(shown, renderers, self.size_px, divisor, wants_difference);
            self.last = Some(next);
            drawn?;
        }
        if self.screen.is_busy() || !is_drawn {
            ctx.request_repaint_after(Duration::from_millis(5));
        } else if !is_settled {
            ctx.request_repaint_after(REST);
        }
        Ok(())
    }
}
