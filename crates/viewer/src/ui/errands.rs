//! Periodic work of the window: watches files and advances the time.

use std::time::Duration;

use eframe::egui::Context;

use super::Viewer;
use crate::action::Action;

/// Interval at which files are polled, in seconds.
const LOOKED_AT_EVERY_S: f64 = 1.0;

impl Viewer {
    pub(super) fn run_errands(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        self.look_outside(ctx, actions);
        // A page's files are in its memory, where no other program writes them.
        if cfg!(not(target_arch = "wasm32")) {
            self.look_at_files(ctx, actions);
        }
        self.play(ctx, actions);
    }

    fn look_at_files(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        let now = ctx.input(|input| input.time);
        let Some(shown) = self.state.shown() else {
            return;
        };
        // Requested in every frame, because each frame discards the previous frame's requests.
        ctx.request_repaint_after(Duration::from_secs_f64(LOOKED_AT_EVERY_S));
        if now - self.watch.1 < LOOKED_AT_EVERY_S {
            return;
        }
        self.watch.1 = now;
        if self.watch.0.has_changed(shown.timeline.files()) {
            actions.push(Action::Reload);
        }
    }

    /// Advances the time while the animation plays; after the end it starts again.
    fn play(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        let duration_s = self.state.shown().and_then(|s| s.timeline.duration_s());
        let Some(duration_s) = duration_s.filter(|_| self.plays) else {
            self.plays = false;
            return;
        };
        let by_s = f64::from(ctx.input(|input| input.stable_dt));
        let time_s = self.state.time_s().unwrap_or(0.0) + by_s;
        actions.push(Action::Seek(time_s % duration_s));
        ctx.request_repaint();
    }
}
