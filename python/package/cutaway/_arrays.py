"""Meshes of others as two arrays: what they are is told by what they have, and none of their packages is imported."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

MOST = 2**31 - 1
"""Most vertices, and most faces: what the numbers in a PLY file can say."""


def refuse(what: str, fault: str, help: str) -> ValueError:
    """An error in the words of the library."""
    return ValueError(f"{what}: {fault}\n  help: {help}")


def columns_of_three(what: str, array: Any) -> npt.NDArray[Any]:
    """An array of numbers of shape (n, 3), not copied, or an error that says what it is."""
    try:
        array = np.asarray(array)
    except Exception as error:
        raise refuse(what, f"it is no array: {error}", "give an array of shape (n, 3)") from None
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
            raise refuse(what, f"it has objects that are no numbers: {error}", "give an array of numbers") from None
    if array.dtype.kind not in "fiu":
        raise refuse(what, f"its type is {array.dtype}", "give an array of numbers")
    return array


def vertices_of(array: Any) -> npt.NDArray[np.float64]:
    """Coordinates, finite."""
    array = columns_of_three("vertices", array)
    if array.shape[0] == 0:
        raise refuse("vertices", "there are none", "give a closed mesh")
    with np.errstate(over="ignore"):
        array = np.ascontiguousarray(array, dtype=np.float64)
    finite = np.isfinite(array).all(axis=1)
    if not finite.all():
        at = int(np.argmin(finite))
        raise refuse("vertices", f"vertex {at} is at {tuple(array[at].tolist())}", "leave out what is not finite")
    return array


def faces_of(array: Any, vertices: int) -> npt.NDArray[np.uint32]:
    """Numbers of vertices, each of which there is."""
    array = columns_of_three("faces", array)
    if array.shape[0] == 0:
        raise refuse("faces", "there are none", "give a closed mesh")
    if array.dtype.kind == "f":
        with np.errstate(invalid="ignore"):
            whole = np.isfinite(array).all() and (array == np.floor(array)).all()
        if not whole:
            raise refuse("faces", "some are no whole numbers", "give numbers of vertices, from 0")
    low, high = array.min(), array.max()
    if low < 0 or high >= vertices:
        bad = (array < 0) | (array >= vertices)
        at = int(np.argmax(bad.any(axis=1)))
        index = array[at][bad[at]][0]
        raise refuse(
            "faces",
            f"face {at} has vertex {index}, and there are {vertices}",
            f"numbers of vertices are from 0 to {vertices - 1}",
        )
    return np.ascontiguousarray(array, dtype=np.uint32)


def arrays_of(mesh: Any) -> tuple[Any, Any] | None:
    """Vertices and faces of a mesh of trimesh, PyVista, Open3D or the like; ``None`` of anything else."""
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
    """Triangles of a ``PolyData``, whose faces are one list of counts and numbers."""
    flat = np.asarray(mesh.faces)
    if flat.ndim == 2:
        return flat
    if flat.size % 4 or (flat.reshape(-1, 4)[:, 0] != 3).any():
        flat = np.asarray(mesh.triangulate().faces)
    if flat.size % 4 or (flat.reshape(-1, 4)[:, 0] != 3).any():
        raise refuse("faces", "they cannot be made triangles", "give vertices and triangles as arrays")
    return flat.reshape(-1, 4)[:, 1:]
