//! Hatches: their direction and their distance, measured from the picture; parts that touch; stillness.

use super::*;
use crate::common::{is_long, some};
use cutaway::layers::Layers;
use cutaway::scene::style::{Hatch, HatchAnchor, HatchZoom, Shading, Strokes, Tint};
use cutaway::scene::{
    Camera, CapHatch, Dash, HatchPattern, LineFamily, Projection, View, Viewpoint,
};
use glam::DVec2;
use std::sync::Arc;

/// White caps with black lines and nothing else.
fn lines(angle_deg: f32) -> Style {
    let mut style = Style {
        paper: Paper::Color(glam::Vec3::ONE),
        shading: Shading::Flat,
        strokes: Strokes::default(),
        hatch: Hatch {
            width: 3.0,
            alpha: 1.0,
            angle_deg,
            least: 25.0,
            most: 25.0,
            solid_below: 0.0,
            ..Hatch::default()
        },
        ..Style::default()
    };
    style.cap.tint = Tint::Color(glam::Vec3::ONE);
    style
}

/// A cube that is cut by a plane and seen through a camera.
fn cut_cube(section: &str, camera: Camera, style: Style) -> Scene {
    let parts = vec![Part::new("cube", meshes::shape("cube"))];
    let mut scene = scenes::of_parts("hatched", parts, Vec::new());
    let plane = ClipSurface::parse(section, &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    scene.camera = camera;
    scene.style = style;
    scene
}

struct Drawn {
    view: View,
    model: Model,
    layers: Layers,
    picture: Vec<u8>,
    /// Across the lines of each part, by its place in the table; none where nothing is hatched.
    across: Vec<[u32; 2]>,
}

fn draw(scene: &Scene, size_px: [u32; 2]) -> Drawn {
    draw_model(Model::new(scene), size_px)
}

fn draw_model(model: Model, size_px: [u32; 2]) -> Drawn {
    let view = model.prepared.view(size_px);
    let method = Method::from(Strategy::RAYCAST_MASK);
    let mut session = session();
    let drawn = session.draw(&model, &view, method).expect("a frame");
    assert_eq!(drawn.outcome, Outcome::Complete, "a frame");
    let layers = session.layers(method).expect("layers");
    let picture = session.picture(method).expect("a picture");
    let lines = session.words(method, "hatch_lines").unwrap_or_default();
    let across = lines.chunks_exact(16).map(|row| [row[0], row[1]]);
    Drawn {
        across: across.collect(),
        view,
        model,
        layers,
        picture,
    }
}

/// Points of the cap on its plane, in scene units along the horizontal and up, with how dark they are.
fn darkness(drawn: &Drawn) -> Vec<(DVec2, f64)> {
    let surface = &drawn.model.prepared.surfaces[0];
    let normal = -surface.frame.normal;
    let u = DVec3::Y.cross(normal).normalize();
    let v = normal.cross(u);
    let width = drawn.view.size_px[0];
    let pixels = drawn
        .layers
        .pixels
        .iter()
        .zip(drawn.picture.chunks_exact(4));
    let caps = pixels.enumerate().filter(|(_, (l, _))| l.kind == Kind::Cap);
    let samples = caps.map(|(i, (layer, color))| {
        let (x, y) = (i as u32 % width, i as u32 / width);
        let at = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
        let (origin, direction) = drawn.view.ray(at);
        let point = origin + direction * layer.depth;
        (
            DVec2::new(u.dot(point), v.dot(point)),
            1.0 - f64::from(color[0]) / 255.0,
        )
    });
    samples.collect()
}

/// How much of a wave there is in what is dark. Samples fade out away from the middle, as through a window, or families of other directions
/// would leak in.
fn share_of(samples: &[(DVec2, f64)], wave: DVec2) -> f64 {
    let sum = samples.iter().fold(DVec2::ZERO, |sum, (at, dark)| {
        sum + DVec2::from_angle(std::f64::consts::TAU * at.dot(wave)) * *dark
    });
    sum.length()
}

/// Samples less their mean, through a window.
fn windowed(samples: &[(DVec2, f64)]) -> Vec<(DVec2, f64)> {
    // Some thousands of samples all over the cap say as much as all; at regular distances they would have waves of their own.
    let every = samples.len() as u64 / 8192 + 1;
    let scattered = |i: u64| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 33;
    let samples = samples.iter().zip(0..);
    let samples: Vec<_> = samples
        .filter(|(_, i)| scattered(*i) % every == 0)
        .map(|(s, _)| *s)
        .collect();
    let count = samples.len() as f64;
    let middle = samples.iter().map(|s| s.0).sum::<DVec2>() / count;
    let spread = samples
        .iter()
        .map(|s| s.0.distance_squared(middle))
        .sum::<f64>()
        / count;
    let weight = |at: DVec2| (-at.distance_squared(middle) / spread).exp();
    let weights: f64 = samples.iter().map(|s| weight(s.0)).sum();
    let mean = samples.iter().map(|s| weight(s.0) * s.1).sum::<f64>() / weights;
    let faded = samples.iter().map(|s| (s.0, weight(s.0) * (s.1 - mean)));
    faded.collect()
}

/// Direction of lines in degrees, and their distance in scene units, near what is expected.
fn measured(samples: &[(DVec2, f64)], angle_deg: f64, spacing: f64) -> (f64, f64) {
    let samples = windowed(samples);
    let wave = |angle_deg: f64, spacing: f64| {
        let (sin, cos) = angle_deg.to_radians().sin_cos();
        DVec2::new(-sin, cos) / spacing
    };
    let mut best = (0.0, angle_deg, spacing);
    let mut reach = (6.0, 0.08);
    // Finer and finer about the best.
    for _ in 0..3 {
        let (_, angle, distance) = best;
        for (i, j) in (-6..=6).flat_map(|i| (-6..=6).map(move |j| (i, j))) {
            let a = angle + reach.0 * f64::from(i) / 6.0;
            let s = distance * (1.0 + reach.1 * f64::from(j) / 6.0);
            let share = share_of(&samples, wave(a, s));
            if share > best.0 {
                best = (share, a, s);
            }
        }
        reach = (reach.0 / 5.0, reach.1 / 5.0);
    }
    (best.1, best.2)
}

/// A pattern of families of lines: their directions, how far they are apart, and whether they are dashed.
fn pattern(families: &[(f64, f64, bool)]) -> CapHatch {
    let dash = |length, is_drawn| Dash { length, is_drawn };
    let family = |&(angle_deg, spacing, is_dashed): &(f64, f64, bool)| LineFamily {
        angle_deg,
        origin: [0.0; 2],
        shift: 0.0,
        spacing,
        dashes: match is_dashed {
            true => vec![dash(2.0, true), dash(0.5, false)],
            false => Vec::new(),
        },
    };
    CapHatch::Pattern(Arc::new(HatchPattern {
        name: "test".to_owned(),
        families: families.iter().map(family).collect(),
    }))
}

/// From line to line of the general hatch as a style of [`lines`] has it, in scene units.
fn spacing_in(view: &View, middle: DVec3) -> f64 {
    let depth = (middle - view.eye).dot(view.forward);
    0.05 * view.half_height * if view.orthographic { 1.0 } else { depth }
}

#[test]
fn lines_have_the_direction_and_the_distance_that_are_asked_for() {
    let projections = [
        Projection::Perspective { fov_y_deg: 35.0 },
        Projection::Orthographic { height: None },
    ];
    // Each with the families to be found, by direction and distance over that of the general hatch.
    let patterns: [(CapHatch, &[(f64, f64)]); 3] = [
        (CapHatch::General, &[(45.0, 1.0)]),
        (
            pattern(&[(45.0, 1.0, false), (135.0, 1.0, false)]),
            &[(45.0, 1.0), (135.0, 1.0)],
        ),
        // A dashed one across one that has no end: the unit is the closer of the two.
        (
            pattern(&[(20.0, 1.0, false), (80.0, 1.5, true)]),
            &[(20.0, 1.0), (80.0, 1.5)],
        ),
    ];
    let sections = [
        "-z=50%",
        "-x=40%",
        "y=55%",
        "-0.3,-0.2,-1@0,0,0",
        "0.2,-0.5,-1@0,0,0.1",
        "-0.7,-0.6,0.4@0.1,0,0",
    ];
    let mut worst = [0.0_f64; 2];
    let pairs = sections
        .iter()
        .flat_map(|s| patterns.iter().map(move |p| (*s, p)));
    for (number, (section, (hatch, families))) in pairs.enumerate() {
        let views = projections
            .iter()
            .flat_map(|p| [0.8, 1.0, 2.5].map(|z| (*p, z)));
        // Each pair of a section and a pattern in other views than the one before.
        let first = if is_long() {
            0
        } else {
            (number + number / 3) % 3
        };
        for (projection, zoom) in some(views.skip(first), 3) {
            let camera = Camera {
                viewpoint: viewpoint_of(section),
                projection,
                zoom,
                ..Camera::default()
            };
            let what = format!("{section} {families:?} {projection:?} {zoom}");
            let mut scene = cut_cube(section, camera, lines(45.0));
            scene.parts[0].material.hatch = hatch.clone();
            let drawn = draw(&scene, [400, 300]);
            let bounds = &drawn.model.prepared.bounds;
            let unit = spacing_in(&drawn.view, bounds.centre());
            let samples = darkness(&drawn);
            assert!(samples.len() > 5000, "{what}: {} samples", samples.len());
            for (angle_deg, spacing) in families.iter().map(|(a, s)| (*a, s * unit)) {
                let (angle, found) = measured(&samples, angle_deg, spacing);
                let off = [(angle - angle_deg).abs(), (found / spacing - 1.0).abs()];
                assert!(
                    off[0] < 0.5,
                    "{what}: {angle} degrees of {} samples",
                    samples.len()
                );
                assert!(off[1] < 0.01, "{what}: {found}, not {spacing}");
                worst = [worst[0].max(off[0]), worst[1].max(off[1])];
            }
        }
    }
    println!(
        "{} degrees and {} of the distance at most",
        worst[0], worst[1]
    );
    // The control.
    let drawn = draw(
        &cut_cube("-z=50%", Camera::default(), lines(46.0)),
        [400, 300],
    );
    let spacing = spacing_in(&drawn.view, drawn.model.prepared.bounds.centre());
    let (angle, _) = measured(&darkness(&drawn), 45.0, spacing);
    assert!(
        (angle - 45.0).abs() > 0.5,
        "46 degrees are noticed: {angle}"
    );
}

/// From where a section is seen at less than a grazing angle.
fn viewpoint_of(section: &str) -> Viewpoint {
    let (azimuth_deg, elevation_deg) = match section {
        "-x=40%" => (65.0, 25.0),
        "-0.7,-0.6,0.4@0.1,0,0" => (50.0, 25.0),
        "y=55%" => (20.0, -40.0),
        _ => (20.0, 30.0),
    };
    Viewpoint::Orbit {
        azimuth_deg,
        elevation_deg,
    }
}

#[test]
fn lines_double_where_the_camera_comes_nearer() {
    let at = |zoom: f64| {
        let camera = Camera {
            projection: Projection::Orthographic { height: None },
            zoom,
            ..Camera::default()
        };
        let mut scene = cut_cube("-z=50%", camera, lines(45.0));
        scene.style.hatch.zoom = HatchZoom::Banded;
        scene
    };
    let first = Model::new(&at(1.0));
    let unit = {
        let view = first.prepared.view([400, 300]);
        spacing_in(&view, first.prepared.bounds.centre())
    };
    for (zoom, spacing) in [(1.0, 1.0), (2.0, 0.5), (4.0, 0.25), (0.5, 2.0)] {
        let drawn = draw_model(first.updated(&at(zoom)), [400, 300]);
        let (angle, found) = measured(&darkness(&drawn), 45.0, unit * spacing);
        assert!((angle - 45.0).abs() < 0.5, "{zoom}: {angle} degrees");
        let found = found / unit;
        assert!((found / spacing - 1.0).abs() < 0.01, "{zoom}: {found}");
    }
    // In between the lines of the next scale are on their way: no tone jumps.
    let tone = |zoom: f64| {
        let samples = darkness(&draw_model(first.updated(&at(zoom)), [400, 300]));
        samples.iter().map(|s| s.1).sum::<f64>() / samples.len() as f64
    };
    for zoom in [1.0, 2.0] {
        let [before, after] = [zoom - 1e-3, zoom + 1e-3].map(tone);
        assert!(
            (before - after).abs() < 0.01,
            "{before} and {after} at {zoom}"
        );
    }
}

#[test]
fn a_part_that_moves_carries_its_lines() {
    let turn = DAffine3::from_rotation_translation(
        glam::DQuat::from_rotation_z(0.6),
        DVec3::new(0.05, -0.03, 0.0),
    );
    for (anchor, is_carried) in [(HatchAnchor::Part, true), (HatchAnchor::Cut, false)] {
        let mut scene = cut_cube("-z=50%", Camera::default(), lines(45.0));
        scene.stage = Some(scene.bounds());
        scene.style.hatch.anchor = anchor;
        let first = Model::new(&scene);
        scene.parts[0].world_from_part = turn;
        let drawn = draw_model(first.updated(&scene), [200, 150]);
        let channels = session().style_channels(&drawn.model, &drawn.view, &drawn.layers);
        let uv = channels.expect("channels").cap_uv;
        let prepared = &drawn.model.prepared;
        let mut offsets: Vec<DVec2> = Vec::new();
        for (i, (layer, [u, v])) in drawn.layers.pixels.iter().zip(uv).enumerate() {
            if layer.kind == Kind::Cap {
                let at = DVec2::new((i % 200) as f64, (i / 200) as f64) + 0.5;
                let (origin, direction) = drawn.view.ray(at);
                let point = (origin + direction * layer.depth) / prepared.scale;
                let at_rest = turn
                    .inverse()
                    .transform_point3(point + prepared.centre_in_world);
                let at_rest = at_rest.truncate() * prepared.scale;
                offsets.push(DVec2::new(f64::from(u), f64::from(v)) - at_rest);
            }
        }
        assert!(offsets.len() > 3000, "{} pixels of caps", offsets.len());
        let apart = offsets.iter().map(|o| (*o - offsets[0]).length());
        let farthest = apart.fold(0.0, f64::max);
        assert_eq!(farthest < 1e-5, is_carried, "{anchor:?}: {farthest}");
    }
}

#[test]
fn lines_stay_where_they_are_while_the_cut_and_the_camera_move() {
    let at = |section: &str, azimuth_deg: f64| {
        let camera = Camera {
            viewpoint: Viewpoint::Orbit {
                azimuth_deg,
                elevation_deg: 30.0,
            },
            ..Camera::default()
        };
        cut_cube(section, camera, lines(45.0))
    };
    let scene = at("-z=50%", 20.0);
    let first = Model::new(&scene);
    let mut session = session();
    let method = Method::from(Strategy::RAYCAST_MASK);
    let mut lines = Vec::new();
    // What a place on the cap has less its place in the scene: the same for all pixels of all frames.
    let mut offsets: Vec<DVec2> = Vec::new();
    for scene in [scene, at("-z=62%", 20.0), at("-z=62%", 35.0)] {
        let model = first.updated(&scene);
        let view = model.prepared.view([200, 150]);
        let drawn = session.draw(&model, &view, method).expect("a frame");
        assert_eq!(drawn.outcome, Outcome::Complete, "a frame");
        lines.push(session.words(method, "hatch_lines").expect("a table"));
        let layers = session.layers(method).expect("layers");
        let channels = session.style_channels(&model, &view, &layers);
        let uv = channels.expect("channels").cap_uv;
        for (i, (layer, [u, v])) in layers.pixels.iter().zip(uv).enumerate() {
            if layer.kind == Kind::Cap {
                let at = DVec2::new((i % 200) as f64, (i / 200) as f64) + 0.5;
                let (origin, direction) = view.ray(at);
                let point = origin + direction * layer.depth;
                offsets.push(DVec2::new(f64::from(u), f64::from(v)) - point.truncate());
            }
        }
    }
    assert!(lines.iter().all(|l| *l == lines[0]), "{lines:?}");
    assert!(offsets.len() > 3000, "{} pixels of caps", offsets.len());
    // The lines are 25 thousandths of the picture apart, which are about 0.04 here.
    let apart = offsets.iter().map(|o| (*o - offsets[0]).length());
    let farthest = apart.fold(0.0, f64::max);
    assert!(farthest < 1e-6, "a place moved by {farthest}");
}

#[test]
fn what_touches_is_hatched_unlike() {
    let mut parts = Vec::new();
    for (i, x) in [0.0, 1.0, 2.0, 5.0].into_iter().enumerate() {
        let mut cube = Part::new(format!("c{i}"), meshes::shape("cube"));
        let size = cube.mesh.bounds().size().x;
        cube.world_from_part = DAffine3::from_translation(DVec3::X * x * size);
        parts.push(cube);
    }
    let mut scene = scenes::of_parts("row", parts, Vec::new());
    let plane = ClipSurface::parse("-z=50%", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    scene.style = style("technical");
    let Drawn { across, .. } = draw(&scene, [300, 100]);
    assert_eq!(across.len(), 4, "a row for each part");
    // Those in a row touch, the last is alone. Places are in the order of parts: all are of one size.
    assert!(
        across[0] != across[1] && across[1] != across[2],
        "{across:?}"
    );
    let distinct: std::collections::BTreeSet<_> = across.iter().collect();
    assert_eq!(distinct.len(), 2, "two directions are enough: {across:?}");
}
