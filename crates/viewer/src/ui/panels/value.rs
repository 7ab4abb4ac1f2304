//! Controls for document values, made from the table of paths. A value's type in the table decides which control it gets, and the table's
//! description is its help text.

use std::ops::RangeInclusive;

use cutaway::scene::{Amount, parse_color};
use cutaway_io::document::paths::{self, Path, ValueType};
use cutaway_io::document::{Node, Value};
use eframe::egui::{Checkbox, ComboBox, DragValue, TextEdit, Ui};

use crate::action::Action;
use crate::state::State;

/// A labelled control for the value at `path` in the document. `pattern` is the path's entry in the table, with `*` for names and numbers.
/// If the document has no value there, the control shows `usual`. The document is only set when the user changes the value.
pub(in crate::ui) fn control(
    ui: &mut Ui,
    state: &State,
    (path, pattern): (&str, &str),
    (label, usual): (&str, Value),
    actions: &mut Vec<Action>,
) {
    cells(ui, state, (path, pattern), (label, usual), actions);
    ui.end_row();
}

/// The label and the control of [`control`], without ending the grid row.
pub(in crate::ui) fn cells(
    ui: &mut Ui,
    state: &State,
    (path, pattern): (&str, &str),
    (label, usual): (&str, Value),
    actions: &mut Vec<Action>,
) {
    let Some(entry) = paths::find(pattern) else {
        return;
    };
    let held = state.posed().get(path).ok().map(|node| node.value.clone());
    let value = held.unwrap_or(usual);
    ui.label(label).on_hover_text(entry.help);
    let name = format!("{label} of {path}");
    let changed = edited(ui, entry, &value, &name);
    if let Some(value) = changed {
        let path = path.to_owned();
        actions.push(Action::Set { path, value });
    }
}

/// The control without a label; returns the new value if it was changed.
fn edited(ui: &mut Ui, entry: &Path, value: &Value, name: &str) -> Option<Value> {
    let mut takes = entry.takes;
    while let ValueType::Or(one, _) = takes {
        takes = *one;
    }
    match (takes, value) {
        (ValueType::Flag, value) => {
            let mut is_on = *value == true.into();
            let response = ui.add(Checkbox::without_text(&mut is_on));
            let response = response.accessible_name(name).on_hover_text(entry.help);
            response.changed().then(|| is_on.into())
        }
        (ValueType::Choice(words), value) => choice(ui, words, value, name),
        (ValueType::Number(least, most), Value::Number(number)) => {
            let mut held = number.value;
            let speed = speed(held, least, most);
            let drag = DragValue::new(&mut held)
                .range(shown(least)..=most)
                .speed(speed);
            let response = ui.add(drag.suffix(suffix(entry)).max_decimals(4));
            let response = response.accessible_name(name).on_hover_text(entry.help);
            response.changed().then(|| held.into())
        }
        (ValueType::Whole(least, most), Value::Number(number)) => {
            let mut held = number.value.round() as i64;
            let most = most.min(9e15);
            let drag = DragValue::new(&mut held)
                .range(least as i64..=most as i64)
                .speed(0.1);
            let response = ui.add(drag.suffix(suffix(entry)));
            let response = response.accessible_name(name).on_hover_text(entry.help);
            response.changed().then(|| held.into())
        }
        (ValueType::Amount(least, most), value) => {
            amount(ui, entry, (value, shown(least)..=most), name)
        }
        (ValueType::Color, Value::Text(text)) => match parse_color(text) {
            Some(color) => {
                let mut rgb = color.to_array().map(|c| (c * 255.0).round() as u8);
                let response = ui.color_edit_button_srgb(&mut rgb);
                let response = response.accessible_name(name).on_hover_text(entry.help);
                let [r, g, b] = rgb;
                (response.changed()).then(|| format!("#{r:02x}{g:02x}{b:02x}").into())
            }
            None => text_edited(ui, text, name),
        },
        (_, Value::Text(text)) => text_edited(ui, text, name),
        (_, other) => {
            let text = other.to_string();
            text_edited(ui, &text, name).map(|value| match value {
                Value::Text(text) => Value::read(&text),
                other => other,
            })
        }
    }
}

/// A control that selects one of some words.
fn choice(ui: &mut Ui, words: &[&str], value: &Value, name: &str) -> Option<Value> {
    let held = Node::new(value.clone());
    let held = held.text().unwrap_or_default().to_owned();
    let mut chosen = None;
    let shown = ComboBox::from_id_salt(name).selected_text(&held);
    let response = shown.show_ui(ui, |ui| {
        for word in words {
            if ui.selectable_label(*word == held, *word).clicked() && *word != held {
                chosen = Some(Value::from(*word));
            }
        }
    });
    response.response.accessible_name(name);
    chosen
}

/// A control for a number or a percentage; a percentage remains a percentage.
fn amount(
    ui: &mut Ui,
    entry: &Path,
    (value, range): (&Value, RangeInclusive<f64>),
    name: &str,
) -> Option<Value> {
    let held = match value {
        Value::Number(number) => Amount::Units(number.value),
        Value::Text(text) => Amount::parse(text).ok()?,
        _ => return None,
    };
    let (mut number, suffix) = match held {
        Amount::Units(v) => (v, ""),
        Amount::Percent(p) => (p, "%"),
    };
    let drag = DragValue::new(&mut number)
        .range(range)
        .speed(0.1)
        .suffix(suffix)
        .max_decimals(4);
    let response = ui.add(drag).accessible_name(name).on_hover_text(entry.help);
    response.changed().then(|| match held {
        Amount::Units(_) => number.into(),
        Amount::Percent(_) => Amount::Percent(number).into(),
    })
}

/// A text field. The text is returned when the field loses focus or Enter is pressed.
pub(in crate::ui) fn text_edited(ui: &mut Ui, text: &str, name: &str) -> Option<Value> {
    let id = ui.make_persistent_id(name);
    let mut typed = ui
        .data(|data| data.get_temp::<String>(id))
        .unwrap_or_else(|| text.to_owned());
    let response = ui.add(TextEdit::singleline(&mut typed).desired_width(140.0));
    let response = response.accessible_name(name);
    if response.lost_focus() {
        ui.data_mut(|data| data.remove::<String>(id));
        return (typed != text).then(|| typed.into());
    }
    // Queried here, because a query inside `data_mut`, which locks the context, would deadlock.
    let has_focus = response.has_focus();
    ui.data_mut(|data| match has_focus {
        true => _ = data.insert_temp(id, typed),
        false => data.remove::<String>(id),
    });
    None
}

/// Minimum of a drag control. For a range that begins above 0 it is at least 1e-6, so that the value can be written.
fn shown(least: f64) -> f64 {
    if least > 0.0 { least.max(1e-6) } else { least }
}

/// Change of a number per point that the pointer is dragged.
fn speed(value: f64, least: f64, most: f64) -> f64 {
    match (most - least).is_finite() {
        true => (most - least) / 300.0,
        false => (value.abs() / 100.0).max(1e-3),
    }
}

fn suffix(entry: &Path) -> &'static str {
    match entry.unit {
        "degrees" => "°",
        "percent" => " %",
        "px" => " px",
        "s" => " s",
        _ => "",
    }
}
