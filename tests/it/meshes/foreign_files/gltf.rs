//! glTF: extensions on nodes, textures and data that are not read, accessors and primitives that lack something, solids in two nodes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::*;
use command::Scratch;

/// A document of one cube, to which accessors of numbers can be added.
struct Document {
    json: Value,
    bytes: Vec<u8>,
}

impl Document {
    fn cube() -> Self {
        let mut document = Self {
            json: json!({
                "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
                "nodes": [{ "mesh": 0 }],
                "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
                "accessors": [], "bufferViews": [],
            }),
            bytes: Vec::new(),
        };
        let positions = CORNERS.as_flattened().iter().map(|c| f32::from(*c));
        let positions: Vec<f32> = positions.collect();
        document.floats("VEC3", 3, &positions);
        let indices: Vec<u16> = triangles().flatten().collect();
        document.indices(&indices);
        document.json["accessors"][0]["min"] = json!([0, 0, 0]);
        document.json["accessors"][0]["max"] = json!([1, 1, 1]);
        document
    }

    fn floats(&mut self, kind: &str, width: usize, numbers: &[f32]) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        self.accessor(
            json!({ "componentType": 5126, "type": kind, "count": numbers.len() / width }),
            &bytes,
        )
    }

    fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|n| n.to_le_bytes()).collect();
        self.accessor(
            json!({ "componentType": 5123, "type": "SCALAR", "count": indices.len() }),
            &bytes,
        )
    }

    fn accessor(&mut self, mut accessor: Value, bytes: &[u8]) -> usize {
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }),
        );
        accessor["bufferView"] = json!(views.len() - 1);
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(accessor);
        accessors.len() - 1
    }

    fn read(mut self) -> Loaded {
        let uri = format!(
            "data:application/octet-stream;base64,{}",
            STANDARD.encode(&self.bytes)
        );
        self.json["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": uri }]);
        let folder = Scratch::new("foreign-gltf");
        open(&folder.write("a.gltf", self.json.to_string()))
    }
}

#[test]
fn instances_are_parts_whether_the_extension_is_required_or_not() {
    for is_required in [false, true] {
        let mut document = Document::cube();
        let to = document.floats("VEC3", 3, &[0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
        let scales = document.floats("VEC3", 3, &[1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0, 0.5]);
        let quarter = std::f32::consts::FRAC_1_SQRT_2;
        let turns = document.floats(
            "VEC4",
            4,
            &[
                0.0, 0.0, 0.0, 1.0, 0.0, 0.0, quarter, quarter, 0.0, 0.0, 0.0, 1.0,
            ],
        );
        document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] =
            json!({ "TRANSLATION": to, "SCALE": scales, "ROTATION": turns });
        document.json["nodes"][0]["translation"] = json!([0, 0, 10]);
        if is_required {
            document.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
        }
        let loaded = document.read();
        must_be_cubes(&loaded, 3, "three instances");
        assert_eq!(loaded.parts.len(), 3);
        // The second is turned by a quarter about Z, so that it lies before its place.
        let second = loaded.parts[1].bounds_in_world();
        assert!(second.min.distance(at(2.0, 0.0, 10.0)) < 1e-6, "{second:?}");
        let third = loaded.parts[2].bounds_in_world();
        assert!(third.max.distance(at(7.0, 2.0, 10.5)) < 1e-6, "{third:?}");
        assert_eq!(loaded.notes, []);
    }
}

#[test]
fn instances_that_do_not_fit_are_refused() {
    for (attributes, words) in [
        (json!({ "TRANSLATION": 9 }), "accessor 9"),
        (json!({ "TRANSLATION": 1 }), "accessor 1"),
    ] {
        let mut document = Document::cube();
        document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] =
            attributes;
        document.json["buffers"] = json!([{ "byteLength": document.bytes.len(),
            "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&document.bytes)) }]);
        let folder = Scratch::new("foreign-gltf");
        let path = folder.write("a.gltf", document.json.to_string());
        let said = load_mesh_file(&path).expect_err(words).to_string();
        assert!(said.contains(words) && said.contains("help:"), "{said}");
    }
}

#[test]
fn hidden_nodes_and_all_below_them_are_left_out() {
    let mut document = Document::cube();
    document.json["nodes"] = json!([
        { "children": [1, 2] }, { "mesh": 0 },
        { "extensions": { "KHR_node_visibility": { "visible": false } }, "children": [3] },
        { "mesh": 0, "translation": [3, 0, 0] },
    ]);
    let loaded = document.read();
    must_be_cubes(&loaded, 1, "one of two is hidden");
    must_say(&loaded, "left out 1 node", "a hidden node");
}

#[test]
fn unknown_extensions_of_nodes_and_meshes_are_named() {
    let mut document = Document::cube();
    document.json["nodes"][0]["extensions"] =
        json!({ "MSFT_lod": { "ids": [] }, "KHR_lights_punctual": { "light": 0 } });
    document.json["meshes"][0]["primitives"][0]["extensions"] = json!({ "EXT_bends": {} });
    let loaded = document.read();
    must_be_cubes(&loaded, 1, "unknown extensions");
    must_say(&loaded, "MSFT_lod", "of a node");
    must_say(&loaded, "EXT_bends", "of a primitive");
    assert_eq!(
        loaded.notes.len(),
        2,
        "lights move nothing: {:?}",
        loaded.notes
    );
}

#[test]
fn textures_and_data_that_are_not_read_stop_no_geometry() {
    for (texture, required, words) in [
        (
            json!({ "extensions": { "KHR_texture_basisu": { "source": 0 } } }),
            None,
            "KHR_texture_basisu",
        ),
        (
            json!({ "extensions": { "KHR_texture_basisu": { "source": 0 } } }),
            Some("KHR_texture_basisu"),
            "KHR_texture_basisu",
        ),
        (
            json!({ "extensions": { "EXT_texture_webp": { "source": 0 } } }),
            Some("EXT_texture_webp"),
            "EXT_texture_webp",
        ),
        (
            json!({ "extensions": { "MSFT_texture_dds": { "source": 0 } } }),
            Some("MSFT_texture_dds"),
            "MSFT_texture_dds",
        ),
        (json!({}), None, "no image"),
        (
            json!({ "source": 0 }),
            Some("KHR_xmp_json_ld"),
            "KHR_xmp_json_ld",
        ),
        (
            json!({ "source": 0 }),
            Some("EXT_structural_metadata"),
            "EXT_structural_metadata",
        ),
    ] {
        let mut document = Document::cube();
        document.json["textures"] = json!([texture]);
        document.json["images"] = json!([{ "uri": "none.bin", "mimeType": "image/ktx2" }]);
        document.json["materials"] =
            json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        document.json["extensionsRequired"] = json!(required.into_iter().collect::<Vec<_>>());
        let loaded = document.read();
        must_be_cubes(&loaded, 1, words);
        must_say(&loaded, words, words);
    }
}

#[test]
fn an_extension_that_is_required_and_may_change_shapes_is_refused() {
    let mut document = Document::cube();
    document.json["extensionsRequired"] = json!(["EXT_bends"]);
    document.json["buffers"] = json!([{ "byteLength": 0 }]);
    let folder = Scratch::new("foreign-gltf");
    let path = folder.write("a.gltf", document.json.to_string());
    let said = load_mesh_file(&path)
        .expect_err("it is required")
        .to_string();
    assert!(said.contains("EXT_bends"), "{said}");
}

#[test]
fn materials_that_are_not_valid_are_left_out() {
    for (what, material) in [
        (
            "a word that is none of glTF",
            json!({ "alphaMode": "SHINY" }),
        ),
        ("a number for a name", json!({ "name": 7 })),
        (
            "a texture that is not there",
            json!({ "normalTexture": { "index": 4 } }),
        ),
    ] {
        let mut document = Document::cube();
        document.json["materials"] = json!([material]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let loaded = document.read();
        must_be_cubes(&loaded, 1, what);
        must_say(&loaded, "without materials", what);
    }
    let mut document = Document::cube();
    document.json["meshes"][0]["primitives"][0]["material"] = json!(7);
    must_be_cubes(&document.read(), 1, "a material that is not there");
}

#[test]
fn what_accessors_and_primitives_may_lack_is_no_fault() {
    let mut document = Document::cube();
    let accessors = document.json["accessors"].as_array_mut().unwrap();
    accessors.push(json!({ "componentType": 5126, "count": 8, "type": "VEC3" }));
    document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(2);
    must_be_cubes(&document.read(), 1, "normals without a buffer view");

    let mut document = Document::cube();
    for extent in ["min", "max"] {
        document.json["accessors"][0]
            .as_object_mut()
            .unwrap()
            .remove(extent);
    }
    must_be_cubes(&document.read(), 1, "positions without extents");

    let mut document = Document::cube();
    let primitives = document.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap();
    primitives.insert(0, json!({ "attributes": {} }));
    let loaded = document.read();
    must_be_cubes(&loaded, 1, "a primitive without positions");
    must_say(
        &loaded,
        "without positions",
        "a primitive without positions",
    );
}

#[test]
fn vertices_without_weight_follow_their_first_joint() {
    let mut document = Document::cube();
    let joints: Vec<u8> = (0..8).flat_map(|_| [1, 0, 0, 0]).collect();
    let joints = document.accessor(
        json!({ "componentType": 5121, "type": "VEC4", "count": 8 }),
        &joints,
    );
    let weights = |v: usize| {
        if v < 4 {
            [1.0, 0.0, 0.0, 0.0]
        } else {
            [0.0; 4]
        }
    };
    let weights: Vec<f32> = (0..8).flat_map(weights).collect();
    let weights = document.floats("VEC4", 4, &weights);
    let attributes = &mut document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    document.json["nodes"] = json!([{ "mesh": 0, "skin": 0 }, {}, { "translation": [5, 0, 0] }]);
    document.json["scenes"] = json!([{ "nodes": [0, 1, 2] }]);
    document.json["skins"] = json!([{ "joints": [1, 2] }]);
    let loaded = document.read();
    must_be_cubes(&loaded, 1, "half of it has no weights");
    assert!(bounds(&loaded).min.distance(at(5.0, 0.0, 0.0)) < 1e-9);
    must_say(&loaded, "first joint", "weights of zero");
}

/// A cube whose lid is in a node of its own, moved by so much.
fn with_a_lid(lift: f64) -> Loaded {
    let mut document = Document::cube();
    let all: Vec<[u16; 3]> = triangles().collect();
    let sides = document.indices(all[..10].as_flattened());
    let lid = document.indices(all[10..].as_flattened());
    let colored = |indices: usize, material: usize| json!({ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": indices, "material": material }] });
    document.json["meshes"] = json!([colored(sides, 0), colored(lid, 1)]);
    let material =
        |color: [f32; 4]| json!({ "pbrMetallicRoughness": { "baseColorFactor": color } });
    document.json["materials"] = json!([
        material([1.0, 0.0, 0.0, 1.0]),
        material([0.0, 0.0, 1.0, 1.0])
    ]);
    document.json["nodes"] = json!([
        { "children": [1, 2], "translation": [0.1, 0.2, 0.3], "scale": [2, 2, 2] }, { "mesh": 0, "name": "sides" },
        { "mesh": 1, "name": "lid", "translation": [0.0, 0.0, lift] },
    ]);
    document.read()
}

#[test]
fn a_solid_in_two_nodes_is_one_part() {
    let loaded = with_a_lid(0.0);
    must_be_cubes(&loaded, 8, "twice as large");
    assert_eq!(loaded.parts.len(), 1);
    must_say(&loaded, "2 nodes", "they are joined");
    let vertex_paint = loaded.parts[0]
        .mesh
        .vertex_paint
        .as_ref()
        .expect("two colours");
    assert_eq!(vertex_paint.triangles.len(), 12);
    assert_eq!(
        [
            vertex_paint.triangles[0].colors[0],
            vertex_paint.triangles[11].colors[0]
        ],
        [[255, 0, 0, 255], [0, 0, 255, 255]]
    );
    // The control: what closes nothing is left alone.
    let apart = with_a_lid(0.01);
    assert_eq!(apart.parts.len(), 2);
}

#[test]
fn transparency_that_is_not_drawn_is_said() {
    for (material, words) in [
        (json!({ "alphaMode": "BLEND" }), "drawn opaque"),
        (json!({ "alphaMode": "MASK" }), "alpha mask"),
    ] {
        let mut document = Document::cube();
        document.json["materials"] = json!([material]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        must_say(&document.read(), words, words);
    }
}
