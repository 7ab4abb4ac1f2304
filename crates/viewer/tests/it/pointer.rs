//! Picking returns the visible surface, and an export matches the picture that the command draws.

use cutaway::layers::Kind;
use cutaway_viewer::Action;
use cutaway_viewer::action::Selection;
use cutaway_viewer::cuts::{NewCut, PlaneMove, plane};
use cutaway_viewer::gizmo::Grip;
use cutaway_viewer::ui::Viewer;
use eframe::egui::{Event, Modifiers, PointerButton, Pos2, Vec2, accesskit::Role};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

use super::common::{Scratch, TORUS, act, classify, drag, gizmo, picture, state, viewer};

fn hover(harness: &mut Harness<'_, Viewer>, at: Pos2) {
    harness.hover_at(at);
    classify(harness);
    classify(harness);
}

#[test]
fn picks_know_what_was_cut_away() {
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(2)));
    act(&mut harness, Action::FaceEye);
    let rect = picture(&harness);
    let mut found = Vec::new();
    for step in 0..40 {
        let x = rect.left() + rect.width() * (step as f32 + 0.5) / 40.0;
        hover(&mut harness, Pos2::new(x, rect.center().y));
        found.push(harness.state().picked().cloned());
    }
    let bounds = harness.state().state().bounds();
    let document = harness.state().state().document().clone();
    let (normal, origin) = plane(&document, 0, &bounds).unwrap();
    let caps: Vec<_> = found
        .iter()
        .flatten()
        .filter(|p| p.kind == Kind::Cap)
        .collect();
    assert!(caps.len() > 3, "the cap is seen: {found:?}");
    assert!(
        found.iter().any(Option::is_none),
        "and the background beside it"
    );
    for cap in caps {
        assert_eq!(
            (cap.part.as_str(), cap.cut.as_deref()),
            ("torus", Some("plane"))
        );
        let off = (cap.point - origin).dot(normal).abs();
        let size = (bounds.max - bounds.min).length();
        assert!(off < size * 1e-5, "on the plane: {off}");
    }
    let step = found
        .iter()
        .position(|p| p.as_ref().is_some_and(|p| p.kind == Kind::Cap));
    let x = rect.left() + rect.width() * (step.unwrap() as f32 + 0.5) / 40.0;
    hover(&mut harness, Pos2::new(x, rect.center().y));
    harness.get_by_label_contains("torus: cap by plane at (");
}

#[test]
fn a_click_counts_where_the_pointer_has_left_by_the_time_it_is_seen() {
    let mut harness = viewer(state("shape:cube"));
    let middle = picture(&harness).center();
    let mut last = None;
    // Often enough that at least one pixel arrives after the pointer has left.
    for click in 0..12_u16 {
        let pos = middle + Vec2::new(f32::from(click * click), 10.0);
        hover(&mut harness, pos);
        let button = |pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        harness.event(button(true));
        harness.step();
        let events = &mut harness.input_mut().events;
        events.extend([button(false), Event::PointerGone]);
        classify(&mut harness);
        if click > 0 {
            let told = harness.get_by_label_contains("distance between the last two clicks");
            let told = told.accesskit_node().value();
            assert_ne!(told, last, "click {click}");
            last = told;
        }
    }
}

#[test]
fn a_key_puts_the_plane_through_the_face_under_the_pointer() {
    let mut harness = viewer(state("shape:cube"));
    let rect = picture(&harness);
    hover(&mut harness, rect.center());
    let picked = harness.state().picked().cloned().unwrap();
    assert_eq!(picked.kind, Kind::Surface);
    harness.key_press(eframe::egui::Key::F);
    classify(&mut harness);
    let document = harness.state().state().document().clone();
    let bounds = harness.state().state().bounds();
    let (normal, origin) = plane(&document, 0, &bounds).unwrap();
    assert!(
        normal.dot(-picked.normal) > 0.999,
        "{normal} is not {}",
        picked.normal
    );
    assert!(
        (picked.point - origin).dot(normal).abs() < 1e-3,
        "through the face"
    );
}

#[test]
fn a_drag_of_the_arrow_moves_the_plane_and_one_beside_it_the_eye() {
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(2)));
    act(&mut harness, Action::MovePlane(PlaneMove::Across(0)));
    let rect = picture(&harness);
    let before = harness.state().state().document().clone();
    // A drag that starts beside the model moves only the eye.
    drag(
        &mut harness,
        rect.left_top() + Vec2::splat(30.0),
        Vec2::new(60.0, 0.0),
    );
    let turned = harness.state().state().document().clone();
    assert_eq!(before.get("cut").unwrap(), turned.get("cut").unwrap());
    assert_ne!(before.root().get("camera"), turned.root().get("camera"));

    let bounds = harness.state().state().bounds();
    let plane_before = plane(&turned, 0, &bounds).unwrap();
    let arrow = gizmo(&harness).handle(Grip::Along).unwrap().line.clone();
    let [from, to] = [arrow[0], arrow[1]].map(|p| rect.min + Vec2::new(p.x as f32, p.y as f32));
    drag(&mut harness, from + (to - from) * 0.6, (to - from) * 0.5);
    let dragged = harness.state().state().document().clone();
    assert_eq!(turned.root().get("camera"), dragged.root().get("camera"));
    let bounds = harness.state().state().bounds();
    let (normal, origin) = plane(&dragged, 0, &bounds).unwrap();
    let moved = (origin - plane_before.1).dot(normal);
    let half = (bounds.max - bounds.min).length() * 0.15 * 0.5;
    assert!(
        (moved + half).abs() < half * 0.1,
        "{moved} is not {half} towards what is removed"
    );
}

#[test]
fn a_picture_is_exported_while_the_window_goes_on() {
    let scratch = Scratch::new();
    let mut harness = viewer(state(TORUS));
    act(&mut harness, Action::Add(NewCut::Plane(2)));
    act(&mut harness, Action::Select(Selection::Scene));
    harness
        .state_mut()
        .export_by(env!("CARGO_BIN_EXE_cutaway-viewer"));
    for (name, starts_with) in [("out.svg", "<svg"), ("out.xyz", "")] {
        let path = scratch.path(name);
        harness.get_by_role_and_label(Role::Button, "File").click();
        classify(&mut harness);
        harness
            .get_by_role_and_label(Role::Button, "Export ...")
            .click();
        classify(&mut harness);
        let field = harness.get_by_role_and_label(Role::TextInput, "File name");
        field.focus();
        classify(&mut harness);
        let modifiers = Modifiers::COMMAND;
        harness.key_press_modifiers(modifiers, eframe::egui::Key::A);
        let field = harness.get_by_role_and_label(Role::TextInput, "File name");
        field.type_text(path.to_str().unwrap());
        classify(&mut harness);
        harness
            .get_by_role_and_label(Role::Button, "Export")
            .click();
        classify(&mut harness);
        match starts_with {
            // Nothing is written, and the reason is shown.
            "" => harness.get_by_label_contains("help:").rect(),
            _ => {
                let text = std::fs::read_to_string(&path).unwrap();
                assert!(text.contains(starts_with), "{text}");
                harness.get_by_label_contains("exported").rect()
            }
        };
    }
}
