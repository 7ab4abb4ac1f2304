//! The JSON document of a glTF file and its buffers: checks that do not need geometry.
//!
//! Animations are removed before the crate validates the rest of the document, so that a broken clip does not prevent loading the mesh.
//! Animations are checked when they are read.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use cutaway::error::{Diagnostic, Error, Result};
use gltf::json::{Animation, Root};
use gltf::{Document, Glb};

use super::super::{Files, without_mark};
use super::{DAMAGED, extensions, mended, packed, uri};

/// A file that has passed the checks of this module.
pub(super) struct GltfFile {
    pub(super) document: Document,
    /// Buffer contents by index.
    pub(super) buffers: Vec<Vec<u8>>,
    /// The animations of the file, which have been removed from `document`.
    pub(super) animations: Vec<Animation>,
}

/// Opens a file, and adds its buffer files to `files`. Animations whose JSON has the wrong structure are left out with a note.
pub(super) fn open(
    path: &Path,
    bytes: &[u8],
    store: &dyn Files,
    (notes, files): (&mut Vec<Diagnostic>, &mut Vec<PathBuf>),
) -> Result<GltfFile> {
    let wrong = |what: String| Error::file(path, what, DAMAGED);
    check_glb(bytes).map_err(wrong)?;
    let broken = |e: gltf::Error| wrong(format!("glTF: {e}"));
    let (mut root, blob) = root(bytes, notes).map_err(broken)?;
    check_attributes(&root).map_err(wrong)?;
    extensions::classify_required(path, &mut root, notes)?;
    notes.extend(extensions::unread(&root));
    for image in &mut root.images {
        // The crate requires fields that such an image lacks. An empty data URI is accepted, and fails when the image is read.
        let is_whole =
            image.uri.is_some() || (image.buffer_view.is_some() && image.mime_type.is_some());
        if !is_whole {
            image.uri = Some("data:".to_owned());
            image.buffer_view = None;
        }
    }
    let animations = std::mem::take(&mut root.animations);
    let mut buffers = buffers(path, &root, blob, store, files)?;
    packed::unpack(&mut root, &mut buffers).map_err(wrong)?;
    mended::mend(&mut root, &mut buffers, notes);
    let document = mended::validated(root, notes).map_err(wrong)?;
    Ok(GltfFile {
        document,
        buffers,
        animations,
    })
}

fn root(bytes: &[u8], notes: &mut Vec<Diagnostic>) -> Result<(Root, Option<Vec<u8>>), gltf::Error> {
    let (json, blob) = if bytes.starts_with(b"glTF") {
        let glb = Glb::from_slice(bytes)?;
        (glb.json, glb.bin.map(Cow::into_owned))
    } else {
        (Cow::Borrowed(without_mark(bytes)), None)
    };
    let root =
        Root::from_slice(&json).or_else(|e| mended::without_odd_entries(&json, notes).ok_or(e));
    Ok((root.map_err(gltf::Error::Deserialize)?, blob))
}

/// The buffer and image files of a readable document.
pub(in crate::load) fn named_files(folder: &Path, bytes: &[u8]) -> Vec<PathBuf> {
    if check_glb(bytes).is_err() {
        return Vec::new();
    }
    let root = root(bytes, &mut Vec::new());
    let Ok((root, _)) = root else {
        return Vec::new();
    };
    let buffers = root.buffers.iter().map(|buffer| buffer.uri.as_deref());
    let images = root.images.iter().map(|image| image.uri.as_deref());
    let uris = buffers.chain(images).flatten();
    let files = uris.filter(|uri| !uri.starts_with("data:"));
    let names = files.map(uri::percent_decoded);
    names
        .filter(|name| uri::leads_away(name).is_none())
        .map(|name| folder.join(name))
        .collect()
}

/// Checks the header of a binary file before the crate uses its lengths.
fn check_glb(bytes: &[u8]) -> Result<(), String> {
    if !bytes.starts_with(b"glTF") {
        return Ok(());
    }
    let word = |at: usize| {
        let bytes = bytes.get(at..at + 4)?.first_chunk()?;
        Some(u32::from_le_bytes(*bytes) as usize)
    };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(format!(
            "it ends after {} bytes, in the header",
            bytes.len()
        ));
    };
    if version != 2 {
        return Err(format!(
            "its version is {version}, but only version 2 is read"
        ));
    }
    if length > bytes.len() {
        return Err(format!("it has only {} of {length} bytes", bytes.len()));
    }
    if length < 20 {
        return Err(format!("its header states a length of {length} bytes"));
    }
    Ok(())
}

/// Checks accessor indices, because the crate's own validation accesses positions before it checks that they exist.
fn check_attributes(root: &Root) -> Result<(), String> {
    let primitives = root.meshes.iter().flat_map(|m| &m.primitives);
    let there = root.accessors.len();
    match primitives
        .flat_map(|p| p.attributes.values())
        .find(|a| a.value() >= there)
    {
        Some(a) => Err(format!(
            "a primitive refers to accessor {}, but there are only {there}",
            a.value()
        )),
        None => Ok(()),
    }
}

/// The bytes of all buffers. Buffers that are only placeholders for packed data are empty.
fn buffers(
    path: &Path,
    root: &Root,
    blob: Option<Vec<u8>>,
    store: &dyn Files,
    files: &mut Vec<PathBuf>,
) -> Result<Vec<Vec<u8>>> {
    let mut blob = blob;
    let all = root.buffers.iter().zip(packed::is_stand_in(root));
    all.enumerate()
        .map(|(number, (buffer, is_stand_in))| {
            if is_stand_in {
                return Ok(Vec::new());
            }
            let bytes = match &buffer.uri {
                None => blob.take().unwrap_or_default(),
                Some(at) => uri::read(path, ("buffer", at), store, files)?,
            };
            let (held, stated) = (bytes.len(), buffer.byte_length.0);
            if (held as u64) < stated {
                let what = format!("buffer {number} has only {held} of {stated} bytes");
                return Err(Error::file(path, what, DAMAGED));
            }
            Ok(bytes)
        })
        .collect()
}
