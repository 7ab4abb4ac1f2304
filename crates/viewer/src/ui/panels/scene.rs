//! The left panel: the document's parts and cuts, and buttons that add cuts.

use std::collections::BTreeSet;

use cutaway_io::document::{Node, Value};
use eframe::egui::{Button, Checkbox, Label, RichText, ScrollArea, Ui};

use super::defects::Badges;
use crate::action::{Action, Selection};
use crate::editing::cuts::NewCut;
use crate::editing::parts;
use crate::state::State;

/// Cuts that the panel can add: label, help text, and the cut.
const NEW: [(&str, &str, NewCut); 6] = [
    (
        "Plane",
        "Remove everything on one side of a plane",
        NewCut::Plane(0),
    ),
    (
        "Relief",
        "Remove everything above a ragged surface",
        NewCut::Relief(0),
    ),
    (
        "Box",
        "Remove a box: the octant nearest to you",
        NewCut::Box,
    ),
    (
        "Wedge",
        "Remove a wedge of 90 degrees about the up axis",
        NewCut::Wedge,
    ),
    (
        "Cutout",
        "Remove an automatically placed wedge that opens towards you",
        NewCut::Cutout,
    ),
    (
        "Breakaway",
        "Remove what hides the interior parts",
        NewCut::Breakaway,
    ),
];

/// Shows the panel.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, badges: &Badges, actions: &mut Vec<Action>) {
    ScrollArea::vertical().show(ui, |ui| {
        ui.heading("Cuts");
        ui.horizontal_wrapped(|ui| {
            for (label, help, new) in NEW {
                if ui.button(label).on_hover_text(help).clicked() {
                    actions.push(Action::Add(across_the_eye(state, new)));
                }
            }
        });
        for (index, cut) in state.cuts().into_iter().enumerate() {
            ui.horizontal(|ui| {
                let mut is_enabled = cut.is_enabled;
                let checkbox = ui.checkbox(&mut is_enabled, "");
                let checkbox = checkbox.accessible_name(format!("Cut by {}", cut.name));
                if checkbox
                    .on_hover_text("Enable or disable this cut")
                    .changed()
                {
                    let path = format!("cut.{index}.enabled");
                    actions.push(Action::Set {
                        path,
                        value: is_enabled.into(),
                    });
                }
                let is_selected = state.selection() == Selection::Cut(index);
                let label = format!("{} ({})", cut.name, cut.kind.name());
                if ui.selectable_label(is_selected, label).clicked() {
                    actions.push(Action::Select(Selection::Cut(index)));
                }
            });
        }
        ui.separator();
        ui.heading("Parts");
        parts(ui, state, badges, actions);
    });
}

fn parts(ui: &mut Ui, state: &State, badges: &Badges, actions: &mut Vec<Action>) {
    let entries = parts::parts(state.document());
    if entries.is_empty() {
        ui.weak("Drop a mesh or a scene into the window.");
    }
    let shown = state
        .shown()
        .map_or(&[] as &[_], |shown| &shown.scene.parts);
    let own: BTreeSet<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
    let names = shown.iter().map(|part| part.name.as_str());
    let solids: Vec<&str> = names.filter(|name| !own.contains(name)).collect();
    for (index, entry) in entries.iter().enumerate() {
        let name = &entry.name;
        let is_selected = state.selection() == Selection::Part(index);
        // Lines wrap, because a wider panel would change the size of the picture.
        ui.horizontal_wrapped(|ui| {
            let mut is_shown = entry.is_enabled;
            let eye = ui.add(Checkbox::without_text(&mut is_shown));
            let eye = eye.accessible_name(format!("Show {name}"));
            let help = "Show or hide this part; a hidden part has no effect on the scene";
            if eye.on_hover_text(help).changed() {
                actions.push(Action::ShowPart(index, is_shown));
            }
            if ui.selectable_label(is_selected, name).clicked() {
                actions.push(Action::Select(Selection::Part(index)));
            }
            let counts = badges.of(index);
            if let Some(badge) = counts.badge() {
                let color = ui.visuals().warn_fg_color;
                let label = Label::new(RichText::new(badge).color(color)).extend();
                ui.add(label).on_hover_text(counts.details());
            }
            if let Selection::Cut(cut) = state.selection() {
                let timeline = state.shown().map(|shown| &shown.timeline);
                let all = timeline.into_iter().flat_map(|t| t.names_of(index));
                spared(ui, state, (cut, name), &all.collect::<Vec<_>>(), actions);
            }
        });
    }
    if badges.has_open() || state.shows_open_edges() {
        let mut shows = state.shows_open_edges();
        let help = "Show edges with an odd number of faces, including cut away and hidden ones";
        if ui
            .checkbox(&mut shows, "Open edges")
            .on_hover_text(help)
            .changed()
        {
            actions.push(Action::ShowOpenEdges(shows));
        }
    }
    if !solids.is_empty() {
        ui.collapsing(format!("{} solids", solids.len()), |ui| {
            for solid in solids {
                ui.horizontal(|ui| {
                    ui.label(solid);
                    if let Selection::Cut(cut) = state.selection() {
                        spared(ui, state, (cut, solid), &[solid], actions);
                    }
                });
            }
        });
    }
}

/// Button that makes the selected cut leave the parts that match a name uncut, or cut them again.
fn spared(
    ui: &mut Ui,
    state: &State,
    (cut, called): (usize, &str),
    parts: &[&str],
    actions: &mut Vec<Action>,
) {
    let path = format!("cut.{cut}.except");
    let held = state.document().get(&path).ok();
    let mut globs: Vec<String> = held
        .map_or(&[] as &[_], Node::items)
        .iter()
        .filter_map(Node::text)
        .map(str::to_owned)
        .collect();
    let is_listed = |part: &&str| globs.iter().any(|glob| glob == part);
    let is_spared = !parts.is_empty() && parts.iter().all(is_listed);
    let button = Button::selectable(is_spared, "spare").small();
    let help = "Exempt this part from the selected cut";
    let button = ui.add(button).on_hover_text(help);
    if button
        .accessible_name(format!("Spare {called} from this cut"))
        .clicked()
    {
        globs.retain(|glob| !parts.contains(&glob.as_str()));
        if !is_spared {
            globs.extend(parts.iter().map(|part| (*part).to_owned()));
        }
        actions.push(match globs.is_empty() {
            true => Action::Change(vec![(path, None)]),
            false => Action::Set {
                path,
                value: Value::from(globs),
            },
        });
    }
}

/// Makes a new plane perpendicular to the axis that is closest to the viewing direction.
fn across_the_eye(state: &State, new: NewCut) -> NewCut {
    let forward = state.shown().map(|shown| shown.view([64, 64]).forward);
    let axis = forward.map_or(0, |f| f.abs().max_position());
    match new {
        NewCut::Plane(_) => NewCut::Plane(axis),
        NewCut::Relief(_) => NewCut::Relief(axis),
        other => other,
    }
}
