//! State of a Python scene: a document that always opens, the files it was read from, and its last drawn model.
//!
//! A change is made to a copy of the document, and the copy replaces the document only if it still opens. So the call that makes an invalid
//! change raises the error, and the scene stays unchanged.

use std::collections::HashSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf, absolute};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use cutaway::Error;
use cutaway_io::document::{Document, Node, Origin, Value};
use cutaway_io::load::Assets;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::door::Result;
use crate::opened::{OpenedDocument, Purpose};
use crate::store::{ArrayStore, NamedBytes};
use crate::{camera, values};

/// The state of a scene, behind a lock for the threads of its calls.
pub(crate) struct Shared(Mutex<SceneState>);

impl From<SceneState> for Shared {
    fn from(state: SceneState) -> Self {
        Self(Mutex::new(state))
    }
}

impl Shared {
    /// The state. Lock it without holding the interpreter lock, because its holder may wait for that.
    pub(crate) fn state(&self) -> MutexGuard<'_, SceneState> {
        self.0.lock().unwrap_or_else(|poisoned| {
            // A panic cannot leave a document half changed, but it can leave the drawn model so.
            let mut state = PoisonError::into_inner(poisoned);
            state.opened = None;
            self.0.clear_poison();
            state
        })
    }
}

/// Path given to the document of a pickled scene: a file in the root folder.
const IN_ROOT: &str = "/scene.toml";

/// State of a scene.
pub(crate) struct SceneState {
    pub(crate) document: Document,
    pub(crate) assets: Assets,
    pub(crate) store: Arc<ArrayStore>,
    opened: Option<OpenedDocument>,
}

/// Settings that a single call adds to the scene: values by path, and keys of the camera.
#[derive(Clone, Default)]
pub(crate) struct CallSettings {
    /// Values by path, including the style by its name or file.
    values: Vec<(String, Value)>,
    camera: Vec<(String, Value)>,
}

impl CallSettings {
    /// Reads the settings from two Python tables.
    pub(crate) fn of(set: &Bound<'_, PyDict>, camera: &Bound<'_, PyDict>) -> PyResult<Self> {
        Ok(Self {
            values: entries(set)?,
            camera: entries(camera)?,
        })
    }
}

/// The entries of a table, in table order.
pub(crate) fn entries(table: &Bound<'_, PyDict>) -> PyResult<Vec<(String, Value)>> {
    let entry = |(key, held): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        Ok((key.extract()?, values::value(&held)?))
    };
    table.iter().map(entry).collect()
}

impl SceneState {
    pub(crate) fn new(document: Document) -> Self {
        let store = Arc::new(ArrayStore::default());
        Self {
            document,
            assets: Assets::from_files(store.clone()),
            store,
            opened: None,
        }
    }

    /// An independent copy.
    pub(crate) fn copied(&self) -> Self {
        Self {
            document: self.document.clone(),
            assets: self.assets.clone(),
            store: self.store.clone(),
            opened: None,
        }
    }

    /// The text of the document, with absolute file paths because it is written as for a file in the root folder; the document's path,
    /// empty if it was not read from a file; and its arrays.
    pub(crate) fn pickled(&self) -> Result<(String, PathBuf, Vec<NamedBytes>)> {
        let path = match self.document.path() {
            path if path == Path::new("") => PathBuf::new(),
            path => absolute(path).map_err(|e| {
                let help = "change to an existing folder before pickling the scene";
                Error::input("scene", format!("the current folder is unknown: {e}"), help)
            })?,
        };
        let text = self.document.moved_to(Path::new(IN_ROOT))?.to_string();
        Ok((text, path, self.store.all()))
    }

    /// Restores a [pickled](SceneState::pickled) scene. The files that it names are read again.
    pub(crate) fn unpickled(
        text: &str,
        path: &Path,
        arrays: Vec<(String, Vec<u8>)>,
    ) -> Result<Self> {
        let mut state = Self::new(Document::parse(IN_ROOT, text)?.moved_to(path)?);
        state.store.hold(arrays);
        state.amend(|_| Ok(()))?;
        Ok(state)
    }

    /// Changes the document, if the result opens.
    pub(crate) fn amend(&mut self, change: impl FnOnce(&mut Document) -> Result<()>) -> Result<()> {
        let mut document = self.document.clone();
        change(&mut document)?;
        if has_parts(&document) {
            document.timeline(&mut self.assets)?;
        } else {
            document.check(&self.assets)?;
        }
        self.document = document;
        Ok(())
    }

    /// Opens the document with a call's settings.
    pub(crate) fn open(
        &mut self,
        asked: CallSettings,
        purpose: Purpose,
    ) -> Result<&OpenedDocument> {
        let mut document = self.document.clone();
        must_have_parts(&document)?;
        camera::aim(&mut document, asked.camera)?;
        for (path, value) in asked.values {
            match (path.as_str(), &value) {
                ("style", Value::Text(style)) => document.set_style(style, "style")?,
                _ => {
                    let origin = Origin::Option(path.as_str().into());
                    document.set_node(&path, Node::new(value).said(&origin))?;
                }
            }
        }
        let opened = OpenedDocument::of(document, &mut self.assets, purpose, self.opened.take())?;
        Ok(self.opened.insert(opened))
    }

    /// The text of the document as a file at a given path, and its accompanying files: meshes added as arrays, under the names in the text.
    pub(crate) fn saved(&mut self, path: &Path) -> Result<(String, Vec<NamedBytes>)> {
        let mut document = self.document.clone();
        document.guess_up(&mut self.assets)?;
        let mut document = document.moved_to(path)?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let parts = document.root().get("part").map_or(&[] as &[_], Node::items);
        let mesh = |node: &Node| node.get("mesh").and_then(Node::text).map(PathBuf::from);
        let meshes: Vec<Option<PathBuf>> = parts.iter().map(mesh).collect();
        // File names that the scene already uses are not reused.
        let files = document.files(&*self.store);
        let names = files.iter().filter_map(|file| file.file_name());
        let mut taken: HashSet<OsString> = names.map(Into::into).collect();
        let mut beside = Vec::new();
        for (number, mesh) in meshes.into_iter().enumerate() {
            let Some(bytes) = mesh.and_then(|mesh| self.store.held(&mesh)) else {
                continue;
            };
            let mut names = (number + 1..).map(|n| format!("{stem}.{n}.ply"));
            let Some(name) = names.find(|name| taken.insert(name.into())) else {
                continue;
            };
            document.set(&format!("part.{number}.mesh"), name.as_str())?;
            beside.push((name, bytes));
        }
        Ok((document.to_string(), beside))
    }
}

/// Returns true if there is anything to draw.
pub(crate) fn has_parts(document: &Document) -> bool {
    let parts = document.root().get("part");
    parts.is_some_and(|parts| !parts.items().is_empty())
}

fn must_have_parts(document: &Document) -> Result<()> {
    if has_parts(document) {
        return Ok(());
    }
    let help = "add a part: scene.add(\"tube\", vertices, faces), or scene.add(\"bracket.stl\")";
    Err(Error::input("scene", "it has no parts", help))
}
