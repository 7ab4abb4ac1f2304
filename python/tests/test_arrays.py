"""Arrays of every wrong shape and type are refused with words, and right ones of every type make the same mesh."""

import subprocess
import sys

import numpy as np
import pytest
from conftest import box

import cutaway

V, F = box()


class Broken:
    """What raises when it is looked at."""

    def __array__(self, *args, **kwargs):
        raise RuntimeError("no array today")


def nan_at(value):
    vertices = V.copy()
    vertices[5, 1] = value
    return vertices


def face_with(index, dtype=np.int64):
    faces = F.astype(dtype)
    faces[7, 2] = index
    return faces


WRONG = {
    "vertices 0-d": (np.array(1.0), F, "vertices: its shape is ()"),
    "vertices 1-d": (V.ravel(), F, "its shape is (24,)"),
    "vertices (n, 2)": (V[:, :2], F, "its shape is (8, 2)"),
    "vertices (n, 4)": (np.ones((8, 4)), F, "its shape is (8, 4)"),
    "vertices 3-d": (V[None], F, "its shape is (1, 8, 3)"),
    "vertices empty": (np.zeros((0, 3)), F, "vertices: there are none"),
    "vertices empty list": ([], F, "its shape is (0,)"),
    "vertices ragged": ([[0, 0, 0], [1, 1]], F, "vertices"),
    "vertices nan": (nan_at(np.nan), F, "vertex 5 is at (1.0, nan, 1.0)"),
    "vertices inf": (nan_at(-np.inf), F, "vertex 5"),
    "vertices text": (np.full((8, 3), "a"), F, "its type is"),
    "vertices complex": (V.astype(complex), F, "its type is complex128"),
    "vertices bool": (V.astype(bool), F, "its type is bool"),
    "vertices dates": (V.astype("datetime64[s]"), F, "its type is datetime64"),
    "vertices records": (np.zeros(8, dtype=[("x", float), ("y", float)]), F, "its shape is (8,)"),
    "vertices objects": (np.full((8, 3), None, dtype=object), F, "vertex 0 is at (nan, nan, nan)"),
    "vertices objects of text": (np.full((8, 3), "a", dtype=object), F, "no numbers"),
    "vertices longdouble beyond float64": (np.full((8, 3), np.longdouble("1e400")), F, "vertex 0 is at"),
    "vertices beyond memory": (np.broadcast_to(np.zeros(3), (2**40, 3)), F, "more than 2147483647"),
    "vertices no array": (Broken(), F, "no array today"),
    "vertices a number": (3, F, "its shape is ()"),
    "vertices a dict": ({}, F, "vertices"),
    "faces 0-d": (V, np.array(1), "faces: its shape is ()"),
    "faces 1-d": (V, F.ravel(), "its shape is (36,)"),
    "faces (m, 2)": (V, F[:, :2], "its shape is (12, 2)"),
    "faces (m, 4)": (V, np.zeros((6, 4), int), "divide quadrilaterals"),
    "faces empty": (V, np.zeros((0, 3), int), "faces: there are none"),
    "faces negative": (V, face_with(-1), "face 7 has vertex -1, and there are 8"),
    "faces beyond": (V, face_with(8), "face 7 has vertex 8, and there are 8"),
    "faces far beyond": (V, face_with(2**63 - 1), "face 7 has vertex 9223372036854775807"),
    "faces uint64 beyond": (V, face_with(2**64 - 1, np.uint64), "face 7 has vertex 18446744073709551615"),
    "faces uint32 beyond": (V, face_with(2**32 - 1, np.uint32), "face 7 has vertex 4294967295"),
    "faces not whole": (V, F + 0.5, "no whole numbers"),
    "faces nan": (V, np.full((12, 3), np.nan), "no whole numbers"),
    "faces inf": (V, np.full((12, 3), np.inf), "no whole numbers"),
    "faces bool": (V, F.astype(bool), "its type is bool"),
    "faces text": (V, F.astype(str), "its type is"),
    "faces objects": (V, np.full((12, 3), object(), dtype=object), "no numbers"),
    "faces beyond memory": (V, np.broadcast_to(np.zeros(3, int), (2**40, 3)), "more than 2147483647"),
}


@pytest.mark.parametrize("vertices, faces, words", WRONG.values(), ids=WRONG.keys())
def test_what_is_no_mesh_is_refused(vertices, faces, words):
    scene = cutaway.Scene()
    with pytest.raises(ValueError) as error:
        scene.add("box", vertices, faces)
    assert words in str(error.value)
    assert "help:" in str(error.value)
    assert scene.parts == [], "nothing was added"


def strided(array):
    """The same numbers, with others between them."""
    wide = np.full((2 * array.shape[0], 2 * array.shape[1]), 77, dtype=array.dtype)
    wide[::2, ::2] = array
    return wide[::2, ::2]


RIGHT = {
    "float64, int64": (V, F),
    "float32": (V.astype(np.float32), F),
    "float16": (V.astype(np.float16), F),
    "longdouble": (V.astype(np.longdouble), F),
    "whole vertices": (V.astype(np.int8), F),
    "int32": (V, F.astype(np.int32)),
    "uint32": (V, F.astype(np.uint32)),
    "uint64": (V, F.astype(np.uint64)),
    "uint8": (V, F.astype(np.uint8)),
    "whole floats": (V, F.astype(float)),
    "objects": (V.astype(object), F.astype(object)),
    "Fortran": (np.asfortranarray(V), np.asfortranarray(F)),
    "strided": (strided(V), strided(F)),
    "reversed": (V[::-1], 7 - F[:, ::-1][::-1][:, ::-1]),
    "big-endian": (V.astype(">f8"), F.astype(">i4")),
    "read-only": (np.frombuffer(V.tobytes()).reshape(8, 3), F),
    "lists": (V.tolist(), F.tolist()),
    "tuples": (tuple(map(tuple, V)), tuple(map(tuple, F))),
    "masked": (np.ma.masked_array(V), F),
}


@pytest.mark.parametrize("vertices, faces", RIGHT.values(), ids=RIGHT.keys())
def test_numbers_of_every_type_make_the_same_mesh(vertices, faces):
    scene = cutaway.Scene()
    scene.add("box", vertices, faces)
    scene.cut("x=25%")
    half = scene.capped()
    assert half.volume == pytest.approx(0.75, abs=1e-12)
    assert half.removed.volume == pytest.approx(0.25, abs=1e-12)


def test_arrays_are_copied(cube):
    vertices, faces = cube
    scene = cutaway.Scene()
    scene.add("box", vertices, faces)
    vertices *= 100
    faces[:] = 0
    assert scene.section("z=50%").area == pytest.approx(1.0)


def test_a_soup_of_triangles_is_welded():
    scene = cutaway.Scene()
    scene.add("soup", V[F].reshape(-1, 3), np.arange(36).reshape(-1, 3))
    scene.cut("z=50%")
    half = scene.capped()
    assert len(half.vertices) < 36
    assert any("welded 36 corners to 8 vertices" in note for note in scene.notes), scene.notes


def test_vertices_without_faces_are_refused():
    with pytest.raises(ValueError, match="no faces"):
        cutaway.Scene().add("box", V)
    with pytest.raises(ValueError, match="no vertices"):
        cutaway.Scene().add("box", faces=F)


class Mesh:
    def __init__(self, **arrays):
        self.__dict__.update(arrays)


@pytest.mark.parametrize(
    "mesh",
    [
        Mesh(vertices=V, faces=F),
        Mesh(vertices=V, triangles=F),
        Mesh(points=V, faces=np.hstack([np.full((12, 1), 3), F]).ravel()),
        Mesh(points=V, faces=F),
    ],
    ids=["trimesh", "open3d", "pyvista", "points and triangles"],
)
def test_meshes_of_others_are_told_by_what_they_have(mesh):
    scene = cutaway.Scene(mesh)
    assert scene.parts == ["mesh"]
    scene.add(mesh, name="other", translate=[3, 0, 0])
    scene.add(mesh)
    assert scene.parts == ["mesh", "other", "mesh 2"]
    assert scene.section("x=0.5").area == pytest.approx(2.0)


def test_no_package_of_others_is_imported():
    program = "import sys, cutaway; cutaway.Scene('shape:cube'); print([m for m in ('trimesh', 'pyvista', 'vtk', 'scipy') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout.strip() == "[]", done.stderr


@pytest.mark.parametrize("model", [3, None, object(), [1, 2], Mesh(vertices=V), Mesh(points=V)])
def test_what_is_no_model_is_refused(model):
    with pytest.raises(ValueError, match="help:"):
        cutaway.Scene().add(model)
