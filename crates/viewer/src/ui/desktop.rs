//! Desktop integration: dropped files, and exports through the command-line program.

use std::path::{Path, PathBuf};
use std::time::Duration;

use cutaway::{Error, Result};
use eframe::egui::{Context, Ui};

use super::Viewer;
use super::dialogs::naming::Asks;
use crate::action::Action;
use crate::storage::export::Export;

/// State of desktop integration.
#[derive(Default)]
pub(super) struct Outside {
    export: Option<Export>,
    /// Program that carries out exports; `None` for this program itself.
    program: Option<PathBuf>,
}

impl Outside {
    pub(super) fn is_busy(&self) -> bool {
        self.export.is_some()
    }
}

impl Viewer {
    /// Sets the program that carries out exports, for hosts that are not `cutaway` itself.
    pub fn export_by(&mut self, program: impl Into<PathBuf>) {
        self.outside.program = Some(program.into());
    }

    /// Handles dropped files and finished exports.
    pub(super) fn look_outside(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        let paths: Vec<PathBuf> = dropped
            .into_iter()
            .map(|file| file.path().to_owned())
            .collect();
        if !paths.is_empty() {
            actions.push(Action::Take(paths));
        }
        if let Some(notice) = self.outside.export.as_mut().and_then(Export::ended) {
            self.outside.export = None;
            self.toasts.add(ctx, notice);
        }
    }

    /// Shows the dialog that asks for a file to open.
    pub(super) fn ask_for_files(&mut self, _: &Context) {
        self.asks = Some(Asks::open());
    }

    pub(super) fn begin_export(&mut self, ctx: &Context, path: &Path) {
        if let Some(export) = &self.outside.export {
            let at = export.path().display();
            let help = "wait for it, or cancel it";
            let error = Error::file(path, format!("{at} is still being exported"), help);
            self.toasts.add(ctx, error.into());
            return;
        }
        let begun = self
            .state
            .must_not_be_read(path)
            .and_then(|()| self.try_export(path));
        match begun {
            Ok(export) => self.outside.export = Some(export),
            Err(error) => self.toasts.add(ctx, error.into()),
        }
    }

    fn try_export(&self, path: &Path) -> Result<Export> {
        let own = || {
            std::env::current_exe().map_err(|e| {
                let what = format!("the path of this program is not known: {e}");
                Error::file(path, what, "use *Copy command* instead")
            })
        };
        let program = self.outside.program.clone().map_or_else(own, Ok)?;
        let moves = self.state.shown().is_some_and(|s| s.timeline.moves());
        let is_picture = path.extension().is_some_and(|ending| ending == "png");
        let document = match is_picture {
            true => self.state.as_seen()?,
            false => self.state.as_moving()?,
        };
        Export::begin(&program, &document, self.size_px, moves, path)
    }

    /// Shows the export in progress, with a cancel button.
    pub(super) fn exporting(&mut self, ui: &mut Ui) {
        let Some(export) = &mut self.outside.export else {
            return;
        };
        ui.spinner();
        ui.label(format!("exporting {}", export.path().display()));
        if ui.button("Cancel export").clicked() {
            export.cancel();
            self.outside.export = None;
        }
        ui.ctx().request_repaint_after(Duration::from_millis(100));
    }
}
