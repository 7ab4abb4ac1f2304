//! The kinds of files that the viewer opens, and the storage of files: on disk, or in a page's memory.

use std::path::Path;

use cutaway::{Error, Result};
use cutaway_io::load::{Files, place_of};

/// Storage that files are read from and written to.
pub trait FileStorage: Files {
    /// Writes a file completely or not at all.
    ///
    /// # Errors
    ///
    /// The path cannot be written.
    fn write(&self, path: &Path, bytes: &[u8]) -> Result<()>;

    /// Returns true if two paths lead to the same file.
    fn is_one(&self, a: &Path, b: &Path) -> bool {
        place_of(a) == place_of(b)
    }
}

/// Kind of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A scene file.
    Scene,
    /// A mesh.
    Model,
    /// An image, used as the height map of a relief.
    Image,
}

/// Mesh extensions.
const MODELS: [&str; 6] = ["obj", "stl", "ply", "glb", "gltf", "3mf"];

/// Image extensions.
const IMAGES: [&str; 11] = [
    "png", "jpg", "jpeg", "tif", "tiff", "bmp", "pgm", "ppm", "pnm", "tga", "exr",
];

/// Kind of a file, by its extension; a built-in shape (`shape:...`) is a model.
///
/// # Errors
///
/// The name has no known extension.
pub fn kind(path: &Path) -> Result<FileKind> {
    let name = path.to_string_lossy().to_lowercase();
    if name.starts_with("shape:") {
        return Ok(FileKind::Model);
    }
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    let ending = name.rsplit('.').next().unwrap_or_default();
    if ending == "toml" {
        Ok(FileKind::Scene)
    } else if MODELS.contains(&ending) {
        Ok(FileKind::Model)
    } else if IMAGES.contains(&ending) {
        Ok(FileKind::Image)
    } else {
        Err(Error::file(
            path,
            "its name is not that of a scene, a mesh or an image",
            "open .toml, .obj, .stl, .ply, .glb, .gltf, .3mf, or an image such as .png",
        ))
    }
}
