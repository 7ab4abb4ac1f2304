//! The strip of a scene that moves: play, and a moment that is dragged.

use eframe::egui::{Slider, Ui};

use crate::action::Action;
use crate::state::State;

/// Shows the strip.
pub(super) fn show(ui: &mut Ui, state: &State, plays: &mut bool, actions: &mut Vec<Action>) {
    let Some(duration_s) = state.shown().and_then(|s| s.timeline.duration_s()) else {
        return;
    };
    ui.horizontal(|ui| {
        if ui.button(if *plays { "Pause" } else { "Play" }).clicked() {
            *plays = !*plays;
        }
        let mut time_s = state.time_s().unwrap_or(0.0);
        ui.spacing_mut().slider_width = (ui.available_width() - 160.0).max(80.0);
        let slider = Slider::new(&mut time_s, 0.0..=duration_s)
            .text("Time")
            .suffix(" s");
        // Shown with few digits and kept with all: a slider that rounds what it is given counts as moved.
        let slider = slider.custom_formatter(|time_s, _| format!("{time_s:.3}"));
        if ui.add(slider).changed() {
            *plays = false;
            actions.push(Action::Seek(time_s));
        }
    });
}
