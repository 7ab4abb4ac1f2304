//! Ghost: what is gone is where the uncut scene is before the cut one, and costs nothing where nothing is.

use super::*;
use cutaway::layers::Layers;
use cutaway::plan::Capacities;
use cutaway::strategies;

fn with(kind: GhostKind) -> Style {
    Style {
        ghost: Ghost {
            kind,
            ..Ghost::default()
        },
        ..Style::default()
    }
}

fn drawn(scene: &Scene) -> (Layers, Vec<u8>) {
    let mut session = session();
    let method = Method::from(Strategy::RAYCAST_MASK);
    let picture = picture_of(&mut session, scene, method).expect("a picture");
    (session.layers(method).expect("layers"), picture)
}

#[test]
fn glass_is_where_something_is_gone_and_nowhere_else() {
    let (shown, plain) = drawn(&scene_in(Style {
        paper: Paper::Color(glam::Vec3::ONE),
        ..Style::default()
    }));
    let (_, ghostly) = drawn(&scene_in(Style {
        paper: Paper::Color(glam::Vec3::ONE),
        ..with(GhostKind::Glass)
    }));
    let mut whole = scene_in(Style::default());
    whole.cuts.clear();
    let (uncut, _) = drawn(&whole);
    let pixels = shown.pixels.iter().zip(&uncut.pixels);
    let pictures = plain.chunks_exact(4).zip(ghostly.chunks_exact(4));
    let (mut gone, mut kept) = (0, 0);
    for ((shown, uncut), (plain, ghostly)) in pixels.zip(pictures) {
        // The cut cube alone is drawn as a ghost: the far ball is kept whole.
        let is_gone = uncut.kind == Kind::Surface && shown.depth > uncut.depth + 0.05;
        let is_kept = uncut.kind == Kind::Background || shown.depth < uncut.depth + 1e-4;
        if is_gone {
            gone += 1;
            assert!(plain != ghostly, "glass is missing before {shown:?}");
        } else if is_kept {
            kept += 1;
            assert!(plain == ghostly, "glass before {shown:?}");
        }
    }
    assert!(gone > 1000 && kept > 1000, "{gone} gone, {kept} kept");
}

#[test]
fn lines_lie_on_the_outline_of_what_is_gone() {
    let (_, plain) = drawn(&scene_in(Style::default()));
    let (_, lined) = drawn(&scene_in(with(GhostKind::Lines)));
    let (_, both) = drawn(&scene_in(with(GhostKind::Both)));
    let (_, glass) = drawn(&scene_in(with(GhostKind::Glass)));
    let changed = |a: &[u8], b: &[u8]| {
        let pairs = a.chunks_exact(4).zip(b.chunks_exact(4));
        pairs.filter(|(a, b)| a != b).count()
    };
    let on_lines = changed(&plain, &lined);
    assert!((50..2000).contains(&on_lines), "{on_lines} pixels of lines");
    assert!(changed(&both, &glass) > 50 && changed(&both, &lined) > 1000);
}

#[test]
fn nothing_that_is_gone_is_no_pass() {
    let passes = |scene: &Scene| -> Vec<String> {
        let model = Model::new(scene);
        let view = model.prepared.view(SIZE_PX);
        let strategy = Strategy::RAYCAST_MASK;
        let plan = strategies::plan(&model, &view, strategy, &Capacities::UNKNOWN);
        let plan = plan.unwrap_or_else(|refusal| panic!("{}", refusal.reason));
        plan.passes.iter().map(|p| p.name.clone()).collect()
    };
    let ghostly = |scene: &Scene| passes(scene).iter().any(|p| p.contains("ghost"));
    let mut scene = scene_in(with(GhostKind::Both));
    assert!(ghostly(&scene), "the control");
    let away = ClipSurface::parse("z=-500", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("away", vec![away])];
    assert!(!ghostly(&scene), "no cut reaches a part");
    let glass = passes(&scene_in(with(GhostKind::Glass)));
    let has_borders = glass.iter().any(|p| p == "find ghost borders");
    assert!(!has_borders, "glass has no lines: {glass:?}");
    assert!(!ghostly(&scene_in(style("technical"))), "nobody asks");
}

#[test]
fn what_is_removed_altogether_is_a_ghost_too() {
    let mut scene = scene_in(with(GhostKind::Glass));
    let all = ClipSurface::parse("z=500", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("all", vec![all])];
    let (layers, ghostly) = drawn(&scene);
    let is_empty = layers.pixels.iter().all(|l| l.kind == Kind::Background);
    scene.style = Style {
        paper: Paper::Gradient,
        shading: cutaway::scene::style::Shading::Flat,
        ..Style::default()
    };
    let (_, plain) = drawn(&scene);
    assert!(is_empty, "the cut removes everything");
    assert!(ghostly != plain, "and its glass is seen");
}
