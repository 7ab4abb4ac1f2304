//! The strip below the picture, with each slot's renderer, the layout, and the errors.

use cutaway::strategies::{AUTO, Strategy};
use cutaway_lab::experiment::Renderer;
use eframe::egui::{Button, ComboBox, ScrollArea, Slider, Ui};

use crate::action::Action;
use crate::picture::screen::Screen;
use crate::picture::slot::{Painter, SlotLayout, SlotSide};
use crate::state::State;
use crate::ui::judged::JudgeState;

/// Shows the strip.
pub(in crate::ui) fn show(
    ui: &mut Ui,
    state: &State,
    (screen, judged): (&Screen, &JudgeState),
    windows: (&mut bool, &mut bool),
    actions: &mut Vec<Action>,
) {
    ScrollArea::horizontal().show(ui, |ui| controls(ui, state, actions));
    ui.horizontal(|ui| {
        measurements(ui, state, windows);
        ScrollArea::horizontal().id_salt("counts").show(ui, |ui| {
            for side in state.layout().sides() {
                ui.label(judged.sentence(*side, state, screen));
                ui.separator();
            }
            if let Some(took_ms) = screen.took_ms() {
                // Browsers do not reveal the adapter's name.
                let on = match screen.gpu().name() {
                    "" => String::new(),
                    name => format!(" on {name}"),
                };
                ui.weak(format!("{took_ms:.0} ms for the last frame{on}"));
            }
        });
    });
}

/// Controls for the renderers and the layout.
fn controls(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        for layout in SlotLayout::ALL {
            let button = ui.selectable_label(state.layout() == layout, layout.name());
            if button.clicked() {
                actions.push(Action::Arrange(layout));
            }
        }
        ui.separator();
        for side in SlotSide::BOTH {
            painter(ui, state, side, actions);
        }
        if ui
            .button("Swap")
            .on_hover_text("Exchange the slots")
            .clicked()
        {
            actions.push(Action::Swap);
        }
        ui.separator();
        let mut shows = state.shows_errors();
        let help = "Compare the slots with the exact reference, and mark the wrong pixels";
        if ui
            .checkbox(&mut shows, "Errors")
            .on_hover_text(help)
            .changed()
        {
            actions.push(Action::ShowErrors(shows));
        }
        if state.layout() == SlotLayout::Wipe {
            let mut at = state.wipe();
            let slider = Slider::new(&mut at, 0.0..=1.0)
                .show_value(false)
                .text("Wipe");
            if ui.add(slider).changed() {
                actions.push(Action::Wipe(at));
            }
        }
    });
}

/// Buttons for measurements: the error and time of all methods, and the cost of the slots' frames.
fn measurements(ui: &mut Ui, state: &State, (asks_survey, shows_cost): (&mut bool, &mut bool)) {
    // A page offers no measurements, because a browser's timers are too coarse.
    if cfg!(target_arch = "wasm32") {
        return;
    }
    let button = Button::new("Measure all here");
    let help = "Error and time of every method that draws this scene, in this view";
    let is_clicked = ui
        .add_enabled(state.shown().is_some(), button)
        .on_hover_text(help)
        .clicked();
    *asks_survey |= is_clicked;
    ui.toggle_value(shows_cost, "Cost")
        .on_hover_text("The time of each pass of a frame, and the bytes that it writes");
    ui.separator();
}

/// The control that selects a slot's renderer.
fn painter(ui: &mut Ui, state: &State, side: SlotSide, actions: &mut Vec<Action>) {
    let held = state.painter(side);
    let shown = ComboBox::new(("painter", side), format!("Slot {side}"));
    shown.selected_text(held.to_string()).show_ui(ui, |ui| {
        let by_methods = Strategy::all().into_iter().flat_map(names);
        let all = [AUTO, "exact"]
            .map(str::to_owned)
            .into_iter()
            .chain(by_methods);
        for name in all {
            let Ok(painter) = name.parse::<Painter>() else {
                continue;
            };
            if ui.selectable_label(painter == held, &name).clicked() {
                actions.push(Action::Choose(side, painter));
            }
        }
    });
}

/// The names of a strategy's methods, one for each rasteriser that can draw it.
fn names(strategy: Strategy) -> Vec<String> {
    let name = strategy.to_string();
    let by_compute = format!("{name}@compute");
    let can = by_compute.parse::<Renderer>().is_ok();
    [Some(name), can.then_some(by_compute)]
        .into_iter()
        .flatten()
        .collect()
}
