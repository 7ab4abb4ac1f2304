//! Meshes and layers between numpy and the library.

use cutaway::scene::Mesh;
use glam::DVec3;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Makes a mesh from (n, 3) coordinates and (m, 3) vertex indices.
pub(crate) fn mesh(
    vertices: &PyReadonlyArray2<'_, f64>,
    faces: &PyReadonlyArray2<'_, u32>,
) -> PyResult<Mesh> {
    let (vertices, faces) = (vertices.as_array(), faces.as_array());
    if vertices.ncols() != 3 || faces.ncols() != 3 {
        return Err(PyValueError::new_err(
            "vertices and faces: they must have three columns\n  help: give arrays of shape (n, 3) and (m, 3)",
        ));
    }
    let positions = vertices.rows().into_iter();
    let triangles = faces.rows().into_iter();
    Ok(Mesh {
        positions: positions.map(|r| DVec3::new(r[0], r[1], r[2])).collect(),
        triangles: triangles.map(|r| [r[0], r[1], r[2]]).collect(),
        ..Mesh::default()
    })
}

/// Rows of three numbers as an array of shape (n, 3).
pub(crate) fn rows<T: numpy::Element>(
    py: Python<'_>,
    flat: Vec<T>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let count = flat.len() / 3;
    flat.into_pyarray(py).reshape([count, 3])
}

/// Points of a plane as an array of shape (n, 2).
pub(crate) fn points<'py>(py: Python<'py>, uv: &[[f64; 2]]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let flat: Vec<f64> = uv.iter().flatten().copied().collect();
    flat.into_pyarray(py).reshape([uv.len(), 2])
}

/// An array with one value per pixel.
pub(crate) fn pixels<T: numpy::Element>(
    py: Python<'_>,
    [width, height]: [u32; 2],
    flat: Vec<T>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let flat: Bound<'_, PyArray1<T>> = flat.into_pyarray(py);
    flat.reshape([height as usize, width as usize])
}
