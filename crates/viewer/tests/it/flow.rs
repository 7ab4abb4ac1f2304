//! Goes from an empty window to a saved scene, finding all controls by their labels.

use cutaway_io::Document;
use cutaway_io::load::Assets;
use cutaway_viewer::cuts::NewCut;
use cutaway_viewer::slot::SlotSide;
use cutaway_viewer::ui::Viewer;
use cutaway_viewer::{Action, State};
use eframe::egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use image::RgbaImage;

use super::common::{self, Scratch, TORUS, act, classify, state, viewer};

fn click(harness: &mut Harness<'_, Viewer>, role: Role, label: &str) {
    harness.get_by_role_and_label(role, label).click();
    classify(harness);
}

fn choose(harness: &mut Harness<'_, Viewer>, combo: &str, choice: &str) {
    harness.get_by_role_and_label(Role::ComboBox, combo).click();
    classify(harness);
    // Clicked as by a screen reader, because a pointer would have to scroll.
    harness.get_by_label(choice).click_accesskit();
    classify(harness);
    // Such a click leaves the list open.
    harness.key_press(eframe::egui::Key::Escape);
    classify(harness);
}

fn picture(harness: &Harness<'_, Viewer>, side: SlotSide) -> RgbaImage {
    common::pixels(harness, side)
}

/// Number of pixels that differ.
fn apart(a: &RgbaImage, b: &RgbaImage) -> usize {
    assert_eq!(a.dimensions(), b.dimensions(), "pictures of one view");
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

fn section(harness: &Harness<'_, Viewer>) -> String {
    let document = harness.state().state().document();
    let node = document.get("cut.0.surfaces.0.section").unwrap();
    node.text().unwrap().to_owned()
}

#[test]
fn a_model_is_cut_tilted_made_ragged_compared_saved_and_taken_back() {
    let mut harness = viewer(state(TORUS));
    let uncut = picture(&harness, SlotSide::A);
    click(&mut harness, Role::Button, "Plane");
    let cut = picture(&harness, SlotSide::A);
    assert!(apart(&uncut, &cut) > 2_000, "a half is gone");
    assert!(section(&harness).ends_with("=50%"), "{}", section(&harness));

    let slider = harness.get_by_role_and_label(Role::Slider, "Position %");
    slider.set_value_accesskit(70.0);
    classify(&mut harness);
    let moved = section(&harness);
    assert!(moved.ends_with("70%") || moved.ends_with("30%"), "{moved}");
    click(&mut harness, Role::Button, "Face me");
    assert!(section(&harness).contains('@'), "{}", section(&harness));
    let tilted = picture(&harness, SlotSide::A);
    assert!(apart(&cut, &tilted) > 500, "another cap");

    choose(&mut harness, "Relief", "fractal");
    let ragged = picture(&harness, SlotSide::A);
    assert!(apart(&tilted, &ragged) > 500, "a ragged cap");
    let document = harness.state().state().document().clone();
    assert!(document.get("relief.fractal.kind").is_ok(), "{document}");

    // A is exact; B is the paper's path on a coarse grid.
    click(&mut harness, Role::Button, "Wipe");
    choose(&mut harness, "Slot B", "grid:256+vds:1024");
    click(&mut harness, Role::CheckBox, "Errors");
    let [a, b] = SlotSide::BOTH.map(|side| {
        let (counts, divisor) = harness.state().errors(side).unwrap();
        assert_eq!(divisor, 1, "{side}: at the resolution of the window");
        (counts.decided_wrong_px, counts.wrong_px())
    });
    assert_eq!(a.0, 0, "auto is exact");
    assert!(b.1 > a.1, "the paper's path is not: {a:?}, {b:?}");
    harness.get_by_label_contains("A: auto: 0 px decided wrong");

    let scratch = Scratch::new();
    let path = scratch.path("scene.toml");
    click(&mut harness, Role::Button, "File");
    click(&mut harness, Role::Button, "Save scene ...");
    let field = harness.get_by_role_and_label(Role::TextInput, "File name");
    field.focus();
    classify(&mut harness);
    harness.key_press_modifiers(eframe::egui::Modifiers::COMMAND, eframe::egui::Key::A);
    let field = harness.get_by_role_and_label(Role::TextInput, "File name");
    field.type_text(path.to_str().unwrap());
    classify(&mut harness);
    click(&mut harness, Role::Button, "Save");
    let saved = Document::read(&path).unwrap();
    let reopened = viewer(State::open(saved, Assets::default()).unwrap());
    let again = picture(&reopened, SlotSide::A);
    assert_eq!(apart(&ragged, &again), 0, "the same picture from the file");
}

#[test]
fn steps_are_taken_back_and_done_again_and_a_drag_is_one() {
    let mut harness = viewer(state(TORUS));
    click(&mut harness, Role::Button, "Plane");
    let first = section(&harness);
    for percent in [52.0, 55.0, 60.0] {
        let slider = harness.get_by_role_and_label(Role::Slider, "Position %");
        slider.set_value_accesskit(percent);
        classify(&mut harness);
    }
    let moved = section(&harness);
    assert_ne!(first, moved, "the slider moves the plane");
    click(&mut harness, Role::Button, "Undo");
    assert_eq!(section(&harness), first, "three moves of one slider");
    click(&mut harness, Role::Button, "Redo");
    assert_eq!(section(&harness), moved, "done again");
    click(&mut harness, Role::Button, "Undo");
    click(&mut harness, Role::Button, "Undo");
    assert!(harness.state().state().cuts().is_empty(), "no cut is left");
}

#[test]
fn slots_show_the_reference_and_the_difference() {
    let mut harness = viewer(state(TORUS));
    click(&mut harness, Role::Button, "Plane");
    choose(&mut harness, "Slot B", "exact");
    click(&mut harness, Role::Button, "Side by side");
    let [a, b] = SlotSide::BOTH.map(|side| picture(&harness, side));
    assert_eq!(a.dimensions(), b.dimensions(), "halves of the window");
    let share = apart(&a, &b) as f64 / f64::from(a.width() * a.height());
    assert!(share < 0.01, "{share} of the pixels differ");
    click(&mut harness, Role::Button, "Difference");
    assert!(
        harness.state().screen().difference().is_some(),
        "it is drawn"
    );
}

#[test]
fn what_is_only_looked_at_does_not_change() {
    let mut state = state(TORUS);
    state.apply(Action::Add(NewCut::Plane(2)));
    // This number has more digits than the slider shows.
    let path = "cut.0.surfaces.0.section".to_owned();
    let value = "z=0.123456".into();
    state.apply(Action::Set { path, value });
    let before = state.document().clone();
    let harness = viewer(state);
    assert_eq!(*harness.state().state().document(), before);
}

#[test]
fn a_relief_is_put_on_and_taken_off_in_one_step_each() {
    let mut harness = viewer(state(TORUS));
    click(&mut harness, Role::Button, "Plane");
    let plain = harness.state().state().document().clone();
    choose(&mut harness, "Relief", "cracks");
    let ragged = harness.state().state().document().clone();
    assert_ne!(plain, ragged);
    let amplitude = "cut.0.surfaces.0.amplitude";
    act(
        &mut harness,
        Action::Set {
            path: amplitude.to_owned(),
            value: "3%".into(),
        },
    );
    choose(&mut harness, "Relief", "none");
    let surface = |harness: &Harness<'_, Viewer>| {
        harness
            .state()
            .state()
            .document()
            .get("cut.0.surfaces.0")
            .unwrap()
            .clone()
    };
    assert_eq!(surface(&harness), *plain.get("cut.0.surfaces.0").unwrap());
    for _ in 0..3 {
        click(&mut harness, Role::Button, "Undo");
    }
    assert_eq!(
        harness.state().state().document().root().get("cut"),
        plain.root().get("cut")
    );
}

#[test]
fn time_passes_until_it_is_stopped() {
    let text = "[[part]]\nname = \"box\"\nshape = \"cube\"\ntranslate = [0, 0, 0]\n\n[[key]]\ntarget = \"part.box.translate\"\ntimes_s = [0, 1]\nvalues = [[0, 0, 0], [1, 0, 0]]\n";
    let document = Document::parse("moving.toml", text).unwrap();
    let mut harness = viewer(State::open(document, Assets::default()).unwrap());
    harness.get_by_role_and_label(Role::Button, "Play").click();
    harness.step();
    let times: Vec<Option<f64>> = (0..3)
        .map(|_| {
            harness.step();
            harness.state().state().time_s()
        })
        .collect();
    assert!(
        times[0] != times[1] && times[1] != times[2],
        "it goes on: {times:?}"
    );
    harness.get_by_role_and_label(Role::Button, "Pause").click();
    classify(&mut harness);
    let stopped = harness.state().state().time_s();
    classify(&mut harness);
    assert_eq!(harness.state().state().time_s(), stopped);
}
