//! The files that a mesh file names: buffers of glTF, material lists of OBJ. Nothing is checked here; who opens the mesh does that.

use std::path::{Path, PathBuf};

/// The files that a mesh file names, beside it.
pub fn companions(path: &Path) -> Vec<PathBuf> {
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let text = || std::fs::read_to_string(path).unwrap_or_default();
    let names = match extension.to_str() {
        Some("gltf") => buffers(&text()),
        Some("obj") => {
            let text = text();
            let libraries = text.lines().filter_map(|l| l.strip_prefix("mtllib "));
            libraries.map(|name| name.trim().to_owned()).collect()
        }
        _ => Vec::new(),
    };
    names.into_iter().map(|name| folder.join(name)).collect()
}

/// The buffers of a glTF document that are files.
fn buffers(text: &str) -> Vec<String> {
    let document: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
    let buffers = document["buffers"].as_array().cloned().unwrap_or_default();
    let names = buffers.iter().filter_map(|b| b["uri"].as_str());
    let files = names.filter(|uri| !uri.starts_with("data:"));
    files.map(str::to_owned).collect()
}
