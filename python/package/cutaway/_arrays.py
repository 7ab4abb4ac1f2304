"""Meshes of other packages as two arrays: a mesh is recognised by its attributes, so no such package is imported."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

MOST = 2**31 - 1
"""Maximum number of vertices, and of faces: the limit of indices in a PLY file."""


def refuse(what: str, fault: str, help: str) -> ValueError:
    """An error in the format of the library's messages."""
    return ValueError(f"{what}: {fault}\n  help: {help}")


def columns_of_three(what: str, array: Any) -> npt.NDArray[Any]:
    """Returns the argument as an array of numbers of shape (n, 3) without a copy; raises an error that describes it otherwise."""
    try:
        array = np.asarray(array)
    except Exception as error:
        raise refuse(what, f"it cannot be converted to an array: {error}", "give an array of shape (n, 3)") from None
    if array.ndim != 2 or array.shape[1] != 3:
        help = "give an array of shape (n, 3), one row for each"
        if what == "faces" and array.ndim == 2 and array.shape[1] == 4:
            help = "divide quadrilaterals into triangles first: give an array of shape (n, 3)"
        raise refuse(what, f"its shape is {array.shape}", help)
    if array.shape[0] > MOST:
        raise refuse(what, f"it has {array.shape[0]} rows, more than {MOST}", "divide the mesh, or decimate it")
    if array.dtype.kind == "O":
        try:
            array = array.astype(np.float64)
        except Exception as error:
            raise refuse(what, f"it contains objects that are no numbers: {error}", "give an array of numbers") from None
    if array.dtype.kind not in "fiu":
        raise refuse(what, f"its type is {array.dtype}", "give an array of numbers")
    return array


def vertices_of(array: Any) -> npt.NDArray[np.float64]:
    """Checks that vertex coordinates are finite, and returns them as float64."""
    array = columns_of_three("vertices", array)
    if array.shape[0] == 0:
        raise refuse("vertices", "there are none", "give a closed mesh")
    with np.errstate(over="ignore"):
        array = np.ascontiguousarray(array, dtype=np.float64)
    finite = np.isfinite(array).all(axis=1)
    if not finite.all():
        at = int(np.argmin(finite))
        raise refuse("vertices", f"vertex {at} is at {tuple(array[at].tolist())}", "remove vertices with coordinates that are not finite")
    return array


def faces_of(array: Any, vertices: int) -> npt.NDArray[np.uint32]:
    """Checks that all vertex indices exist, and returns the faces as uint32."""
    array = columns_of_three("faces", array)
    if array.shape[0] == 0:
        raise refuse("faces", "there are none", "give a closed mesh")
    if array.dtype.kind == "f":
        with np.errstate(invalid="ignore"):
            whole = np.isfinite(array).all() and (array == np.floor(array)).all()
        if not whole:
            raise refuse("faces", "some are no whole numbers", "give vertex indices, counted from 0")
    low, high = array.min(), array.max()
    if low < 0 or high >= vertices:
        bad = (array < 0) | (array >= vertices)
        at = int(np.argmax(bad.any(axis=1)))
        index = array[at][bad[at]][0]
        raise refuse(
            "faces",
            f"face {at} has vertex {index}, and there are {vertices} vertices",
            f"vertex indices must be from 0 to {vertices - 1}",
        )
    return np.ascontiguousarray(array, dtype=np.uint32)


def arrays_of(mesh: Any) -> tuple[Any, Any] | None:
    """Vertices and faces of a mesh of trimesh, PyVista, Open3D or similar; ``None`` for any other object."""
    if _has(mesh, "points") and _has(mesh, "faces") and not _has(mesh, "vertices"):
        return mesh.points, _triangles_of_vtk(mesh)
    if _has(mesh, "vertices") and _has(mesh, "faces"):
        return mesh.vertices, mesh.faces
    if _has(mesh, "vertices") and _has(mesh, "triangles"):
        return mesh.vertices, mesh.triangles
    return None


def _has(mesh: Any, name: str) -> bool:
    try:
        return getattr(mesh, name, None) is not None
    except Exception:
        return False


def _triangles_of_vtk(mesh: Any) -> npt.NDArray[Any]:
    """Triangles of a ``PolyData``, which stores its faces as one flat list: for each face its vertex count, then its vertex indices."""
    flat = np.asarray(mesh.faces)
    if flat.ndim == 2:
        return flat
    if flat.size % 4 or (flat.reshape(-1, 4)[:, 0] != 3).any():
        flat = np.asarray(mesh.triangulate().faces)
    if flat.size % 4 or (flat.reshape(-1, 4)[:, 0] != 3).any():
        raise refuse("faces", "they cannot be triangulated", "give vertices and triangles as arrays")
    return flat.reshape(-1, 4)[:, 1:]
