//! Scenes are animated, and keys are added, dragged and deleted; each change is one undo step.

use cutaway_io::Document;
use cutaway_io::load::Assets;
use cutaway_viewer::action::Selection;
use cutaway_viewer::camera::CameraMove;
use cutaway_viewer::cuts::{NewCut, PlaneMove, plane};
use cutaway_viewer::timeline::tracks;
use cutaway_viewer::ui::Viewer;
use cutaway_viewer::{Action, State};
use eframe::egui::{PointerButton, Vec2, accesskit::Role};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::DVec2;

use super::common::{TORUS, act, classify, drag, state, viewer};

const MOVING: &str = "[[part]]\nname = \"box\"\nshape = \"cube\"\ntranslate = [0, 0, 0]\n\n[[key]]\ntarget = \"part.box.translate\"\ntimes_s = [0, 1, 4]\nvalues = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\n";

fn moving() -> State {
    let document = Document::parse("moving.toml", MOVING).unwrap();
    State::open(document, Assets::default()).unwrap()
}

fn times(state: &State, row: usize) -> Vec<f64> {
    tracks(state.document())[row].times_s.clone()
}

fn click(harness: &mut Harness<'_, Viewer>, label: &str) {
    harness.get_by_role_and_label(Role::Button, label).click();
    classify(harness);
}

#[test]
fn a_cut_begins_to_move_and_is_where_it_was_put_at_each_time() {
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(0)));
    act(&mut harness, Action::MovePlane(PlaneMove::Across(2)));
    let before = harness.state().state().document().clone();
    click(&mut harness, "Animate");
    assert_eq!(times(harness.state().state(), 0), [0.0, 2.0]);
    assert!(harness.query_by_label("Animate").is_none(), "it moves");
    harness.get_by_role_and_label(Role::Button, "Play");

    let bounds = harness.state().state().bounds();
    let offset = |harness: &Harness<'_, Viewer>| {
        let (normal, origin) = plane(harness.state().state().posed(), 0, &bounds).unwrap();
        origin.dot(normal)
    };
    let rest = offset(&harness);
    act(&mut harness, Action::Seek(2.0));
    act(&mut harness, Action::MovePlane(PlaneMove::Along(0.2)));
    let surface = |harness: &Harness<'_, Viewer>| {
        let shown = harness.state().state().shown().unwrap();
        let surface = &shown.scene.cuts[0].surfaces[0];
        surface.origin.dot(surface.frame().normal)
    };
    assert!((offset(&harness) - rest - 0.2).abs() < 1e-6, "at its end");
    assert!(
        (surface(&harness) - offset(&harness)).abs() < 1e-9,
        "as it is drawn"
    );
    act(&mut harness, Action::Seek(1.0));
    assert!((offset(&harness) - rest - 0.1).abs() < 1e-6, "halfway");
    act(&mut harness, Action::Seek(0.0));
    assert!((offset(&harness) - rest).abs() < 1e-6, "at its beginning");

    act(&mut harness, Action::Seek(0.5));
    click(&mut harness, "Add key here");
    assert_eq!(times(harness.state().state(), 0), [0.0, 0.5, 2.0]);
    let command = harness.state().state().command([64, 48]).unwrap();
    assert!(command.contains("key"), "{command}");
    for _ in 0..4 {
        click(&mut harness, "Undo");
    }
    let cut = |document: &Document| document.root().get("cut").cloned();
    act(&mut harness, Action::Redo);
    let after = harness.state().state().document().clone();
    assert_eq!(cut(&after), cut(&before), "a section again");
}

#[test]
fn keys_are_gone_to_dragged_and_deleted_by_hand() {
    let mut harness = viewer(moving());
    let key = |time: &str| format!("Key of part.box.translate at {time} s");
    harness.get_by_label(&key("1")).click();
    classify(&mut harness);
    assert_eq!(harness.state().state().time_s(), Some(1.0));

    let at = harness.get_by_label(&key("1")).rect().center();
    let end = harness.get_by_label(&key("4")).rect().center();
    let by = Vec2::new((end.x - at.x) / 3.0, 0.0);
    drag(&mut harness, at, by);
    let moved = times(harness.state().state(), 0);
    assert!((moved[1] - 2.0).abs() < 0.02, "{moved:?}");
    click(&mut harness, "Undo");
    assert_eq!(
        times(harness.state().state(), 0),
        [0.0, 1.0, 4.0],
        "one step"
    );

    harness
        .get_by_label(&key("1"))
        .click_button(PointerButton::Secondary);
    classify(&mut harness);
    assert_eq!(times(harness.state().state(), 0), [0.0, 4.0]);
    harness.get_by_label(&key("4")).click();
    classify(&mut harness);
    let number = harness.get_by_label("Time of the key");
    number.set_value_accesskit(6.5);
    classify(&mut harness);
    assert_eq!(times(harness.state().state(), 0), [0.0, 6.5]);
    click(&mut harness, "Delete key");
    assert_eq!(times(harness.state().state(), 0), [0.0]);
    assert!(harness.query_by_label("Play").is_none(), "nothing moves");
    assert_eq!(harness.state().state().time_s(), None, "at rest");
}

#[test]
fn what_keys_move_is_changed_at_the_moment_that_is_shown() {
    let mut state = moving();
    state.apply(Action::Select(Selection::Part(0)));
    state.apply(Action::Seek(2.5));
    let path = "part.0.translate".to_owned();
    let value = vec![1.5, 3.0, 0.0].into();
    state.apply(Action::Set { path, value });
    assert_eq!(times(&state, 0), [0.0, 1.0, 2.5, 4.0]);
    let rest = state.document().get("part.0.translate").unwrap();
    let saved = Document::parse("moving.toml", MOVING).unwrap();
    assert_eq!(rest, saved.get("part.0.translate").unwrap());
    let part = &state.shown().unwrap().scene.parts[0];
    assert_eq!(part.world_from_part.translation.y, 3.0);
    // A value that no key animates is the same at all times.
    let path = "part.0.priority".to_owned();
    let value = 2_i64.into();
    state.apply(Action::Set { path, value });
    assert_eq!(tracks(state.document()).len(), 1);
    assert!(state.notices().iter().all(|n| !n.is_error()));
}

#[test]
fn the_eye_is_keyed_where_it_is_and_may_be_moved_between() {
    let mut state = state(TORUS);
    state.apply(Action::Animate);
    assert_eq!(tracks(state.document()).len(), 4, "angles, zoom and pan");
    state.apply(Action::Seek(2.0));
    state.apply(Action::MoveCamera(CameraMove::Orbit(DVec2::new(40.0, 0.0))));
    state.apply(Action::AddKey);
    let azimuth = |state: &State| {
        let camera = state.shown().unwrap().scene.camera;
        cutaway_viewer::camera::angles(&camera)[0]
    };
    let at_end = azimuth(&state);
    state.apply(Action::Seek(0.0));
    let at_begin = azimuth(&state);
    state.apply(Action::Seek(1.0));
    let between = azimuth(&state);
    assert!(
        (at_begin - at_end - 40.0).abs() < 0.1,
        "{at_begin} to {at_end}"
    );
    assert!(
        (between - (at_begin + at_end) * 0.5).abs() < 0.1,
        "{between}"
    );
    // A default zoom stays in the document, because it has keys.
    state.apply(Action::MoveCamera(CameraMove::Home));
    state.apply(Action::Add(NewCut::Plane(0)));
    state.apply(Action::Undo);
    state.apply(Action::Undo);
    state.apply(Action::MoveCamera(CameraMove::Home));
    state.apply(Action::Redo);
    let notices = state.notices();
    assert!(notices.iter().all(|n| !n.is_error()), "{notices:?}");
}

#[test]
fn keys_stay_with_their_cuts_when_another_one_goes() {
    let cut =
        |z: f64| format!("[[cut]]\nsurfaces = [{{ normal = [0, 0, 1], origin = [0, 0, {z}] }}]\n");
    let key = |cut: usize, z: f64| {
        format!(
            "[[key]]\ntarget = \"cut.{cut}.surfaces.0.origin\"\ntimes_s = [0, 1]\nvalues = [[0, 0, {z}], [0, 0, 0.3]]\n"
        )
    };
    let cuts = [cut(0.1), cut(0.2)].concat();
    let keys = [key(0, 0.1), key(1, 0.2)].concat();
    let text = format!("[[part]]\nshape = \"cube\"\n{cuts}{keys}");
    let document = Document::parse("moving.toml", &text).unwrap();
    let mut state = State::open(document.clone(), Assets::default()).unwrap();
    state.apply(Action::Remove(0));
    let left = tracks(state.document());
    assert_eq!(left.len(), 1, "{}", state.document());
    assert_eq!(left[0].target, "cut.0.surfaces.0.origin");
    assert_eq!(left[0].values, tracks(&document)[1].values);
    state.apply(Action::Seek(0.0));
    let surface = &state.shown().unwrap().scene.cuts[0].surfaces[0];
    assert!((surface.origin.z - 0.2).abs() < 1e-9, "{}", surface.origin);
    state.apply(Action::Undo);
    assert_eq!(tracks(state.document()), tracks(&document), "one step");
    assert_eq!(state.cuts().len(), 2);
}

#[test]
fn the_second_of_two_parts_with_one_name_moves_alone() {
    // Both parts have the name of their shape.
    let part = "[[part]]\nshape = \"cube\"\n";
    let document = Document::parse("two.toml", &part.repeat(2)).unwrap();
    let mut state = State::open(document, Assets::default()).unwrap();
    let places = |state: &State| {
        let parts = state.shown().unwrap().scene.parts.iter();
        parts
            .map(|part| part.bounds_in_world().min.x)
            .collect::<Vec<_>>()
    };
    let before = places(&state);
    state.apply(Action::Select(Selection::Part(1)));
    state.apply(Action::Animate);
    state.apply(Action::Seek(2.0));
    state.apply(Action::Set {
        path: "part.1.translate".to_owned(),
        value: vec![3.0, 0.0, 0.0].into(),
    });
    assert_eq!(tracks(state.document())[0].target, "part.1.translate");
    let after = places(&state);
    assert_eq!(after[0], before[0], "the first stays");
    assert!((after[1] - before[1] - 3.0).abs() < 1e-6, "{after:?}");
}
