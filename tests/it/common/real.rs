//! Real meshes, cut.

use std::path::{Path, PathBuf};

use cutaway::scene::{Cut, Scene, Topology};
use cutaway_io::document::section;
use cutaway_io::load::load_mesh_file;

use super::data::data;

/// Extensions of what is no mesh.
const OTHERS: [&str; 3] = ["md", "step", "stp"];

/// The mesh files of some folders, in order.
pub(crate) fn files(folders: &[&str]) -> Vec<PathBuf> {
    let Some(data) = data() else {
        return Vec::new();
    };
    let mut files: Vec<PathBuf> = folders
        .iter()
        .flat_map(|f| std::fs::read_dir(data.join(f)).expect("a folder of meshes"))
        .map(|entry| entry.expect("an entry of it").path())
        // Meshes lie beside their sources and notes.
        .filter(|file| {
            !file
                .extension()
                .is_some_and(|e| OTHERS.iter().any(|o| e == *o))
        })
        .collect();
    files.sort();
    assert!(!files.is_empty(), "the folders hold meshes");
    files
}

/// A file, cut through the middle of its bounds by an oblique plane, or by a relief on it.
pub(crate) fn cut(file: &Path, relief: Option<&str>) -> Scene {
    let parts = load_mesh_file(file).expect("a mesh that loads").parts;
    let mut scene = Scene {
        parts,
        ..Scene::default()
    };
    let mut surface = section("-0.3,-0.25,-1@50%,50%,50%");
    if let Some(relief) = relief {
        surface = surface.relief(relief);
    }
    let surface = surface.on(&scene.bounds()).expect("a section");
    scene.cuts.push(Cut::new("middle", vec![surface]));
    scene
}

/// Closed meshes among some files, cut as [`cut`] does, with the names of their files.
pub(crate) fn closed(
    files: impl IntoIterator<Item = PathBuf>,
    relief: Option<&'static str>,
) -> impl Iterator<Item = (String, Scene)> {
    files.into_iter().filter_map(move |file| {
        let name = file.file_name().unwrap_or_default();
        let scene = cut(&file, relief);
        is_closed(&scene).then(|| (name.to_string_lossy().into_owned(), scene))
    })
}

/// Whether all meshes of a scene are closed.
pub(crate) fn is_closed(scene: &Scene) -> bool {
    scene.parts.iter().all(|p| Topology::new(&p.mesh).closed)
}
