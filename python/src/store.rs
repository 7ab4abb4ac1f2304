//! Arrays as files: meshes added from Python are kept as the bytes of a PLY file, so they are read, welded, checked and saved like a
//! mesh file with the same numbers.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::{Arc, PoisonError, RwLock};

use cutaway_io::load::{Disk, Files};

/// The virtual folder of arrays; a real folder is unlikely to have this name.
const FOLDER: &str = "<arrays>";

/// A file's name and contents.
pub(crate) type NamedBytes = (String, Arc<[u8]>);

/// The files on disk, and the virtual files of arrays.
#[derive(Debug, Default)]
pub(crate) struct ArrayStore(RwLock<BTreeMap<String, Arc<[u8]>>>);

impl ArrayStore {
    /// Stores bytes under a new name, for use in documents.
    pub(crate) fn keep(&self, bytes: Vec<u8>) -> String {
        let mut held = self.0.write().unwrap_or_else(PoisonError::into_inner);
        let name = format!("{}.ply", held.len() + 1);
        held.insert(name.clone(), bytes.into());
        format!("{FOLDER}/{name}")
    }

    /// All arrays by name.
    pub(crate) fn all(&self) -> Vec<NamedBytes> {
        let held = self.0.read().unwrap_or_else(PoisonError::into_inner);
        let all = held
            .iter()
            .map(|(name, bytes)| (name.clone(), bytes.clone()));
        all.collect()
    }

    /// Stores arrays under the names that they had in another store.
    pub(crate) fn hold(&self, arrays: Vec<(String, Vec<u8>)>) {
        let mut held = self.0.write().unwrap_or_else(PoisonError::into_inner);
        held.extend(arrays.into_iter().map(|(name, bytes)| (name, bytes.into())));
    }

    /// The bytes of the arrays stored under this name, if any.
    pub(crate) fn held(&self, path: &Path) -> Option<Arc<[u8]>> {
        let name = path.file_name()?.to_str()?;
        let held = self.0.read().unwrap_or_else(PoisonError::into_inner);
        held.get(name).filter(|_| is_virtual(path)).cloned()
    }
}

/// Returns true if a name denotes arrays, also if it is relative to another folder.
pub(crate) fn is_virtual(path: &Path) -> bool {
    path.parent().is_some_and(|folder| folder.ends_with(FOLDER))
}

impl Files for ArrayStore {
    fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        match self.held(path) {
            Some(bytes) => Ok(bytes.to_vec().into()),
            None => Disk.read(path).map(|bytes| bytes.into_owned().into()),
        }
    }

    fn is_file(&self, path: &Path) -> bool {
        self.held(path).is_some() || Disk.is_file(path)
    }

    fn leads_out(&self, path: &Path, from: &Path) -> bool {
        Disk.leads_out(path, from)
    }
}
