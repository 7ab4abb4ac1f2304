//! The class `Scene` of Python: a document that always opens, and what it was last drawn as.
//!
//! A change is made on a copy of the document, which takes the place of the other only if it still opens. So an error is raised by the call
//! that is at fault, and leaves the scene as it was.

use std::collections::HashSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use cutaway::document::{CutDraft, Document, Node, Origin, PartDraft, Value, cut, part, section};
use cutaway::load::Assets;
use cutaway::save::plain_ply;
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::door::{Result, detached, raised};
use crate::opened::{Opened, Purpose};
use crate::store::Store;
use crate::{arrays, camera, values};

/// The name of a file, and what it holds.
type NamedBytes = (String, Arc<[u8]>);

/// A scene: parts, cuts, a camera and a look, as a document has them.
#[pyclass(frozen, module = "cutaway._native")]
pub(crate) struct Scene {
    state: Mutex<State>,
}

/// What a scene holds.
pub(crate) struct State {
    pub(crate) document: Document,
    pub(crate) assets: Assets,
    store: Arc<Store>,
    opened: Option<Opened>,
}

/// What a call asks for beside the scene, for itself alone: paths and their values, and keys of the camera.
#[derive(Clone, Default)]
pub(crate) struct Asked {
    /// Values by their paths, the style among them by its name or file.
    values: Vec<(String, Value)>,
    camera: Vec<(String, Value)>,
}

impl Asked {
    /// What two tables of Python ask for.
    pub(crate) fn of(set: &Bound<'_, PyDict>, camera: &Bound<'_, PyDict>) -> PyResult<Self> {
        Ok(Self {
            values: entries(set)?,
            camera: entries(camera)?,
        })
    }
}

/// The entries of a table, in its order.
fn entries(table: &Bound<'_, PyDict>) -> PyResult<Vec<(String, Value)>> {
    let entry = |(key, held): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        Ok((key.extract()?, values::value(&held)?))
    };
    table.iter().map(entry).collect()
}

impl State {
    fn new(document: Document) -> Self {
        let store = Arc::new(Store::default());
        Self {
            document,
            assets: Assets::from_files(store.clone()),
            store,
            opened: None,
        }
    }

    /// Changes the document, if what comes out opens.
    fn amend(&mut self, change: impl FnOnce(&mut Document) -> Result<()>) -> Result<()> {
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

    /// Opens the document with what a call asks for.
    pub(crate) fn open(&mut self, asked: Asked, purpose: Purpose) -> Result<&Opened> {
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
        let opened = Opened::of(document, &mut self.assets, purpose, self.opened.take())?;
        Ok(self.opened.insert(opened))
    }

    /// The document as a file of some name, and what is to lie beside it: meshes that were arrays, by their names in that file.
    fn saved(&mut self, path: &Path) -> Result<(String, Vec<NamedBytes>)> {
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

fn has_parts(document: &Document) -> bool {
    let parts = document.root().get("part");
    parts.is_some_and(|parts| !parts.items().is_empty())
}

fn must_have_parts(document: &Document) -> Result<()> {
    if has_parts(document) {
        return Ok(());
    }
    let help = "add a part: scene.add(\"tube\", vertices, faces), or scene.add(\"bracket.stl\")";
    Err(cutaway::Error::input("scene", "it has no parts", help))
}

impl Scene {
    fn of(document: Document) -> Self {
        Self {
            state: Mutex::new(State::new(document)),
        }
    }

    /// The state. To be asked for without the lock of the interpreter, which who holds the state may wait for.
    pub(crate) fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(|poisoned| {
            // Documents are never half changed; what was drawn may be.
            let mut state = PoisonError::into_inner(poisoned);
            state.opened = None;
            self.state.clear_poison();
            state
        })
    }

    fn add_draft(
        &self,
        py: Python<'_>,
        draft: impl FnOnce(&State) -> PartDraft + Send,
        fields: Vec<(String, Value)>,
    ) -> PyResult<()> {
        detached(py, || {
            let mut state = self.state();
            let draft = draft(&state);
            let draft = fields
                .into_iter()
                .fold(draft, |draft, (key, value)| draft.with(&key, value));
            state.amend(|document| document.add_part(draft))
        })
    }
}

#[pymethods]
impl Scene {
    #[new]
    fn new() -> Self {
        Self::of(Document::new())
    }

    /// A scene file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        detached(py, || {
            let scene = Self::of(Document::read(&path)?);
            scene.state().amend(|_| Ok(()))?;
            Ok(scene)
        })
    }

    /// Adds the parts of a file, or a built-in shape.
    fn add_model(&self, py: Python<'_>, model: String, fields: &Bound<'_, PyDict>) -> PyResult<()> {
        self.add_draft(py, move |_| part(&model), entries(fields)?)
    }

    /// Adds a mesh.
    fn add_arrays(
        &self,
        py: Python<'_>,
        name: String,
        vertices: PyReadonlyArray2<'_, f64>,
        faces: PyReadonlyArray2<'_, u32>,
        fields: &Bound<'_, PyDict>,
    ) -> PyResult<()> {
        let mesh = arrays::mesh(&vertices, &faces)?;
        if let Some(defect) = mesh.defect() {
            let help = "clean the arrays before they are added";
            return Err(raised(cutaway::Error::input(
                format!("mesh `{name}`"),
                defect.to_string(),
                help,
            )));
        }
        let draft = move |state: &State| part(&state.store.keep(plain_ply(&mesh))).name(&name);
        self.add_draft(py, draft, entries(fields)?)
    }

    /// Adds a cut of sections with reliefs, of which each may keep the other side, boxes, wedges and more keys of `[[cut]]`.
    #[pyo3(signature = (sections, boxes, wedges, cutter, cutout, breakaway, exclude, fields))]
    #[allow(
        clippy::too_many_arguments,
        reason = "they are the words of one call of Python"
    )]
    fn cut(
        &self,
        py: Python<'_>,
        sections: Vec<(String, Option<String>, bool)>,
        boxes: Vec<String>,
        wedges: Vec<String>,
        cutter: Option<String>,
        cutout: Option<String>,
        breakaway: Option<String>,
        exclude: Vec<String>,
        fields: &Bound<'_, PyDict>,
    ) -> PyResult<()> {
        let fields = entries(fields)?;
        let draft = move || {
            let surfaces = sections.iter().map(|(spec, relief, flip)| {
                let surface = section(spec);
                let surface = match relief {
                    Some(relief) => surface.relief(relief),
                    None => surface,
                };
                if *flip { surface.flip() } else { surface }
            });
            let draft = boxes.iter().fold(cut(surfaces), |d, b| d.block(b));
            let draft = wedges.iter().fold(draft, |d, w| d.wedge(w));
            let some = |draft: CutDraft,
                        words: &Option<String>,
                        add: fn(CutDraft, &str) -> CutDraft| match words {
                Some(words) => add(draft, words),
                None => draft,
            };
            let draft = some(draft, &cutter, |d, words| d.volume(words));
            let draft = some(draft, &cutout, |d, words| d.cutout(words));
            let draft = some(draft, &breakaway, |d, words| d.breakaway(words));
            fields
                .into_iter()
                .fold(draft.except(&exclude), |d, (key, value)| {
                    d.with(&key, value)
                })
        };
        detached(py, || {
            self.state().amend(|document| document.add_cut(draft()))
        })
    }

    /// Sets a value.
    fn set(&self, py: Python<'_>, path: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let value = values::value(value)?;
        detached(py, || {
            self.state().amend(|document| match (path, &value) {
                ("style", Value::Text(style)) => document.set_style(style, "style"),
                _ => document.set(path, value),
            })
        })
    }

    /// The value at a path.
    fn get<'py>(&self, py: Python<'py>, path: &str) -> PyResult<Bound<'py, PyAny>> {
        let node = detached(py, || Ok(self.state().document.get(path)?.clone()))?;
        values::object(py, &node.value)
    }

    /// Takes a value away.
    fn remove(&self, py: Python<'_>, path: &str) -> PyResult<()> {
        detached(py, || self.state().amend(|document| document.remove(path)))
    }

    /// Names of the parts as they are drawn, and what the user should know of what was read.
    fn parts(&self, py: Python<'_>) -> PyResult<(Vec<String>, Vec<String>)> {
        detached(py, || {
            let mut state = self.state();
            if !has_parts(&state.document) {
                return Ok(Default::default());
            }
            let State {
                document, assets, ..
            } = &mut *state;
            let timeline = document.timeline(assets)?;
            let parts = timeline.scene()?.parts;
            let names = parts.into_iter().map(|part| part.name).collect();
            Ok((names, timeline.notes().to_vec()))
        })
    }

    /// Names of the cuts.
    fn cuts(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        detached(py, || {
            let state = self.state();
            let cuts = state
                .document
                .root()
                .get("cut")
                .map_or(&[] as &[_], Node::items);
            let name = |node: &Node| node.name().unwrap_or_default().to_owned();
            Ok(cuts.iter().map(name).collect())
        })
    }

    /// The text of the scene as a file of this name, and the bytes of the files beside it.
    #[allow(clippy::type_complexity, reason = "a text and files by their names")]
    fn saved(&self, py: Python<'_>, path: PathBuf) -> PyResult<(String, Vec<(String, Vec<u8>)>)> {
        detached(py, || {
            let (text, beside) = self.state().saved(&path)?;
            let beside = beside
                .into_iter()
                .map(|(name, bytes)| (name, bytes.to_vec()));
            Ok((text, beside.collect()))
        })
    }

    /// The text of the scene.
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        detached(py, || Ok(self.state().document.to_string()))
    }

    /// Draws it: see `crate::render`.
    fn render<'py>(
        &self,
        py: Python<'py>,
        set: &Bound<'_, PyDict>,
        camera: &Bound<'_, PyDict>,
    ) -> PyResult<Bound<'py, PyDict>> {
        crate::render::render(self, py, Asked::of(set, camera)?)
    }

    /// Slices it: see `crate::section`.
    fn section<'py>(
        &self,
        py: Python<'py>,
        spec: &str,
        set: &Bound<'_, PyDict>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let none = PyDict::new(py);
        crate::section::section(self, py, spec, Asked::of(set, &none)?)
    }

    /// Divides it: see `crate::capped`.
    fn capped<'py>(
        &self,
        py: Python<'py>,
        relief_cells: u32,
        set: &Bound<'_, PyDict>,
    ) -> PyResult<Bound<'py, PyList>> {
        if !(1..=4096).contains(&relief_cells) {
            return Err(PyValueError::new_err(format!(
                "relief_cells={relief_cells}: it must be from 1 to 4096\n  help: 256 is usual"
            )));
        }
        let none = PyDict::new(py);
        crate::capped::capped(self, py, relief_cells, Asked::of(set, &none)?)
    }

    /// Judges strategies: see `crate::compare`.
    fn compare(
        &self,
        py: Python<'_>,
        strategies: Vec<String>,
        rounds: usize,
        set: &Bound<'_, PyDict>,
        camera: &Bound<'_, PyDict>,
        command: String,
    ) -> PyResult<String> {
        let asked = Asked::of(set, camera)?;
        crate::compare::compare(self, py, &strategies, rounds, asked, command)
    }
}
