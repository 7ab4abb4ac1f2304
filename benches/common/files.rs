//! A mesh as the bytes of a file, in each format that is read: the least that is valid, with the numbers in f32 but in OBJ.

use std::fmt::Write as _;

use cutaway::scene::Mesh;
use glam::Vec3;
use serde_json::json;

/// Text, with as many digits as tell the numbers apart.
pub(crate) fn obj(mesh: &Mesh) -> Vec<u8> {
    let mut text = String::new();
    for p in &mesh.positions {
        writeln!(text, "v {} {} {}", p.x, p.y, p.z).expect("a text takes all");
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| i + 1);
        writeln!(text, "f {a} {b} {c}").expect("a text takes all");
    }
    text.into_bytes()
}

/// Binary, little-endian.
pub(crate) fn ply(mesh: &Mesh) -> Vec<u8> {
    let head = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len()
    );
    let mut bytes = head.into_bytes();
    bytes.extend(positions(mesh));
    for t in &mesh.triangles {
        bytes.push(3);
        bytes.extend(t.iter().flat_map(|i| i.to_le_bytes()));
    }
    bytes
}

/// Binary: each triangle with its own corners, to be welded.
pub(crate) fn stl(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    let count = u32::try_from(mesh.triangles.len()).expect("a mesh that STL can count");
    bytes.extend(count.to_le_bytes());
    for triangle in 0..mesh.triangles.len() {
        // No normal: readers go by the corners.
        bytes.extend([0; 12]);
        for corner in mesh.corners(triangle) {
            bytes.extend(le_bytes(corner.as_vec3()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// One node, one primitive, positions and indices.
pub(crate) fn glb(mesh: &Mesh) -> Vec<u8> {
    let mut binary: Vec<u8> = positions(mesh).collect();
    let of_positions = binary.len();
    let indices = mesh.triangles.iter().flatten();
    binary.extend(indices.flat_map(|i| i.to_le_bytes()));
    let points = || mesh.positions.iter().map(|p| p.as_vec3());
    let least = points().fold(Vec3::INFINITY, Vec3::min).to_array();
    let most = points().fold(Vec3::NEG_INFINITY, Vec3::max).to_array();
    let document = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": mesh.positions.len(), "type": "VEC3", "min": least, "max": most },
            { "bufferView": 1, "componentType": 5125, "count": 3 * mesh.triangles.len(), "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": of_positions },
            { "buffer": 0, "byteOffset": of_positions, "byteLength": binary.len() - of_positions },
        ],
        "buffers": [{ "byteLength": binary.len() }],
    });
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let size = |n: usize| {
        u32::try_from(n)
            .expect("a file that GLB can hold")
            .to_le_bytes()
    };
    let whole = 12 + 8 + text.len() + 8 + binary.len();
    [
        b"glTF".as_slice(),
        &2_u32.to_le_bytes(),
        &size(whole),
        &size(text.len()),
        b"JSON",
        &text,
        &size(binary.len()),
        b"BIN\0",
        &binary,
    ]
    .concat()
}

fn positions(mesh: &Mesh) -> impl Iterator<Item = u8> {
    mesh.positions.iter().flat_map(|p| le_bytes(p.as_vec3()))
}

fn le_bytes(p: Vec3) -> impl Iterator<Item = u8> {
    p.to_array().into_iter().flat_map(f32::to_le_bytes)
}
