//! Actions without a window.

use std::fs;

use cutaway_io::Document;
use cutaway_io::load::Assets;
use cutaway_viewer::action::Selection;
use cutaway_viewer::camera::CameraMove;
use cutaway_viewer::cuts::NewCut;
use cutaway_viewer::{Action, State};
use glam::DVec2;

use super::common::{Scratch, TORUS, state};

#[test]
fn cuts_are_copied_spared_switched_off_and_taken_away() {
    let mut state = state(TORUS);
    state.apply(Action::Add(NewCut::Plane(0)));
    state.apply(Action::Duplicate(0));
    let names: Vec<String> = state.cuts().into_iter().map(|c| c.name).collect();
    assert_eq!(names, ["plane", "plane_2"]);
    assert_eq!(state.selection(), Selection::Cut(1));
    let set = |path: &str, value: cutaway_io::document::Value| Action::Set {
        path: path.to_owned(),
        value,
    };
    state.apply(set("cut.1.enabled", false.into()));
    assert!(!state.cuts()[1].is_enabled, "switched off");
    state.apply(set("cut.0.except", vec!["torus"].into()));
    let spared = &state.shown().unwrap().scene.cuts[0];
    assert_eq!(spared.except, ["torus"]);
    state.apply(Action::Remove(0));
    assert_eq!(state.cuts().len(), 1);
    assert!(state.notices().is_empty(), "nothing was refused");
}

#[test]
fn undo_leaves_the_eye_where_it_is() {
    let mut state = state(TORUS);
    state.apply(Action::Add(NewCut::Plane(0)));
    state.apply(Action::MoveCamera(CameraMove::Orbit(DVec2::new(30.0, 5.0))));
    let camera = state.shown().unwrap().scene.camera;
    state.apply(Action::Undo);
    assert!(state.cuts().is_empty(), "the cut is gone");
    let after = state.shown().unwrap().scene.camera;
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs();
    let angles = cutaway_viewer::camera::angles;
    assert!(apart(angles(&camera), angles(&after)) < 0.02, "{after:?}");
}

#[test]
fn comments_of_a_scene_file_are_kept() {
    let scratch = Scratch::new();
    let path = scratch.path("scene.toml");
    let text = "# Mine.\n[[part]]\nshape = \"cube\" # a box\n\n[[cut]]\nname = \"front\"\nsurfaces = [{ section = \"z=50%\" }]\n";
    fs::write(&path, text).unwrap();
    let mut state = State::open(Document::read(&path).unwrap(), Assets::default()).unwrap();
    state.apply(Action::Select(Selection::Cut(0)));
    state.apply(Action::MovePlane(cutaway_viewer::cuts::PlaneMove::Flip));
    assert!(state.is_changed(), "by the flip");
    state.apply(Action::Save(path.clone()));
    assert!(!state.is_changed(), "it is saved");
    let saved = fs::read_to_string(&path).unwrap();
    assert_eq!(saved, text.replace("z=50%", "-z=50%"));
}

#[test]
fn an_empty_window_takes_a_model_and_then_an_image() {
    let scratch = Scratch::new();
    let mut state = State::open(Document::new(), Assets::default()).unwrap();
    assert!(state.shown().is_none(), "nothing is there");
    state.apply(Action::Add(NewCut::Plane(0)));
    assert!(state.notices()[0].to_string().contains("there is no model"));
    let mesh = scratch.path("a.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    fs::write(&mesh, text).unwrap();
    let heights = scratch.path("rock.png");
    image::GrayImage::from_fn(8, 8, |x, y| image::Luma([(x * y * 4) as u8]))
        .save(&heights)
        .unwrap();
    state.apply(Action::Take(vec![mesh]));
    assert_eq!(state.shown().unwrap().scene.parts.len(), 1);
    state.apply(Action::Add(NewCut::Plane(0)));
    state.apply(Action::Take(vec![heights]));
    assert!(
        state.notices().iter().all(|n| !n.is_error()),
        "all was taken"
    );
    let surface = &state.shown().unwrap().scene.cuts[0].surfaces[0];
    assert!(surface.relief.is_some(), "the image is its relief");
}

#[test]
fn a_scene_file_that_was_written_is_read_again_unless_both_were_changed() {
    let scratch = Scratch::new();
    let path = scratch.path("scene.toml");
    let text = "[[part]]\nshape = \"cube\"\n\n[[cut]]\nsurfaces = [{ section = \"z=50%\" }]\n";
    fs::write(&path, text).unwrap();
    let mut state = State::open(Document::read(&path).unwrap(), Assets::default()).unwrap();
    state.apply(Action::MoveCamera(CameraMove::Orbit(DVec2::new(7.0, 3.0))));
    let camera = state.shown().unwrap().scene.camera;
    fs::write(&path, text.replace("50%", "60%")).unwrap();
    state.apply(Action::Reload);
    assert!(state.document().to_string().contains("z=60%"), "read again");
    let after = state.shown().unwrap().scene.camera;
    assert_eq!(camera.viewpoint, after.viewpoint, "the eye stays");
    assert!(
        state.notices().iter().all(|n| !n.is_error()),
        "nothing is lost"
    );

    state.apply(Action::Select(Selection::Cut(0)));
    state.apply(Action::MovePlane(cutaway_viewer::cuts::PlaneMove::Flip));
    fs::write(&path, text.replace("50%", "70%")).unwrap();
    state.apply(Action::Reload);
    assert!(
        state.document().to_string().contains("-z=60%"),
        "what was changed here stays"
    );
    let notices = state.notices();
    let is_told = |phrase: &str| {
        notices
            .iter()
            .any(|n| n.is_error() && n.to_string().contains(phrase))
    };
    assert!(is_told("the scene was changed here as well"), "{notices:?}");
}

#[test]
fn options_beside_a_scene_file_are_changes_of_it() {
    let scratch = Scratch::new();
    let path = scratch.path("scene.toml");
    fs::write(&path, "[[part]]\nshape = \"cube\"\n").unwrap();
    let mut document = Document::read(&path).unwrap();
    document
        .add_cut(cutaway_io::document::cut([cutaway_io::document::section(
            "x=50%",
        )]))
        .unwrap();
    let mut state = State::open(document, Assets::default()).unwrap();
    let command = state.command([64, 48]).unwrap();
    assert!(command.contains("--section x=50%"), "{command}");
    state.apply(Action::Reload);
    assert_eq!(state.cuts().len(), 1, "the cut is still there");
}

#[cfg(unix)]
#[test]
fn a_saved_scene_is_as_readable_as_any_other_file() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = Scratch::new();
    let other = scratch.path("other");
    fs::write(&other, "").unwrap();
    let path = scratch.path("scene.toml");
    let mut state = state(TORUS);
    state.apply(Action::Save(path.clone()));
    let mode = |path: &std::path::Path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&path), mode(&other));
}
