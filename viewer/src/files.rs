//! Files by what they are to the viewer, and files that are written whole.

use std::io::Write;
use std::path::Path;

use cutaway::{Error, Result};
use tempfile::Builder;

/// What a file is, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A scene file.
    Scene,
    /// A mesh.
    Model,
    /// An image: heights of a relief.
    Image,
}

/// Endings of names of meshes.
const MODELS: [&str; 5] = ["obj", "stl", "ply", "glb", "gltf"];

/// Endings of names of images.
const IMAGES: [&str; 11] = [
    "png", "jpg", "jpeg", "tif", "tiff", "bmp", "pgm", "ppm", "pnm", "tga", "exr",
];

/// What a file is, by its name; a built-in shape is a model.
///
/// # Errors
///
/// A name that says nothing.
pub fn kind(path: &Path) -> Result<Kind> {
    let name = path.to_string_lossy().to_lowercase();
    if name.starts_with("shape:") {
        return Ok(Kind::Model);
    }
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    let ending = name.rsplit('.').next().unwrap_or_default();
    if ending == "toml" {
        Ok(Kind::Scene)
    } else if MODELS.contains(&ending) {
        Ok(Kind::Model)
    } else if IMAGES.contains(&ending) {
        Ok(Kind::Image)
    } else {
        Err(Error::file(
            path,
            "it is no scene, no mesh and no image by its name",
            "open .toml, .obj, .stl, .ply, .glb, .gltf, or an image such as .png",
        ))
    }
}

/// Writes a file that is there whole or not at all.
///
/// # Errors
///
/// A folder that takes no file.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    // A link is followed: what it points to is replaced, not the link.
    let path = &std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
    let fault = |e: std::io::Error| {
        Error::file(
            path,
            format!("cannot be written: {e}"),
            "check the folder's permissions and the room on the disk",
        )
    };
    let mut builder = Builder::new();
    // As any other file: the mask of the process decides.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = (builder.tempfile_in(folder.unwrap_or(Path::new(".")))).map_err(fault)?;
    file.write_all(bytes).map_err(fault)?;
    file.persist(path).map_err(|e| fault(e.error))?;
    Ok(())
}
