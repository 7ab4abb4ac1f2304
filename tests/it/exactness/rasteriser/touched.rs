//! What a frame leaves beside the tiles that it touches is background, whatever was drawn before it by the same program.

use cutaway::layers::Kind;
use cutaway::passes::Model;
use cutaway::scene::{Camera, Scene, View};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Method;
use cutaway_io::document::named_style;
use glam::DVec3;

use crate::common::{gpu, scenes};

/// Words before the tiles of the list, each of four: `shaders/lib/touched_list.wgsl`.
const HEAD_WORDS: usize = 10;

/// A frame that is drawn after others.
struct Shot {
    what: &'static str,
    scene: Scene,
    camera: Camera,
    size_px: [u32; 2],
    style: &'static str,
}

fn shots(relief: Option<&str>) -> Vec<Shot> {
    let scene = |shape: &str| {
        let mut scene = scenes::sectioned(shape, &[]);
        let surface = scenes::relief(&scene, "-z=55%", relief.unwrap_or("constant"));
        scene.cuts = vec![cutaway::scene::Cut::new("cut", vec![surface])];
        scene
    };
    let near = scenes::looking(DVec3::new(1.5, -2.0, 3.0), DVec3::ZERO, 40.0);
    let far = scenes::looking(DVec3::new(-4.0, 3.0, 6.0), DVec3::new(0.8, 0.3, 0.0), 40.0);
    let inside = scenes::looking(DVec3::Z * 0.1, DVec3::X, 60.0);
    let parallel = scenes::parallel(DVec3::Z * 5.0, DVec3::ZERO, 3.0);
    let shot = |what, shape, camera: &Camera, size_px, style| Shot {
        what,
        scene: scene(shape),
        camera: *camera,
        size_px,
        style,
    };
    vec![
        shot("near", "torus", &near, [96, 64], "lit"),
        shot("far", "torus", &far, [96, 64], "lit"),
        shot("near again", "torus", &near, [96, 64], "lit"),
        shot(
            "as many pixels in other rows",
            "torus",
            &far,
            [64, 96],
            "lit",
        ),
        shot("from within", "cube", &inside, [64, 96], "lit"),
        shot("another model", "cube", &far, [64, 96], "lit"),
        shot("without perspective", "cube", &parallel, [64, 96], "lit"),
        shot("in a style", "torus", &near, [64, 96], "technical"),
        shot("plain once more", "torus", &far, [64, 96], "lit"),
    ]
}

fn drawn(session: &mut Session, shot: &Shot, method: Method) -> (Vec<u32>, Vec<u8>) {
    let mut scene = shot.scene.clone();
    scene.style = named_style(shot.style).unwrap_or_else(|e| panic!("{e}"));
    let model = Model::new(&scene);
    let view: View = model.prepared.view_of(&shot.camera, shot.size_px);
    let drawn = session.draw(&model, &view, method);
    let drawn = drawn.unwrap_or_else(|e| panic!("{}: {e}", shot.what));
    assert_eq!(drawn.outcome, Outcome::Complete, "{}", shot.what);
    let words = session.words(method, "layers");
    let picture = session.picture(method);
    (
        words.unwrap_or_else(|e| panic!("{e}")),
        picture.unwrap_or_else(|e| panic!("{e}")),
    )
}

#[test]
fn frames_after_others_are_those_of_a_fresh_session() {
    let open = || Session::new(gpu());
    for (name, relief) in [
        ("raycast+mask@compute", None),
        ("raycast+mask@compute,32-bit", None),
        ("raycast+mask@compute", Some("waves:size=32,amplitude=8%")),
        (
            "raycast+mask@compute,list",
            Some("waves:size=32,amplitude=8%"),
        ),
        ("raycast+abuffer@compute", None),
    ] {
        let method: Method = name.parse().unwrap_or_else(|e| panic!("{e}"));
        let mut session = open();
        let mut other = open();
        let mut before = None;
        for shot in shots(relief) {
            let after_others = drawn(&mut session, &shot, method);
            // Its buffers are made anew for each frame.
            other.forget();
            let fresh = drawn(&mut other, &shot, method);
            assert!(after_others == fresh, "{name}: {}", shot.what);
            // The control: the frame before would show.
            assert!(before.as_ref() != Some(&fresh), "{name}: {}", shot.what);
            before = Some(fresh);
        }
    }
}

#[test]
fn tiles_without_a_triangle_are_not_gone_over() {
    let mut session = Session::new(gpu());
    for (name, relief) in [
        ("raycast+mask@compute", None),
        ("raycast+mask@compute", Some("waves:size=32,amplitude=8%")),
    ] {
        let method: Method = name.parse().unwrap_or_else(|e| panic!("{e}"));
        let shot = &shots(relief)[1];
        drawn(&mut session, shot, method);
        let layers = session.layers(method).unwrap_or_else(|e| panic!("{e}"));
        let [width, height] = shot.size_px.map(|px| px.div_ceil(16) as usize);
        let shown = |tile: usize| {
            let (x, y) = (tile % width * 16, tile / width * 16);
            let at = |i: usize| layers.pixels[(y + i / 16) * shot.size_px[0] as usize + x + i % 16];
            (0..256).any(|i| at(i).kind != Kind::Background)
        };
        let words = session.words(method, "touched");
        let words = words.unwrap_or_else(|e| panic!("{e}"));
        let count = words[0] as usize;
        let mut listed: Vec<usize> = (words[HEAD_WORDS..].chunks_exact(4).take(count))
            .map(|tile| tile[0] as usize)
            .collect();
        listed.sort_unstable();
        let all = width * height;
        let needed: Vec<usize> = (0..all).filter(|t| shown(*t)).collect();
        assert!(
            needed.iter().all(|t| listed.contains(t)),
            "{name}: {needed:?} in {listed:?}"
        );
        listed.dedup();
        assert_eq!(listed.len(), count, "{name}: each once");
        assert!(count < all, "{name}: {count} of {all} tiles");
    }
}
