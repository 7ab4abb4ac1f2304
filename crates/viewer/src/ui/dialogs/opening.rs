//! Shows in the menu bar which files are being opened, with a cancel button.

use std::time::Duration;

use eframe::egui::{Context, Ui};

use crate::ui::Viewer;

impl Viewer {
    /// Takes over opened files, and begins the next opening.
    pub(in crate::ui) fn open_files(&mut self, ctx: &Context) {
        let wake = ctx.clone();
        let is_another = (self.opening).go_on(&mut self.state, move || wake.request_repaint());
        if is_another {
            self.preclassified = Some(self.state.revision());
        }
    }

    /// Shows which files are being opened, with a cancel button.
    pub(in crate::ui) fn opening(&mut self, ui: &mut Ui) {
        let Some(what) = self.opening.what() else {
            return;
        };
        ui.spinner();
        ui.label(what);
        if ui.button("Cancel opening").clicked() {
            self.opening.cancel();
        }
        ui.ctx().request_repaint_after(Duration::from_millis(100));
    }
}
