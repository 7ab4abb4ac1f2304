//! Effects go over the tiles that show something: what they leave in all others is what a frame of its own would.

use super::*;
use cutaway::plan::Capacities;
use cutaway::scene::Camera;
use cutaway::scene::style::Strokes;
use cutaway::shader::{self, Shader};
use cutaway::strategies;
use glam::Vec3;

/// Words before the tiles of the list, and of a tile: `shaders/lib/effects/effect_tile_list.wgsl`.
const HEAD_WORDS: usize = 28;
const TILE_WORDS: usize = 3;

/// A frame that is drawn after others.
struct Shot {
    what: &'static str,
    style: Style,
    camera: Camera,
    size_px: [u32; 2],
}

fn shots() -> Vec<Shot> {
    let near = scenes::looking(DVec3::new(1.5, -2.0, 3.0), DVec3::ZERO, 40.0);
    let far = scenes::looking(DVec3::new(-4.0, 3.0, 6.0), DVec3::new(0.8, 0.3, 0.0), 40.0);
    let technical = style("technical");
    let wide = Strokes {
        outline: 500.0,
        ..technical.strokes
    };
    let ghost = Ghost {
        kind: GhostKind::Both,
        ..Ghost::default()
    };
    let on = |paper| Style { paper, ..technical };
    let shot = |what, style, camera: &Camera, size_px| Shot {
        what,
        style,
        camera: *camera,
        size_px,
    };
    let wide = Style {
        strokes: wide,
        ..technical
    };
    let size = [96, 64];
    let turned = [64, 96];
    vec![
        shot("near", technical, &near, size),
        shot("far", technical, &far, size),
        shot("near again", technical, &near, size),
        shot("wide strokes", wide, &far, size),
        shot("narrow ones after wide ones", technical, &far, size),
        shot(
            "on colour",
            on(Paper::Color(Vec3::new(0.9, 0.4, 0.1))),
            &far,
            size,
        ),
        shot("on nothing", on(Paper::None), &far, size),
        shot("on a gradient", on(Paper::Gradient), &far, size),
        shot(
            "as many pixels in other rows",
            on(Paper::Gradient),
            &near,
            turned,
        ),
        shot("with a ghost", Style { ghost, ..technical }, &near, turned),
        shot("without one", technical, &far, turned),
        shot("without strokes", style("clay"), &near, turned),
        shot("with strokes", technical, &far, turned),
        shot("plain", Style::default(), &near, turned),
        shot("in a style again", technical, &far, turned),
    ]
}

fn drawn(session: &mut Session, shot: &Shot, method: Method) -> Vec<u8> {
    let model = Model::new(&scene_in(shot.style));
    let view = model.prepared.view_of(&shot.camera, shot.size_px);
    let drawn = session.draw(&model, &view, method).expect("a frame");
    assert_eq!(drawn.outcome, Outcome::Complete, "{}", shot.what);
    session.picture(method).expect("a picture")
}

#[test]
fn pictures_after_others_are_those_of_a_fresh_session() {
    for by in [Rasteriser::Compute, Rasteriser::Hardware] {
        let method = Method::new(Strategy::RAYCAST_MASK, DrawOptions::by(by));
        // Of its own: who takes two of those that tests share may wait for ever.
        let open = || Session::new(common::gpu());
        let (mut session, mut other) = (open(), open());
        let mut before = None;
        for shot in shots() {
            let after_others = drawn(&mut session, &shot, method);
            // Its buffers are made anew for each frame.
            other.forget();
            let fresh = drawn(&mut other, &shot, method);
            assert!(after_others == fresh, "{by}: {}", shot.what);
            // The control: the frame before would show.
            assert!(before.as_ref() != Some(&fresh), "{by}: {}", shot.what);
            before = Some(fresh);
        }
    }
}

#[test]
fn tiles_beyond_the_reach_of_strokes_are_not_gone_over() {
    let mut session = session();
    let method = Method::new(Strategy::RAYCAST_MASK, DrawOptions::default());
    let shot = &shots()[1];
    drawn(&mut session, shot, method);
    let layers = session.layers(method).expect("layers");
    let [width, height] = shot.size_px.map(|px| px.div_ceil(16) as usize);
    let shown = |tile: usize| {
        let (x, y) = (tile % width * 16, tile / width * 16);
        let at = |i: usize| layers.pixels[(y + i / 16) * shot.size_px[0] as usize + x + i % 16];
        (0..256).any(|i| at(i).kind != Kind::Background)
    };
    let words = session.words(method, "effect tiles").expect("words");
    let count = words[0] as usize;
    let tiles = words[HEAD_WORDS..].chunks_exact(TILE_WORDS);
    let mut listed: Vec<usize> = tiles.take(count).map(|tile| tile[0] as usize).collect();
    listed.sort_unstable();
    listed.dedup();
    assert_eq!(listed.len(), count, "each once");
    let all = width * height;
    let mut needed = (0..all).filter(|t| shown(*t));
    assert!(needed.all(|t| listed.contains(&t)), "{listed:?}");
    assert!(count < all, "{count} of {all} tiles");
}

#[test]
fn strokes_that_reach_farther_than_is_looked_are_missed() {
    let shots = shots();
    let shot = shots.iter().find(|s| s.what == "wide strokes").expect("it");
    let model = Model::new(&scene_in(shot.style));
    let view = model.prepared.view_of(&shot.camera, shot.size_px);
    let mut plan = strategies::plan(&model, &view, Strategy::RAYCAST_MASK, &Capacities::UNKNOWN)
        .unwrap_or_else(|refusal| panic!("{}", refusal.reason));
    let gpu = session();
    let picture = |plan: &cutaway::plan::Plan| {
        let mut program = cutaway::gpu::Program::default();
        program.load(gpu.gpu(), plan.clone()).expect("a program");
        let ran = program.run(gpu.gpu(), cutaway::gpu::ClockSet::ALL);
        ran.expect("a frame");
        program.picture(gpu.gpu()).expect("a picture")
    };
    let right = picture(&plan);
    let list = plan.passes.iter_mut().find(|p| p.name == "list tiles");
    let reach = &mut list.expect("the pass").constants[0];
    assert!(reach.0 == "reach" && reach.1 >= 2.0, "{reach:?}");
    reach.1 = 0.0;
    assert!(picture(&plan) != right, "strokes end where tiles do");
}

#[test]
fn the_list_is_laid_out_as_it_is_read() {
    let list = Shader::from("effects/tiles/list.wgsl");
    let clear = Shader::from("effects/tiles/clear.wgsl")
        .with("lib/backdrop/paper.wgsl")
        .with("lib/blank_strokes/none.wgsl");
    for shader in [list, clear] {
        let composed = shader::compose(&shader).unwrap_or_else(|e| panic!("{e}"));
        let size = |name: &str| {
            let layout = shader::struct_layout(&composed.module, name);
            layout.unwrap_or_else(|| panic!("{shader}: no {name}")).size as usize
        };
        assert_eq!(size("EffectTile"), 4 * TILE_WORDS, "{shader}");
        // A count, padded, and two backdrops.
        assert_eq!(16 + 2 * size("Backdrop"), 4 * HEAD_WORDS, "{shader}");
    }
}
