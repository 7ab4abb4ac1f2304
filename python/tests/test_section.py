"""Sections: areas that are known, polygons that shapely takes, and doubts about open meshes."""

import numpy as np
import pytest
from conftest import box

import cutaway

shapely = pytest.importorskip("shapely")
trimesh = pytest.importorskip("trimesh")


def of(vertices, faces, plane):
    scene = cutaway.Scene()
    scene.add("part", vertices, faces)
    return scene.section(plane)


def test_a_section_unpacks_into_polygons_and_area(cube):
    polygons, area = of(*cube, "z=50%")
    assert area == pytest.approx(1.0, abs=1e-12) and isinstance(area, float)
    ((outer, holes),) = polygons
    assert holes == [] and outer.shape == (len(outer), 2) and outer.dtype == np.float64
    assert shapely.Polygon(*polygons[0]).exterior.is_ccw


@pytest.mark.parametrize(
    "plane, corner, normal",
    [("x=25%", (0.5, 0, 0), (1, 0, 0)), ("y=50%", (0, 1.5, 0), (0, 1, 0)), ("z=2.5", (0, 0, 2.5), (0, 0, 1)), ("-z=2.5", (0, 0, 2.5), (0, 0, -1))],
)
def test_points_are_coordinates_of_the_model(plane, corner, normal):
    size = np.array([2.0, 3.0, 5.0])
    found = of(*box(size), plane)
    assert np.allclose(found.origin, corner) and np.allclose(found.normal, normal)
    assert np.allclose(np.cross(found.u, found.v), normal)
    across = size[np.array(normal) == 0]
    assert found.area == pytest.approx(np.prod(across)) and found.perimeter == pytest.approx(2 * across.sum())
    world = found.to_world(found.polygons[0].outer)
    assert np.allclose(world.min(axis=0), np.where(np.array(normal) == 0, 0, corner))
    assert np.allclose(world.max(axis=0), np.where(np.array(normal) == 0, size, corner))
    if plane.startswith("z"):
        assert np.allclose(found.polygons[0].outer, world[:, :2]), "they are x and y"


def test_holes_are_holes():
    tube = trimesh.creation.annulus(r_min=1, r_max=2, height=3)
    found = of(tube.vertices, tube.faces, "z=50%")
    ((outer, holes),) = found.polygons
    assert len(holes) == 1
    polygon = shapely.Polygon(outer, holes)
    assert polygon.is_valid and polygon.area == pytest.approx(found.area)
    # Across it are two rectangles.
    along = of(tube.vertices, tube.faces, "x=50%")
    assert [len(p.holes) for p in along.polygons] == [0, 0]
    assert along.area == pytest.approx(2 * 3 * 1, rel=1e-3)


@pytest.mark.parametrize("model", ["shape:gears", "shape:crank", "shape:sponge", "shape:knot", "shape:torus", "shape:earth"])
@pytest.mark.parametrize("plane", ["x=37%", "z=50%", "1,2,3@50%,50%,50%"])
def test_polygons_are_valid_and_their_areas_add_up(model, plane):
    scene = cutaway.Scene(model)
    if "@" in plane:
        plane = "1,2,3,0.05"
    found = scene.section(plane)
    polygons = [shapely.Polygon(*p) for p in found.polygons]
    assert polygons, "the plane meets it"
    for polygon in polygons:
        assert polygon.is_valid, shapely.is_valid_reason(polygon)
    assert sum(p.area for p in polygons) == pytest.approx(found.area, rel=1e-9)
    assert sum(p.length for p in polygons) == pytest.approx(found.perimeter, rel=1e-9)
    assert set(found.parts) <= set(scene.parts) and len(found.parts) == len(polygons)


def test_cuts_of_the_scene_do_not_matter(scene):
    assert scene.section("z=50%").area == pytest.approx(1.0)


def test_a_plane_that_misses_cuts_nothing(cube):
    found = of(*cube, "z=7")
    assert found.polygons == [] and found.area == 0.0 and found.parts == []
    assert repr(found) == "Section(0 polygons, area=0)"


def test_open_meshes_are_doubted(cube):
    vertices, faces = cube
    with pytest.warns(cutaway.CutawayWarning, match="part: the mesh is open(.|\n)*help:"):
        found = of(vertices, faces[2:], "z=50%")
    assert found.doubts and found.area == 0.0


@pytest.mark.parametrize("plane", ["", "z", "q=3", "0,0,0@1,1,1", "nan,0,0,1", "z=inf", 3, None, b"z=1"])
def test_what_is_no_plane_is_refused(scene, plane):
    with pytest.raises(ValueError, match="help:"):
        scene.section(plane)
