//! Relief cuts: flat ones are planes, and every cap lies on its surface.

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, OffsetMap, Prepared, Wrap};
use glam::{DVec2, DVec3, dvec3};

use crate::exactness::exact::solids::{
    ball, differing, fractal, frame, noise, orbit, parallel, relief, scene, sound, unit_cube,
};

#[test]
fn a_flat_relief_is_a_plane() {
    let plane = vec![vec![ClipSurface::plane(DVec3::Z * 0.125, DVec3::NEG_Z)]];
    let flat = OffsetMap::new([4, 4], vec![0.25; 16]).unwrap();
    // The same, but for one texel that no ray meets: this one is walked cell by cell.
    let mut texels = vec![0.25; 64 * 64];
    texels[32 * 64 + 32] = 9.0;
    let dented = OffsetMap::new([64, 64], texels).unwrap();
    for camera in [
        orbit(30.0, 40.0),
        parallel(DVec3::Z * 4.0, DVec3::ZERO, 2.0),
    ] {
        let expected = sound(&scene(vec![unit_cube()], plane.clone(), camera), [96, 96]);
        for map in [flat.clone(), dented.clone()] {
            let surface = relief(-0.125, 8.0, 1.0, map);
            let found = sound(
                &scene(vec![unit_cube()], vec![vec![surface]], camera),
                [96, 96],
            );
            assert_eq!(differing(&expected, &found), 0, "a flat map is a plane");
            for (a, b) in expected.layers.pixels.iter().zip(&found.layers.pixels) {
                let off = (a.depth - b.depth).abs();
                assert!(
                    a.kind != b.kind || a.kind == Kind::Background || off < 1e-9,
                    "depth off by {off}"
                );
            }
        }
    }
}

#[test]
fn caps_lie_on_their_surface_and_face_along_its_slope() {
    let mut random = noise(2);
    let white = OffsetMap::new([16, 8], (0..128).map(|_| random() as f32).collect()).unwrap();
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        for camera in [
            orbit(20.0, 50.0),
            orbit(80.0, 5.0),
            parallel(dvec3(3.0, 0.1, 0.6), DVec3::ZERO, 2.0),
        ] {
            let surface = ClipSurface {
                wrap,
                ..relief(0.0, 0.6, 0.3, white.clone())
            };
            let scene = scene(vec![ball(1.0, 24, 24)], vec![vec![surface.clone()]], camera);
            let prepared = Prepared::new(&scene);
            let view = prepared.view([96, 96]);
            let exact = sound(&scene, [96, 96]);
            let mut caps = 0;
            for y in 0..96 {
                for x in 0..96 {
                    let layer = exact.layers.at(x, y);
                    if layer.kind != Kind::Cap {
                        continue;
                    }
                    caps += 1;
                    let (o, d) = view.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
                    let at = |t: f64| (o + d * t) / prepared.scale + prepared.centre_in_world;
                    let point = at(layer.depth);
                    let height = surface.kept_height(point);
                    assert!(height.abs() < 1e-6, "kept height {height} on the cap");
                    let step = 1e-5;
                    let slope = [DVec3::X, DVec3::Y, DVec3::Z].map(|e| {
                        surface.kept_height(point + e * step)
                            - surface.kept_height(point - e * step)
                    });
                    let normal = -DVec3::from(slope).normalize();
                    let cosine = normal.dot(layer.normal.as_dvec3());
                    // At a crease between texels the differences straddle two slopes.
                    assert!(
                        cosine > 0.9999 || crease(&surface, point),
                        "cosine {cosine}"
                    );
                }
            }
            assert!(caps > 200, "only {caps} px of cap");
        }
    }
}

fn crease(surface: &ClipSurface, point: DVec3) -> bool {
    let map = surface.relief.as_ref().expect("only reliefs have creases");
    let size = map.size().map(f64::from);
    let texel = surface.map_from_world(point) * DVec2::from(size) - 0.5;
    (texel - texel.round()).abs().min_element() < 1e-3
}

#[test]
fn a_relief_seen_edge_on_is_sound_at_every_scale() {
    for height in [0.01, 0.2, 3.0] {
        for camera in [
            orbit(0.0, 0.0),
            orbit(45.0, 0.5),
            parallel(DVec3::X * 3.0, DVec3::ZERO, 2.0),
        ] {
            let cut = vec![vec![relief(0.05, 0.4, height, fractal(64, 6))]];
            let exact = sound(&scene(vec![unit_cube()], cut, camera), [128, 128]);
            assert!(
                exact.covered_px() > 100,
                "something is left at height {height}"
            );
        }
    }
    // Control: the relief is there at all.
    let [low, high] = [0.01, 0.2].map(|h| {
        let cut = vec![vec![relief(0.05, 0.4, h, fractal(64, 6))]];
        frame(
            &scene(vec![unit_cube()], cut, orbit(30.0, 20.0)),
            [128, 128],
        )
    });
    assert!(differing(&low, &high) > 50, "height changes the picture");
}
