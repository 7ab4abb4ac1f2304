//! The opening in the background, in the menu bar, with a button that drops it.

use std::time::Duration;

use eframe::egui::{Context, Ui};

use crate::ui::Viewer;

impl Viewer {
    /// Shows what was opened, and begins with what is to be opened.
    pub(in crate::ui) fn open_files(&mut self, ctx: &Context) {
        let wake = ctx.clone();
        let is_another = (self.opening).go_on(&mut self.state, move || wake.request_repaint());
        if is_another {
            self.preclassified = Some(self.state.revision());
        }
    }

    /// Shows the opening in progress, with a button that drops it.
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
