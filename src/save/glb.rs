//! Binary glTF 2.0: a node for each solid, whose mesh has a primitive for faces and one for caps, on the same vertices.
//!
//! Without normals viewers shade each triangle flat, as the format has it. Units are those of the model; the format means metres.

use serde_json::{Value, json};

use super::Solid;
use crate::scene::linear_from_srgb;

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;

/// What a file is made of, as it grows.
#[derive(Default)]
struct Draft {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
}

pub(super) fn encoded(solids: &[Solid<'_>]) -> Vec<u8> {
    let mut draft = Draft::default();
    for solid in solids.iter().filter(|s| !s.mesh.triangles.is_empty()) {
        draft.add(solid);
    }
    let mut root = json!({
        "asset": { "version": "2.0", "generator": "cutaway" },
        "scene": 0,
        "scenes": [{ "nodes": (0..draft.nodes.len()).collect::<Vec<_>>() }],
    });
    // Lists that are there are not empty.
    if !draft.nodes.is_empty() {
        root["nodes"] = draft.nodes.into();
        root["meshes"] = draft.meshes.into();
        root["materials"] = draft.materials.into();
        root["accessors"] = draft.accessors.into();
        root["bufferViews"] = draft.views.into();
        root["buffers"] = json!([{ "byteLength": draft.bytes.len() }]);
    } else {
        root["scenes"] = json!([{}]);
    }
    let mut text = root.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let chunks = [(*b"JSON", text), (*b"BIN\0", draft.bytes)];
    let chunks = chunks.iter().filter(|(_, bytes)| !bytes.is_empty());
    let length: usize = 12
        + chunks
            .clone()
            .map(|(_, bytes)| 8 + bytes.len())
            .sum::<usize>();
    let mut file = Vec::with_capacity(length);
    file.extend_from_slice(b"glTF");
    file.extend_from_slice(&2_u32.to_le_bytes());
    file.extend_from_slice(&(length as u32).to_le_bytes());
    for (kind, bytes) in chunks {
        file.extend_from_slice(&(bytes.len() as u32).to_le_bytes());
        file.extend_from_slice(kind);
        file.extend_from_slice(bytes);
    }
    file
}

impl Draft {
    fn add(&mut self, solid: &Solid<'_>) {
        let rounded: Vec<[f32; 3]> = (solid.mesh.positions.iter())
            .map(|p| p.as_vec3().to_array())
            .collect();
        let extreme = |of: fn(f32, f32) -> f32, start: f32| {
            let all = rounded.iter().copied();
            all.fold([start; 3], |m, p| [0, 1, 2].map(|i| of(m[i], p[i])))
        };
        let view = self.view(rounded.as_flattened(), |c| c.to_le_bytes(), ARRAY_BUFFER);
        let position = self.accessors.len();
        self.accessors.push(json!({
            "bufferView": view, "componentType": FLOAT, "count": rounded.len(), "type": "VEC3",
            "min": extreme(f32::min, f32::INFINITY), "max": extreme(f32::max, f32::NEG_INFINITY),
        }));
        let (faces, caps) = solid.mesh.triangles.split_at(solid.faces);
        let groups = [
            (faces, solid.name.to_owned(), solid.color),
            (caps, format!("{} cap", solid.name), solid.cap_color),
        ];
        let mut primitives = Vec::new();
        for (triangles, name, color) in groups {
            let is_flat = |[a, b, c]: &[u32; 3]| {
                let [a, b, c] = [a, b, c].map(|i| rounded[*i as usize]);
                a == b || b == c || c == a
            };
            let seen: Vec<[u32; 3]> = triangles.iter().filter(|t| !is_flat(t)).copied().collect();
            if seen.is_empty() {
                continue;
            }
            let view = self.view(
                seen.as_flattened(),
                |i| i.to_le_bytes(),
                ELEMENT_ARRAY_BUFFER,
            );
            let indices = self.accessors.len();
            self.accessors.push(json!({
                "bufferView": view, "componentType": UNSIGNED_INT, "count": 3 * seen.len(), "type": "SCALAR",
            }));
            let [r, g, b] = color
                .to_array()
                .map(|c| linear_from_srgb(c.clamp(0.0, 1.0)));
            let material = self.materials.len();
            self.materials.push(json!({
                "name": name,
                "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8 },
            }));
            primitives.push(json!({
                "attributes": { "POSITION": position }, "indices": indices, "material": material,
            }));
        }
        if primitives.is_empty() {
            return;
        }
        self.nodes
            .push(json!({ "name": solid.name, "mesh": self.meshes.len() }));
        self.meshes
            .push(json!({ "name": solid.name, "primitives": primitives }));
    }

    /// Puts numbers of four bytes into the buffer.
    fn view<T: Copy>(&mut self, numbers: &[T], to_bytes: fn(T) -> [u8; 4], target: u32) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(numbers.iter().flat_map(|n| to_bytes(*n)));
        self.views.push(json!({
            "buffer": 0, "byteOffset": offset, "byteLength": 4 * numbers.len(), "target": target,
        }));
        self.views.len() - 1
    }
}
