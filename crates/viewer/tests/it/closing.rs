//! A window with unsaved changes asks before it closes, and opened files appear in the list of recent files.

use std::fs;

use cutaway_io::Document;
use cutaway_io::load::Assets;
use cutaway_viewer::camera::CameraMove;
use cutaway_viewer::cuts::NewCut;
use cutaway_viewer::recent::Recent;
use cutaway_viewer::ui::Viewer;
use cutaway_viewer::{Action, State};
use eframe::egui::accesskit::Role;
use eframe::egui::{ViewportCommand, ViewportEvent, ViewportId};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::DVec2;

use super::common::{Scratch, TORUS, act, classify, state, viewer};

/// Requests that the window close, and returns the commands with which it responds.
fn close(harness: &mut Harness<'_, Viewer>) -> Vec<ViewportCommand> {
    let root = harness
        .input_mut()
        .viewports
        .entry(ViewportId::ROOT)
        .or_default();
    root.events.push(ViewportEvent::Close);
    harness.step();
    let root = harness
        .input_mut()
        .viewports
        .entry(ViewportId::ROOT)
        .or_default();
    root.events.clear();
    let said = said(harness);
    classify(harness);
    said
}

fn said(harness: &Harness<'_, Viewer>) -> Vec<ViewportCommand> {
    harness.output().viewport_output[&ViewportId::ROOT]
        .commands
        .clone()
}

fn click(harness: &mut Harness<'_, Viewer>, label: &str) -> Vec<ViewportCommand> {
    harness.get_by_role_and_label(Role::Button, label).click();
    let mut all = Vec::new();
    for _ in 0..3 {
        harness.step();
        all.extend(said(harness));
    }
    classify(harness);
    all
}

#[test]
fn changes_are_saved_discarded_or_kept_open() {
    let scratch = Scratch::new();
    let path = scratch.path("scene.toml");
    fs::write(&path, "[[part]]\nshape = \"cube\"\n").unwrap();
    let open = || {
        let document = Document::read(&path).unwrap();
        viewer(State::open(document, Assets::default()).unwrap())
    };
    let mut harness = open();
    act(
        &mut harness,
        Action::MoveCamera(CameraMove::Orbit(DVec2::new(20.0, 0.0))),
    );
    assert!(
        close(&mut harness).is_empty(),
        "who has only looked is not asked"
    );

    act(&mut harness, Action::Add(NewCut::Plane(2)));
    let asked = [ViewportCommand::CancelClose];
    assert_eq!(close(&mut harness), asked);
    assert!(click(&mut harness, "Cancel").is_empty());
    assert!(harness.query_by_label("Discard").is_none(), "it is gone");
    assert_eq!(close(&mut harness), asked, "and asks again");
    assert_eq!(click(&mut harness, "Discard"), [ViewportCommand::Close]);
    assert!(close(&mut harness).is_empty(), "it may go");
    assert!(
        !fs::read_to_string(&path).unwrap().contains("cut"),
        "discarded"
    );

    let mut harness = open();
    act(&mut harness, Action::Add(NewCut::Plane(2)));
    assert_eq!(close(&mut harness), asked);
    assert_eq!(click(&mut harness, "Save"), [ViewportCommand::Close]);
    assert!(
        fs::read_to_string(&path).unwrap().contains("[[cut]]"),
        "saved"
    );
}

#[test]
fn a_scene_without_a_file_is_closed_when_it_has_one() {
    let scratch = Scratch::new();
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(2)));
    close(&mut harness);
    assert!(click(&mut harness, "Save").is_empty(), "it has no name yet");
    let path = scratch.path("new.toml");
    harness.state_mut().apply(Action::Save(path.clone()));
    harness.step();
    assert_eq!(said(&harness), [ViewportCommand::Close]);
    assert!(path.exists(), "saved");
    assert!(
        close(&mut harness).is_empty(),
        "nothing is left to be saved"
    );
}

#[test]
fn recent_files_are_opened_and_dropped_when_they_are_gone() {
    let scratch = Scratch::new();
    let (first, second) = (scratch.path("first.toml"), scratch.path("second.toml"));
    for (path, shape) in [(&first, "cube"), (&second, "torus")] {
        fs::write(path, format!("[[part]]\nshape = \"{shape}\"\n")).unwrap();
    }
    let list = scratch.path("recent");
    let document = Document::read(&first).unwrap();
    let mut harness = viewer(State::open(document, Assets::default()).unwrap());
    harness.state_mut().remember_in(Recent::read(&list));
    classify(&mut harness);
    act(&mut harness, Action::Take(vec![second.clone()]));
    let written = || fs::read_to_string(&list).unwrap();
    let lines = |paths: &[&std::path::PathBuf]| -> String {
        paths.iter().map(|p| format!("{}\n", p.display())).collect()
    };
    assert_eq!(written(), lines(&[&second, &first]));

    let choose = |harness: &mut Harness<'_, Viewer>, path: &std::path::Path| {
        click(harness, "File");
        click(harness, "Recent");
        click(harness, &path.display().to_string());
    };
    choose(&mut harness, &first);
    assert_eq!(harness.state().state().document().path(), first);
    assert_eq!(written(), lines(&[&first, &second]));
    harness.key_press(eframe::egui::Key::Escape);
    classify(&mut harness);
    fs::remove_file(&second).unwrap();
    choose(&mut harness, &second);
    assert_eq!(
        harness.state().state().document().path(),
        first,
        "still there"
    );
    harness.get_by_label_contains("it is not there any more");
    assert_eq!(written(), lines(&[&first]));
}

#[test]
fn another_scene_is_opened_when_changes_are_discarded() {
    let scratch = Scratch::new();
    let path = scratch.path("other.toml");
    fs::write(&path, "[[part]]\nshape = \"cube\"\n").unwrap();
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(2)));
    let mut open = |answer: &str| {
        click(&mut harness, "File");
        click(&mut harness, "Open ...");
        let field = harness.get_by_role_and_label(Role::TextInput, "File name");
        field.focus();
        harness.step();
        let field = harness.get_by_role_and_label(Role::TextInput, "File name");
        field.type_text(path.to_str().unwrap());
        harness.step();
        click(&mut harness, "Open");
        click(&mut harness, answer);
        harness.state().state().document().to_string()
    };
    assert!(open("Cancel").contains("torus"), "it was left all the same");
    assert!(open("Discard").contains("cube"), "it was not opened");
}
