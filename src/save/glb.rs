//! Binary glTF 2.0: a node for each solid, whose mesh has a primitive for faces and one for caps, on the same vertices.
//!
//! Without normals viewers shade each triangle flat, as the format has it. Units and axes are those of the model; the format means metres,
//! and +Y up. The mesh of a solid that is farther from the origin than [`FAR_FROM_ORIGIN`] of its sizes is around the origin of its node, whose
//! translation readers hold in f64 or in f32: so its shape does not depend on where it stands.

use serde_json::{Value, json};

use glam::{DVec3, Vec3};

use super::{Solid, Unwritable, rounded};
use crate::scene::{Mesh, linear_from_srgb};

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

pub(super) fn encoded(solids: &[Solid<'_>]) -> Result<Vec<u8>, Unwritable> {
    let mut draft = Draft::default();
    for solid in solids.iter().filter(|s| !s.mesh.triangles.is_empty()) {
        draft.add(solid);
    }
    let mut root = json!({
        "asset": { "version": "2.0", "generator": "cutaway" },
        "scene": 0,
        "scenes": [{ "nodes": (0..draft.nodes.len()).collect::<Vec<_>>() }],
    });
    if draft.nodes.is_empty() {
        return Err(Unwritable::Collapsed);
    }
    root["nodes"] = draft.nodes.into();
    root["meshes"] = draft.meshes.into();
    root["materials"] = draft.materials.into();
    root["accessors"] = draft.accessors.into();
    root["bufferViews"] = draft.views.into();
    root["buffers"] = json!([{ "byteLength": draft.bytes.len() }]);
    let mut text = root.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let chunks = [(*b"JSON", text), (*b"BIN\0", draft.bytes)];
    let length = 12
        + chunks
            .iter()
            .map(|(_, bytes)| 8 + bytes.len())
            .sum::<usize>();
    let in_header = |length: usize| u32::try_from(length).map_err(|_| Unwritable::TooLarge);
    let mut file = Vec::with_capacity(length);
    file.extend_from_slice(b"glTF");
    file.extend_from_slice(&2_u32.to_le_bytes());
    file.extend_from_slice(&in_header(length)?.to_le_bytes());
    for (kind, bytes) in &chunks {
        file.extend_from_slice(&in_header(bytes.len())?.to_le_bytes());
        file.extend_from_slice(kind);
        file.extend_from_slice(bytes);
    }
    Ok(file)
}

/// So many of its sizes from the origin a mesh loses four of the 24 bits of f32.
const FAR_FROM_ORIGIN: f64 = 16.0;

/// The point that is the origin of the node of a mesh: that of the world, but far from it the middle of the mesh.
pub(super) fn origin(mesh: &Mesh) -> DVec3 {
    let bounds = mesh.bounds();
    let farthest = bounds.min.abs().max(bounds.max.abs()).max_element();
    match farthest > FAR_FROM_ORIGIN * bounds.size().max_element() {
        true => bounds.centre(),
        false => DVec3::ZERO,
    }
}

impl Draft {
    fn add(&mut self, solid: &Solid<'_>) {
        let origin = origin(solid.mesh);
        let positions: Vec<Vec3> = (solid.mesh.positions.iter())
            .map(|p| (*p - origin).as_vec3())
            .collect();
        let numbers: Vec<[f32; 3]> = positions.iter().map(Vec3::to_array).collect();
        let extreme = |of: fn(f32, f32) -> f32, start: f32| {
            let all = numbers.iter().copied();
            all.fold([start; 3], |m, p| [0, 1, 2].map(|i| of(m[i], p[i])))
        };
        let view = self.view(numbers.as_flattened(), |c| c.to_le_bytes(), ARRAY_BUFFER);
        let position = self.accessors.len();
        self.accessors.push(json!({
            "bufferView": view, "componentType": FLOAT, "count": numbers.len(), "type": "VEC3",
            "min": extreme(f32::min, f32::INFINITY), "max": extreme(f32::max, f32::NEG_INFINITY),
        }));
        let (faces, caps) = solid.mesh.triangles.split_at(solid.faces);
        let groups = [
            (faces, solid.name.to_owned(), solid.color),
            (caps, format!("{} cap", solid.name), solid.cap_color),
        ];
        let mut primitives = Vec::new();
        for (triangles, name, color) in groups {
            let has_area = |t: &&[u32; 3]| rounded(&positions, t).is_some();
            let seen: Vec<[u32; 3]> = triangles.iter().filter(has_area).copied().collect();
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
        let mut node = json!({ "name": solid.name, "mesh": self.meshes.len() });
        if origin != DVec3::ZERO {
            node["translation"] = json!(origin.to_array());
        }
        self.nodes.push(node);
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
