//! After a device loss, the viewer continues on another device.

use cutaway_viewer::Action;
use cutaway_viewer::action::Selection;
use cutaway_viewer::camera::CameraMove;
use cutaway_viewer::cuts::{NewCut, PlaneMove};
use cutaway_viewer::device::DeviceLoss;
use cutaway_viewer::screen::Screen;
use cutaway_viewer::slot::{SlotLayout, SlotSide};
use cutaway_viewer::ui::Viewer;
use egui_kittest::kittest::Queryable;
use glam::DVec2;

use super::common::{TORUS, act, classify, host, pixels, shown, state, viewer};

#[test]
fn a_scene_that_was_changed_goes_on_with_another_device() {
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(2)));
    let by = CameraMove::Orbit(DVec2::new(25.0, 10.0));
    act(&mut harness, Action::MoveCamera(by));
    act(&mut harness, Action::Arrange(SlotLayout::SideBySide));
    act(&mut harness, Action::ShowErrors(true));
    act(&mut harness, Action::ShowErrors(false));
    let added = harness.state().state().document().clone();
    act(&mut harness, Action::MovePlane(PlaneMove::Along(0.2)));
    let moved = harness.state().state().document().clone();
    assert_ne!(
        moved.to_string(),
        added.to_string(),
        "the plane is elsewhere"
    );
    let before = pixels(&harness, SlotSide::B);

    harness.state().screen().gpu().device().destroy();
    for _ in 0..3 {
        harness.step();
    }
    let lost = harness.into_state();
    let mut harness = shown(lost.reopened_on(Screen::on(&host()).unwrap()));
    harness.get_by_label_contains("lost and has been reopened; the scene is intact.");
    let state = harness.state().state();
    assert_eq!(state.document().to_string(), moved.to_string());
    assert_eq!(state.selection(), Selection::Cut(0));
    assert_eq!(state.layout(), SlotLayout::SideBySide);
    assert!(state.has_unsaved_changes(), "no file has it");
    let after = pixels(&harness, SlotSide::B);
    assert!(after == before, "the picture is another one");
    act(&mut harness, Action::Undo);
    let undone = harness.state().state().document();
    assert_eq!(undone.get("cut").unwrap(), added.get("cut").unwrap());
    assert!(pixels(&harness, SlotSide::B) != before, "and it is drawn");
    act(&mut harness, Action::ShowErrors(true));
    assert!(
        harness.state().errors(SlotSide::B).is_some(),
        "and compared again"
    );
}

#[test]
fn a_loss_is_noticed_within_a_frame() {
    let host = host();
    let loss = DeviceLoss::watch(&host.device, || {});
    let mut harness = shown(Viewer::on(&host, state(TORUS)).unwrap());
    classify(&mut harness);
    assert_eq!(loss.reason(), None, "it draws");
    host.device.destroy();
    harness.step();
    assert_eq!(loss.reason(), Some("it was destroyed"));
}
