//! The right panel: the values of the selected scene, cut or part.

use cutaway::scene::relief::Procedure;
use cutaway_io::document::{Value, hex, paths};
use eframe::egui::{ComboBox, Grid, ScrollArea, Slider, Ui};

use super::style;
use super::value::{control, text_edited};
use crate::action::{Action, Selection};
use crate::editing::cuts::{self, CutKind, PlaneMove};
use crate::editing::parts;
use crate::state::State;

/// Shows the panel.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    ScrollArea::vertical().show(ui, |ui| {
        match state.selection() {
            Selection::Scene => scene(ui, state, actions),
            Selection::Cut(index) => cut(ui, state, index, actions),
            Selection::Part(index) => part(ui, state, index, actions),
        }
        animate(ui, state, actions);
    });
}

/// A button that adds first keys to a scene without animation.
fn animate(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    if state.shown().is_none_or(|shown| shown.timeline.moves()) {
        return;
    }
    ui.separator();
    let help = match state.selection() {
        Selection::Scene => {
            "Add keys for the eye at 0 s and 2 s; then go to a time, move the eye and add a key"
        }
        Selection::Cut(_) => "Add keys for the cut at 0 s and 2 s; then go to a time and move it",
        Selection::Part(_) => {
            "Add keys for the part at 0 s and 2 s; then go to a time and move the part"
        }
    };
    if ui.button("Animate").on_hover_text(help).clicked() {
        actions.push(Action::Animate);
    }
}

fn scene(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    ui.heading("Scene");
    style::show(ui, state, actions);
    if let Some(shown) = state.shown() {
        let faces: usize = shown
            .scene
            .parts
            .iter()
            .map(|p| p.mesh.triangles.len())
            .sum();
        let parts = shown.scene.parts.len();
        ui.label(format!("{faces} faces in {parts} parts"));
        for note in shown.timeline.notes() {
            ui.weak(note.to_string());
        }
    }
}

fn part(ui: &mut Ui, state: &State, index: usize, actions: &mut Vec<Action>) {
    ui.heading("Part");
    let entries = state.document().root().get("part");
    let Some(entry) = entries.and_then(|parts| parts.items().get(index)) else {
        return;
    };
    ui.label(parts::name(index, entry));
    let part = state.shown().and_then(|shown| {
        let first = shown.timeline.names_of(index).next()?;
        shown.scene.parts.iter().find(|part| part.name == first)
    });
    let colors = part.map(|part| [part.material.color, part.material.cap_color()]);
    Grid::new("numbers of the part")
        .num_columns(2)
        .show(ui, |ui| {
            let mut of = |key: &str, label: &str, usual: Value| {
                let (path, pattern) = (format!("part.{index}.{key}"), format!("part.*.{key}"));
                control(ui, state, (&path, &pattern), (label, usual), actions);
            };
            if let Some([color, cap]) = colors {
                of("material.color", "Colour", hex(color).into());
                of("material.cap_color", "Colour of caps", hex(cap).into());
            }
            of("material.hatch", "Hatch", "general".into());
            of("priority", "Priority", 0_i64.into());
            of("role", "Role", "exterior".into());
            of("fill", "Fill", "even-odd".into());
        });
}

fn cut(ui: &mut Ui, state: &State, index: usize, actions: &mut Vec<Action>) {
    let all = state.cuts();
    let Some(cut) = all.get(index) else {
        return;
    };
    ui.heading(format!("Cut: {}", cut.kind.name()));
    ui.horizontal(|ui| {
        if ui.button("Duplicate").clicked() {
            actions.push(Action::Duplicate(index));
        }
        if ui.button("Remove").clicked() {
            actions.push(Action::Remove(index));
        }
    });
    ui.horizontal(|ui| {
        ui.label("Name");
        if let Some(name) = text_edited(ui, &cut.name, "Name of the cut") {
            let path = format!("cut.{index}.name");
            actions.push(Action::Set { path, value: name });
        }
    });
    match cut.kind {
        CutKind::Plane | CutKind::Relief | CutKind::Surfaces => {
            plane(ui, state, index, actions);
            relief(ui, state, index, actions);
        }
        kind => others(ui, state, (index, kind), actions),
    }
}

fn plane(ui: &mut Ui, state: &State, index: usize, actions: &mut Vec<Action>) {
    let bounds = state.bounds();
    let Ok((normal, origin)) = cuts::plane(state.posed(), index, &bounds) else {
        ui.weak("This surface can only be edited in the scene file.");
        return;
    };
    ui.separator();
    let ends = bounds.corners().map(|corner| corner.dot(normal));
    let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let most = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // If the model has no extent along the normal, the plane cannot move.
    if most > least {
        let percent_at = (origin.dot(normal) - least) / (most - least) * 100.0;
        // Round as the slider does; otherwise the slider would report a change.
        let was = (percent_at.clamp(0.0, 100.0) * 100.0).round() / 100.0;
        let mut percent = was;
        let slider = Slider::new(&mut percent, 0.0..=100.0).text("Position %");
        let is_moved = ui.add(slider.max_decimals(2)).changed();
        if is_moved && (percent - was).abs() > 1e-9 {
            let by = (percent - percent_at) / 100.0 * (most - least);
            actions.push(Action::MovePlane(PlaneMove::Along(by)));
        }
    }
    ui.horizontal(|ui| {
        for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
            let button = ui
                .button(letter)
                .on_hover_text("Plane perpendicular to this axis; click again for the other side");
            if button.clicked() {
                actions.push(Action::MovePlane(PlaneMove::Across(axis)));
            }
        }
        if ui
            .button("Flip")
            .on_hover_text("Keep the other side")
            .clicked()
        {
            actions.push(Action::MovePlane(PlaneMove::Flip));
        }
        if ui
            .button("Face me")
            .on_hover_text("Turn the plane to face you")
            .clicked()
        {
            actions.push(Action::FaceEye);
        }
    });
    let path = format!("cut.{index}.surfaces.0.section");
    let section = state
        .document()
        .get(&path)
        .ok()
        .and_then(|n| n.text().map(str::to_owned));
    if let Some(section) = section {
        ui.horizontal(|ui| {
            ui.label("Section");
            if let Some(value) = text_edited(ui, &section, "Section") {
                actions.push(Action::Set { path, value });
            }
        });
    }
}

fn relief(ui: &mut Ui, state: &State, index: usize, actions: &mut Vec<Action>) {
    ui.separator();
    let surface = format!("cut.{index}.surfaces.0");
    let text = |path: &str| {
        state
            .document()
            .get(path)
            .ok()
            .and_then(|n| n.text().map(str::to_owned))
    };
    let name = text(&format!("{surface}.relief"));
    let kind = (name.as_ref())
        .map(|name| text(&format!("relief.{name}.kind")).unwrap_or_else(|| "image".to_owned()));
    let shown = kind.as_deref().unwrap_or("none");
    ComboBox::new("relief", "Relief")
        .selected_text(shown)
        .show_ui(ui, |ui| {
            if ui.selectable_label(kind.is_none(), "none").clicked() && kind.is_some() {
                let keys = ["relief", "spin_deg", "amplitude", "period", "wrap"];
                let gone = keys.map(|key| (format!("{surface}.{key}"), None));
                actions.push(Action::Change(gone.into()));
            }
            for word in Procedure::NAMES {
                if ui.selectable_label(shown == word, word).clicked() && shown != word {
                    put_relief(state, index, name.as_deref(), word, actions);
                }
            }
        });
    let (Some(name), Some(kind)) = (name, kind) else {
        return;
    };
    Grid::new("numbers of the relief")
        .num_columns(2)
        .show(ui, |ui| {
            for (key, label, usual) in [
                ("amplitude", "Amplitude", "6%".into()),
                ("period", "Period", "40%".into()),
                ("wrap", "Wrap", "repeat".into()),
                ("spin_deg", "Spin", Value::from(0.0)),
            ] {
                let (path, pattern) = (
                    format!("{surface}.{key}"),
                    format!("cut.*.surfaces.*.{key}"),
                );
                control(ui, state, (&path, &pattern), (label, usual), actions);
            }
            let own = Procedure::named(&kind).map(|p| paths::values(&p, "relief"));
            for (held, usual) in own.into_iter().flatten() {
                let key = held.trim_start_matches("relief.");
                let path = format!("relief.{name}.{key}");
                let pattern = format!("relief.*.{key}");
                control(ui, state, (&path, &pattern), (key, usual), actions);
            }
        });
}

/// Changes the kind of a surface's relief, or gives the surface a new relief if it has none.
fn put_relief(
    state: &State,
    index: usize,
    name: Option<&str>,
    kind: &str,
    actions: &mut Vec<Action>,
) {
    let root = state.document().root();
    let is_taken = |name: &str| root.get("relief").is_some_and(|r| r.get(name).is_some());
    let mut numbered = (2..).map(|n| format!("{kind}_{n}"));
    let free = match is_taken(kind) {
        true => numbered.find(|n| !is_taken(n)).unwrap_or_default(),
        false => kind.to_owned(),
    };
    let of = name.map_or(free, str::to_owned);
    // The whole table is replaced, because values that only the other kind has would be refused.
    let table = Value::from([("kind", Value::from(kind))]);
    let mut changes = vec![(format!("relief.{of}"), Some(table))];
    if name.is_none() {
        let surface = format!("cut.{index}.surfaces.0.relief");
        changes.push((surface, Some(of.into())));
    }
    actions.push(Action::Change(changes));
}

fn others(ui: &mut Ui, state: &State, (index, kind): (usize, CutKind), actions: &mut Vec<Action>) {
    ui.separator();
    let keys: &[(&str, &str, Value)] = &match kind {
        CutKind::Box => vec![
            ("box.min", "Least corner", "".into()),
            ("box.max", "Greatest corner", "".into()),
        ],
        CutKind::Wedge => vec![
            ("wedge.from_deg", "From", 0.0.into()),
            ("wedge.to_deg", "To", 90.0.into()),
        ],
        CutKind::Cutout => vec![("cutout.angle_deg", "Angle", 110.0.into())],
        CutKind::Breakaway => vec![
            ("breakaway.distance", "Distance", "1%".into()),
            ("breakaway.bevel_deg", "Bevel", 0.0.into()),
        ],
        _ => Vec::new(),
    };
    Grid::new("numbers of the cut")
        .num_columns(2)
        .show(ui, |ui| {
            for (key, label, usual) in keys {
                let (path, pattern) = (format!("cut.{index}.{key}"), format!("cut.*.{key}"));
                control(
                    ui,
                    state,
                    (&path, &pattern),
                    (label, usual.clone()),
                    actions,
                );
            }
        });
}
