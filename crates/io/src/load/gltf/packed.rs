//! Decompression, which runs before all other reading. `EXT_meshopt_compression` and its successor `KHR_meshopt_compression` pack buffer
//! views, and `KHR_draco_mesh_compression` packs primitives. Results are put into new buffers, so that readers need no special case.
//!
//! As for archives, the unpacked size is limited to a multiple of the packed size.

use gltf::json::buffer::{Buffer, View};
use gltf::json::validation::USize64;
use gltf::json::{Index, Root};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::draco;
use super::meshopt::{Filter, Mode, Packing};
use crate::load::input_file::most_unpacked;

pub(super) const MESHOPT: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
pub(super) const DRACO: &str = "KHR_draco_mesh_compression";

/// Returns, for each buffer, true if it is only a placeholder without data, whose views are packed in other buffers.
pub(super) fn is_stand_in(root: &Root) -> Vec<bool> {
    let mut is_named = vec![false; root.buffers.len()];
    let mut is_needed = vec![false; root.buffers.len()];
    let mark = |flags: &mut Vec<bool>, buffer: usize| {
        if let Some(flag) = flags.get_mut(buffer) {
            *flag = true;
        }
    };
    for view in &root.buffer_views {
        mark(&mut is_named, view.buffer.value());
        match meshopt_of(view) {
            None => mark(&mut is_needed, view.buffer.value()),
            Some((_, packed)) => {
                let source = packed.get("buffer").and_then(Value::as_u64);
                mark(&mut is_needed, source.map_or(0, |b| b as usize));
            }
        }
    }
    let both = is_named.iter().zip(&is_needed);
    both.map(|(named, needed)| *named && !needed).collect()
}

/// Unpacks all views and primitives into new buffers.
pub(super) fn unpack(root: &mut Root, buffers: &mut Vec<Vec<u8>>) -> Result<(), String> {
    let packed = buffers.iter().map(|b| b.len() as u64).sum();
    let mut room = ByteBudget(most_unpacked(packed));
    for number in 0..root.buffer_views.len() {
        let Some((name, packed)) = meshopt_of(&root.buffer_views[number]) else {
            continue;
        };
        let at = |what: String| format!("buffer view {number} ({name}): {what}");
        let packed: PackedView = said(packed).map_err(at)?;
        let view = &root.buffer_views[number];
        let bytes = packed.unpack(view, buffers, &mut room).map_err(at)?;
        let buffer = add_buffer(root, buffers, bytes);
        let view = &mut root.buffer_views[number];
        view.buffer = buffer;
        view.byte_offset = None;
    }
    for mesh in 0..root.meshes.len() {
        for primitive in 0..root.meshes[mesh].primitives.len() {
            let of = &root.meshes[mesh].primitives[primitive];
            let others = of.extensions.as_ref().map(|e| &e.others);
            let Some(packed) = others.and_then(|others| others.get(DRACO)) else {
                continue;
            };
            let at = |what: String| format!("mesh {mesh}, primitive {primitive} ({DRACO}): {what}");
            let packed: draco::DracoExtension = said(packed).map_err(at)?;
            let place = [mesh, primitive];
            draco::unpack(root, buffers, place, &packed, &mut room).map_err(at)?;
        }
    }
    Ok(())
}

/// Number of bytes that may still be unpacked.
pub(super) struct ByteBudget(pub(super) u64);

impl ByteBudget {
    pub(super) fn take(&mut self, bytes: usize) -> Result<(), String> {
        self.0 = self.0.checked_sub(bytes as u64).ok_or(
            "it unpacks to more bytes than are accepted for a file of its size: unpack it with another program",
        )?;
        Ok(())
    }
}

/// Adds a buffer with these bytes.
fn add_buffer(root: &mut Root, buffers: &mut Vec<Vec<u8>>, bytes: Vec<u8>) -> Index<Buffer> {
    let buffer = Index::new(buffers.len() as u32);
    root.buffers.push(Buffer {
        byte_length: USize64::from(bytes.len()),
        name: None,
        uri: None,
        extensions: None,
        extras: None,
    });
    buffers.push(bytes);
    buffer
}

/// Adds a buffer with these bytes, and its view.
pub(super) fn add_view(root: &mut Root, buffers: &mut Vec<Vec<u8>>, bytes: Vec<u8>) -> Index<View> {
    let byte_length = USize64::from(bytes.len());
    let buffer = add_buffer(root, buffers, bytes);
    let view = Index::new(root.buffer_views.len() as u32);
    root.buffer_views.push(View {
        buffer,
        byte_length,
        byte_offset: None,
        byte_stride: None,
        name: None,
        target: None,
        extensions: None,
        extras: None,
    });
    view
}

/// Returns a byte range of a buffer.
pub(super) fn range(
    buffers: &[Vec<u8>],
    buffer: usize,
    from: usize,
    length: usize,
) -> Result<&[u8], String> {
    let held = buffers.get(buffer);
    held.and_then(|held| held.get(from..from.checked_add(length)?))
        .ok_or_else(|| format!("its {length} bytes are not within buffer {buffer}"))
}

/// Returns the name and the content of the extension that packs a view.
fn meshopt_of(view: &View) -> Option<(&'static str, &Value)> {
    let others: &Map<String, Value> = &view.extensions.as_ref()?.others;
    MESHOPT
        .iter()
        .find_map(|name| Some((*name, others.get(*name)?)))
}

/// Deserializes the content of an extension.
fn said<'a, T: Deserialize<'a>>(value: &'a Value) -> Result<T, String> {
    T::deserialize(value).map_err(|e| e.to_string())
}

/// Content of the extension of a buffer view.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct PackedView {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
    byte_stride: usize,
    count: usize,
    mode: String,
    filter: Option<String>,
}

impl PackedView {
    fn unpack(
        &self,
        view: &View,
        buffers: &[Vec<u8>],
        room: &mut ByteBudget,
    ) -> Result<Vec<u8>, String> {
        let packing = Packing {
            mode: named("mode", &self.mode, &Mode::NAMED)?,
            filter: named(
                "filter",
                self.filter.as_deref().unwrap_or("NONE"),
                &Filter::NAMED,
            )?,
            stride: self.byte_stride,
            count: self.count,
        };
        let length = self.count.checked_mul(self.byte_stride);
        if length.map(|n| n as u64) != Some(view.byte_length.0) {
            let (count, stride, view) = (self.count, self.byte_stride, view.byte_length.0);
            return Err(format!(
                "{count} elements of {stride} bytes do not give the {view} bytes of the view"
            ));
        }
        room.take(length.unwrap_or(usize::MAX))?;
        let stream = range(buffers, self.buffer, self.byte_offset, self.byte_length)?;
        packing.unpack(stream)
    }
}

fn named<T: Copy>(what: &str, name: &str, known: &[(&str, T)]) -> Result<T, String> {
    let found = known.iter().find(|(known, _)| *known == name);
    found
        .map(|(_, value)| *value)
        .ok_or_else(|| format!("its {what} {name:?} is not known"))
}
