//! Writes binary glTF 2.0. Each solid is a node whose mesh has a primitive for faces and one for caps. Both share vertices. If faces have
//! vertex colours or images, their vertices are separate, and each image has its own primitive.
//!
//! No normals are written, so viewers shade each triangle flat, as the specification requires. Units and axes are the model's, although the
//! format defines metres and +Y up. If a solid is farther from the origin than [`FAR_FROM_ORIGIN`] times its size, its mesh is relative to
//! its node. Then f32 rounding affects only the node's translation, not the shape.

use std::collections::BTreeMap;

use cutaway::scene::{Mesh, VertexPaint, linear_from_srgb};
use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use super::images::{Images, bits};
use super::solid::{Solid, Unwritable, rounded};

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;

/// Contents of a file while it is built.
#[derive(Default)]
struct GlbBuilder {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
}

pub(super) fn encoded(solids: &[Solid<'_>]) -> Result<Vec<u8>, Unwritable> {
    let mut draft = GlbBuilder::default();
    let images = Images::of(solids);
    for (index, solid) in solids.iter().enumerate() {
        draft.add(solid, groups(solid, index, &images));
    }
    let mut root = json!({
        "asset": { "version": "2.0", "generator": "cutaway" },
        "scene": 0,
        "scenes": [{ "nodes": (0..draft.nodes.len()).collect::<Vec<_>>() }],
    });
    if draft.nodes.is_empty() {
        return Err(Unwritable::Collapsed);
    }
    if images.count() > 0 {
        let textures = (0..images.count()).map(|i| json!({ "source": i }));
        root["textures"] = textures.collect();
        let views = images.pngs()?.into_iter().map(|png| draft.packed(&png));
        let images = views.map(|view| json!({ "bufferView": view, "mimeType": "image/png" }));
        root["images"] = images.collect();
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

/// Distance from the origin, in multiples of the mesh's size, at which f32 coordinates lose four of their 24 bits.
const FAR_FROM_ORIGIN: f64 = 16.0;

/// The origin of a mesh's node. It is the world origin, or the middle of the mesh if the mesh is far from the world origin.
pub(super) fn origin(mesh: &Mesh) -> DVec3 {
    let bounds = mesh.bounds();
    let farthest = bounds.min.abs().max(bounds.max.abs()).max_element();
    match farthest > FAR_FROM_ORIGIN * bounds.size().max_element() {
        true => bounds.centre(),
        false => DVec3::ZERO,
    }
}

/// Triangles with the same material.
struct MaterialGroup {
    name: String,
    /// Indices of triangles in the solid.
    triangles: Vec<usize>,
    /// Colour in linear RGB.
    color: [f32; 3],
    /// Index of the group's image among all images.
    image: Option<usize>,
    /// True if corners have colours or texture coordinates.
    is_textured: bool,
}

/// The faces of solid number `index`, grouped by image, followed by its caps.
fn groups(solid: &Solid<'_>, index: usize, images: &Images) -> Vec<MaterialGroup> {
    let linear = |color: Vec3| {
        color
            .to_array()
            .map(|c| linear_from_srgb(c.clamp(0.0, 1.0)))
    };
    let count = solid.mesh.triangles.len();
    let mut groups = Vec::new();
    match &solid.vertex_paint {
        None => groups.push(MaterialGroup {
            name: solid.name.to_owned(),
            triangles: (0..solid.faces).collect(),
            color: linear(solid.color),
            image: None,
            is_textured: false,
        }),
        Some(_) => {
            let faces = images.faces(index, solid).into_iter();
            groups.extend(faces.map(|(image, triangles)| MaterialGroup {
                name: solid.name.to_owned(),
                triangles,
                color: [1.0; 3],
                image,
                is_textured: true,
            }));
        }
    }
    groups.push(MaterialGroup {
        name: format!("{} cap", solid.name),
        triangles: (solid.faces..count).collect(),
        color: linear(solid.cap_color),
        image: None,
        is_textured: false,
    });
    groups
}

/// A corner of a painted triangle, as its vertex, its colour, and the bits of its texture coordinate.
type TexturedCorner = (u32, [u8; 4], [u32; 2]);

impl GlbBuilder {
    fn add(&mut self, solid: &Solid<'_>, groups: Vec<MaterialGroup>) {
        let origin = origin(solid.mesh);
        let positions: Vec<Vec3> = (solid.mesh.positions.iter())
            .map(|p| (*p - origin).as_vec3())
            .collect();
        let mut shared = None;
        let mut primitives = Vec::new();
        for mut group in groups {
            let all = &solid.mesh.triangles;
            group
                .triangles
                .retain(|t| rounded(&positions, &all[*t]).is_some());
            if group.triangles.is_empty() {
                continue;
            }
            let (attributes, indices) =
                match solid.vertex_paint.as_ref().filter(|_| group.is_textured) {
                    Some(vertex_paint) => self.textured(&group, vertex_paint, all, &positions),
                    None => {
                        let at = *shared.get_or_insert_with(|| self.positions(&positions));
                        let corners = group.triangles.iter().flat_map(|t| all[*t]);
                        (json!({ "POSITION": at }), corners.collect())
                    }
                };
            let view = self.view(&indices, |i| i.to_le_bytes(), ELEMENT_ARRAY_BUFFER);
            let count = indices.len();
            let indices = self.accessor(json!({
                "bufferView": view, "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR",
            }));
            let material = self.material(group);
            primitives.push(json!({
                "attributes": attributes, "indices": indices, "material": material,
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

    /// Returns the attributes and the corners of painted triangles. Each distinct combination at a position becomes one vertex.
    fn textured(
        &mut self,
        group: &MaterialGroup,
        vertex_paint: &VertexPaint,
        triangles: &[[u32; 3]],
        positions: &[Vec3],
    ) -> (Value, Vec<u32>) {
        let mut numbers: BTreeMap<TexturedCorner, u32> = BTreeMap::new();
        let mut corners: Vec<TexturedCorner> = Vec::new();
        let mut indices = Vec::with_capacity(3 * group.triangles.len());
        for t in &group.triangles {
            let of = &vertex_paint.triangles[*t];
            for (i, vertex) in triangles[*t].into_iter().enumerate() {
                let uv = match group.image {
                    Some(_) => bits(of.uv[i]),
                    None => [0; 2],
                };
                let corner = (vertex, of.colors[i], uv);
                indices.push(*numbers.entry(corner).or_insert_with(|| {
                    corners.push(corner);
                    corners.len() as u32 - 1
                }));
            }
        }
        let at: Vec<Vec3> = corners
            .iter()
            .map(|(i, ..)| positions[*i as usize])
            .collect();
        let mut attributes = json!({ "POSITION": self.positions(&at) });
        let count = corners.len();
        if corners.iter().any(|(_, color, _)| *color != [255; 4]) {
            let linear = |color: [u8; 4]| color.map(|c| linear_from_srgb(f32::from(c) / 255.0));
            let colors: Vec<f32> = (corners.iter())
                .flat_map(|(_, color, _)| linear(*color).into_iter().take(3))
                .collect();
            let view = self.view(&colors, |c| c.to_le_bytes(), ARRAY_BUFFER);
            attributes["COLOR_0"] = json!(self.accessor(json!({
                "bufferView": view, "componentType": FLOAT, "count": count, "type": "VEC3",
            })));
        }
        if group.image.is_some() {
            let places: Vec<u32> = corners.iter().flat_map(|(.., uv)| *uv).collect();
            let view = self.view(&places, |c| c.to_le_bytes(), ARRAY_BUFFER);
            attributes["TEXCOORD_0"] = json!(self.accessor(json!({
                "bufferView": view, "componentType": FLOAT, "count": count, "type": "VEC2",
            })));
        }
        (attributes, indices)
    }

    /// Adds positions and returns their accessor.
    fn positions(&mut self, positions: &[Vec3]) -> usize {
        let numbers: Vec<[f32; 3]> = positions.iter().map(Vec3::to_array).collect();
        let extreme = |of: fn(f32, f32) -> f32, start: f32| {
            let all = numbers.iter().copied();
            all.fold([start; 3], |m, p| [0, 1, 2].map(|i| of(m[i], p[i])))
        };
        let view = self.view(numbers.as_flattened(), |c| c.to_le_bytes(), ARRAY_BUFFER);
        self.accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": numbers.len(), "type": "VEC3",
            "min": extreme(f32::min, f32::INFINITY), "max": extreme(f32::max, f32::NEG_INFINITY),
        }))
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn material(&mut self, group: MaterialGroup) -> usize {
        let [r, g, b] = group.color;
        let mut surface = json!({
            "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8,
        });
        if let Some(image) = group.image {
            surface["baseColorTexture"] = json!({ "index": image });
        }
        self.materials
            .push(json!({ "name": group.name, "pbrMetallicRoughness": surface }));
        self.materials.len() - 1
    }

    /// Adds bytes of any kind to the buffer.
    fn packed(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views
            .push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }));
        self.views.len() - 1
    }

    /// Adds four-byte numbers to the buffer.
    fn view<T: Copy>(&mut self, numbers: &[T], to_bytes: fn(T) -> [u8; 4], target: u32) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(numbers.iter().flat_map(|n| to_bytes(*n)));
        self.views.push(json!({
            "buffer": 0, "byteOffset": offset, "byteLength": 4 * numbers.len(), "target": target,
        }));
        self.views.len() - 1
    }
}
