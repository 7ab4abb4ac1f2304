//! Notices in a corner of the window. Notes disappear by themselves; warnings and errors stay until they are closed.

use std::time::Duration;

use eframe::egui::{self, Align2, Area, Color32, Frame, RichText, Vec2};

use cutaway::error::{Diagnostic, Severity};

/// Display time of a notice about a completed action.
const SHOWN_FOR: Duration = Duration::from_secs(4);

/// The visible notices, each with the time of its appearance on egui's clock, in seconds.
#[derive(Debug, Default)]
pub(in crate::ui) struct Toasts(Vec<(Diagnostic, f64)>);

impl Toasts {
    /// Adds a notice.
    pub(in crate::ui) fn add(&mut self, ctx: &egui::Context, notice: Diagnostic) {
        let is_same = |(held, _): &(Diagnostic, f64)| *held == notice;
        self.0.retain(|held| !is_same(held));
        self.0.push((notice, ctx.input(|input| input.time)));
    }

    /// Shows the notices.
    pub(in crate::ui) fn show(&mut self, ctx: &egui::Context) {
        let now = ctx.input(|input| input.time);
        let is_there = |(notice, since): &(Diagnostic, f64)| {
            notice.severity > Severity::Note || now - since < SHOWN_FOR.as_secs_f64()
        };
        self.0.retain(is_there);
        if self.0.is_empty() {
            return;
        }
        let mut closed = None;
        let area =
            Area::new(egui::Id::unique("notices")).anchor(Align2::RIGHT_BOTTOM, Vec2::splat(-12.0));
        area.show(ctx, |ui| {
            ui.set_max_width(420.0);
            for (index, (notice, _)) in self.0.iter().enumerate() {
                Frame::popup(ui.style()).show(ui, |ui| {
                    ui.horizontal_top(|ui| {
                        let text = RichText::new(notice.to_string());
                        ui.label(match notice.severity > Severity::Note {
                            true => text.color(error_color(ui)),
                            false => text,
                        });
                        let close = ui.small_button("x").on_hover_text("Close this notice");
                        if close.clicked() {
                            closed = Some(index);
                        }
                    });
                });
            }
        });
        if let Some(index) = closed {
            self.0.remove(index);
        }
        ctx.request_repaint_after(SHOWN_FOR);
    }
}

fn error_color(ui: &egui::Ui) -> Color32 {
    ui.visuals().error_fg_color
}
