//! What goes on beside the picture: files that are dropped, watched and exported, and time that passes.

use std::path::{Path, PathBuf};
use std::time::Duration;

use cutaway::{Error, Result};
use eframe::egui::{Context, Ui};

use super::Viewer;
use crate::action::Action;
use crate::export::Export;

/// How often files are looked at, in seconds.
const LOOKED_AT_EVERY_S: f64 = 1.0;

impl Viewer {
    pub(super) fn run_errands(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        self.take_drops(ctx, actions);
        self.look_at_files(ctx, actions);
        self.play(ctx, actions);
        if let Some(notice) = self.export.as_mut().and_then(Export::ended) {
            self.export = None;
            self.toasts.add(ctx, notice);
        }
    }

    fn take_drops(&self, ctx: &Context, actions: &mut Vec<Action>) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        let paths: Vec<PathBuf> = dropped
            .into_iter()
            .map(|file| file.path().to_owned())
            .collect();
        if !paths.is_empty() {
            actions.push(Action::Take(paths));
        }
    }

    fn look_at_files(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        let now = ctx.input(|input| input.time);
        let Some(shown) = self.state.shown() else {
            return;
        };
        // Asked for in every frame, for each frame forgets what the one before has asked for.
        ctx.request_repaint_after(Duration::from_secs_f64(LOOKED_AT_EVERY_S));
        if now - self.watch.1 < LOOKED_AT_EVERY_S {
            return;
        }
        self.watch.1 = now;
        if self.watch.0.has_changed(shown.timeline.files()) {
            actions.push(Action::Reload);
        }
    }

    /// Goes on in time, and begins anew at the end.
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

    pub(super) fn begin_export(&mut self, ctx: &Context, path: &Path) {
        if let Some(export) = &self.export {
            let at = export.path().display();
            let help = "wait for it, or cancel it";
            let error = Error::file(path, format!("{at} is still being exported"), help);
            self.toasts.add(ctx, error.into());
            return;
        }
        match self.try_export(path) {
            Ok(export) => self.export = Some(export),
            Err(error) => self.toasts.add(ctx, error.into()),
        }
    }

    fn try_export(&self, path: &Path) -> Result<Export> {
        let own = || {
            std::env::current_exe().map_err(|e| {
                let what = format!("this program does not know where it is: {e}");
                Error::file(path, what, "use *Copy command* instead")
            })
        };
        let program = self.program.clone().map_or_else(own, Ok)?;
        let moves = self.state.shown().is_some_and(|s| s.timeline.moves());
        let document = self.state.as_seen()?;
        Export::begin(&program, &document, self.size_px, moves, path)
    }

    /// What is being exported, and a button that ends it.
    pub(super) fn exporting(&mut self, ui: &mut Ui) {
        let Some(export) = &mut self.export else {
            return;
        };
        ui.spinner();
        ui.label(format!("exporting {}", export.path().display()));
        if ui.button("Cancel export").clicked() {
            export.cancel();
            self.export = None;
        }
        ui.ctx().request_repaint_after(Duration::from_millis(100));
    }
}
