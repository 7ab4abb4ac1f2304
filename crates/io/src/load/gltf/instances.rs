//! Instances of a node's mesh, by `EXT_mesh_gpu_instancing`. Each has its own transform relative to the node.
//!
//! Each instance becomes a rig node whose parent is the instanced node, so that it follows the motion of its parent.

use cutaway::scene::motion::NodeTransform;
use glam::{DQuat, DVec3};
use gltf::{Accessor, Document, Node};
use serde_json::Value;

use super::accessor::{TRIPLES, items};
use super::extensions::INSTANCES;
use super::quantized::rotations;

/// Maximum total number of instances in a file.
pub(super) const MOST: usize = 1 << 16;

/// Reads the instance transforms of a node's mesh, relative to the node. Returns `None` if the node is not instanced.
pub(super) fn read(
    document: &Document,
    node: &Node<'_>,
    buffers: &[Vec<u8>],
) -> Result<Option<Vec<NodeTransform>>, String> {
    let Some(extension) = node.extension_value(INSTANCES) else {
        return Ok(None);
    };
    let at = |what: String| format!("node {} ({INSTANCES}): {what}", node.index());
    let accessor = |name: &str| -> Result<Option<Accessor<'_>>, String> {
        let Some(number) = extension.pointer(&format!("/attributes/{name}")) else {
            return Ok(None);
        };
        let index = number.as_u64().and_then(|n| usize::try_from(n).ok());
        let accessor = index.and_then(|index| document.accessors().nth(index));
        let missing = || {
            at(format!(
                "its {name} is accessor {number}, which does not exist"
            ))
        };
        accessor.ok_or_else(missing).map(Some)
    };
    let triples = |accessor: Accessor<'_>| -> Result<Vec<DVec3>, String> {
        let triples: Vec<[f32; 3]> = items(accessor, TRIPLES, buffers).map_err(at)?;
        Ok(triples
            .into_iter()
            .map(|t| DVec3::from(t.map(f64::from)))
            .collect())
    };
    let translations = accessor("TRANSLATION")?.map(triples).transpose()?;
    let scales = accessor("SCALE")?.map(triples).transpose()?;
    let turns = accessor("ROTATION")?;
    let turns = turns
        .map(|a| rotations(a, buffers).map_err(at))
        .transpose()?;
    let counts = [
        translations.as_ref().map(Vec::len),
        turns.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut counts = counts.into_iter().flatten();
    let Some(count) = counts.next() else {
        return match extension.get("attributes").and_then(Value::as_object) {
            Some(_) => Ok(None),
            None => Err(at("it has no attributes".to_owned())),
        };
    };
    if let Some(other) = counts.find(|other| *other != count) {
        return Err(at(format!(
            "its attributes differ in length: {count} and {other} instances"
        )));
    }
    let of = |all: &Option<Vec<DVec3>>, i: usize, usual| all.as_ref().map_or(usual, |all| all[i]);
    let stands = (0..count).map(|i| NodeTransform {
        translation: of(&translations, i, DVec3::ZERO),
        rotation: (turns.as_ref()).map_or(DQuat::IDENTITY, |turns| turns[i].normalize()),
        scale: of(&scales, i, DVec3::ONE),
    });
    Ok(Some(stands.collect()))
}
