//! Shared cache of the files that documents name: meshes, built-in shapes, height maps, textures.
//!
//! The first request reads a file, from disk or from a host's [`Files`], and keeps its content in memory. Later requests return the same
//! [`Arc`]s. A program that already has a mesh inserts it under the name that documents use for it. Changes to files are not noticed. To
//! read changed files, create new assets.

use std::any::{Any, TypeId};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::Result;
use cutaway::generate::shapes::shape;
use cutaway::scene::{LengthUnit, OffsetMap, Part, Texture, TextureKind};
use rayon::prelude::*;

use super::images::image::read_offset_map_from;
use super::images::texture::read_texture_from;
use super::{Disk, Files, Loaded, load_mesh_file_from};

/// Meshes, shapes, height maps and textures by name. Clones share them.
#[derive(Clone, Debug)]
pub struct Assets {
    store: Arc<dyn Files>,
    meshes: BTreeMap<PathBuf, Loaded>,
    shapes: BTreeMap<String, Vec<Part>>,
    images: BTreeMap<PathBuf, Arc<OffsetMap>>,
    textures: BTreeMap<(PathBuf, bool), Arc<Texture>>,
    /// Values cached by document readers, by type.
    kept: BTreeMap<TypeId, Arc<dyn Any + Send + Sync>>,
}

impl Default for Assets {
    fn default() -> Self {
        Self::from_files(Arc::new(Disk))
    }
}

impl Assets {
    /// Creates assets whose files are read from this store instead of the disk.
    pub fn from_files(store: Arc<dyn Files>) -> Self {
        Self {
            store,
            meshes: BTreeMap::new(),
            shapes: BTreeMap::new(),
            images: BTreeMap::new(),
            textures: BTreeMap::new(),
            kept: BTreeMap::new(),
        }
    }

    /// Store from which files are read.
    pub(crate) fn store(&self) -> &dyn Files {
        &*self.store
    }

    /// Inserts parts in place of a mesh file. `path` is the document's folder joined with the name that the document uses for the mesh.
    pub fn insert_mesh(&mut self, path: impl Into<PathBuf>, mesh: impl Into<Loaded>) {
        self.meshes.insert(path.into(), mesh.into());
        self.kept.clear();
    }

    /// Inserts parts in place of a built-in shape. Documents must use exactly this specification, including its numbers.
    pub fn insert_shape(&mut self, spec: impl Into<String>, parts: Vec<Part>) {
        self.shapes.insert(spec.into(), parts);
        self.kept.clear();
    }

    /// Inserts an offset map in place of an image file.
    pub fn insert_image(&mut self, path: impl Into<PathBuf>, map: impl Into<Arc<OffsetMap>>) {
        self.images.insert(path.into(), map.into());
        self.kept.clear();
    }

    /// Inserts a texture in place of an image file.
    pub fn insert_texture(&mut self, path: impl Into<PathBuf>, texture: impl Into<Arc<Texture>>) {
        let (path, texture) = (path.into(), texture.into());
        for is_color in [false, true] {
            self.textures
                .insert((path.clone(), is_color), texture.clone());
        }
        self.kept.clear();
    }

    /// Returns true if a texture of this name was inserted or its file exists.
    pub(crate) fn has_texture(&self, path: &Path) -> bool {
        self.textures.contains_key(&(path.to_owned(), true)) || self.store.is_file(path)
    }

    /// Returns true if a mesh of this name was inserted or its file exists.
    pub fn has_mesh(&self, path: &Path) -> bool {
        self.meshes.contains_key(path) || self.store.is_file(path)
    }

    /// Returns the content of a mesh file.
    ///
    /// # Errors
    ///
    /// The errors of [`load_mesh_file`](super::load_mesh_file).
    pub fn mesh(&mut self, path: &Path) -> Result<&Loaded> {
        self.read_meshes(&[path.to_owned()])?;
        Ok(&self.meshes[path])
    }

    /// Returns the length unit of the mesh files read so far, or `None` unless all of them state the same unit.
    pub fn unit(&self) -> Option<LengthUnit> {
        let mut units = self.meshes.values().map(|loaded| loaded.unit);
        let first = units.next()??;
        units.all(|unit| unit == Some(first)).then_some(first)
    }

    /// Reads the mesh files that have not been read yet, in parallel.
    ///
    /// # Errors
    ///
    /// The errors of [`load_mesh_file`](super::load_mesh_file), for the first file that cannot be read.
    pub fn read_meshes(&mut self, paths: &[PathBuf]) -> Result<()> {
        let missing = paths
            .par_iter()
            .filter(|path| !self.meshes.contains_key(*path));
        let read = missing.map(|path| Ok((path.clone(), load_mesh_file_from(path, &*self.store)?)));
        let read: Vec<_> = read.collect::<Result<_>>()?;
        self.meshes.extend(read);
        Ok(())
    }

    /// Returns the parts of a built-in shape such as `crank?throws=3`. The prefix `shape:` is optional.
    ///
    /// # Errors
    ///
    /// The errors of [`shape`].
    pub fn shape(&mut self, spec: &str) -> Result<&[Part]> {
        if !self.shapes.contains_key(spec) {
            self.shapes.insert(spec.to_owned(), shape(spec)?);
        }
        Ok(&self.shapes[spec])
    }

    /// Returns the height map in an image file.
    ///
    /// # Errors
    ///
    /// The errors of [`read_offset_map`](super::read_offset_map).
    pub fn image(&mut self, path: &Path) -> Result<&Arc<OffsetMap>> {
        if !self.images.contains_key(path) {
            let map = read_offset_map_from(path, &*self.store)?;
            self.images.insert(path.to_owned(), Arc::new(map));
        }
        Ok(&self.images[path])
    }

    /// Returns the texture in an image file.
    ///
    /// # Errors
    ///
    /// The errors of [`read_texture_from`].
    pub fn texture(&mut self, path: &Path, kind: TextureKind) -> Result<Arc<Texture>> {
        let key = (path.to_owned(), kind == TextureKind::Color);
        if !self.textures.contains_key(&key) {
            let texture = read_texture_from(path, kind, &*self.store)?;
            self.textures.insert(key.clone(), Arc::new(texture));
        }
        Ok(self.textures[&key].clone())
    }

    /// Returns the value of this type that a document reader has cached for the next document. Inserting any asset that the value may
    /// depend on discards it.
    pub(crate) fn kept<T: Any + Send + Sync>(&self) -> Option<Arc<T>> {
        self.kept.get(&TypeId::of::<T>())?.clone().downcast().ok()
    }

    /// Caches a value, replacing the cached value of the same type, and returns it.
    pub(crate) fn keep<T: Any + Send + Sync>(&mut self, made: T) -> Arc<T> {
        let made = Arc::new(made);
        self.kept.insert(TypeId::of::<T>(), made.clone());
        made
    }

    /// All files read so far, including companion files.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let of_meshes = self.meshes.values().flat_map(|loaded| &loaded.files);
        let of_textures = self.textures.keys().map(|(path, _)| path);
        (of_meshes.chain(self.images.keys()).chain(of_textures)).map(PathBuf::as_path)
    }
}
