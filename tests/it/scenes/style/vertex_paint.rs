//! Surfaces show the colours that files paint them with, whoever drew the layers, and wherever the part goes.

use super::*;
use cutaway::scene::style::Shading;
use cutaway::scene::{Mesh, Projection, TexturedTriangle, VertexPaint, Viewpoint};
use cutaway_io::load::{Memory, load_mesh_file_from};
use glam::{Vec2, Vec3};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// The cube, each vertex in the colour of its place.
fn cube_in_colours() -> Mesh {
    let mut mesh = Mesh::clone(&meshes::shape("cube"));
    let bounds = mesh.bounds();
    let color = |i: u32| {
        let share = (mesh.positions[i as usize] - bounds.min) / bounds.size();
        let [r, g, b] = (share * 255.0).round().to_array().map(|c| c as u8);
        [r, g, b, 255]
    };
    let triangles = mesh.triangles.iter().map(|t| TexturedTriangle {
        colors: t.map(color),
        ..TexturedTriangle::default()
    });
    mesh.vertex_paint = Some(VertexPaint {
        images: Vec::new(),
        triangles: triangles.collect(),
    });
    mesh
}

fn scene_of(mesh: Mesh, style: Style) -> Scene {
    let mut scene = scenes::of_parts("coated", vec![Part::new("cube", mesh)], Vec::new());
    let plane = ClipSurface::parse("-1,-0.4,-1@60%,50%,60%", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    scene.style = style;
    scene
}

/// Colours as they are, without light.
fn flat() -> Style {
    Style {
        shading: Shading::Flat,
        ..Style::default()
    }
}

#[test]
fn every_strategy_shows_the_vertex_paint_at_its_surfaces() {
    let mut session = session();
    let scene = scene_of(cube_in_colours(), flat());
    let bounds = scene.bounds();
    let model = Model::new(&scene);
    let view = model.prepared.view(SIZE_PX);
    let mut compared = 0;
    for strategy in Strategy::all() {
        for by in [Rasteriser::Hardware, Rasteriser::Compute] {
            let method = Method::new(strategy, DrawOptions::by(by));
            let Some((layers, drawn)) = drawn_as_shaded(&mut session, ("colours", &scene), method)
            else {
                continue;
            };
            compared += 1;
            let mut off = 0;
            let mut shown = 0;
            for (i, (layer, color)) in layers.pixels.iter().zip(drawn.chunks_exact(4)).enumerate() {
                if layer.kind != Kind::Surface {
                    continue;
                }
                let at = glam::DVec2::new(
                    (i as u32 % SIZE_PX[0]) as f64,
                    (i as u32 / SIZE_PX[0]) as f64,
                ) + 0.5;
                let (origin, direction) = view.ray(at);
                let point = (origin + direction * layer.depth) / model.prepared.scale
                    + model.prepared.centre_in_world;
                let share = (point - bounds.min) / bounds.size();
                // Between corners of 0 and 1 colours go evenly in linear light.
                let linear = |c: u8| {
                    let c = f64::from(c) / 255.0;
                    if c <= 0.04045 {
                        c / 12.92
                    } else {
                        ((c + 0.055) / 1.055).powf(2.4)
                    }
                };
                let found = DVec3::new(linear(color[0]), linear(color[1]), linear(color[2]));
                shown += 1;
                off += usize::from((found - share).abs().max_element() > 0.02);
            }
            assert!(shown > 1000, "{method}: {shown} pixels of surfaces");
            // At edges a pixel has the colour of the next one.
            assert!(
                off * 100 <= shown * 2,
                "{method}: {off} of {shown} in other colours"
            );
        }
    }
    assert!(compared > 8, "{compared} pictures");
}

#[test]
fn a_vertex_paint_goes_where_the_part_goes() {
    let mut session = session();
    let still = scene_of(cube_in_colours(), flat());
    let mut turned = still.clone();
    turned.stage = Some(still.bounds());
    let placed = DAffine3::from_rotation_y(0.7);
    turned.parts[0].world_from_part = placed;
    let first = Model::new(&still);
    let view = first.prepared.view(SIZE_PX);
    let method = Method::from(Strategy::RAYCAST_MASK);
    let mut draw = |model: &Model| {
        let drawn = session.draw(model, &view, method).expect("a frame");
        assert_eq!(drawn.outcome, Outcome::Complete);
        session.picture(method).expect("a picture")
    };
    let before = draw(&first);
    let moved = draw(&first.updated(&turned));
    let anew = draw(&Model::new(&turned));
    let differing = moved.chunks_exact(4).zip(anew.chunks_exact(4));
    let differing = differing
        .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2))
        .count();
    assert!(
        differing < 40,
        "{differing} pixels differ from those of a scene packed anew"
    );
    assert!(before != moved, "the control: it has moved");
}

#[test]
fn who_paints_over_or_has_a_style_of_his_own_sees_no_vertex_paint() {
    let passes = |scene: &Scene| {
        let model = Model::new(scene);
        let view = model.prepared.view(SIZE_PX);
        let capacities = cutaway::plan::Capacities::UNKNOWN;
        let plan = cutaway::strategies::plan(&model, &view, Strategy::RAYCAST_MASK, &capacities);
        let plan = plan.unwrap_or_else(|refusal| panic!("{}", refusal.reason));
        plan.passes
            .iter()
            .any(|pass| pass.name == "draw vertex paints")
    };
    for (name, is_shown) in [
        ("lit", true),
        ("clay", true),
        ("vivid", true),
        ("technical", false),
        ("ink", false),
    ] {
        assert_eq!(
            passes(&scene_of(cube_in_colours(), style(name))),
            is_shown,
            "{name}"
        );
    }
    let mut painted = scene_of(cube_in_colours(), Style::default());
    painted.parts[0].material.is_painted_over = true;
    assert!(!passes(&painted), "a colour of its own");
}

const MTL: &str = "newmtl wall\nmap_Kd four.png\nnewmtl roof\nKd 0 0 1\n";

/// A square of two triangles, upright, from -1 to 1, with four texels on it, and a roof in blue.
const OBJ: &str = "mtllib it.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl wall\n\
f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nusemtl roof\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n";

fn four_png() -> Vec<u8> {
    let texels = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]];
    let image = image::RgbImage::from_raw(2, 2, texels.concat()).expect("an image");
    let mut bytes = Vec::new();
    image
        .write_to(
            &mut std::io::Cursor::new(&mut bytes),
            image::ImageFormat::Png,
        )
        .expect("PNG");
    bytes
}

#[test]
fn images_of_an_obj_stand_upright() {
    let mut files = Memory::default();
    files.insert("it.obj", OBJ.as_bytes().to_vec());
    files.insert("it.mtl", MTL.as_bytes().to_vec());
    files.insert("four.png", four_png());
    let loaded = load_mesh_file_from(Path::new("it.obj"), &files).expect("a mesh");
    assert!(
        loaded.files.iter().any(|f| f.ends_with("four.png")),
        "{:?}",
        loaded.files
    );
    let mesh = Mesh::clone(&loaded.parts[0].mesh);
    let vertex_paint = mesh.vertex_paint.as_ref().expect("a coat");
    assert_eq!(vertex_paint.images.len(), 1);
    assert_eq!(
        vertex_paint.triangles[2].colors[0],
        [0, 0, 255, 255],
        "the roof is blue"
    );
    let mut scene = scene_of(mesh, flat());
    scene.cuts.clear();
    scene.camera.viewpoint = Viewpoint::Orbit {
        azimuth_deg: 0.0,
        elevation_deg: 0.0,
    };
    scene.camera.projection = Projection::Orthographic { height: Some(2.0) };
    let picture = picture_of(&mut session(), &scene, Method::from(Strategy::RAYCAST_MASK));
    let picture = picture.expect("a picture");
    let at = |x: u32, y: u32| {
        let first = ((y * SIZE_PX[0] + x) * 4) as usize;
        Vec3::new(
            f32::from(picture[first]),
            f32::from(picture[first + 1]),
            f32::from(picture[first + 2]),
        )
    };
    // The square fills the height of the picture: the middles of its quarters are the middles of texels.
    for (x, y, color) in [
        (50, 30, Vec3::X),
        (110, 30, Vec3::Y),
        (50, 90, Vec3::Z),
        (110, 90, Vec3::ONE),
    ] {
        let found = at(x, y);
        // A pixel beside the middle of a texel has a little of the next ones, and in sRGB a little is 35.
        assert!(
            (found - color * 255.0).abs().max_element() < 50.0,
            "{found} at {x}, {y}, not {color}"
        );
    }
    // An image that is not there is said, and the mesh is read.
    let mut without = Memory::default();
    without.insert("it.obj", OBJ.as_bytes().to_vec());
    without.insert("it.mtl", MTL.as_bytes().to_vec());
    let loaded = load_mesh_file_from(Path::new("it.obj"), &without).expect("a mesh");
    assert!(
        loaded
            .notes
            .iter()
            .any(|n| n.to_string().contains("four.png")),
        "{:?}",
        loaded.notes
    );
}

#[test]
fn vertex_colours_of_a_ply_are_a_vertex_paint_unless_they_are_all_alike() {
    let ply = |last: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
             property uchar green\nproperty uchar blue\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n\
             0 0 0 255 255 255\n1 0 0 255 255 255\n0 1 0 255 255 255\n0 0 1 {last}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
        )
    };
    let vertex_paint = |last: &str| {
        let mut files = Memory::default();
        files.insert("it.ply", ply(last).into_bytes());
        let loaded = load_mesh_file_from(Path::new("it.ply"), &files).expect("a mesh");
        Arc::clone(&loaded.parts[0].mesh).vertex_paint.clone()
    };
    assert_eq!(
        vertex_paint("255 255 255"),
        None,
        "white all over says nothing"
    );
    let vertex_paint = vertex_paint("10 20 30").expect("a coat");
    assert_eq!(vertex_paint.triangles[1].colors[2][..3], [10, 20, 30]);
}

/// A textured tetrahedron as glTF: bytes of its texture coordinates and how they are told, its texture and its image.
fn textured_gltf(uv: &[u8], mut told: Value, texture: &Value, image: &Value) -> Memory {
    let triangles: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let places: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let indices = triangles
        .as_flattened()
        .iter()
        .flat_map(|i| i.to_le_bytes());
    let numbers = places.as_flattened().iter().flat_map(|c| c.to_le_bytes());
    let bytes: Vec<u8> = indices.chain(numbers).chain(uv.iter().copied()).collect();
    for (key, value) in [
        ("bufferView", json!(2)),
        ("count", json!(4)),
        ("type", json!("VEC2")),
    ] {
        told[key] = value;
    }
    let gltf = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "extensionsUsed": ["KHR_mesh_quantization", "KHR_texture_transform"],
        "extensionsRequired": ["KHR_mesh_quantization", "KHR_texture_transform"],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 1, "TEXCOORD_0": 2 }, "indices": 0, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": { "baseColorTexture": texture } }],
        "textures": [{ "source": 0 }], "images": [image],
        "buffers": [{ "uri": "it.bin", "byteLength": bytes.len() }],
        "bufferViews": [
            { "buffer": 0, "byteLength": 24 },
            { "buffer": 0, "byteOffset": 24, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 72, "byteLength": uv.len() },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5123, "count": 12, "type": "SCALAR" },
            { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1] },
            told,
        ],
    });
    let mut files = Memory::default();
    files.insert("it.gltf", gltf.to_string().into_bytes());
    files.insert("it.bin", bytes);
    files
}

#[test]
fn odd_images_of_a_gltf_are_said_and_its_mesh_is_read() {
    let uv: [[f32; 2]; 4] = [
        [f32::NAN, 0.0],
        [f32::INFINITY, 1.0],
        [0.0, 1.0],
        [1e30, 0.0],
    ];
    let uv: Vec<u8> = uv
        .as_flattened()
        .iter()
        .flat_map(|c| c.to_le_bytes())
        .collect();
    for image in [
        json!({}),
        json!({ "bufferView": 0 }),
        json!({ "bufferView": 0, "mimeType": "image/png" }),
        json!({ "uri": "../../etc/passwd" }),
        json!({ "uri": "not there.png" }),
    ] {
        let told = json!({ "componentType": 5126 });
        let files = textured_gltf(&uv, told, &json!({ "index": 0 }), &image);
        let loaded = load_mesh_file_from(Path::new("it.gltf"), &files);
        let loaded = loaded.unwrap_or_else(|e| panic!("{image}: {e}"));
        assert_eq!(loaded.parts[0].mesh.triangles.len(), 4, "{image}");
        let is_said = loaded
            .notes
            .iter()
            .any(|n| n.to_string().contains("shown without it"));
        assert!(is_said, "{image}: {:?}", loaded.notes);
    }
}

/// As packers write them: whole numbers of 12 bits that a transform brings to the image.
#[test]
fn texture_coordinates_of_a_gltf_are_moved_and_scaled() {
    let uv: [[u16; 2]; 4] = [[0, 0], [4095, 0], [0, 4095], [4095, 4095]];
    let uv: Vec<u8> = uv
        .as_flattened()
        .iter()
        .flat_map(|c| c.to_le_bytes())
        .collect();
    let read = |is_normalized: bool, transform: Value| {
        let told = json!({ "componentType": 5123, "normalized": is_normalized });
        let texture = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
        let mut files = textured_gltf(&uv, told, &texture, &json!({ "uri": "four.png" }));
        files.insert("four.png", four_png());
        let loaded = load_mesh_file_from(Path::new("it.gltf"), &files).expect("a mesh");
        let vertex_paint = loaded.parts[0].mesh.vertex_paint.clone().expect("a coat");
        (vertex_paint.triangles[0].uv, loaded.notes)
    };
    let twelve_bits = json!({ "scale": [1.0 / 4095.0, 0.5 / 4095.0], "offset": [0.25, 0.0] });
    let (uv, notes) = read(false, twelve_bits);
    let expected = [[0.25, 0.0], [0.25, 0.5], [1.25, 0.0]].map(Vec2::from);
    let is_near = uv.iter().zip(expected).all(|(a, b)| a.distance(b) < 1e-6);
    assert!(is_near, "{uv:?}");
    assert!(notes.is_empty(), "{notes:?}");
    let (uv, notes) = read(true, json!({ "rotation": 1.0 }));
    assert!((uv[2].x - 4095.0 / 65535.0).abs() < 1e-6, "{uv:?}");
    assert!(
        notes.iter().any(|n| n.to_string().contains("rotation")),
        "{notes:?}"
    );
}
