//! Promise: a style is made of the layers of whatever drew them, by no more than it asks for; strokes are where layers differ and
//! nowhere else.

mod borders;
mod files;
mod ghost;
mod ground;
mod hatch;
mod materials;
mod occlusion;
mod plans;
mod strokes;
mod tiles;
mod vertex_paint;

use crate::common;

use common::{meshes, scenes, session};
use cutaway::Model;
use cutaway::layers::{Kind, Layers};
use cutaway::plan::Limits;
use cutaway::scene::style::{Ghost, GhostKind, Occlusion, OcclusionKind, Paper};
use cutaway::scene::{ClipSurface, Cut, Part, Scene, Style};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use cutaway_io::document::{named_style, style_names};
use glam::{DAffine3, DVec3};

const SIZE_PX: [u32; 2] = [160, 120];

fn style(name: &str) -> Style {
    named_style(name).unwrap_or_else(|e| panic!("{e}"))
}

/// A ball in a cube, cut by a plane, beside another ball.
fn scene_in(style: Style) -> Scene {
    let mut far = Part::new("far", meshes::shape("sphere?subdivisions=3"));
    far.world_from_part = DAffine3::from_translation(DVec3::new(0.7, 0.7, -0.7));
    let parts = vec![Part::new("cube", meshes::shape("cube?divisions=2")), far];
    let mut scene = scenes::of_parts("styled", parts, Vec::new());
    let plane = ClipSurface::parse("-0.2,-0.3,-1@0,0,0.1", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    scene.style = style;
    scene
}

fn picture_of(session: &mut Session, scene: &Scene, method: Method) -> Option<Vec<u8>> {
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE_PX);
    let drawn = session.draw(&model, &view, method).expect("a frame");
    match drawn.outcome {
        Outcome::Refused(_) => None,
        _ => Some(session.picture(method).expect("a picture")),
    }
}

/// The layers of what a method draws, and the picture, which shading these layers must make too; none where the method refuses.
fn drawn_as_shaded(
    session: &mut Session,
    (name, scene): (&str, &Scene),
    method: Method,
) -> Option<(Layers, Vec<u8>)> {
    let drawn = picture_of(session, scene, method)?;
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE_PX);
    let layers = session.layers(method).expect("layers");
    let made = session.shade(&model, &view, &layers).expect("a picture");
    assert!(drawn == made, "{method} in {name}: another picture");
    Some((layers, drawn))
}

#[test]
fn every_strategy_has_every_style_that_its_layers_have() {
    let mut session = session();
    let mut compared = 0;
    let ghostly = Style {
        ghost: Ghost {
            kind: GhostKind::Both,
            ..Ghost::default()
        },
        ..style("technical")
    };
    let named = style_names().map(|name| (name, style(name)));
    for (name, style) in named.chain([("a ghost", ghostly)]) {
        let scene = scene_in(style);
        let plain = scene_in(Style::default());
        for strategy in Strategy::all() {
            for by in [Rasteriser::Hardware, Rasteriser::Compute] {
                let method = Method::new(strategy, DrawOptions::by(by));
                if drawn_as_shaded(&mut session, (name, &scene), method).is_none() {
                    let lit = picture_of(&mut session, &plain, method);
                    assert!(lit.is_none(), "{method} refuses {name} alone");
                    continue;
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared} pictures");
}

#[test]
fn styles_differ_from_each_other() {
    let mut session = session();
    let method = Method::from(Strategy::RAYCAST_MASK);
    let mut all: Vec<(&str, Vec<u8>)> = Vec::new();
    for name in style_names() {
        let picture = picture_of(&mut session, &scene_in(style(name)), method);
        let picture = picture.expect("a picture");
        for (other, theirs) in &all {
            assert!(*theirs != picture, "{name} looks like {other}");
        }
        all.push((name, picture));
    }
}

#[test]
fn bands_make_the_picture_of_one_piece() {
    let ghost = Ghost {
        kind: GhostKind::Both,
        width: 9.0,
        ..Ghost::default()
    };
    let occlusion = Occlusion {
        kind: OcclusionKind::Unsharp,
        ..Occlusion::default()
    };
    for (name, style) in [
        ("toon", style("toon")),
        ("technical", style("technical")),
        (
            "a ghost",
            Style {
                ghost,
                ..style("toon")
            },
        ),
        (
            "unsharp",
            Style {
                occlusion,
                ..style("clay")
            },
        ),
    ] {
        bands_make_one(name, style);
    }
}

fn bands_make_one(name: &str, style: Style) {
    let method = Method::from(Strategy::RAYCAST_MASK);
    let scene = scene_in(style);
    let model = Model::new(&scene);
    let view = model.prepared.view([160, 400]);
    let held = |storage_binding_bytes| {
        let gpu = common::gpu();
        let limits = Limits {
            storage_binding_bytes,
            ..Limits::CORE
        };
        let mut session = Session::new(gpu.held_to(limits));
        let drawn = session.draw(&model, &view, method).expect("a frame");
        assert_eq!(drawn.outcome, Outcome::Complete, "a frame to compare");
        let picture = session.picture(method).expect("a picture");
        let layers = session.layers(method).expect("layers");
        (
            session.bands(method).expect("a frame"),
            picture,
            layers,
            session,
        )
    };
    let (one, whole, of_whole, mut in_one) = held(Limits::CORE.storage_binding_bytes);
    let (several, banded, of_bands, mut in_bands) = held(160 * 200 * 12);
    assert_eq!(one, 1, "the control");
    assert!(several > 2, "{several} bands");
    // Layers may differ by the rounding of a rasteriser, what is made of them by that of rays, which each band rounds for itself.
    let is_like = |a: &[u8], b: &[u8]| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1);
    let made_of = |session: &mut Session, layers| {
        let made = session.shade(&model, &view, layers);
        made.expect("a picture")
    };
    assert!(
        is_like(&made_of(&mut in_one, &of_bands), &banded),
        "{name}: bands are seen"
    );
    assert!(
        is_like(&made_of(&mut in_bands, &of_whole), &whole),
        "{name}: bands are seen"
    );
    let mut shifted = of_whole.clone();
    shifted.pixels.rotate_left(1);
    assert!(
        !is_like(&made_of(&mut in_bands, &shifted), &whole),
        "the control"
    );
}

#[test]
fn what_is_transparent_lies_on_paper_as_if_it_were_drawn_there() {
    let mut session = session();
    let method = Method::from(Strategy::RAYCAST_MASK);
    let opaque = style("technical");
    let Paper::Color(paper) = opaque.paper else {
        panic!("technical has paper of one colour");
    };
    let clear = Style {
        paper: Paper::None,
        ..opaque
    };
    let on_paper = picture_of(&mut session, &scene_in(opaque), method).expect("a picture");
    let on_nothing = picture_of(&mut session, &scene_in(clear), method).expect("a picture");
    let layers = session.layers(method).expect("layers");
    let linear = |v: f32| ((v + 0.055) / 1.055).powf(2.4);
    let (mut beyond, mut most) = (0, 0.0_f32);
    for ((layer, a), b) in (layers.pixels.iter())
        .zip(on_paper.chunks_exact(4))
        .zip(on_nothing.chunks_exact(4))
    {
        let share = f32::from(b[3]) / 255.0;
        beyond += usize::from(layer.kind == Kind::Background && b[3] > 0);
        for c in 0..3 {
            let [on, off] = [a[c], b[c]].map(|v| linear(f32::from(v) / 255.0));
            most = most.max((off * share + linear(paper[c]) * (1.0 - share) - on).abs());
        }
    }
    assert!(most < 0.02, "they differ by {most} of linear light");
    assert!(
        beyond > 100,
        "outlines go on beyond the model, by {beyond} pixels"
    );
}
