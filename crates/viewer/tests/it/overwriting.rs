//! No file is replaced without confirmation, and no input of the scene is ever replaced.

use std::fs;
use std::path::{Path, PathBuf};

use cutaway_io::Document;
use cutaway_io::document::part;
use cutaway_io::load::Assets;
use cutaway_viewer::cuts::NewCut;
use cutaway_viewer::ui::Viewer;
use cutaway_viewer::{Action, State};
use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use super::common::{Scratch, act, classify, viewer};

const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const OTHER: &str = "[[part]]\nshape = \"cube\"\n";

/// A state with a mesh and a plane cut.
fn cut(mesh: &Path) -> State {
    fs::write(mesh, MESH).unwrap();
    let mut document = Document::new();
    document.add_part(part(mesh.to_str().unwrap())).unwrap();
    let mut state = State::open(document, Assets::default()).unwrap();
    state.apply(Action::Add(NewCut::Plane(2)));
    state
}

/// Opens the dialog that asks for a file name, and types a name. Returns the name that the dialog suggested.
fn name(harness: &mut Harness<'_, Viewer>, entry: &str, path: &Path) -> String {
    click(harness, "File");
    click(harness, entry);
    let field = harness.get_by_role_and_label(Role::TextInput, "File name");
    let before = field.value().unwrap_or_default();
    field.focus();
    classify(harness);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    let field = harness.get_by_role_and_label(Role::TextInput, "File name");
    field.type_text(path.to_str().unwrap());
    classify(harness);
    before
}

fn click(harness: &mut Harness<'_, Viewer>, label: &str) {
    harness.get_by_role_and_label(Role::Button, label).click();
    classify(harness);
}

fn asks(harness: &Harness<'_, Viewer>) -> bool {
    harness
        .query_by_label_contains("is there already")
        .is_some()
}

#[test]
fn a_scene_is_saved_beside_its_mesh_and_replaces_another_only_when_agreed() {
    let scratch = Scratch::new();
    let [mesh, other] = ["b.obj", "other.toml"].map(|name| scratch.path(name));
    fs::write(&other, OTHER).unwrap();
    let mut harness = viewer(cut(&mesh));
    let prefilled = name(&mut harness, "Save scene ...", &mesh);
    assert_eq!(PathBuf::from(prefilled), scratch.path("b.toml"));
    click(&mut harness, "Save");
    assert_eq!(fs::read_to_string(&mesh).unwrap(), MESH);
    assert!(
        scratch.path("b.obj.toml").is_file(),
        "a scene has its ending"
    );

    let mut harness = viewer(cut(&mesh));
    name(&mut harness, "Save scene ...", &other);
    click(&mut harness, "Save");
    assert!(asks(&harness), "it belongs to somebody");
    assert_eq!(fs::read_to_string(&other).unwrap(), OTHER);
    click(&mut harness, "Cancel");
    assert_eq!(fs::read_to_string(&other).unwrap(), OTHER);
    // The same file, by a path through a folder that does not exist.
    name(
        &mut harness,
        "Save scene ...",
        &scratch.path("no/../other.toml"),
    );
    click(&mut harness, "Save");
    assert!(asks(&harness), "it is the same file");
    click(&mut harness, "Replace");
    assert!(!asks(&harness), "agreed");
    let saved = fs::read_to_string(&other).unwrap();
    assert!(saved.contains("[[cut]]"), "{saved}");
    // This is now the scene's own file.
    act(&mut harness, Action::Add(NewCut::Plane(0)));
    name(&mut harness, "Save scene ...", &other);
    click(&mut harness, "Save");
    assert!(!asks(&harness), "it is its own");
    assert_eq!(
        fs::read_to_string(&other)
            .unwrap()
            .matches("[[cut]]")
            .count(),
        2
    );
    // Another program then changes the file.
    fs::write(&other, OTHER).unwrap();
    act(&mut harness, Action::Add(NewCut::Plane(1)));
    name(&mut harness, "Save scene ...", &other);
    click(&mut harness, "Save");
    assert!(asks(&harness), "it says something else by now");
}

#[test]
fn an_export_replaces_a_file_only_when_agreed() {
    let scratch = Scratch::new();
    let [mesh, picture] = ["b.obj", "cut.png"].map(|name| scratch.path(name));
    fs::write(&picture, "mine").unwrap();
    let mut harness = viewer(cut(&mesh));
    name(&mut harness, "Export ...", &picture);
    click(&mut harness, "Export");
    assert!(asks(&harness), "it belongs to somebody");
    click(&mut harness, "Cancel");
    assert_eq!(fs::read_to_string(&picture).unwrap(), "mine");
}

#[test]
fn no_input_of_the_scene_is_ever_replaced() {
    let scratch = Scratch::new();
    let [mesh, relief] = ["b.toml", "r.png"].map(|name| scratch.path(name));
    let state = cut(&scratch.path("b.obj"));
    fs::hard_link(scratch.path("b.obj"), &mesh).unwrap();
    image::GrayImage::new(4, 4).save(&relief).unwrap();
    let image = fs::read(&relief).unwrap();
    let mut harness = viewer(state);
    act(&mut harness, Action::Take(vec![relief.clone()]));
    act(&mut harness, Action::SaveOver(mesh.clone()));
    harness.get_by_label_contains("it is an input of the scene");
    assert_eq!(fs::read_to_string(&mesh).unwrap(), MESH);
    name(&mut harness, "Export ...", &scratch.path("no/../r.png"));
    click(&mut harness, "Export");
    assert!(!asks(&harness), "it is refused");
    assert_eq!(fs::read(&relief).unwrap(), image);
}
