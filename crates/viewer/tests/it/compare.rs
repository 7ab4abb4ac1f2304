//! Comparisons: a pixel with the reference, all methods in a chart, and the passes of a frame.

use cutaway::layers::{Kind, Layer};
use cutaway::plan::Clock;
use cutaway::{Gpu, GpuOptions, Session};
use cutaway_io::Document;
use cutaway_io::load::Assets;
use cutaway_lab::exact::evaluate;
use cutaway_lab::experiment::Renderer;
use cutaway_viewer::judge::survey::{Found, SurveyPoint, methods};
use cutaway_viewer::slot::{Painter, SlotLayout, SlotSide};
use cutaway_viewer::ui::Viewer;
use cutaway_viewer::{Action, State};
use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use super::common::{act, classify, state, viewer};

/// A state with a shape that a relief cuts in half.
fn ragged(shape: &str) -> State {
    let text = format!(
        "[[part]]\nname = \"body\"\n{shape}\n\n[relief.rough]\nkind = \"fractal\"\n\n[[cut]]\nname = \"front\"\nsurfaces = [{{ section = \"-z=50%\", relief = \"rough\" }}]\n"
    );
    let document = Document::parse("ragged.toml", &text).unwrap();
    State::open(document, Assets::default()).unwrap()
}

const TORUS: &str = "shape = \"torus?segments=48&sides=24\"";

fn choose(harness: &mut Harness<'_, Viewer>, side: SlotSide, name: &str) {
    act(harness, Action::Choose(side, name.parse().unwrap()));
}

fn click(harness: &mut Harness<'_, Viewer>, label: &str) {
    harness.get_by_label(label).click();
    classify(harness);
}

/// Clicks on a pixel of the picture.
fn click_at(harness: &mut Harness<'_, Viewer>, [x, y]: [u32; 2]) {
    let rect = harness.get_by_label("Picture").rect();
    let at: Pos2 = rect.min + Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
    harness.hover_at(at);
    harness.step();
    harness.drag_at(at);
    harness.drop_at(at);
    classify(harness);
}

#[test]
fn a_click_on_a_wrong_pixel_lists_what_its_ray_crosses() {
    let name = "grid:16+vds:64";
    let mut harness = viewer(ragged("shape = \"crank\""));
    choose(&mut harness, SlotSide::A, name);
    act(&mut harness, Action::ShowErrors(true));
    let size_px = harness.state().size_px();
    let shown = harness.state().state().shown().unwrap();
    let view = shown.view(size_px);
    let exact = evaluate(shown.at.truth().unwrap(), &view);
    let mut session = Session::new(Gpu::open(&GpuOptions::default()).unwrap());
    let Renderer::Method(method) = name.parse().unwrap() else {
        panic!("{name} is a method");
    };
    let drawn = session.draw(&shown.at.model, &view, method).unwrap();
    assert!(drawn.outcome.reason().is_none(), "{:?}", drawn.outcome);
    let found = session.layers(method).unwrap();
    let says = |layer: &Layer| (layer.kind, layer.part, layer.clip_surface);
    let pixels = exact.layers.pixels.iter().zip(&found.pixels).enumerate();
    let wrong = pixels.filter(|(index, (truth, found))| {
        let is_cap = truth.kind == Kind::Cap;
        is_cap && says(truth) != says(found) && !exact.undecided[*index]
    });
    let wrong: Vec<u32> = wrong.map(|(index, _)| index as u32).collect();
    assert!(wrong.len() > 10, "only {} are wrong", wrong.len());
    let middle = wrong[wrong.len() / 2];
    let at_px = [middle % size_px[0], middle / size_px[0]];
    let truth = *exact.layers.at(at_px[0], at_px[1]);
    let scale = shown.at.model.prepared.scale;

    click_at(&mut harness, at_px);
    let magnified = harness.state().magnified().unwrap().clone();
    assert_eq!(magnified.at_px, at_px);
    assert!(!magnified.is_undecided, "it is decided");
    let seen: Vec<_> = magnified.depths.iter().filter(|r| r.is_seen).collect();
    assert_eq!(seen.len(), 1, "{:?}", magnified.depths);
    assert_eq!(seen[0].depth, truth.depth / scale);
    assert_eq!(seen[0].what, "cut front", "a cap");
    let before = magnified.depths.iter().take_while(|row| !row.is_seen);
    assert!(
        before.clone().all(|row| !row.is_kept),
        "what is before it is gone"
    );
    assert!(before.count() > 0, "{:?}", magnified.depths);
    let [own, reference] = &magnified.neighbourhoods[..] else {
        panic!("slot A and exact: {:?}", magnified.neighbourhoods);
    };
    assert_eq!((own.side, own.name.as_str()), (Some(SlotSide::A), name));
    assert!(
        reference.says.contains("body: cap by cut front"),
        "{reference:?}"
    );
    assert_ne!(own.says, reference.says);
    let pictures = [own, reference].map(|shown| shown.picture.as_ref().unwrap());
    assert_ne!(pictures[0], pictures[1], "they show different pixels");
    harness.get_by_label("Magnifier");
    harness.get_by_label("seen");
    harness.get_by_label(&format!("A: {name}"));

    harness.key_press(Key::Escape);
    classify(&mut harness);
    assert!(
        harness.query_by_label("Magnifier").is_none(),
        "it is closed"
    );
    click_at(&mut harness, [2, 2]);
    let depths = &harness.state().magnified().unwrap().depths;
    assert!(depths.is_empty(), "nothing is there: {depths:?}");
    harness.get_by_label_contains("meets nothing of the model");
    harness
        .get_by_role_and_label(Role::Button, "Close window")
        .click();
    classify(&mut harness);
    assert!(
        harness.query_by_label("Magnifier").is_none(),
        "it is closed"
    );
}

#[test]
fn the_magnifier_follows_the_scene_and_is_not_there_without_errors() {
    let mut harness = viewer(ragged(TORUS));
    let [width, height] = harness.state().size_px();
    let in_ring = [width / 2, height / 2 + height / 5];
    click_at(&mut harness, in_ring);
    assert!(
        harness.query_by_label("Magnifier").is_none(),
        "nothing is compared"
    );
    act(&mut harness, Action::ShowErrors(true));
    act(&mut harness, Action::Arrange(SlotLayout::Wipe));
    choose(&mut harness, SlotSide::B, "exact");
    click_at(&mut harness, in_ring);
    let first = harness.state().magnified().unwrap().clone();
    assert!(!first.depths.is_empty(), "the ring is there");
    assert_eq!(first.neighbourhoods.len(), 2, "exact is shown once");
    let path = "cut.0.surfaces.0.section".to_owned();
    let value = "z=50%".into();
    act(&mut harness, Action::Set { path, value });
    let second = harness.state().magnified().unwrap().clone();
    assert_ne!(first.depths, second.depths, "the other half is kept");
}

fn point<'a>(harness: &'a Harness<'_, Viewer>, name: &str) -> Option<&'a SurveyPoint> {
    let entries = harness.state().surveyed().iter();
    let mut points = entries.filter_map(|(method, found)| match found {
        Found::SurveyPoint(point) if method.to_string() == name => Some(point),
        _ => None,
    });
    points.next()
}

#[test]
fn all_methods_that_draw_the_scene_are_points_of_a_chart() {
    let mut harness = viewer(ragged(TORUS));
    click(&mut harness, "Measure all here");
    assert_eq!(harness.state().surveyed().len(), methods().len());
    for (name, is_right) in [("raycast+mask", true), ("grid:256+vds:1024", false)] {
        let point = point(&harness, name).unwrap();
        assert_eq!(point.wrong_px == 0, is_right, "{name}: {point:?}");
        assert!(point.time_ms > 0.0, "{name}: {point:?}");
    }
    assert!(point(&harness, "planar").is_none(), "it draws no reliefs");
    harness.get_by_label_contains("planar refuses: ");
    let before = harness.state().state().painter(SlotSide::B);
    let mark = harness.get_by_label_contains("grid:256+vds:1024: ");
    mark.click_accesskit();
    classify(&mut harness);
    let after = harness.state().state().painter(SlotSide::B);
    assert_ne!(before, after);
    assert_eq!(after, "grid:256+vds:1024".parse::<Painter>().unwrap());
    assert!(
        harness
            .query_by_label_contains("has changed since")
            .is_none(),
        "the slot is none of the scene"
    );
    let path = "cut.0.enabled".to_owned();
    let value = false.into();
    act(&mut harness, Action::Set { path, value });
    harness.get_by_label_contains("has changed since");
}

#[test]
fn measuring_ends_when_it_is_cancelled() {
    let mut harness = viewer(ragged(TORUS));
    harness.get_by_label("Measure all here").click();
    while harness.state().surveyed().is_empty() {
        harness.step();
    }
    harness
        .get_by_role_and_label(Role::Button, "Cancel measuring")
        .click();
    classify(&mut harness);
    let done = harness.state().surveyed().len();
    assert!(done < methods().len() / 2, "{done} were measured");
    assert!(harness.query_by_label("Cancel measuring").is_none());
    harness.get_by_label_contains("Ended after");
    // The judge can now answer other questions.
    act(&mut harness, Action::ShowErrors(true));
    assert!(harness.state().errors(SlotSide::A).is_some(), "it answers");
    assert_eq!(harness.state().surveyed().len(), done, "it has ended");
}

#[test]
fn costs_are_known_of_the_slots_that_are_seen_while_they_are_shown() {
    let mut harness = viewer(state("shape:cube"));
    assert!(harness.state().cost(SlotSide::A).is_none(), "nobody asked");
    click(&mut harness, "Cost");
    let uncut = harness.state().cost(SlotSide::A).unwrap().clone();
    assert!(
        harness.state().cost(SlotSide::B).is_none(),
        "it is not seen"
    );
    assert!(uncut.bytes.frame > 0 && uncut.scene_bytes > 0, "{uncut:?}");
    assert!(uncut.time_ms(Clock::Frame) > 0.0, "{uncut:?}");
    harness.get_by_label_contains("the last frame ran on: ");
    harness.get_by_label_contains("per frame, for each frame: ");

    let mut harness = viewer(ragged(TORUS));
    act(&mut harness, Action::Arrange(SlotLayout::SideBySide));
    choose(&mut harness, SlotSide::A, "raycast+mask");
    choose(&mut harness, SlotSide::B, "grid:16+vds:64");
    click(&mut harness, "Cost");
    let [a, b] = SlotSide::BOTH.map(|side| harness.state().cost(side).unwrap().clone());
    assert!(
        a.passes.len() > uncut.passes.len(),
        "a cut takes more passes"
    );
    let of_solid = |cost: &cutaway_viewer::judge::cost::Cost| {
        cost.passes
            .iter()
            .filter(|p| p.clock == Clock::Solid)
            .count()
    };
    assert_eq!(of_solid(&a), 0, "nothing hangs on the mesh alone");
    assert!(of_solid(&b) > 0, "sprites are made once for a mesh");
    assert!(b.bytes.solid > a.bytes.solid, "and are kept");
    harness.get_by_label_contains("per solid, once for a mesh: ");
    let path = "camera.zoom".to_owned();
    let value = 1.5.into();
    act(&mut harness, Action::Set { path, value });
    let clocks = harness.state().screen().clocks(SlotSide::B).unwrap();
    assert!(clocks.contains(Clock::Frame), "a frame was drawn");
    assert!(harness.state().cost(SlotSide::B).is_some(), "asked anew");
    harness
        .get_by_role_and_label(Role::Button, "Close window")
        .click();
    classify(&mut harness);
    assert!(
        harness
            .query_by_label_contains("the last frame ran")
            .is_none()
    );
}
