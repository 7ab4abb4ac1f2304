"""Capped halves: closed, of volumes that are known, and an error that says where they are not."""

import numpy as np
import pytest
from conftest import box

import cutaway

trimesh = pytest.importorskip("trimesh")


def test_halves_are_watertight_and_add_up():
    tube = trimesh.creation.annulus(r_min=1, r_max=2, height=3)
    scene = cutaway.Scene()
    scene.add("tube", tube.vertices, tube.faces)
    scene.cut("x=0.3")
    half = scene.capped()
    for one in (half, half.removed):
        mesh = trimesh.Trimesh(*one.arrays)
        assert mesh.is_watertight and mesh.is_winding_consistent
        assert mesh.volume == pytest.approx(one.volume, rel=1e-12)
        caps = one.caps >= 0
        assert caps.any() and (one.caps[caps] == 0).all()
        assert np.allclose(one.vertices[one.faces[caps]][..., 0], 0.3)
        assert trimesh.Trimesh(one.vertices, one.faces[caps]).area == pytest.approx(one.cap_area)
    assert half.volume + half.removed.volume == pytest.approx(tube.volume, rel=1e-12)
    assert half.removed.removed is half
    assert half.cap_area == pytest.approx(scene.section("x=0.3").area)


def test_parts_are_solids_of_their_own():
    scene = cutaway.Scene()
    scene.add("a", *box())
    scene.add("b", *box(at=(0, 2, 0)))
    scene.cut("x=50%", name="half")
    scene.cut("y=150%", "z=90%")
    half = scene.capped()
    assert list(half.parts) == ["a", "b"] and half.name == "a+b"
    assert half.faces.max() == len(half.vertices) - 1
    assert half.volume == pytest.approx(sum(p.volume for p in half.parts.values()))
    assert trimesh.Trimesh(*half.arrays).is_watertight
    assert repr(half.parts["a"]).startswith("Solid('a'")


def test_caps_have_the_numbers_that_layers_have():
    scene = cutaway.Scene()
    scene.add("cube", *box())
    scene.cut("x=50%", "y=50%", name="corner")
    scene.cut("z=25%", name="base")
    half = scene.capped()
    assert set(half.caps.tolist()) == {-1, 0, 1, 2}
    for number, (axis, at) in enumerate([(0, 0.5), (1, 0.5), (2, 0.25)]):
        corners = half.vertices[half.faces[half.caps == number]]
        assert np.allclose(corners[..., axis], at)
    _, layers = scene.render(size=(64, 48), position=[-3, -3, -3])
    assert set(layers.surface[layers.kind == layers.CAP].tolist()) == {0, 1, 2}
    assert layers.surfaces == ["corner", "corner", "base"]


def test_reliefs_cut_closed_meshes():
    scene = cutaway.Scene()
    scene.add("cube", *box())
    scene.cut("x=50%", relief="fractal:amplitude=10%")
    half = scene.capped(relief_cells=32)
    assert trimesh.Trimesh(*half.arrays).is_watertight
    assert half.volume + half.removed.volume == pytest.approx(1.0, rel=1e-9)
    assert half.relief_off > 0
    assert half.cap_area > 1.0


def test_what_is_open_is_named_with_a_place(cube):
    vertices, faces = cube
    scene = cutaway.Scene()
    scene.add("lidless", vertices, faces[2:])
    scene.cut("z=50%")
    with pytest.raises(ValueError, match=r"part `lidless`: (.|\n)*open(.|\n)*help:") as error:
        scene.capped()
    # The missing face is that at x = 0: the place is on its edge.
    assert "(0, " in str(error.value), error.value
    with pytest.warns(cutaway.CutawayWarning, match="lidless"):
        half = scene.capped(watertight=False)
    assert not trimesh.Trimesh(*half.arrays).is_watertight


def test_a_relief_in_an_open_mesh_is_refused(cube):
    vertices, faces = cube
    scene = cutaway.Scene()
    scene.add("lidless", vertices, faces[2:])
    scene.cut("z=50%", relief="waves")
    with pytest.raises(ValueError, match="part `lidless`(.|\n)*help:"):
        scene.capped()


def test_without_a_cut_there_is_nothing_to_cap(cube):
    scene = cutaway.Scene()
    scene.add("cube", *cube)
    with pytest.raises(ValueError, match="nothing to cut by(.|\n)*help:"):
        scene.capped()


def test_a_half_may_be_empty(cube):
    scene = cutaway.Scene()
    scene.add("cube", *cube)
    scene.cut("x=-7")
    half = scene.capped()
    assert half.volume == pytest.approx(1.0) and half.removed.volume == 0
    assert half.removed.vertices.shape == (0, 3) and half.removed.faces.shape == (0, 3)
    assert half.removed.parts == {}


@pytest.mark.parametrize("cells", [0, -1, 10**9, 10**30, "many", None, float("nan")])
def test_cells_that_make_no_sense_are_refused(scene, cells):
    with pytest.raises(ValueError, match="relief_cells(.|\n)*help:"):
        scene.capped(relief_cells=cells)
