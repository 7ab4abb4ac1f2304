//! The copied command draws the same picture as the window.

use std::process::Command;

use cutaway_viewer::Action;
use cutaway_viewer::camera::CameraMove;
use cutaway_viewer::cuts::{NewCut, PlaneMove};
use cutaway_viewer::slot::SlotSide;
use glam::DVec2;

use super::common::{self, Scratch, TORUS, act, state, viewer};

/// Runs a command in a shell, and returns the picture that it writes to a scratch folder.
pub(super) fn run(command: &str, scratch: &Scratch) -> image::RgbaImage {
    let program = env!("CARGO_BIN_EXE_cutaway-viewer");
    let line = command.replacen("cutaway", program, 1);
    let folder = scratch.path("");
    let ran = Command::new("sh")
        .args(["-c", &line])
        .current_dir(folder)
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{line}\n{stderr}");
    image::open(scratch.path("cut.png")).unwrap().into_rgba8()
}

#[test]
fn it_makes_the_picture_that_is_seen() {
    let set = |path: &str, value: &str| Action::Set {
        path: path.to_owned(),
        value: cutaway_io::document::Value::read(value),
    };
    for (what, actions) in [
        (
            "a plane",
            vec![
                Action::Add(NewCut::Plane(2)),
                Action::MovePlane(PlaneMove::Along(-0.1)),
            ],
        ),
        ("a relief", vec![Action::Add(NewCut::Relief(0))]),
        ("a box", vec![Action::Add(NewCut::Box)]),
        ("a cutout", vec![Action::Add(NewCut::Cutout)]),
        (
            "an eye that went around",
            vec![
                Action::Add(NewCut::Plane(0)),
                Action::MoveCamera(CameraMove::Orbit(DVec2::new(20.123_45, 10.987_65))),
            ],
        ),
        (
            "an eye that came nearer",
            vec![
                Action::Add(NewCut::Plane(0)),
                Action::MoveCamera(CameraMove::Zoom {
                    factor: 1.234_567_8,
                    about: DVec2::new(0.2, 0.1),
                }),
            ],
        ),
        (
            "parallel rays",
            vec![
                Action::Add(NewCut::Plane(0)),
                Action::MoveCamera(CameraMove::Parallel(true)),
            ],
        ),
        (
            "colours and a style",
            vec![
                Action::Add(NewCut::Wedge),
                set("part.0.material.color", "#c02020"),
                set("style", "blueprint"),
            ],
        ),
    ] {
        let mut harness = viewer(state(TORUS));
        let before = common::pixels(&harness, SlotSide::A);
        for action in actions {
            act(&mut harness, action);
        }
        let seen = common::pixels(&harness, SlotSide::A);
        assert_ne!(before, seen, "{what} changes the picture");
        let command = harness
            .state()
            .state()
            .command(harness.state().size_px())
            .unwrap();
        let scratch = Scratch::new();
        let made = run(&format!("{command} --supersample 1"), &scratch);
        assert_eq!(made.dimensions(), seen.dimensions(), "{what}: {command}");
        let apart = made
            .pixels()
            .zip(seen.pixels())
            .filter(|(a, b)| a != b)
            .count();
        assert_eq!(apart, 0, "{what}: {command}");
    }
}

#[test]
fn at_rest_edges_become_as_smooth_as_the_commands() {
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(2)));
    let raw = common::pixels(&harness, SlotSide::A);
    harness.state_mut().smooth(true);
    common::classify(&mut harness);
    let seen = common::pixels(&harness, SlotSide::A);
    let (state, size_px) = (harness.state().state(), harness.state().size_px());
    let made = run(&state.command(size_px).unwrap(), &Scratch::new());
    // The device rounds powers differently.
    let apart = |a: &image::RgbaImage| {
        let both = a.as_raw().iter().zip(made.as_raw());
        both.map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(255)
    };
    assert_eq!(made.dimensions(), seen.dimensions());
    assert!(apart(&seen) <= 1, "{} levels", apart(&seen));
    assert!(apart(&raw) > 30, "one sample is as smooth");
    // During motion the picture is drawn with one sample; at rest it is smoothed again.
    act(&mut harness, Action::MovePlane(PlaneMove::Along(-0.1)));
    assert!(
        common::pixels(&harness, SlotSide::A) != seen,
        "it has not moved"
    );
}
