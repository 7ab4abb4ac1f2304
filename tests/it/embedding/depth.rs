//! Composition by depth: at every pixel what is nearer, the host's or ours, in whatever convention the host keeps.

use cutaway::Model;
use cutaway::gpu::wgpu;
use cutaway::layers::Kind;
use cutaway::scene::HostDepth;
use cutaway::session::Encoded;
use cutaway::strategies::Strategy;
use glam::dcamera::rh::proj::directx::{orthographic, perspective, perspective_infinite_reverse};
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3};

use super::common::scenes;
use super::host::Host;

const SIZE_PX: [u32; 2] = [160, 120];
const NEAR: f64 = 0.5;

#[test]
fn the_nearer_one_is_seen_in_every_convention() {
    let scene = scenes::sectioned("sphere?subdivisions=3", &["-z=50%"]);
    let model = Model::new(&scene);
    let aspect = f64::from(SIZE_PX[0]) / f64::from(SIZE_PX[1]);
    let world_from_view = look_at_mat4(DVec3::new(0.3, 0.4, 2.5), DVec3::ZERO, DVec3::Y).inverse();
    for (name, clip_from_view) in [
        ("reversed", perspective_infinite_reverse(0.6, aspect, NEAR)),
        ("usual", perspective(0.6, aspect, NEAR, 20.0)),
        (
            "parallel",
            orthographic(-aspect, aspect, -1.0, 1.0, NEAR, 20.0),
        ),
    ] {
        composed(name, &model, &world_from_view, &clip_from_view);
    }
}

/// The host's depth is everywhere that of a wall which the sphere sticks out of.
fn composed(name: &str, model: &Model, world_from_view: &DMat4, clip_from_view: &DMat4) {
    let host = Host::new(SIZE_PX, wgpu::TextureFormat::Rgba8Unorm);
    let convention = HostDepth::from_projection(clip_from_view);
    let view = (model.prepared)
        .view_from(world_from_view, clip_from_view, SIZE_PX)
        .expect("a camera");
    let mut session = host.session();
    let method = Strategy::RAYCAST_MASK;
    let _ = session.draw(model, &view, method).expect("a frame");
    let layers = session.layers(method).expect("layers");
    let picture = session.picture(method).expect("a picture");
    let in_world = |depth: f64| depth / model.prepared.scale;
    let mut depths: Vec<f64> = (layers.pixels.iter())
        .filter(|p| p.kind != Kind::Background)
        .map(|p| in_world(p.depth))
        .collect();
    depths.sort_by(f64::total_cmp);
    let wall = depths[depths.len() / 2] + 1e-4;

    let views = host.views();
    for background in [false, true] {
        let mut encoder = host.encoder();
        host.clear(&mut encoder, [0.0, 1.0, 0.0], convention.at(wall) as f32);
        let mut target = host.target(&views, Some(convention));
        target.background = background;
        let encoded = session.encode(&mut encoder, model, &view, method, &target);
        assert!(
            matches!(encoded, Ok(Encoded::Drawn { .. })),
            "{name}: {encoded:?}"
        );
        host.submit(encoder);
        let (color, depth) = host.read();
        let (mut ours, mut theirs) = (0, 0);
        for (i, layer) in layers.pixels.iter().enumerate() {
            let own = in_world(layer.depth);
            let is_ours = layer.kind != Kind::Background && own < wall;
            let expected: [u8; 4] = match is_ours {
                true => picture[i * 4..][..4].try_into().expect("four bytes"),
                false => [0, 255, 0, 255],
            };
            assert_eq!(color[i * 4..][..4], expected, "{name}: pixel {i}");
            let at = if is_ours { own } else { wall };
            let off = (f64::from(depth[i]) - convention.at(at)).abs();
            assert!(off < 1e-5, "{name}: pixel {i} is {off} off in depth");
            *(if is_ours { &mut ours } else { &mut theirs }) += 1;
        }
        assert!(ours > 1000 && theirs > 3000, "{name}: {ours}, {theirs}");
    }
    // Where the host has drawn nothing, the sky is drawn if it is wanted.
    for background in [false, true] {
        let mut encoder = host.encoder();
        host.clear(&mut encoder, [0.0, 1.0, 0.0], convention.far() as f32);
        let mut target = host.target(&views, Some(convention));
        target.background = background;
        let _ = session.encode(&mut encoder, model, &view, method, &target);
        host.submit(encoder);
        let (color, _) = host.read();
        let green = color
            .chunks_exact(4)
            .filter(|c| *c == [0, 255, 0, 255])
            .count();
        let sky = layers.count(Kind::Background);
        assert_eq!(green, if background { 0 } else { sky }, "{name}");
    }
}
