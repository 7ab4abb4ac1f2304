//! Promise: glTF whose vertices are quantized, and packed by meshopt or Draco, is what other programs unpack; streams that are cut off or
//! changed are refused or other meshes, and never crash the program; what is not read is refused by name.
//!
//! The packed tetrahedra were made by other programs: `meshoptimizer` 1.3.0 and `draco3d` 1.5.9 of npm, of which the latter keeps 8 bits
//! of a position.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use cutaway::scene::Topology;
use cutaway_io::load::{Loaded, load_mesh_file};

use crate::common::command::Scratch;
use crate::common::data::data;

const DRACO: &str = "RFJBQ08CAgEBAAAABAQAAwAAAS8BARAB/wAAAQAJAwAAAgEBAQADAwEQATADAFCCJJEEAAAAAP8AAAAAAAAAAAAAAAAAAAAAAIA/CA==";
const TRIANGLES: &str = "4f4OEgPwBAB2h1ZneKmGZYlomAFpAAA=";
const POSITIONS: &str = "oAAAATwAAAD//wE8AAAAfn0AAAEPAAAA//8BDwAAAH59AAABAwAAAP8BAwAAAH4AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA==";
/// The same positions by the second version of the codec.
const POSITIONS_1: &str = "ofr66gAA/wAAf34AAAAA/wAAf34AAAB/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAQEB";

/// The buffer that packed views are said to be in.
const STAND_IN: &str = r#",{"byteLength":72}"#;

/// A document of one mesh, with its accessors and what they read, in a buffer of these bytes.
fn gltf(primitive: &str, accessors: &str, views: &str, required: &str, bytes: &[u8]) -> String {
    let uri = STANDARD.encode(bytes);
    let length = bytes.len();
    format!(
        r#"{{"asset":{{"version":"2.0"}},"extensionsUsed":[{required}],"extensionsRequired":[{required}],
"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{{primitive}}}]}}],
"accessors":[{accessors}],"bufferViews":[{views}],
"buffers":[{{"byteLength":{length},"uri":"data:application/octet-stream;base64,{uri}"}}{STAND_IN}]}}"#
    )
}

fn decoded(text: &str) -> Vec<u8> {
    STANDARD.decode(text).expect("base64")
}

/// A tetrahedron by meshopt; positions first in the buffer, then triangles.
fn meshopt(positions: &[u8], triangles: &[u8]) -> String {
    let view = |at: usize, length: usize, offset: usize, stream: &[u8], rest: &str| {
        let packed = stream.len();
        format!(
            r#"{{"buffer":1,"byteOffset":{at},"byteLength":{length},"extensions":{{"EXT_meshopt_compression":{{"buffer":0,"byteOffset":{offset},"byteLength":{packed},{rest}}}}}}}"#
        )
    };
    let views = [
        view(
            0,
            48,
            0,
            positions,
            r#""byteStride":12,"count":4,"mode":"ATTRIBUTES""#,
        ),
        view(
            48,
            24,
            positions.len(),
            triangles,
            r#""byteStride":2,"count":12,"mode":"TRIANGLES""#,
        ),
    ]
    .join(",");
    gltf(
        r#""attributes":{"POSITION":0},"indices":1"#,
        r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}"#,
        &views,
        r#""EXT_meshopt_compression""#,
        &[positions, triangles].concat(),
    )
}

/// A tetrahedron by Draco.
fn draco(stream: &[u8]) -> String {
    gltf(
        r#""attributes":{"POSITION":0},"indices":1,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}"#,
        r#"{"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},{"componentType":5123,"count":12,"type":"SCALAR"}"#,
        &format!(r#"{{"buffer":0,"byteLength":{}}}"#, stream.len()),
        r#""KHR_draco_mesh_compression""#,
        stream,
    )
    .replace(STAND_IN, "")
}

/// A tetrahedron with positions in two bytes, as shares of the greatest where they are `normalized`.
fn quantized(normalized: bool) -> String {
    let corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
    let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let unit = if normalized { u16::MAX } else { 1 };
    let mut bytes = Vec::new();
    for [x, y, z] in corners {
        // Eight bytes each, as positions are aligned.
        bytes.extend(
            [x, y, z, 0]
                .iter()
                .flat_map(|c: &u16| (c * unit).to_le_bytes()),
        );
    }
    bytes.extend(
        triangles
            .iter()
            .flatten()
            .flat_map(|i: &u16| i.to_le_bytes()),
    );
    gltf(
        r#""attributes":{"POSITION":0},"indices":1"#,
        &format!(
            r#"{{"bufferView":0,"componentType":5123,"normalized":{normalized},"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},{{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}"#
        ),
        r#"{"buffer":0,"byteLength":32,"byteStride":8},{"buffer":0,"byteOffset":32,"byteLength":24}"#,
        r#""KHR_mesh_quantization""#,
        &bytes,
    )
    .replace(STAND_IN, "")
}

fn load(folder: &Scratch, text: &str) -> Result<Loaded, String> {
    load_mesh_file(&folder.write("a.gltf", text)).map_err(|e| e.to_string())
}

/// Six times the volume between the triangles and the origin of the world: of an open mesh it depends on that point.
fn six_volumes(loaded: &Loaded) -> f64 {
    let of_part = |part: &cutaway::scene::Part| -> f64 {
        let corners = (0..part.mesh.triangles.len()).map(|t| part.mesh.corners(t));
        let placed = corners.map(|c| c.map(|p| part.world_from_part.transform_point3(p)));
        placed.map(|[a, b, c]| a.dot(b.cross(c))).sum()
    };
    loaded.parts.iter().map(of_part).sum()
}

fn facts(loaded: &Loaded) -> Topology {
    Topology::from_parts(&loaded.parts)
}

#[test]
fn packed_and_quantized_tetrahedra_are_whole() {
    let folder = Scratch::new("packed");
    let successor = meshopt(&decoded(POSITIONS_1), &decoded(TRIANGLES));
    for (name, text) in [
        ("meshopt", meshopt(&decoded(POSITIONS), &decoded(TRIANGLES))),
        (
            "meshopt by its successor",
            successor.replace("EXT_meshopt", "KHR_meshopt"),
        ),
        ("draco", draco(&decoded(DRACO))),
        ("whole numbers", quantized(false)),
        ("shares", quantized(true)),
    ] {
        let loaded = load(&folder, &text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let facts = facts(&loaded);
        assert!(
            facts.closed && facts.vertices == 4 && facts.faces == 4,
            "{name}: {facts:?}"
        );
        assert!((facts.volume - 1.0 / 6.0).abs() < 1e-6, "{name}: {facts:?}");
    }
}

#[test]
fn real_files_are_what_gltf_transform_unpacks() {
    let Some(folder) = data() else { return };
    // Faces, bounds and volume of what gltf-transform 4.5.1 reads with `meshoptimizer` 1.3.0 and `draco3d` 1.5.9 of npm.
    for (file, faces, min, max, volume) in [
        (
            "pirate_meshopt.glb",
            5_010,
            [-0.760_581_97, -0.001_088, -0.229_468_003],
            [0.760_505_213_499, 1.903_962_938_537, 0.225_776_727_785],
            0.328_515_480_644_6,
        ),
        (
            "2CylinderEngine.gltf",
            // Of 110,336 ten have two corners in one place.
            110_326,
            [-371.692_265_929_9, -180.971_557_617_2, -139.999_992_949_9],
            [371.691_238_403_5, 92.016_984_098_5, 127.999_996_188_1],
            11_119_134.047_722_7,
        ),
    ] {
        let loaded = load_mesh_file(&folder.join("compressed").join(file));
        let loaded = loaded.unwrap_or_else(|e| panic!("{e}"));
        let facts = facts(&loaded);
        assert_eq!(facts.faces, faces, "{file}");
        let size = max[1] - min[1];
        for axis in 0..3 {
            assert!(
                (facts.bounds.min[axis] - min[axis]).abs() < 1e-6 * size,
                "{file}: {facts:?}"
            );
            assert!(
                (facts.bounds.max[axis] - max[axis]).abs() < 1e-6 * size,
                "{file}: {facts:?}"
            );
        }
        let found = six_volumes(&loaded) / 6.0;
        assert!((found / volume - 1.0).abs() < 1e-5, "{file}: {found}");
    }
}

/// The document of a stream.
type Text<'a> = &'a dyn Fn(&[u8]) -> String;

#[test]
fn streams_that_are_cut_off_or_changed_never_crash() {
    let folder = Scratch::new("packed");
    let (positions, triangles, stream) = (decoded(POSITIONS), decoded(TRIANGLES), decoded(DRACO));
    let texts: [(&[u8], Text<'_>); 3] = [
        (&positions, &|bytes| meshopt(bytes, &triangles)),
        (&triangles, &|bytes| meshopt(&positions, bytes)),
        (&stream, &draco),
    ];
    for (whole, text) in texts {
        load(&folder, &text(whole)).expect("the control");
        for length in 0..whole.len() - 1 {
            // Draco does not look at what is behind the last attribute.
            let loaded = load(&folder, &text(&whole[..length]));
            assert!(
                loaded.is_err() || whole == stream,
                "{length} bytes: {loaded:?}"
            );
        }
        for at in 0..whole.len() {
            for change in [1, 0x10, 0x80, 0xff] {
                let mut changed = whole.to_vec();
                changed[at] ^= change;
                if let Err(said) = load(&folder, &text(&changed)) {
                    assert!(said.contains("a.gltf") && said.contains("help:"), "{said}");
                }
            }
        }
    }
}

#[test]
fn what_a_document_says_of_streams_is_held_against_them() {
    let folder = Scratch::new("packed");
    let packed = meshopt(&decoded(POSITIONS), &decoded(TRIANGLES));
    let of_draco = draco(&decoded(DRACO));
    for (text, from, to, said) in [
        (
            &packed,
            r#""count":4,"mode""#,
            r#""count":5,"mode""#,
            "do not give the 48 bytes",
        ),
        (
            &packed,
            r#""byteStride":12"#,
            r#""byteStride":16"#,
            "do not give the 48 bytes",
        ),
        (
            &packed,
            r#""byteStride":2,"count":12"#,
            r#""byteStride":3,"count":8"#,
            "3 bytes",
        ),
        (&packed, "ATTRIBUTES", "SPLATS", "SPLATS"),
        (
            &packed,
            r#""mode":"ATTRIBUTES""#,
            r#""mode":"ATTRIBUTES","filter":"BLUR""#,
            "BLUR",
        ),
        (
            &packed,
            r#""mode":"TRIANGLES""#,
            r#""mode":"TRIANGLES","filter":"OCTAHEDRAL""#,
            "Octahedral",
        ),
        (
            &packed,
            r#""mode":"ATTRIBUTES""#,
            r#""mode":"TRIANGLES""#,
            "buffer view 0",
        ),
        (
            &packed,
            r#""mode":"ATTRIBUTES""#,
            r#""node":"ATTRIBUTES""#,
            "mode",
        ),
        (
            &packed,
            r#"{"buffer":0,"byteOffset":0"#,
            r#"{"buffer":7,"byteOffset":0"#,
            "buffer 7",
        ),
        (
            &packed,
            r#"{"buffer":0,"byteOffset":0"#,
            r#"{"buffer":0,"byteOffset":99999"#,
            "buffer 0",
        ),
        (
            &packed,
            r#""byteLength":48"#,
            r#""byteLength":206158430208"#,
            "206158430208",
        ),
        (
            &of_draco,
            r#"{"bufferView":0,"attributes""#,
            r#"{"bufferView":9,"attributes""#,
            "buffer view 9",
        ),
        (
            &of_draco,
            r#"{"POSITION":0}}"#,
            r#"{"POSITION":7}}"#,
            "attribute 7",
        ),
        (&of_draco, r#"{"POSITION":0}}"#, r#"{}}"#, "bufferView"),
        (
            &of_draco,
            "KHR_draco_mesh_compression\"]",
            "EXT_other_compression\"]",
            "gltf-transform",
        ),
        (
            &of_draco,
            "KHR_draco_mesh_compression\"]",
            "EXT_voxels\"]",
            "EXT_voxels",
        ),
    ] {
        assert!(text.contains(from), "{from} is not there");
        let said_of = load(&folder, &text.replace(from, to))
            .err()
            .unwrap_or_default();
        assert!(
            said_of.contains(said) && said_of.contains("help:"),
            "{to}: {said_of}"
        );
    }
    // Looks are left out with a note.
    let looks = quantized(false).replace("KHR_mesh_quantization", "KHR_materials_unlit");
    let notes = load(&folder, &looks).expect("a mesh").notes;
    assert!(
        notes
            .iter()
            .any(|n| n.to_string().contains("KHR_materials_unlit")),
        "{notes:?}"
    );
}

#[test]
fn few_bytes_do_not_become_many() {
    let folder = Scratch::new("packed");
    // A view of 3 GB that says it comes from 70 bytes.
    let count: usize = 1 << 28;
    let positions = decoded(POSITIONS);
    let text = meshopt(&positions, &decoded(TRIANGLES))
        .replace(
            r#""byteLength":48"#,
            &format!(r#""byteLength":{}"#, 12 * count),
        )
        .replace(r#""count":4,"mode""#, &format!(r#""count":{count},"mode""#));
    let said = load(&folder, &text).expect_err("too many");
    assert!(said.contains("unpacks to more"), "{said}");
}
