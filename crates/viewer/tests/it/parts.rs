//! Parts are hidden and shown, and values of a style are changed and reset.

use cutaway_io::Document;
use cutaway_io::load::Assets;
use cutaway_viewer::Action;
use cutaway_viewer::State;
use cutaway_viewer::action::Selection;
use cutaway_viewer::slot::SlotSide;
use cutaway_viewer::ui::Viewer;
use eframe::egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use super::common::{act, classify, pixels, viewer};

const TWO: &str = "[[part]]\nname = \"block\"\nshape = \"cube\"\n\n[[part]]\nname = \"ball\"\nshape = \"sphere?subdivisions=2\"\ntranslate = [2, 0, 0]\n\n[[cut]]\nsurfaces = [{ section = \"z=60%\" }]\n";

fn open(text: &str) -> State {
    let document = Document::parse("two.toml", text).unwrap();
    State::open(document, Assets::default()).unwrap()
}

fn names(harness: &Harness<'_, Viewer>) -> Vec<String> {
    let scene = &harness.state().state().shown().unwrap().scene;
    scene.parts.iter().map(|p| p.name.clone()).collect()
}

#[test]
fn a_part_is_hidden_in_the_picture_and_in_the_command_and_shown_again() {
    let mut harness = viewer(open(TWO));
    let picture = |harness: &Harness<'_, Viewer>| pixels(harness, SlotSide::A);
    let before = (
        harness.state().state().document().clone(),
        picture(&harness),
    );
    let eye = |harness: &mut Harness<'_, Viewer>, name: &str| {
        harness
            .get_by_role_and_label(Role::CheckBox, &format!("Show {name}"))
            .click();
        classify(harness);
    };
    eye(&mut harness, "ball");
    assert_eq!(names(&harness), ["block"]);
    assert_ne!(picture(&harness), before.1, "the ball is gone");
    let command = harness.state().state().command([64, 48]).unwrap();
    assert!(command.contains("part.1.enabled=false"), "{command}");
    // Hiding the last part is refused, with a reason.
    eye(&mut harness, "block");
    assert_eq!(names(&harness), ["block"]);
    harness.get_by_label_contains("no part is enabled");
    eye(&mut harness, "ball");
    assert_eq!(names(&harness), ["block", "ball"]);
    assert_eq!(*harness.state().state().document(), before.0, "as it was");
}

#[test]
fn a_part_is_spared_from_the_list_whatever_it_is_made_of() {
    let text = "[[part]]\nname = \"drive\"\nshape = \"gears\"\n\n[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n";
    let mut harness = viewer(open(text));
    assert!(names(&harness).len() > 1, "a shape of several solids");
    act(&mut harness, Action::Select(Selection::Cut(0)));
    harness.get_by_label("Spare drive from this cut").click();
    classify(&mut harness);
    let except = |harness: &Harness<'_, Viewer>| {
        let scene = &harness.state().state().shown().unwrap().scene;
        let mut names = scene.cuts[0].except.clone();
        names.sort();
        names
    };
    let mut all = names(&harness);
    all.sort();
    assert_eq!(except(&harness), all);
    harness.get_by_label("Spare drive from this cut").click();
    classify(&mut harness);
    assert!(except(&harness).is_empty(), "and none again");
}

#[test]
fn numbers_of_a_style_are_changed_and_taken_back() {
    let mut state = open(&format!("style = \"drafting\"\n{TWO}"));
    state.apply(Action::Select(Selection::Scene));
    let mut harness = viewer(state);
    let before = harness.state().state().document().clone();
    let own = harness.state().state().shown().unwrap().scene.style;
    for group in ["Numbers of the style", "strokes"] {
        harness.get_by_label(group).click_accesskit();
        classify(&mut harness);
    }
    let number = harness.get_by_label("cut of style.strokes.cut");
    number.set_value_accesskit(7.5);
    classify(&mut harness);
    let style =
        |harness: &Harness<'_, Viewer>| harness.state().state().shown().unwrap().scene.style;
    assert_eq!(style(&harness).strokes.cut, 7.5);
    assert_eq!(
        style(&harness).strokes.outline,
        own.strokes.outline,
        "of the style"
    );
    let named = harness
        .state()
        .state()
        .document()
        .get("style.base")
        .unwrap();
    assert_eq!(named.text(), Some("drafting"));
    harness
        .get_by_label("Reset style.strokes.cut")
        .click_accesskit();
    classify(&mut harness);
    assert_eq!(style(&harness), own);
    let after = harness.state().state().document();
    assert_eq!(after.root().get("style"), before.root().get("style"));
}

#[test]
fn a_part_with_holes_has_a_badge_and_its_open_edges_are_drawn() {
    let text = format!(
        "{}defects = [{{ kind = \"holes\", amount = \"5%\", seed = 1 }}]\n",
        TWO.split("\n[[cut]]").next().unwrap()
    );
    let mut harness = viewer(open(&text));
    harness.get_by_label_contains("open: ");
    assert_eq!(
        harness.query_all_by_label_contains("open: ").count(),
        1,
        "the block is sound"
    );
    let lines = |harness: &Harness<'_, Viewer>| {
        let color = eframe::egui::Color32::from_rgb(255, 0, 170);
        let is_edge = |shape: &eframe::egui::Shape| matches!(shape, eframe::egui::Shape::LineSegment { stroke, .. } if stroke.color == color);
        let shapes = harness.output().shapes.iter();
        shapes.filter(|clipped| is_edge(&clipped.shape)).count()
    };
    assert_eq!(lines(&harness), 0);
    harness
        .get_by_role_and_label(Role::CheckBox, "Open edges")
        .click();
    classify(&mut harness);
    let scene = &harness.state().state().shown().unwrap().scene;
    let open: usize = scene.parts.iter().map(|p| p.mesh.open_edges().len()).sum();
    assert!(open > 0, "holes have edges");
    assert_eq!(lines(&harness), open);
}
