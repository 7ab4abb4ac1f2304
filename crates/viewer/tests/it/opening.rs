//! Files are opened in the background while the window stays responsive.

use std::borrow::Cow;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;

use cutaway::Result;
use cutaway_io::Document;
use cutaway_io::document::part;
use cutaway_io::load::{Assets, Disk, Files};
use cutaway_viewer::camera::CameraMove;
use cutaway_viewer::cuts::NewCut;
use cutaway_viewer::files::FileStorage;
use cutaway_viewer::slot::SlotSide;
use cutaway_viewer::ui::Viewer;
use cutaway_viewer::{Action, State};
use eframe::egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::DVec2;

use super::common::{Scratch, TORUS, classify, pixels, viewer};

const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// File storage on disk that blocks all reading until it is released.
#[derive(Debug, Default)]
struct Slow {
    is_let_go: Mutex<bool>,
    changed: Condvar,
}

impl Slow {
    fn let_go(&self) {
        *self.is_let_go.lock().unwrap() = true;
        self.changed.notify_all();
    }
}

impl Files for Slow {
    fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        let held = self.is_let_go.lock().unwrap();
        drop(
            self.changed
                .wait_while(held, |is_let_go| !*is_let_go)
                .unwrap(),
        );
        fs::read(path).map(Cow::Owned)
    }

    fn is_file(&self, path: &Path) -> bool {
        path.is_file()
    }
}

impl FileStorage for Slow {
    fn write(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        Disk.write(path, bytes)
    }
}

/// A viewer of a cut torus on slow storage, with the storage and two files: a valid mesh and an invalid one.
fn slow(scratch: &Scratch) -> (Harness<'static, Viewer>, Arc<Slow>, [PathBuf; 2]) {
    let files = [scratch.path("corner.obj"), scratch.path("bad.obj")];
    fs::write(&files[0], MESH).unwrap();
    fs::write(&files[1], "f 1 2 3\n").unwrap();
    let disk = Arc::new(Slow::default());
    let mut document = Document::new();
    document.add_part(part(TORUS)).unwrap();
    let assets = Assets::from_files(disk.clone());
    let mut state = State::open_from(disk.clone(), document, assets).unwrap();
    state.apply(Action::Add(NewCut::Plane(0)));
    (viewer(state), disk, files)
}

fn parts(harness: &Harness<'_, Viewer>) -> usize {
    harness.state().state().shown().unwrap().scene.parts.len()
}

/// Runs frames until a condition holds.
fn wait(harness: &mut Harness<'_, Viewer>, holds: impl Fn(&Harness<'_, Viewer>) -> bool) {
    for _ in 0..2_000 {
        if holds(harness) {
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    panic!("it never comes");
}

#[test]
fn a_model_is_shown_when_it_has_been_opened() {
    let scratch = Scratch::new();
    let (mut harness, disk, [mesh, _]) = slow(&scratch);
    let before = pixels(&harness, SlotSide::A);
    harness.state_mut().apply(Action::Take(vec![mesh]));
    harness.step();
    harness.step();
    harness.get_by_label("opening corner.obj");
    harness.check_accessibility();
    assert_eq!(parts(&harness), 1, "it is not there yet");
    assert!(harness.state().is_busy(), "it is awaited");
    disk.let_go();
    wait(&mut harness, |harness| {
        harness.query_by_label_contains("opened ").is_some()
    });
    assert!(harness.query_by_label("Cancel opening").is_none());
    classify(&mut harness);
    assert_eq!(parts(&harness), 2);
    assert_ne!(pixels(&harness, SlotSide::A), before);
    harness.state_mut().apply(Action::Undo);
    classify(&mut harness);
    assert_eq!(parts(&harness), 1, "it is a step");
}

#[test]
fn what_is_done_meanwhile_is_seen_at_once_and_stays() {
    let scratch = Scratch::new();
    let (mut harness, disk, [mesh, _]) = slow(&scratch);
    let before = pixels(&harness, SlotSide::A);
    harness.state_mut().apply(Action::Take(vec![mesh]));
    harness.step();
    let orbit = CameraMove::Orbit(DVec2::new(40.0, 10.0));
    harness.state_mut().apply(Action::MoveCamera(orbit));
    harness.state_mut().apply(Action::Add(NewCut::Plane(1)));
    wait(&mut harness, |harness| {
        pixels(harness, SlotSide::A) != before
    });
    let camera = harness.state().state().shown().unwrap().scene.camera;
    assert_eq!(parts(&harness), 1, "it is drawn before the model is there");
    disk.let_go();
    classify(&mut harness);
    let state = harness.state().state();
    assert_eq!((parts(&harness), state.cuts().len()), (2, 2));
    let after = state.shown().unwrap().scene.camera;
    assert_eq!(after.viewpoint, camera.viewpoint, "the eye stays");
    harness.state_mut().apply(Action::Undo);
    classify(&mut harness);
    assert_eq!(parts(&harness), 1, "the last step was the model");
    assert_eq!(harness.state().state().cuts().len(), 2);
}

#[test]
fn what_is_cancelled_leaves_the_scene_and_what_waits_comes_next() {
    let scratch = Scratch::new();
    let (mut harness, disk, [mesh, _]) = slow(&scratch);
    let before = harness.state().state().document().clone();
    harness.state_mut().apply(Action::Take(vec![mesh]));
    let other = Action::Take(vec!["shape:cube".into()]);
    harness.step();
    harness.step();
    (harness.get_by_role_and_label(Role::Button, "Cancel opening")).click();
    for _ in 0..3 {
        harness.step();
    }
    assert!(harness.query_by_label("opening corner.obj").is_none());
    disk.let_go();
    classify(&mut harness);
    std::thread::sleep(Duration::from_millis(50));
    classify(&mut harness);
    assert_eq!(*harness.state().state().document(), before);
    harness.state_mut().apply(other.clone());
    harness.state_mut().apply(Action::Reload);
    wait(&mut harness, |harness| {
        (harness.query_by_label_contains("read all files again")).is_some()
    });
    assert_eq!(parts(&harness), 2, "the other was taken before");
}

#[test]
fn what_cannot_be_opened_is_told_and_the_scene_stays() {
    let scratch = Scratch::new();
    let (mut harness, disk, [_, bad]) = slow(&scratch);
    for is_changed in [false, true] {
        harness.state_mut().apply(Action::Take(vec![bad.clone()]));
        harness.step();
        if is_changed {
            let home = Action::MoveCamera(CameraMove::Home);
            harness.state_mut().apply(home);
        }
        let before = harness.state().state().document().clone();
        disk.let_go();
        classify(&mut harness);
        assert_eq!(*harness.state().state().document(), before);
        harness.get_by_label_contains("bad.obj");
        harness.get_by_label("x").click();
        classify(&mut harness);
        assert!(
            harness.query_by_label_contains("bad.obj").is_none(),
            "told once"
        );
    }
}

#[test]
fn a_scene_is_opened_whatever_is_done_meanwhile() {
    let scratch = Scratch::new();
    let path = scratch.path("scene.toml");
    let text = "[[part]]\nmesh = \"corner.obj\"\n\n[[cut]]\nsurfaces = [{ section = \"z=30%\" }]\n";
    fs::write(&path, text).unwrap();
    for is_changed in [false, true] {
        let (mut harness, disk, _) = slow(&scratch);
        harness.state_mut().apply(Action::Take(vec![path.clone()]));
        harness.step();
        if is_changed {
            harness.state_mut().apply(Action::Add(NewCut::Box));
        }
        disk.let_go();
        classify(&mut harness);
        let state = harness.state().state();
        assert_eq!(state.document().to_string(), text);
        assert_eq!(state.can_undo_redo(), [false; 2], "another scene");
        assert_eq!(state.shown().unwrap().scene.parts[0].name, "corner");
    }
}
