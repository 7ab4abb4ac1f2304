//! Refused actions change nothing, and are reported with a help text.

use std::fs;

use cutaway_viewer::Action;
use cutaway_viewer::action::Selection;
use cutaway_viewer::cuts::{NewCut, PlaneMove};
use cutaway_viewer::slot::SlotSide;
use egui_kittest::kittest::Queryable;

use super::common::{Scratch, TORUS, act, state, viewer};

#[test]
fn bad_files_and_values_are_told_and_change_nothing() {
    let scratch = Scratch::new();
    for (name, text) in [
        ("no.xyz", ""),
        ("bad.toml", "part = 3"),
        ("bad.obj", "f 1 2 3\n"),
        ("h.png", "no image"),
    ] {
        fs::write(scratch.path(name), text).unwrap();
    }
    let take = |name: &str| Action::Take(vec![scratch.path(name)]);
    let set = |path: &str, value: &str| Action::Set {
        path: path.to_owned(),
        value: cutaway_io::document::Value::read(value),
    };
    for (action, phrase) in [
        (take("no.xyz"), "not that of a scene, a mesh or"),
        (take("gone.obj"), "gone.obj"),
        (take("bad.toml"), "bad.toml"),
        (take("bad.obj"), "bad.obj"),
        (take("h.png"), "no cut is selected"),
        (set("cut.0.surfaces.0.section", "z=middle"), "z=middle"),
        (set("camera.zoom", "-1"), "zoom"),
        (set("part.0.material.hatch", "stele"), "stele"),
        (Action::MovePlane(PlaneMove::Flip), "no cut is selected"),
        (
            Action::Save(scratch.path("bad.obj/scene.toml")),
            "cannot be written",
        ),
        (
            Action::Save(scratch.path("bad.toml")),
            "the file exists, and would",
        ),
    ] {
        let mut state = state(TORUS);
        state.apply(Action::Add(NewCut::Plane(2)));
        state.apply(Action::Select(Selection::Scene));
        assert!(state.notices().is_empty(), "nothing to be told so far");
        let before = state.document().clone();
        state.apply(action);
        assert_eq!(*state.document(), before, "{phrase}");
        let notices = state.notices();
        let [notice] = &notices[..] else {
            panic!("{phrase}: {notices:?}");
        };
        assert!(
            notice.is_error() && notice.to_string().contains(phrase),
            "{notice:?}"
        );
        assert!(notice.help.is_some(), "{notice:?}");
    }
}

#[test]
fn a_method_that_refuses_says_so_in_its_slot() {
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Box));
    act(
        &mut harness,
        Action::Choose(SlotSide::A, "stencil".parse().unwrap()),
    );
    assert!(
        harness.state().screen().refusal(SlotSide::A).is_some(),
        "stencil knows one plane"
    );
    harness.get_by_label_contains("A: stencil refuses:");
    act(
        &mut harness,
        Action::Choose(SlotSide::A, "auto".parse().unwrap()),
    );
    assert!(
        harness.state().screen().refusal(SlotSide::A).is_none(),
        "auto draws it"
    );
}
