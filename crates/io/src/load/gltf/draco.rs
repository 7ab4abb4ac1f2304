//! Unpacks primitives with `KHR_draco_mesh_compression`, by `draco-core`. The results are triangles, and attributes in the component types
//! that their accessors state.

use std::collections::BTreeMap;

use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType, Type};
use gltf::json::mesh::Mode;
use gltf::json::validation::{Checked, USize64};
use gltf::json::{Index, Root};
use serde::Deserialize;

use super::packed::{ByteBudget, add_view, range};

/// Content of the extension of a primitive.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct DracoExtension {
    buffer_view: usize,
    /// Number of each attribute in the stream, by glTF attribute name.
    attributes: BTreeMap<String, u32>,
}

/// Unpacks a primitive of a mesh.
pub(super) fn unpack(
    root: &mut Root,
    buffers: &mut Vec<Vec<u8>>,
    [mesh, primitive]: [usize; 2],
    packed: &DracoExtension,
    room: &mut ByteBudget,
) -> Result<(), String> {
    let view = root.buffer_views.get(packed.buffer_view);
    let view = view.ok_or_else(|| format!("there is no buffer view {}", packed.buffer_view))?;
    let place = [view.byte_offset.unwrap_or_default(), view.byte_length];
    let [from, length] = place.map(|n| usize::try_from(n.0).unwrap_or(usize::MAX));
    let stream = range(buffers, view.buffer.value(), from, length)?;
    let decoded = decoded(stream, room)?;
    let points = decoded.num_points();

    let attributes = root.meshes[mesh].primitives[primitive].attributes.clone();
    for (semantic, place) in attributes {
        let Some(number) = packed.attributes.get(&semantic.to_string()) else {
            continue;
        };
        let accessor = root.accessors[place.value()].clone();
        let (Checked::Valid(GenericComponentType(kind)), Checked::Valid(shape)) =
            (accessor.component_type, accessor.type_)
        else {
            return Err(format!(
                "{} has an accessor without a type",
                semantic.to_string()
            ));
        };
        let attribute = decoded.attribute_by_unique_id(*number);
        let attribute = attribute.ok_or_else(|| {
            format!(
                "its stream lacks attribute {number}, {}",
                semantic.to_string()
            )
        })?;
        let components = shape.multiplicity();
        room.take(points.saturating_mul(components * kind.size()))?;
        let numbers = attribute.read_f32s(points, components);
        let bytes = in_components(&numbers, kind);
        let count = USize64::from(points);
        let accessor = Accessor { count, ..accessor };
        let number = give(root, buffers, bytes, (Some(place), accessor));
        let primitive = &mut root.meshes[mesh].primitives[primitive];
        primitive.attributes.insert(semantic, number);
    }

    let corners = decoded.faces().iter().flatten();
    room.take(decoded.num_faces().saturating_mul(12))?;
    let bytes: Vec<u8> = corners.flat_map(|point| point.0.to_le_bytes()).collect();
    let place = root.meshes[mesh].primitives[primitive].indices;
    let accessor = indices(3 * decoded.num_faces());
    let number = give(root, buffers, bytes, (place, accessor));
    let primitive = &mut root.meshes[mesh].primitives[primitive];
    primitive.indices = Some(number);
    // The stream always contains triangles, whatever mode the primitive states.
    primitive.mode = Checked::Valid(Mode::Triangles);
    Ok(())
}

/// Decodes the mesh in a stream.
fn decoded(stream: &[u8], room: &ByteBudget) -> Result<Mesh, String> {
    // Each attribute value and each face index takes at least four bytes.
    let mut limits = DecodeLimits::default();
    limits.max_points = limits.max_points.min(room.0 / 4);
    limits.max_faces = limits.max_faces.min(room.0 / 12);
    limits.max_decoded_bytes = limits.max_decoded_bytes.min(room.0);
    let mut mesh = Mesh::new();
    let mut bytes = DecoderBuffer::new(stream).with_limits(limits);
    MeshDecoder::new()
        .decode(&mut bytes, &mut mesh)
        .map_err(|e| format!("its stream cannot be decoded: {e}"))?;
    Ok(mesh)
}

/// Converts numbers to an accessor's component type.
fn in_components(numbers: &[f32], kind: ComponentType) -> Vec<u8> {
    let numbers = numbers.iter();
    match kind {
        ComponentType::I8 => numbers.map(|n| *n as i8 as u8).collect(),
        ComponentType::U8 => numbers.map(|n| *n as u8).collect(),
        ComponentType::I16 => numbers.flat_map(|n| (*n as i16).to_le_bytes()).collect(),
        ComponentType::U16 => numbers.flat_map(|n| (*n as u16).to_le_bytes()).collect(),
        ComponentType::U32 => numbers.flat_map(|n| (*n as u32).to_le_bytes()).collect(),
        ComponentType::F32 => numbers.flat_map(|n| n.to_le_bytes()).collect(),
    }
}

/// Creates an accessor for `corners` vertex indices.
fn indices(corners: usize) -> Accessor {
    Accessor {
        buffer_view: None,
        byte_offset: None,
        count: USize64::from(corners),
        component_type: Checked::Valid(GenericComponentType(ComponentType::U32)),
        extensions: None,
        extras: None,
        type_: Checked::Valid(Type::Scalar),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
    }
}

/// Assigns bytes to an accessor. If it already has a buffer view, a new accessor with the same properties gets the bytes.
fn give(
    root: &mut Root,
    buffers: &mut Vec<Vec<u8>>,
    bytes: Vec<u8>,
    (place, accessor): (Option<Index<Accessor>>, Accessor),
) -> Index<Accessor> {
    let view = add_view(root, buffers, bytes);
    let accessor = Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        sparse: None,
        ..accessor
    };
    let held = place.and_then(|place| Some((place, root.accessors.get_mut(place.value())?)));
    match held {
        Some((place, held)) if held.buffer_view.is_none() => {
            *held = accessor;
            place
        }
        _ => {
            root.accessors.push(accessor);
            Index::new(root.accessors.len() as u32 - 1)
        }
    }
}
