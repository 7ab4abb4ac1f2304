//! A picture that is drawn in strips is that of one frame, in a fraction of the memory.

use cutaway::layers::{Kind, Layers};
use cutaway::plan::Limits;
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Method;
use cutaway_io::document::named_style;
use cutaway_lab::compare::FrameCounts;
use cutaway_lab::experiment::{Renderer, SceneAtTime, picture};

use super::bands::classes;
use super::*;

const SIZE_PX: [u32; 2] = [240, 420];

fn cut_scene(style: &str) -> Scene {
    Scene {
        style: named_style(style).unwrap_or_else(|e| panic!("{e}")),
        ..bands::cut_scene()
    }
}

fn session(strip_bytes: u64) -> Session {
    Session::new(crate::common::gpu()).with_strip_bytes(strip_bytes)
}

/// The layers and the picture of a scene, and the number of strips that they were drawn in.
fn drawn(session: &mut Session, style: &str, method: Method) -> (Layers, Vec<u8>, usize) {
    let model = Model::new(&cut_scene(style));
    let view = model.prepared.view(SIZE_PX);
    let (mut pixels, mut picture, mut strips) = (Vec::new(), Vec::new(), 0);
    let found = session.strips(&model, &view, method).expect("strips");
    let all = session.draw_strips(&model, method, &found, |session, strip| {
        let [first, rows] = strip.rows();
        assert_eq!(
            pixels.len(),
            first as usize * SIZE_PX[0] as usize,
            "{method}"
        );
        let layers = session.layers(method)?;
        let own = strip.own_layers(layers.clone());
        assert_eq!(own.size_px, [SIZE_PX[0], rows], "{method}");
        assert_eq!(own.pixels, strip.own(&layers.pixels, 1), "{method}");
        pixels.extend(own.pixels);
        picture.extend(strip.own(&session.picture(method)?, 4));
        strips += 1;
        Ok(())
    });
    let outcome = all.unwrap_or_else(|e| panic!("{e}")).outcome;
    assert_eq!(outcome, Outcome::Complete, "{method}, {style}");
    let size_px = SIZE_PX;
    (Layers { size_px, pixels }, picture, strips)
}

#[test]
fn strips_show_what_one_frame_shows() {
    for (name, style) in [
        ("raycast+mask", "lit"),
        ("raycast+mask@compute", "lit"),
        ("raycast+mask@compute", "drafting"),
        ("raycast+mask@compute", "toon"),
        ("raycast+winding@compute", "lit"),
        ("grid:8+vds:64", "lit"),
        ("adaptive+mask", "lit"),
    ] {
        let method: Method = name.parse().expect("a method");
        let what = format!("{method}, {style}");
        let mut whole = session(u64::MAX);
        let (layers, picture, strips) = drawn(&mut whole, style, method);
        assert_eq!(strips, 1, "{what}");
        assert!(layers.count(Kind::Cap) > 500, "{what}: caps");
        // Effects that read rows around a strip want strips of several times as many.
        let mut held = session(if style == "lit" { 0 } else { 6_000_000 });
        let (found, mut found_picture, strips) = drawn(&mut held, style, method);
        assert!(strips > 1, "{what}: {strips} strips");
        let [expected, found] = [&layers, &found].map(classes);
        let others = expected.iter().zip(&found).filter(|(a, b)| a != b).count();
        // The triangles of an adaptive cap depend on the view of the strip: its rims move within their tolerance.
        let is_adaptive = name.starts_with("adaptive");
        let most = if is_adaptive { 8 } else { 0 };
        assert!(others <= most, "{what}: {others} pixels of another class");
        // A depth is rounded in another way where its row has another number, which moves a colour by a step or two; without the rows
        // around strips it is 31.
        let moved = |found: &[u8]| {
            let steps = picture.iter().zip(found).map(|(a, b)| a.abs_diff(*b));
            steps.max().unwrap_or(0)
        };
        assert_eq!(picture.len(), found_picture.len(), "{what}");
        assert!(
            is_adaptive || moved(&found_picture) <= 3,
            "{what}: {}",
            moved(&found_picture)
        );
        // The control: rows in another order are seen.
        found_picture.rotate_left(SIZE_PX[0] as usize * 4);
        assert!(moved(&found_picture) > 3, "{what}: the control");
        // All strips use the buffers of one.
        let [of_whole, of_strip] =
            [&whole, &held].map(|s| s.bytes(method).expect("bytes")[Clock::Frame as usize]);
        assert!(
            3 * of_strip < 2 * of_whole,
            "{what}: {of_strip} of {of_whole} bytes"
        );
    }
}

#[test]
fn regression_0019_a_large_picture_with_occlusion_is_drawn_on_a_device_of_small_bindings() {
    let method: Method = "raycast+mask@compute".parse().expect("a method");
    let shown = SceneAtTime::new(&cut_scene("technical"));
    let view = shown.model.prepared.view(SIZE_PX);
    let drawn = |session: &mut Session| {
        let renderer = Renderer::from(method);
        let picture = picture::draw(session, &shown, &view, renderer, 2);
        picture.map(|p| (p.image.into_raw(), p.frames.len()))
    };
    let (expected, frames) = drawn(&mut session(u64::MAX)).expect("a picture");
    assert_eq!(frames, 4);
    // The rows around a strip that occlusion reads are too many for the crossings of a strip, but not for its layers.
    let limits = Limits {
        storage_binding_bytes: 12 * u64::from(SIZE_PX[0]) * 200,
        ..Limits::CORE
    };
    let held = || Session::new(crate::common::gpu().held_to(limits));
    // The control: as frames of its own it is refused.
    let whole = held()
        .draw(&shown.model, &view, method)
        .expect("an outcome");
    assert!(matches!(whole.outcome, Outcome::Refused(_)), "{whole:?}");
    let mut held = held().with_strip_bytes(0);
    let (found, frames) = drawn(&mut held).expect("a picture");
    assert_eq!(frames, 4);
    let steps = expected.iter().zip(&found).map(|(a, b)| a.abs_diff(*b));
    let most = steps.max().unwrap_or(u8::MAX);
    assert!(most <= 3, "{most}");
}

#[test]
fn a_picture_of_several_samples_and_its_counts_do_not_depend_on_strips() {
    let method: Method = "raycast+mask@compute".parse().expect("a method");
    let mut scene = cut_scene("lit");
    // A hole: pixels are marked.
    let mesh = Arc::make_mut(&mut scene.parts[0].mesh);
    mesh.triangles.truncate(mesh.triangles.len() - 4);
    let shown = SceneAtTime::new(&scene);
    let view = shown.model.prepared.view(SIZE_PX);
    let drawn = |session: &mut Session| {
        let (mut counts, mut strips) = (FrameCounts::default(), 0);
        let mut count = |layers: &Layers, row| {
            counts.add(layers, &shown.model.prepared, &view, row);
            strips += 1;
        };
        let renderer = Renderer::from(method);
        let picture = picture::draw_noting(session, &shown, &view, renderer, 2, Some(&mut count));
        let image = picture.expect("a picture").image.into_raw();
        (image, counts, strips)
    };
    let (expected, counts, strips) = drawn(&mut session(u64::MAX));
    assert_eq!(strips, 1);
    assert_eq!(counts.total(), (SIZE_PX[0] * SIZE_PX[1]) as usize);
    assert!(counts.may_be_wrong > 20, "{counts:?}");
    let (found, found_counts, strips) = drawn(&mut session(0));
    assert!(strips > 1, "{strips} strips");
    assert_eq!(found_counts, counts);
    let steps = expected.iter().zip(&found).map(|(a, b)| a.abs_diff(*b));
    assert!(steps.max().unwrap_or(u8::MAX) <= 3, "another picture");
}
