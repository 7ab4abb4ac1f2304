//! What documents name, read once and shared: meshes, built-in shapes, height maps.
//!
//! A file is read when it is first asked for and stays in memory; whoever asks again gets the same [`Arc`]s. A program that has a
//! mesh already puts it in under the name that documents call it by. What changes on disk is not noticed: take new assets then.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;

use super::image::read_offset_map;
use super::{Loaded, load_mesh_file};
use crate::error::Result;
use crate::generate::shapes::shape;
use crate::scene::{OffsetMap, Part};

/// Meshes, shapes and height maps by name.
#[derive(Debug, Default)]
pub struct Assets {
    meshes: BTreeMap<PathBuf, Loaded>,
    shapes: BTreeMap<String, Vec<Part>>,
    images: BTreeMap<PathBuf, Arc<OffsetMap>>,
}

impl Assets {
    /// Puts parts in the place of a mesh file, under the path that a document comes to: its folder and the name that it says.
    pub fn insert_mesh(&mut self, path: impl Into<PathBuf>, mesh: impl Into<Loaded>) {
        self.meshes.insert(path.into(), mesh.into());
    }

    /// Puts parts in the place of a built-in shape, under all that a document says of it.
    pub fn insert_shape(&mut self, spec: impl Into<String>, parts: Vec<Part>) {
        self.shapes.insert(spec.into(), parts);
    }

    /// Puts a map in the place of an image file.
    pub fn insert_image(&mut self, path: impl Into<PathBuf>, map: impl Into<Arc<OffsetMap>>) {
        self.images.insert(path.into(), map.into());
    }

    /// Whether there is a mesh of this name, in memory or on disk.
    pub fn has_mesh(&self, path: &Path) -> bool {
        self.meshes.contains_key(path) || path.is_file()
    }

    /// What a mesh file holds.
    ///
    /// # Errors
    ///
    /// As of [`load_mesh_file`].
    pub fn mesh(&mut self, path: &Path) -> Result<&Loaded> {
        self.read_meshes(&[path.to_owned()])?;
        Ok(&self.meshes[path])
    }

    /// Reads mesh files that have not been read, in parallel.
    ///
    /// # Errors
    ///
    /// As of [`load_mesh_file`], of the first that cannot be read.
    pub fn read_meshes(&mut self, paths: &[PathBuf]) -> Result<()> {
        let missing = paths
            .par_iter()
            .filter(|path| !self.meshes.contains_key(*path));
        let read = missing.map(|path| Ok((path.clone(), load_mesh_file(path)?)));
        let read: Vec<_> = read.collect::<Result<_>>()?;
        self.meshes.extend(read);
        Ok(())
    }

    /// The parts of a built-in shape: `crank?throws=3`, with or without `shape:` before it.
    ///
    /// # Errors
    ///
    /// As of [`shape`].
    pub fn shape(&mut self, spec: &str) -> Result<&[Part]> {
        if !self.shapes.contains_key(spec) {
            self.shapes.insert(spec.to_owned(), shape(spec)?);
        }
        Ok(&self.shapes[spec])
    }

    /// The heights of an image.
    ///
    /// # Errors
    ///
    /// As of [`read_offset_map`].
    pub fn image(&mut self, path: &Path) -> Result<&Arc<OffsetMap>> {
        if !self.images.contains_key(path) {
            let map = read_offset_map(path)?;
            self.images.insert(path.to_owned(), Arc::new(map));
        }
        Ok(&self.images[path])
    }

    /// All files that were read, with those that they name.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let of_meshes = self.meshes.values().flat_map(|loaded| &loaded.files);
        of_meshes.chain(self.images.keys()).map(PathBuf::as_path)
    }
}
