//! Ghost: what is gone is where the uncut scene is before the cut one, and costs nothing where nothing is.

use super::*;
use cutaway::layers::Layers;
use cutaway::plan::Capacities;
use cutaway::scene::Viewpoint;
use cutaway::strategies;
use glam::DVec2;

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
fn edges_in_all_directions_are_dashed() {
    // A cube that is gone, from around: each edge that is seen is drawn for about 27 widths of 34, and seen to be.
    for azimuth_deg in [0.0, 20.0, 30.0, 60.0, 75.0] {
        let ghost = Ghost {
            kind: GhostKind::Lines,
            width: 6.0,
            alpha: 1.0,
            ..Ghost::default()
        };
        let parts = vec![Part::new("cube", meshes::shape("cube"))];
        let mut scene = scenes::of_parts("gone", parts, Vec::new());
        let all = ClipSurface::parse("y=500", &scene.bounds()).expect("a section");
        scene.cuts = vec![Cut::new("all", vec![all])];
        scene.camera.viewpoint = Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg: 25.0,
        };
        scene.style = Style {
            paper: Paper::Color(glam::Vec3::ONE),
            ghost,
            ..Style::default()
        };
        let model = Model::new(&scene);
        let view = model.prepared.view([640, 480]);
        let mut session = session();
        let method = Method::from(Strategy::RAYCAST_MASK);
        let drawn = session.draw(&model, &view, method).expect("a frame");
        assert_eq!(drawn.outcome, Outcome::Complete, "a frame");
        let picture = session.picture(method).expect("a picture");
        let is_dark = |at: DVec2| {
            let near = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y)));
            let mut near = near.map(|(x, y)| (at.x as i32 + x, at.y as i32 + y));
            near.any(|(x, y)| picture[4 * (y * 640 + x) as usize] < 100)
        };
        let bounds = model.prepared.bounds;
        let corners = bounds.corners();
        let toward = |p: DVec3| (p - view.eye).normalize();
        for (i, a) in corners.iter().enumerate() {
            for b in &corners[..i] {
                let axes = (*a - *b).to_array().map(|d| d.abs() > 1e-9);
                let middle = (*a + *b) / 2.0 - bounds.centre();
                // An edge, of which a face is turned to the eye.
                let is_edge = axes.iter().filter(|d| **d).count() == 1;
                let is_seen = (0..3).any(|k| {
                    let face = DVec3::AXES[k] * middle[k].signum();
                    !axes[k] && toward(*a).dot(face) < -0.02
                });
                let ends = [*a, *b].map(|p| view.project(p).0);
                let length = (ends[0] - ends[1]).length();
                if !is_edge || !is_seen || length < 60.0 {
                    continue;
                }
                let count = 200;
                let along: Vec<bool> = (10..count - 10)
                    .map(|k| is_dark(ends[0].lerp(ends[1], f64::from(k) / f64::from(count))))
                    .collect();
                let dark = along.iter().filter(|d| **d).count() as f64 / along.len() as f64;
                let turns = along.windows(2).filter(|w| w[0] != w[1]).count();
                let what = format!("{a} to {b} from {azimuth_deg}: {dark} in {turns} turns");
                assert!((0.5..0.99).contains(&dark) && turns >= 2, "{what}");
            }
        }
    }
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
