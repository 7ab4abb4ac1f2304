//! A cut's handles are dragged in the picture, and each drag is one undo step.

use cutaway_viewer::Action;
use cutaway_viewer::cuts::{NewCut, PlaneMove, plane};
use cutaway_viewer::gizmo::Grip;
use cutaway_viewer::regions::{Region, regions};
use cutaway_viewer::ui::Viewer;
use eframe::egui::{Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use super::common::{act, classify, drag, gizmo, picture, state, viewer};

const TORUS: &str = super::common::TORUS;

/// Drags a handle by an offset in points.
fn pull(harness: &mut Harness<'_, Viewer>, grip: Grip, by: Vec2) {
    let gizmo = gizmo(harness);
    let handle = gizmo.handle(grip).unwrap_or_else(|| panic!("no {grip:?}"));
    let at = handle.knob.unwrap_or(handle.line[handle.line.len() - 1]);
    let from = picture(harness).min + Vec2::new(at.x as f32, at.y as f32);
    drag(harness, from, by);
}

/// Unit direction of a handle in the picture.
fn along(harness: &Harness<'_, Viewer>, grip: Grip) -> Vec2 {
    let gizmo = gizmo(harness);
    let line = &gizmo.handle(grip).unwrap().line;
    let by = (line[line.len() - 1] - line[0]).normalize();
    Vec2::new(by.x as f32, by.y as f32)
}

#[test]
fn arcs_tilt_a_plane_in_one_step() {
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(0)));
    act(&mut harness, Action::MovePlane(PlaneMove::Across(2)));
    let before = harness.state().state().document().clone();
    let bounds = harness.state().state().bounds();
    let normal = |harness: &Harness<'_, Viewer>| {
        plane(harness.state().state().document(), 0, &bounds)
            .unwrap()
            .0
    };
    let upright = normal(&harness);
    for index in [0, 1] {
        let by = along(&harness, Grip::Tilt(index)) * 30.0;
        pull(&mut harness, Grip::Tilt(index), by);
        let degrees = normal(&harness).dot(upright).acos().to_degrees();
        assert!((3.0..60.0).contains(&degrees), "arc {index}: {degrees}");
        harness.get_by_label("Undo").click();
        classify(&mut harness);
        let after = harness.state().state().document();
        assert_eq!(
            after.root().get("cut"),
            before.root().get("cut"),
            "one step"
        );
    }
    // With Ctrl the handle moves in steps of 5 degrees.
    let by = along(&harness, Grip::Tilt(0)) * 30.0;
    let held = Modifiers::COMMAND | Modifiers::CTRL;
    harness.event(eframe::egui::Event::ModifiersChanged(held));
    pull(&mut harness, Grip::Tilt(0), by);
    let degrees = normal(&harness).dot(upright).acos().to_degrees();
    assert!(degrees > 4.0, "{degrees}");
    let off = degrees - (degrees / 5.0).round() * 5.0;
    assert!(off.abs() < 1e-3, "{degrees} is no multiple of 5");
}

#[test]
fn knobs_move_faces_of_boxes_and_angles_of_wedges() {
    let mut harness = viewer(state(TORUS));
    let bounds = harness.state().state().bounds();
    act(&mut harness, Action::Add(NewCut::Box));
    let boxes = |harness: &Harness<'_, Viewer>, index| {
        let all = regions(harness.state().state().document(), index, &bounds);
        all.first().cloned().unwrap()
    };
    let faces = gizmo(&harness).handles.len();
    assert_eq!(faces, 6, "of a box");
    let mut moved = 0;
    for handle in gizmo(&harness).handles {
        let before = boxes(&harness, 0);
        let by = along(&harness, handle.grip) * 25.0;
        let [width, seen] = [picture(&harness).width() as f64, by.length() as f64];
        let at = handle.knob.unwrap();
        // If another knob is nearer, or the rail is seen end-on, the pointer holds something else.
        let own = gizmo(&harness).at(at).map(|h| h.grip) == Some(handle.grip);
        let is_long = (handle.line[1] - handle.line[0]).length() > 12.0;
        if !own || !is_long || at.x > width || seen < 1.0 {
            continue;
        }
        pull(&mut harness, handle.grip, by);
        let (Region::Block { block: a, .. }, Region::Block { block: b, .. }) =
            (before, boxes(&harness, 0))
        else {
            panic!("no box");
        };
        let changed = (0..3)
            .flat_map(|i| [a.min[i] != b.min[i], a.max[i] != b.max[i]])
            .filter(|is| *is)
            .count();
        assert_eq!(changed, 1, "{:?}: {a:?} to {b:?}", handle.grip);
        moved += 1;
    }
    assert!(moved >= 3, "only {moved} faces can be moved");
    let text = harness.state().state().document().to_string();
    assert!(text.contains('%'), "percent stays percent: {text}");

    act(&mut harness, Action::Add(NewCut::Wedge));
    let angles = |harness: &Harness<'_, Viewer>| match boxes(harness, 1) {
        Region::Wedge { wedge, .. } => [wedge.from_deg, wedge.to_deg],
        Region::Block { .. } => panic!("no wedge"),
    };
    for is_end in [false, true] {
        let before = angles(&harness);
        let grip = Grip::Angle { region: 0, is_end };
        let by = along(&harness, grip) * 25.0;
        pull(&mut harness, grip, by);
        let after = angles(&harness);
        let (same, other) = (usize::from(!is_end), usize::from(is_end));
        assert_eq!(before[same], after[same], "the other one stays");
        assert!(
            after[other] - before[other] > 2.0,
            "{before:?} to {after:?}"
        );
    }
}
