//! The scene's style: its name, and its values, each with a button that resets the value.

use cutaway_io::document::paths;
use cutaway_io::document::{Node, Value, named_style, style_names};
use eframe::egui::{Button, CollapsingHeader, ComboBox, Grid, Ui};

use super::value::cells;
use crate::action::Action;
use crate::editing::styles;
use crate::picture::shown::Shown;
use crate::state::State;

/// Shows the style's name and values.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    let held = state.document().root().get("style").cloned();
    let named = held.as_ref().and_then(|style| match &style.value {
        Value::Text(name) => Some(name.to_string()),
        _ => style.get("base").and_then(Node::text).map(str::to_owned),
    });
    let named = named.unwrap_or_else(|| crate::picture::shown::USUAL_STYLE.to_owned());
    ComboBox::new("style", "Style")
        .selected_text(&named)
        .show_ui(ui, |ui| {
            for name in style_names() {
                if ui.selectable_label(name == named, name).clicked() && named_style(name).is_ok() {
                    let is_table = matches!(held.as_ref().map(|h| &h.value), Some(Value::Table(_)));
                    let path = if is_table { "style.base" } else { "style" }.to_owned();
                    actions.push(Action::Set {
                        path,
                        value: name.into(),
                    });
                }
            }
        });
    if let Some(shown) = state.shown() {
        CollapsingHeader::new("Numbers of the style").show(ui, |ui| {
            numbers(ui, state, shown, actions);
        });
    }
}

/// Shows all values of the style, in groups with headings, in the order of the table of paths.
fn numbers(ui: &mut Ui, state: &State, shown: &Shown, actions: &mut Vec<Action>) {
    let values = styles::values(&shown.scene.style);
    let of_styles = || {
        paths::all()
            .iter()
            .filter_map(|p| p.path.strip_prefix("style."))
    };
    let mut groups: Vec<&str> = of_styles()
        .filter_map(|p| Some(p.split_once('.')?.0))
        .collect();
    groups.dedup();
    // A group can occur twice in the table, with other groups in between.
    groups.sort_unstable();
    groups.dedup();
    let mut of_group = |ui: &mut Ui, group: &str| {
        Grid::new(format!("style {group}"))
            .num_columns(3)
            .show(ui, |ui| {
                for path in of_styles() {
                    let (of, key) = path.split_once('.').unwrap_or(("", path));
                    let path = format!("style.{path}");
                    let value = values.iter().find(|(known, _)| *known == path);
                    if let Some((_, value)) = value.filter(|_| of == group) {
                        number(ui, state, (&path, key), value.clone(), actions);
                    }
                }
            });
    };
    of_group(ui, "");
    for group in groups {
        CollapsingHeader::new(group)
            .id_salt(("style", group))
            .show(ui, |ui| {
                of_group(ui, group);
            });
    }
}

fn number(
    ui: &mut Ui,
    state: &State,
    (path, label): (&str, &str),
    value: Value,
    actions: &mut Vec<Action>,
) {
    cells(ui, state, (path, path), (label, value), actions);
    let is_changed = state.document().get(path).is_ok();
    let button = ui.add_enabled(is_changed, Button::new("Back").small());
    let button = button.accessible_name(format!("Reset {path}"));
    if button.on_hover_text("Use the style's own value").clicked() {
        actions.push(Action::TakeBack(path.to_owned()));
    }
    ui.end_row();
}
