//! Kept and removed halves of a scene, as meshes with their caps.

use cutaway::scene::Mesh;
use cutaway::slice::{CappedPart, Half, capped_with};
use cutaway::{Error, Scene as Shown};
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::arrays::rows;
use crate::door::{Result, detached};
use crate::opened::Purpose;
use crate::scene::Scene;
use crate::state::{CallSettings, Shared};

/// A half as arrays.
struct Flat {
    vertices: Vec<f64>,
    faces: Vec<i64>,
    /// Number of the clip-surface of each face; -1 for faces of the mesh.
    caps: Vec<i32>,
    volume: f64,
    cap_area: f64,
    /// Number of open edges, and the midpoint of one.
    open: Option<(usize, [f64; 3])>,
}

/// Both halves of a part.
struct DividedPart {
    name: String,
    kept: Flat,
    removed: Flat,
    relief_off: f64,
    doubts: Vec<String>,
}

impl Flat {
    fn of(half: &Half, number_of: impl Fn(usize, usize) -> i32) -> Self {
        let mesh = &half.mesh;
        let mut caps = vec![-1; mesh.triangles.len()];
        for cap in &half.caps {
            caps[cap.triangles.clone()].fill(number_of(cap.region, cap.plane));
        }
        Self {
            vertices: mesh.positions.iter().flat_map(|p| p.to_array()).collect(),
            faces: mesh
                .triangles
                .iter()
                .flatten()
                .map(|i| i64::from(*i))
                .collect(),
            caps,
            volume: if mesh.triangles.is_empty() {
                0.0
            } else {
                mesh.volume()
            },
            cap_area: half.cap_area(),
            open: open_edges(mesh),
        }
    }

    fn into_python<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let half = PyDict::new(py);
        half.set_item("vertices", rows(py, self.vertices)?)?;
        half.set_item("faces", rows(py, self.faces)?)?;
        half.set_item("caps", self.caps.into_pyarray(py))?;
        half.set_item("volume", self.volume)?;
        half.set_item("cap_area", self.cap_area)?;
        half.set_item("open", self.open)?;
        Ok(half)
    }
}

fn open_edges(mesh: &Mesh) -> Option<(usize, [f64; 3])> {
    let open = mesh.open_edges();
    let [a, b] = open.first()?.map(|i| mesh.positions[i as usize]);
    Some((open.len(), ((a + b) * 0.5).to_array()))
}

/// Divides a scene at a given time.
pub(crate) fn capped<'py>(
    scene: &Scene,
    py: Python<'py>,
    relief_cells: u32,
    asked: CallSettings,
) -> PyResult<Bound<'py, PyList>> {
    let scene = scene.shared();
    let divided = detached(py, move || divided(&scene, relief_cells, asked))?;
    let parts = PyList::empty(py);
    for part in divided {
        let entry = PyDict::new(py);
        entry.set_item("name", part.name)?;
        entry.set_item("kept", part.kept.into_python(py)?)?;
        entry.set_item("removed", part.removed.into_python(py)?)?;
        entry.set_item("relief_off", part.relief_off)?;
        entry.set_item("doubts", part.doubts)?;
        parts.append(entry)?;
    }
    Ok(parts)
}

fn divided(scene: &Shared, relief_cells: u32, asked: CallSettings) -> Result<Vec<DividedPart>> {
    let shown = scene
        .state()
        .open(asked, Purpose::Measurement)?
        .scene
        .clone();
    if !shown.cuts.iter().any(|cut| cut.enabled) {
        let help = "cut it first: scene.cut(\"x=50%\")";
        return Err(Error::input("scene", "there is nothing to cut by", help));
    }
    let parts = capped_with(&shown, relief_cells)?;
    Ok(parts.iter().map(|part| of_part(&shown, part)).collect())
}

fn of_part(shown: &Shown, part: &CappedPart) -> DividedPart {
    // Clip-surfaces are numbered across all cuts; within a cut, the cutter comes last.
    let before = |cut: usize| -> usize {
        let cuts = shown.cuts[..cut].iter();
        cuts.map(|c| c.surfaces.len() + usize::from(c.volume.is_some()))
            .sum()
    };
    let number_of = |region: usize, plane: usize| {
        i32::try_from(before(part.cuts[region]) + plane).unwrap_or(i32::MAX)
    };
    let defects = part.halves.defects.iter().filter(|d| d.loses_cap());
    DividedPart {
        name: shown.parts[part.part].name.clone(),
        kept: Flat::of(&part.halves.kept, number_of),
        removed: Flat::of(&part.halves.removed, number_of),
        relief_off: part.relief_off,
        doubts: defects
            .map(|d| format!("{d}\n  help: {}", d.help()))
            .collect(),
    }
}
