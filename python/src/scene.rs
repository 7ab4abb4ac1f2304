//! The Python class `Scene`: a document that always opens, and its last drawn model.
//!
//! The work of a call runs on a separate thread ([`detached`]), with the scene's state ([`Shared`]).

use std::path::PathBuf;
use std::sync::Arc;

use cutaway::error::Diagnostic;
use cutaway_io::document::{CutDraft, Document, Node, PartDraft, Value, cut, part, section};
use cutaway_io::save::plain_ply;
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::door::{detached, raised};
use crate::state::{CallSettings, SceneState, Shared, entries, has_parts};
use crate::{arrays, values};

/// A scene: parts, cuts, a camera and a style, stored as a document.
#[pyclass(frozen, module = "cutaway._native")]
pub(crate) struct Scene(Arc<Shared>);

impl From<SceneState> for Scene {
    fn from(state: SceneState) -> Self {
        Self(Arc::new(state.into()))
    }
}

impl Scene {
    /// A handle to the shared state that can move to another thread.
    pub(crate) fn shared(&self) -> Arc<Shared> {
        self.0.clone()
    }

    fn add_draft(
        &self,
        py: Python<'_>,
        draft: impl FnOnce(&SceneState) -> PartDraft + Send + 'static,
        fields: Vec<(String, Value)>,
    ) -> PyResult<()> {
        let scene = self.shared();
        detached(py, move || {
            let mut state = scene.state();
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
        SceneState::new(Document::new()).into()
    }

    /// Reads a scene file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        detached(py, move || {
            let mut state = SceneState::new(Document::read(&path)?);
            state.amend(|_| Ok(()))?;
            Ok(state.into())
        })
    }

    /// Copies the scene; both copies share the files that were read.
    fn copied(&self, py: Python<'_>) -> PyResult<Self> {
        let scene = self.shared();
        detached(py, move || Ok(scene.state().copied().into()))
    }

    /// Pickled form, from which another process can restore the scene: see [`Scene::unpickled`].
    #[allow(clippy::type_complexity, reason = "the arguments of `unpickled`")]
    fn pickled(&self, py: Python<'_>) -> PyResult<(String, PathBuf, Vec<(String, Vec<u8>)>)> {
        let scene = self.shared();
        detached(py, move || {
            let (text, path, arrays) = scene.state().pickled()?;
            let arrays = arrays.into_iter();
            let arrays = arrays.map(|(name, bytes)| (name, bytes.to_vec()));
            Ok((text, path, arrays.collect()))
        })
    }

    /// Restores a scene from its text, its path, and arrays by name. The text is written as for a file in the root folder.
    #[staticmethod]
    fn unpickled(
        py: Python<'_>,
        text: String,
        path: PathBuf,
        arrays: Vec<(String, Vec<u8>)>,
    ) -> PyResult<Self> {
        detached(py, move || {
            Ok(SceneState::unpickled(&text, &path, arrays)?.into())
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
        let draft = move |state: &SceneState| part(&state.store.keep(plain_ply(&mesh))).name(&name);
        self.add_draft(py, draft, entries(fields)?)
    }

    /// Adds a cut: sections (each with an optional relief and a flip flag), boxes, wedges and further keys of `[[cut]]`.
    #[pyo3(signature = (sections, boxes, wedges, cutter, cutout, breakaway, exclude, fields))]
    #[allow(
        clippy::too_many_arguments,
        reason = "they are the arguments of one Python call"
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
        let scene = self.shared();
        detached(py, move || {
            scene.state().amend(|document| document.add_cut(draft()))
        })
    }

    /// Sets a value.
    fn set(&self, py: Python<'_>, path: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let (scene, path, value) = (self.shared(), path.to_owned(), values::value(value)?);
        detached(py, move || {
            scene.state().amend(|document| match (&*path, &value) {
                ("style", Value::Text(style)) => document.set_style(style, "style"),
                _ => document.set(&path, value),
            })
        })
    }

    /// The value at a path.
    fn get<'py>(&self, py: Python<'py>, path: &str) -> PyResult<Bound<'py, PyAny>> {
        let (scene, path) = (self.shared(), path.to_owned());
        let node = detached(py, move || Ok(scene.state().document.get(&path)?.clone()))?;
        values::object(py, &node.value)
    }

    /// Removes a value.
    fn remove(&self, py: Python<'_>, path: &str) -> PyResult<()> {
        let (scene, path) = (self.shared(), path.to_owned());
        detached(py, move || {
            scene.state().amend(|document| document.remove(&path))
        })
    }

    /// Names of the parts, in order of part number, and notes for the user on the meshes that were read.
    fn parts(&self, py: Python<'_>) -> PyResult<(Vec<String>, Vec<String>)> {
        let scene = self.shared();
        detached(py, move || {
            let mut state = scene.state();
            if !has_parts(&state.document) {
                return Ok(Default::default());
            }
            let SceneState {
                document, assets, ..
            } = &mut *state;
            let timeline = document.timeline(assets)?;
            let parts = timeline.scene()?.parts;
            let names = parts.into_iter().map(|part| part.name).collect();
            let notes = timeline.notes().iter().map(Diagnostic::to_string);
            Ok((names, notes.collect()))
        })
    }

    /// Names of the cuts.
    fn cuts(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let scene = self.shared();
        detached(py, move || {
            let state = scene.state();
            let cuts = state
                .document
                .root()
                .get("cut")
                .map_or(&[] as &[_], Node::items);
            let name = |node: &Node| node.name().unwrap_or_default().to_owned();
            Ok(cuts.iter().map(name).collect())
        })
    }

    /// The text of the scene as a file at this path, and the bytes of its accompanying files.
    #[allow(clippy::type_complexity, reason = "a text and files by their names")]
    fn saved(&self, py: Python<'_>, path: PathBuf) -> PyResult<(String, Vec<(String, Vec<u8>)>)> {
        let scene = self.shared();
        detached(py, move || {
            let (text, beside) = scene.state().saved(&path)?;
            let beside = beside
                .into_iter()
                .map(|(name, bytes)| (name, bytes.to_vec()));
            Ok((text, beside.collect()))
        })
    }

    /// The text of the scene.
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        let scene = self.shared();
        detached(py, move || Ok(scene.state().document.to_string()))
    }

    /// Draws the scene: see `crate::render`.
    fn render<'py>(
        &self,
        py: Python<'py>,
        set: &Bound<'_, PyDict>,
        camera: &Bound<'_, PyDict>,
    ) -> PyResult<Bound<'py, PyDict>> {
        crate::render::render(self, py, CallSettings::of(set, camera)?)
    }

    /// Slices the scene: see `crate::section`.
    fn section<'py>(
        &self,
        py: Python<'py>,
        spec: &str,
        set: &Bound<'_, PyDict>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let none = PyDict::new(py);
        crate::section::section(self, py, spec, CallSettings::of(set, &none)?)
    }

    /// Divides the scene: see `crate::capped`.
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
        crate::capped::capped(self, py, relief_cells, CallSettings::of(set, &none)?)
    }

    /// Compares strategies: see `crate::compare`.
    fn compare(
        &self,
        py: Python<'_>,
        strategies: Vec<String>,
        rounds: usize,
        set: &Bound<'_, PyDict>,
        camera: &Bound<'_, PyDict>,
        command: String,
    ) -> PyResult<String> {
        let asked = CallSettings::of(set, camera)?;
        crate::compare::compare(self, py, strategies, rounds, asked, command)
    }
}
