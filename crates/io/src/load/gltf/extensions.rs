//! Decides which glTF extensions are read and which may be ignored, and writes notes about all others.
//!
//! A file that requires an unread extension is refused, unless the extension's name refers to appearance or to data unrelated to geometry.
//! If an unread extension is only used, not required, a note names it where it may move, hide or add geometry, that is on a node or a mesh.

use std::collections::BTreeMap;
use std::path::Path;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::weld::thousands;
use gltf::json::Root;
use serde_json::{Map, Value};

use super::packed::{DRACO, MESHOPT};

/// Name of the extension for instances of a node's mesh.
pub(super) const INSTANCES: &str = "EXT_mesh_gpu_instancing";

/// Name of the extension for the visibility of a node and its descendants.
pub(super) const VISIBILITY: &str = "KHR_node_visibility";

/// Extensions that are read.
const READ: [&str; 7] = [
    MESHOPT[0],
    MESHOPT[1],
    DRACO,
    INSTANCES,
    VISIBILITY,
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Substrings by which the names of extensions that only change appearance are recognized.
const LOOKS: [&str; 5] = [
    "_materials_",
    "_lights_",
    "_texture_",
    "_environment",
    "_sky",
];

/// Substrings by which the names of extensions that add data, sound or behaviour, but no geometry, are recognized.
const BESIDE: [&str; 9] = [
    "_xmp",
    "_metadata",
    "_features",
    "_audio",
    "_animation_pointer",
    "_interactivity",
    "_selectability",
    "_hoverability",
    "_articulations",
];

fn has_any(name: &str, pieces: &[&str]) -> bool {
    pieces.iter().any(|piece| name.contains(piece))
}

/// Refuses required extensions that are not supported. Afterwards, the document's list of required extensions is empty.
pub(super) fn classify_required(
    path: &Path,
    root: &mut Root,
    notes: &mut Vec<Diagnostic>,
) -> Result<()> {
    for name in std::mem::take(&mut root.extensions_required) {
        if READ.contains(&name.as_str()) {
            continue;
        }
        if has_any(&name, &LOOKS) || has_any(&name, &BESIDE) {
            notes.push(Diagnostic::note(
                "extension-left-out",
                format!("shown without {name}"),
            ));
            continue;
        }
        let what = format!("it requires the extension {name}, which is not read");
        let help = match name.ends_with("_compression") {
            true => "unpack it, for example with `gltf-transform copy packed.glb plain.glb`",
            false => "export it again as plain glTF 2.0, without that extension",
        };
        return Err(Error::file(path, what, help));
    }
    Ok(())
}

/// A note for each unread extension of nodes, meshes and primitives, except those that only change appearance.
pub(super) fn unread(root: &Root) -> Vec<Diagnostic> {
    let of_nodes = (root.nodes.iter()).filter_map(|node| Some(&node.extensions.as_ref()?.others));
    let of_meshes = (root.meshes.iter()).filter_map(|mesh| Some(&mesh.extensions.as_ref()?.others));
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let of_primitives = primitives.filter_map(|p| Some(&p.extensions.as_ref()?.others));
    let named = |noun, extensions: &'_ Map<String, Value>| {
        let names = extensions.keys().cloned();
        names.map(|name| (name, noun)).collect::<Vec<_>>()
    };
    let all = (of_nodes.flat_map(|all| named("node", all)))
        .chain(of_meshes.flat_map(|all| named("mesh", all)))
        .chain(of_primitives.flat_map(|all| named("primitive", all)));
    let mut counts: BTreeMap<(String, &str), usize> = BTreeMap::new();
    for key in all.filter(|(name, _)| !READ.contains(&name.as_str()) && !has_any(name, &LOOKS)) {
        *counts.entry(key).or_default() += 1;
    }
    let notes = counts.into_iter().map(|((name, noun), count)| {
        let nouns = match (noun, count) {
            (noun, 1) => noun.to_owned(),
            ("mesh", _) => "meshes".to_owned(),
            (noun, _) => format!("{noun}s"),
        };
        let count = thousands(count);
        let text =
            format!("shown without {name}, an extension of {count} {nouns} that is not read");
        Diagnostic::note("extension-left-out", text)
    });
    notes.collect()
}
