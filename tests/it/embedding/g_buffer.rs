//! The G-buffer of a host: what the layers say, in attachments that its lights read.

use cutaway::Model;
use cutaway::gpu::{Attachment, GBuffer, TargetDepth, wgpu};
use cutaway::layers::{Kind, Layer};
use cutaway::scene::HostDepth;
use cutaway::session::Encoded;
use cutaway::strategies::Strategy;

use super::common::scenes;
use super::host::{DEPTH, Host};

const SIZE_PX: [u32; 2] = [160, 120];
const NORMALS: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// What of a layer the third attachment holds.
fn word_of(layer: &Layer) -> u32 {
    let flags = u32::from(layer.back_face) << 2
        | u32::from(layer.unreliable) << 3
        | u32::from(layer.overlap) << 4;
    layer.kind as u32 | flags | u32::from(layer.clip_surface) << 8 | u32::from(layer.part) << 16
}

#[test]
fn it_holds_what_the_layers_say() {
    let host = Host::new(SIZE_PX, wgpu::TextureFormat::Rgba8Unorm);
    let mut scene = scenes::sectioned("crank", &["-z=50%"]);
    scene.parts[0].material.color = glam::Vec3::new(0.2, 0.4, 0.6);
    let model = Model::new(&scene);
    let view_of_all = model.prepared.view(SIZE_PX);
    let normals = host.attachment(SIZE_PX, NORMALS);
    let words = host.attachment(SIZE_PX, wgpu::TextureFormat::R32Uint);
    let [normal_view, word_view] =
        [&normals, &words].map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
    let [color, depth] = &host.views();
    let buffer = GBuffer {
        base_color: Attachment {
            view: color,
            format: wgpu::TextureFormat::Rgba8Unorm,
        },
        normal: Attachment {
            view: &normal_view,
            format: normals.format(),
        },
        what: &word_view,
        depth: TargetDepth {
            view: depth,
            format: DEPTH,
            // Nearer is greater: the reciprocal of the distance.
            convention: HostDepth {
                coefficients: [0.0, 1.0, 1.0, 0.0],
            },
        },
        origin_px: [0, 0],
    };
    let mut session = host.session();
    let method = Strategy::RAYCAST_MASK;
    let mut encoder = host.encoder();
    host.clear(&mut encoder, [1.0, 0.0, 1.0], 0.0);
    let encoded = session.encode_g_buffer(&mut encoder, &model, &view_of_all, method, &buffer);
    let Encoded::Drawn { passes } = encoded.expect("a frame") else {
        panic!("refused");
    };
    assert!(passes > 2, "{passes}");
    host.submit(encoder);

    let layers = session.layers(method).expect("layers");
    let (colors, depths) = host.read();
    let of_words: Vec<u32> = bytemuck::pod_collect_to_vec(&host.bytes_of(&words));
    let of_normals: Vec<f32> = bytemuck::pod_collect_to_vec(&host.bytes_of(&normals));
    let mut seen = [0, 0];
    for (i, layer) in layers.pixels.iter().enumerate() {
        let color = &colors[4 * i..4 * i + 3];
        if layer.kind == Kind::Background {
            assert_eq!((color, depths[i]), (&[255, 0, 255][..], 0.0), "pixel {i}");
            continue;
        }
        assert_eq!(of_words[i], word_of(layer), "pixel {i}");
        let part = &scene.parts[usize::from(layer.part)];
        let is_cap = layer.kind == Kind::Cap;
        seen[usize::from(is_cap)] += 1;
        let expected = match is_cap {
            true => part.material.cap_color(),
            false => part.material.color,
        };
        let expected = (expected * 255.0).round().to_array().map(|c| c as u8);
        assert!(
            color.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 1),
            "pixel {i}: {color:?} for {expected:?}"
        );
        let normal = [0, 1, 2].map(|axis| of_normals[4 * i + axis]);
        let off = (glam::Vec3::from(normal) - layer.normal).length();
        assert!(off < 2e-3, "pixel {i}: {normal:?} for {:?}", layer.normal);
        let distance = layer.depth / model.prepared.scale;
        let ratio = f64::from(depths[i]) * distance;
        assert!((ratio - 1.0).abs() < 1e-5, "pixel {i}: {ratio}");
    }
    // What would fail when the host finishes its encoder is refused by name.
    let small = host.attachment([80, 60], NORMALS);
    let small_view = small.create_view(&wgpu::TextureViewDescriptor::default());
    let unsigned = wgpu::TextureFormat::Rgba8Unorm;
    let wrong = [
        (&small_view, normals.format(), "does not fit"),
        (&normal_view, unsigned, "not Rgba8Unorm"),
        (color, unsigned, "no negative numbers"),
    ];
    for (view, format, reason) in wrong {
        let normal = Attachment { view, format };
        let buffer = GBuffer { normal, ..buffer };
        let mut encoder = host.encoder();
        let refused = session.encode_g_buffer(&mut encoder, &model, &view_of_all, method, &buffer);
        let message = refused.expect_err("a bad attachment").to_string();
        assert!(
            message.contains("the normals") && message.contains(reason),
            "{message}"
        );
    }
    // The control: both kinds are there to be compared.
    assert!(seen.iter().all(|count| *count > 200), "{seen:?}");
}
