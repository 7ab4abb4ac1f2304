//! Repairs missing or invalid entries before the crate validates the document. No repair removes geometry.
//!
//! | fault | becomes |
//! |---|---|
//! | positions without `min` and `max`, which this reader does not use | placeholder values |
//! | an accessor without a buffer view, except for positions | zeros, as glTF defines it |
//! | a primitive without positions | left out, with a note |
//! | a clip whose JSON has the wrong structure | left out, with a note |
//! | invalid materials, textures, images, samplers or cameras | all of them left out, with a note |

use cutaway::error::Diagnostic;
use gltf::json::accessor::{Accessor, Type};
use gltf::json::validation::{Checked, Error, Validate};
use gltf::json::{Animation, Path, Root};
use gltf::{Document, Semantic};
use serde_json::{Value, json};

use super::packed::add_view;

/// Size in bytes of the zeros that accessors without a buffer view share. An accessor that states a greater length is not repaired.
const MOST_ZEROS: usize = 1 << 28;

/// Document keys that only affect appearance.
const LOOKS: [&str; 5] = ["materials", "textures", "images", "samplers", "cameras"];

/// Parses a document again without its malformed animation or appearance entries. Returns `None` if the document has other faults, too.
pub(super) fn without_odd_entries(json: &[u8], notes: &mut Vec<Diagnostic>) -> Option<Root> {
    let mut value: Value = serde_json::from_slice(json).ok()?;
    let mut said = without_odd_clips(&mut value);
    if let Ok(root) = serde_json::from_value(value.clone()) {
        notes.append(&mut said);
        return Some(root);
    }
    let document = value.as_object_mut()?;
    for looks in LOOKS {
        document.remove(looks);
    }
    let each = |of: &mut Value, name: &str, key: &str| {
        for item in of
            .get_mut(name)
            .and_then(Value::as_array_mut)
            .into_iter()
            .flatten()
        {
            item.as_object_mut().map(|item| item.remove(key));
        }
    };
    each(&mut value, "nodes", "camera");
    for mesh in value.get_mut("meshes").and_then(Value::as_array_mut)? {
        each(mesh, "primitives", "material");
    }
    let root = serde_json::from_value(value).ok()?;
    said.push(Diagnostic::note(
        "materials-left-out",
        "shown without materials and cameras: their JSON is not valid glTF",
    ));
    notes.append(&mut said);
    Some(root)
}

/// Removes malformed animations, and returns a note on each.
fn without_odd_clips(document: &mut Value) -> Vec<Diagnostic> {
    let mut said = Vec::new();
    let mut number = 0;
    let animations = document.get_mut("animations").and_then(Value::as_array_mut);
    let Some(animations) = animations else {
        return said;
    };
    animations.retain(|animation| {
        let read = serde_json::from_value::<Animation>(animation.clone());
        if let Err(why) = &read {
            let name = animation.get("name").and_then(Value::as_str);
            let name = name.map_or(format!("clip_{number}"), str::to_owned);
            said.push(Diagnostic::note(
                "clip-left-out",
                format!("left out clip `{name}`: {why}"),
            ));
        }
        number += 1;
        read.is_ok()
    });
    said
}

/// Makes all repairs that remove no geometry. Attribute indices must be in range.
pub(super) fn mend(root: &mut Root, buffers: &mut Vec<Vec<u8>>, notes: &mut Vec<Diagnostic>) {
    let mut positions = Vec::new();
    for (number, mesh) in root.meshes.iter_mut().enumerate() {
        let before = mesh.primitives.len();
        mesh.primitives.retain(|primitive| {
            let accessor = primitive
                .attributes
                .get(&Checked::Valid(Semantic::Positions));
            positions.extend(accessor.copied());
            accessor.is_some()
        });
        let left_out = before - mesh.primitives.len();
        if left_out > 0 {
            notes.push(
                Diagnostic::note(
                    "primitives-left-out",
                    format!(
                        "left out {left_out} of {before} primitives: without positions nothing can be drawn"
                    ),
                )
                .about(format!("mesh {number}")),
            );
        }
    }
    for position in &positions {
        let accessor = &mut root.accessors[position.value()];
        for extent in [&mut accessor.min, &mut accessor.max] {
            let is_there =
                (extent.take()).filter(|v| serde_json::from_value::<[f32; 3]>(v.clone()).is_ok());
            *extent = Some(is_there.unwrap_or_else(|| json!([0.0, 0.0, 0.0])));
        }
    }
    give_zeros(root, buffers, |accessor| {
        positions.iter().any(|p| p.value() == accessor)
    });
}

/// Assigns a shared buffer of zeros to accessors without data. Positions get none, because a mesh with all vertices at 0 is an error.
fn give_zeros(
    root: &mut Root,
    buffers: &mut Vec<Vec<u8>>,
    is_of_positions: impl Fn(usize) -> bool,
) {
    let is_bare = |(number, a): &(usize, &Accessor)| {
        a.buffer_view.is_none() && a.sparse.is_none() && !is_of_positions(*number)
    };
    let bytes_of = |accessor: &Accessor| {
        let (Checked::Valid(kind), Checked::Valid(shape)) =
            (accessor.component_type, accessor.type_)
        else {
            return None;
        };
        // Matrix columns are aligned to four bytes.
        let item = match shape {
            Type::Mat2 | Type::Mat3 => 4 * shape.multiplicity(),
            _ => shape.multiplicity() * kind.0.size(),
        };
        let count = usize::try_from(accessor.count.0).ok()?;
        count.checked_mul(item).filter(|bytes| *bytes <= MOST_ZEROS)
    };
    let all = root.accessors.iter().enumerate().filter(is_bare);
    let bare: Vec<(usize, usize)> = all
        .filter_map(|(number, accessor)| Some((number, bytes_of(accessor)?)))
        .collect();
    let Some(most) = bare.iter().map(|(_, bytes)| *bytes).max() else {
        return;
    };
    let view = add_view(root, buffers, vec![0; most]);
    for (number, _) in bare {
        let accessor = &mut root.accessors[number];
        accessor.buffer_view = Some(view);
        accessor.byte_offset = None;
    }
}

/// Validates the document, and removes its appearance data if only that is invalid. An error gives the first fault and the fault count.
pub(super) fn validated(mut root: Root, notes: &mut Vec<Diagnostic>) -> Result<Document, String> {
    let mut faults = faults(&root);
    let is_of_looks = |(at, _): &(Path, Error)| {
        LOOKS.iter().any(|looks| at.0.starts_with(looks))
            || [".material", ".camera"]
                .iter()
                .any(|key| at.0.ends_with(key))
    };
    if let Some(first) = faults.first().filter(|_| faults.iter().all(is_of_looks)) {
        notes.push(Diagnostic::note(
            "materials-left-out",
            format!("shown without materials and cameras: {}", said(first)),
        ));
        root.materials.clear();
        root.textures.clear();
        root.images.clear();
        root.samplers.clear();
        root.cameras.clear();
        for primitive in root.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
            primitive.material = None;
        }
        root.nodes.iter_mut().for_each(|node| node.camera = None);
        faults = self::faults(&root);
    }
    match faults.first() {
        None => Ok(Document::from_json_without_validation(root)),
        Some(first) => Err(format!(
            "glTF: {} (and {} more)",
            said(first),
            faults.len() - 1
        )),
    }
}

fn faults(root: &Root) -> Vec<(Path, Error)> {
    let mut faults = Vec::new();
    root.validate(root, Path::new, &mut |at, what| faults.push((at(), what)));
    faults
}

fn said((at, what): &(Path, Error)) -> String {
    format!("{at}: {what}")
}
