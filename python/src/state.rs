//! State of a Python scene: a document that always opens, the files it was read from, and its last drawn model.
//!
//! A change is made on a copy of the document, which takes the place of the other only if it still opens. So an error is raised by the call
//! that is at fault, and leaves the scene as it was.

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
use crate::store::{NamedBytes, ArrayStore};
use crate::{camera, values};

/// The state of a scene, which threads of its calls use in turn.
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
            // Documents are never half changed; what was drawn may be.
            let mut state = PoisonError::into_inner(poisoned);
            state.opened = None;
            self.0.clear_poison();
            state
        })
    }
}

/// The document of a pickled scene, as a file in the root folder.
const IN_ROOT: &str = "/scene.toml";

/// State of a scene.
pub(crate) struct SceneState {
    pub(crate) document: Document,
    pub(crate) assets: Assets,
    pub(crate) store: Arc<ArrayStore>,
    opened: Option<OpenedDocument>,
}

/// Settings of a single call on top of the scene: paths and their values, and keys of the camera.
#[derive(Clone, Default)]
pub(crate) struct CallSettings {
    /// Values by their paths, the style among them by its name or file.
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

/// The entries of a table, in its order.
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

    /// The text of the document, written as for a file of the root folder, so that it names files by their whole paths; the path of the document,
    /// empty if it was read from no file; and its arrays.
    pub(crate) fn pickled(&self) -> Result<(String, PathBuf, Vec<NamedBytes>)> {
        let path = match self.document.path() {
            path if path == Path::new("") => PathBuf::new(),
            path => absolute(path).map_err(|e| {
                let help = "go to a folder that is there before the scene is pickled";
                Error::input("scene", format!("its folder is not known: {e}"), help)
            })?,
        };
        let text = self.document.moved_to(Path::new(IN_ROOT))?.to_string();
        Ok((text, path, self.store.all()))
    }

    /// A scene that was [pickled](SceneState::pickled). What it names is read again.
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
    pub(crate) fn open(&mut self, asked: CallSettings, purpose: Purpose) -> Result<&OpenedDocument> {
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

    /// The document as a file of a given name, and its accompanying files: meshes that were arrays, by their names in that file.
    pub(crate) fn saved(&mut self, path: &Path) -> Result<(String, Vec<NamedBytes>)> {
        let mut document = self.document.clone();
        document.guess_up(&mut self.assets)?;
        let mut document = document.moved_to(path)?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let parts = document.root().get("part").map_or(&[] as &[_], Node::items);
        let mesh = |node: &Node| node.get("mesh").and_then(Node::text).map(PathBuf::from);
        let meshes: Vec<Option<PathBuf>> = parts.iter().map(mesh).collect();
        // Names of files that the scene has of an earlier time stay theirs.
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
