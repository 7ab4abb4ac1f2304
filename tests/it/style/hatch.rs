//! Hatches: their direction and their distance, measured from the picture; parts that touch; stillness.

use super::*;
use cutaway::layers::Layers;
use cutaway::scene::style::{Hatch, Shading, Strokes, Tint};
use cutaway::scene::{Camera, Projection, View, Viewpoint};
use glam::DVec2;

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
    let model = Model::new(scene);
    let view = model.prepared.view(size_px);
    let method = Method::from(Strategy::RAYCAST_MASK);
    let mut session = session();
    let drawn = session.draw(&model, &view, method).expect("a frame");
    assert_eq!(drawn.outcome, Outcome::Complete, "{}", scene.name);
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

/// How much of a wave there is in what is dark.
fn share_of(samples: &[(DVec2, f64)], mean: f64, wave: DVec2) -> f64 {
    let sum = samples.iter().fold(DVec2::ZERO, |sum, (at, dark)| {
        let phase = std::f64::consts::TAU * at.dot(wave);
        sum + (dark - mean) * DVec2::new(phase.cos(), phase.sin())
    });
    sum.length() / samples.len() as f64
}

/// Direction of lines in degrees, and their distance in scene units, near what is expected.
fn measured(samples: &[(DVec2, f64)], angle_deg: f64, spacing: f64) -> (f64, f64) {
    let mean = samples.iter().map(|s| s.1).sum::<f64>() / samples.len() as f64;
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
            let share = share_of(samples, mean, wave(a, s));
            if share > best.0 {
                best = (share, a, s);
            }
        }
        reach = (reach.0 / 5.0, reach.1 / 5.0);
    }
    (best.1, best.2)
}

#[test]
fn lines_have_the_direction_and_the_distance_that_are_asked_for() {
    let projections = [
        Projection::Perspective { fov_y_deg: 35.0 },
        Projection::Orthographic { height: None },
    ];
    for section in ["-z=50%", "-0.3,-0.2,-1@0,0,0", "0.2,-0.5,-1@0,0,0.1"] {
        for projection in projections {
            for zoom in [0.8, 1.0, 2.5] {
                let camera = Camera {
                    viewpoint: Viewpoint::Orbit {
                        azimuth_deg: 20.0,
                        elevation_deg: 30.0,
                    },
                    projection,
                    zoom,
                    ..Camera::default()
                };
                let what = format!("{section} {projection:?} {zoom}");
                let drawn = draw(&cut_cube(section, camera, lines(45.0)), [400, 300]);
                let samples = darkness(&drawn);
                assert!(samples.len() > 5000, "{what}: {} samples", samples.len());
                let middle =
                    (drawn.model.prepared.bounds.min + drawn.model.prepared.bounds.max) / 2.0;
                let depth = (middle - drawn.view.eye).dot(drawn.view.forward);
                let height = 2.0
                    * drawn.view.half_height
                    * if drawn.view.orthographic { 1.0 } else { depth };
                let spacing = 0.025 * height;
                let (angle, found) = measured(&samples, 45.0, spacing);
                assert!((angle - 45.0).abs() < 0.5, "{what}: {angle} degrees");
                assert!(
                    (found / spacing - 1.0).abs() < 0.01,
                    "{what}: {found}, not {spacing}"
                );
            }
        }
    }
    // The control.
    let drawn = draw(
        &cut_cube("-z=50%", Camera::default(), lines(46.0)),
        [400, 300],
    );
    let middle = (drawn.model.prepared.bounds.min + drawn.model.prepared.bounds.max) / 2.0;
    let depth = (middle - drawn.view.eye).dot(drawn.view.forward);
    let (angle, _) = measured(
        &darkness(&drawn),
        45.0,
        0.05 * drawn.view.half_height * depth,
    );
    assert!(
        (angle - 45.0).abs() > 0.5,
        "46 degrees are noticed: {angle}"
    );
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
