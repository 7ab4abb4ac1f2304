//! The timeline strip of a scene with animation: a slider for the time, and above it the document's keys, with one row per target.

use cutaway_io::document::Value;
use eframe::egui::{
    Align2, Button, Color32, DragValue, FontId, Pos2, Rect, Response, ScrollArea, Sense, Shape,
    Slider, Stroke, Ui, Vec2, pos2, vec2,
};

use crate::action::Action;
use crate::editing::timeline::{self, TimelineTrack};
use crate::state::State;

/// Height of a row of keys, in points.
const ROW: f32 = 16.0;

/// Maximum number of rows visible at once.
const MOST_ROWS: usize = 5;

/// Width of the area to the left of the time axis, in points.
const GUTTER: f32 = 310.0;

/// Width of the area to the right of the time axis, in points.
const BEHIND: f32 = 110.0;

/// Half the height of a key's mark, in points.
const HALF_KEY: f32 = 5.0;

/// State of the strip.
#[derive(Debug, Default)]
pub(in crate::ui) struct Strip {
    /// Row and index of the key that was last clicked or dragged.
    chosen: Option<[usize; 2]>,
    /// Duration that the time axis shows while a key is dragged, in seconds; it stays fixed even if the scene's end moves.
    held_duration_s: Option<f64>,
}

/// Height of the strip, in points.
pub(in crate::ui) fn height(state: &State) -> f32 {
    let rows = timeline::tracks(state.document()).len().min(MOST_ROWS);
    34.0 + rows as f32 * ROW
}

/// Shows the strip.
pub(in crate::ui) fn show(
    ui: &mut Ui,
    state: &State,
    (plays, strip): (&mut bool, &mut Strip),
    actions: &mut Vec<Action>,
) {
    let Some(duration_s) = state.shown().and_then(|s| s.timeline.duration_s()) else {
        return;
    };
    let tracks = timeline::tracks(state.document());
    let is_there = |[track, key]: [usize; 2]| {
        tracks
            .get(track)
            .is_some_and(|track| key < track.times_s.len())
    };
    strip.chosen = strip.chosen.filter(|key| is_there(*key));
    let slider_width = (ui.available_width() - GUTTER - BEHIND).max(80.0);
    let left = ui.min_rect().left() + GUTTER;
    // The time axis covers the range of the slider's knob.
    let inset = ui.spacing().interact_size.y / 2.5;
    let line = [left + inset, left + slider_width - inset];
    let shown_s = strip.held_duration_s.unwrap_or(duration_s);
    if !tracks.is_empty() {
        let rows = tracks.len().min(MOST_ROWS) as f32 * ROW;
        ui.spacing_mut().item_spacing.y = 0.0;
        ScrollArea::vertical().max_height(rows).show(ui, |ui| {
            for (index, track) in tracks.iter().enumerate() {
                row(ui, (index, track), (line, shown_s), strip, actions);
            }
        });
    }
    // The time axis keeps its duration while the pointer is pressed.
    if !ui.input(|input| input.pointer.any_down()) {
        strip.held_duration_s = None;
    }
    ui.horizontal(|ui| {
        if ui.button(if *plays { "Pause" } else { "Play" }).clicked() {
            *plays = !*plays;
        }
        let help = "Add a key for the selection at this time, with its present values";
        if ui.button("Add key here").on_hover_text(help).clicked() {
            *plays = false;
            actions.push(Action::AddKey);
        }
        chosen_key(ui, &tracks, strip, actions);
        ui.add_space((left - ui.cursor().left()).max(0.0));
        let mut time_s = state.time_s().unwrap_or(0.0);
        ui.spacing_mut().slider_width = slider_width;
        let slider = Slider::new(&mut time_s, 0.0..=duration_s)
            .text("Time")
            .suffix(" s");
        // Few digits are shown but the value is not rounded: a slider that rounds its value would report a change.
        let slider = slider.custom_formatter(|time_s, _| format!("{time_s:.3}"));
        if ui.add(slider).changed() {
            *plays = false;
            actions.push(Action::Seek(time_s));
        }
    });
}

/// Controls for the chosen key: its time, and a button that deletes the key.
fn chosen_key(ui: &mut Ui, tracks: &[TimelineTrack], strip: &mut Strip, actions: &mut Vec<Action>) {
    let [track, key] = strip.chosen.unwrap_or_default();
    let mut time_s = strip.chosen.map_or(0.0, |_| tracks[track].times_s[key]);
    ui.add_enabled_ui(strip.chosen.is_some(), |ui| {
        let drag = DragValue::new(&mut time_s).speed(0.01).suffix(" s");
        let drag = drag.custom_formatter(|time_s, _| format!("{time_s:.3}"));
        let response = ui.add(drag).accessible_name("Time of the key");
        if response.on_hover_text("Time of the chosen key").changed() {
            actions.push(Action::MoveKey([track, key], time_s));
        }
        let button = ui.add(Button::new("Delete key").small());
        if button.on_hover_text("Delete the chosen key").clicked() {
            actions.push(Action::RemoveKey([track, key]));
            strip.chosen = None;
        }
    });
}

/// Shows a row: the target's name and its keys.
fn row(
    ui: &mut Ui,
    (index, track): (usize, &TimelineTrack),
    ([from, to], shown_s): ([f32; 2], f64),
    strip: &mut Strip,
    actions: &mut Vec<Action>,
) {
    let (rect, name) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::hover());
    name.on_hover_text(&track.target);
    let visuals = ui.visuals().clone();
    let labels = Rect::from_min_max(rect.min, pos2(from - 12.0, rect.bottom()));
    ui.painter_at(labels).text(
        labels.left_center(),
        Align2::LEFT_CENTER,
        &track.target,
        FontId::proportional(11.0),
        visuals.weak_text_color(),
    );
    let line = Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color);
    ui.painter().hline(from..=to, rect.center().y, line);
    let x_of = |time_s: f64| from + (to - from) * (time_s / shown_s) as f32;
    for (key, (time_s, value)) in track.times_s.iter().zip(&track.values).enumerate() {
        let at = pos2(x_of(*time_s), rect.center().y);
        let around = Rect::from_center_size(at, Vec2::splat(2.0 * HALF_KEY + 4.0));
        let id = ui.scope_id().with(("key", index, key));
        let response = ui.interact(around, id, Sense::click_and_drag());
        let name = format!("Key of {} at {time_s} s", track.target);
        let response = response.accessible_name(name);
        let is_chosen = strip.chosen == Some([index, key]);
        paint(ui, at, &response, is_chosen);
        let is_at = |pointer: Pos2| f64::from((pointer.x - from) / (to - from)) * shown_s;
        if response.drag_started() {
            strip.held_duration_s = Some(shown_s);
        }
        if response.dragged()
            && let Some(pointer) = response.interact_pointer_pos()
        {
            strip.chosen = Some([index, key]);
            actions.push(Action::MoveKey([index, key], is_at(pointer)));
        }
        if response.clicked() {
            strip.chosen = Some([index, key]);
            actions.push(Action::Seek(*time_s));
        }
        if response.secondary_clicked() {
            strip.chosen = None;
            actions.push(Action::RemoveKey([index, key]));
        }
        response.on_hover_ui(|ui| {
            ui.label(format!("{}\n{time_s} s: {}", track.target, short(value)));
            ui.weak("click: go there; drag: move it; right click: delete it");
        });
    }
}

fn paint(ui: &Ui, at: Pos2, response: &Response, is_chosen: bool) {
    let color = match (is_chosen, response.hovered() || response.dragged()) {
        (true, _) => Color32::from_rgb(255, 214, 64),
        (_, true) => ui.visuals().strong_text_color(),
        _ => Color32::from_rgb(230, 120, 30),
    };
    let corners = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)];
    let points = corners.map(|(x, y)| at + vec2(x, y) * HALF_KEY);
    let rim = Stroke::new(1.0, ui.visuals().extreme_bg_color);
    let painter = ui.painter();
    painter.add(Shape::convex_polygon(points.to_vec(), color, rim));
}

/// A value as text with few digits.
fn short(value: &Value) -> String {
    match value {
        Value::List(list) => {
            let each: Vec<String> = list.iter().map(|node| short(&node.value)).collect();
            format!("[{}]", each.join(", "))
        }
        Value::Number(number) => format!("{:.4}", number.value)
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned(),
        other => other.to_string(),
    }
}
