"""Areas of plane sections by the peers, and what they report to have made of a cut mesh.

Each function takes a mesh, the origin and the unit normal of a plane; the side that the normal points to is kept. Where there are
loops to fill, they are filled by the even-odd rule. A peer's own words of refusal are passed on.
"""

import manifold3d
import numpy as np
import pyvista
import shapely
import trimesh
import vtk
from vtk.util.misc import calldata_type
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from record import Failed, Refused


def frame(normal):
    """Two directions that make a right-handed frame with a normal."""
    u = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    u /= np.linalg.norm(u)
    return u, np.cross(normal, u)


def even_odd(loops):
    """Area of what an odd number of loops encloses."""
    polygons = [shapely.make_valid(shapely.Polygon(p)) for p in loops if len(p) > 2]
    if not polygons:
        return 0.0
    # A sum of signed areas would trust orientations.
    region = polygons[0]
    for polygon in polygons[1:]:
        region = region.symmetric_difference(polygon)
    return region.area


def projected_area(vertices, faces, normal):
    """Area of triangles that all face one way, as it is seen along a normal."""
    u, v = frame(normal)
    flat = vertices @ np.stack([u, v], axis=1)
    a, b, c = (flat[faces[:, i]] for i in range(3))
    (p, q), (r, s) = (b - a).T, (c - a).T
    return abs(float((p * s - q * r).sum())) / 2


def cap_faces(vertices, faces, origin, normal):
    """The triangles that lie in a plane."""
    height = np.abs((vertices - origin) @ normal)
    within = 1e-9 * np.abs(vertices).max()
    return faces[(height[faces] <= within).all(axis=1)]


# trimesh


def trimesh_section(mesh, origin, normal):
    """Loops of the section in the plane, as trimesh makes a path of them."""
    segments = trimesh.intersections.mesh_plane(mesh, normal, origin)
    if len(segments) == 0:
        return []
    flat = (segments - origin) @ np.stack(frame(normal), axis=1)
    # Its tolerance for joining ends is absolute.
    scale = np.abs(flat).max()
    path = trimesh.load_path(flat / scale)
    return [np.asarray(p) * scale for p in path.discrete if np.allclose(p[0], p[-1], atol=1e-9)]


def trimesh_cap(mesh, origin, normal):
    """The kept part with a cap."""
    return mesh.slice_plane(origin, normal, cap=True, engine="earcut")


def trimesh_cap_area(sliced, origin, normal):
    return projected_area(sliced.vertices, cap_faces(sliced.vertices, sliced.faces, origin, normal), normal)


# VTK


def as_vtk(mesh):
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(mesh.vertices), deep=True))
    starts = np.arange(0, 3 * len(mesh.faces) + 1, 3, dtype=np.int64)
    corners = np.ascontiguousarray(mesh.faces, dtype=np.int64).ravel()
    cells = vtk.vtkCellArray()
    cells.SetData(*(numpy_to_vtkIdTypeArray(a, deep=True) for a in (starts, corners)))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def plane_of(origin, normal):
    plane = vtk.vtkPlane()
    plane.SetOrigin(*origin)
    plane.SetNormal(*normal)
    return plane


def vtk_loops(data, origin, normal):
    """Loops of the section in the plane: cut, and stripped into lines."""
    cutter = vtk.vtkCutter()
    cutter.SetCutFunction(plane_of(origin, normal))
    cutter.SetInputData(data)
    stripper = vtk.vtkStripper()
    stripper.SetInputConnection(cutter.GetOutputPort())
    stripper.JoinContiguousSegmentsOn()
    stripper.SetMaximumLength(10_000_000)
    stripper.Update()
    out = stripper.GetOutput()
    if out.GetNumberOfPoints() == 0:
        return []
    flat = (vtk_to_numpy(out.GetPoints().GetData()).astype(float) - origin) @ np.stack(frame(normal), axis=1)
    lines = out.GetLines()
    starts, ids = (vtk_to_numpy(a) for a in (lines.GetOffsetsArray(), lines.GetConnectivityArray()))
    strips = [ids[a:b] for a, b in zip(starts[:-1], starts[1:])]
    return [flat[strip] for strip in strips if strip[0] == strip[-1]]


def vtk_cap(data, origin, normal):
    """The kept part with a cap whose cells are labelled 1."""
    planes = vtk.vtkPlaneCollection()
    planes.AddItem(plane_of(origin, normal))
    clip = vtk.vtkClipClosedSurface()
    clip.SetClippingPlanes(planes)
    clip.SetScalarModeToLabels()
    clip.SetInputData(data)
    # It stays silent by itself where a cap could not be filled.
    clip.TriangulationErrorDisplayOn()
    errors = []

    @calldata_type(vtk.VTK_STRING)
    def heard(_filter, _event, words):
        # Without the address of the filter, which is another one in every run.
        errors.append(words.strip().splitlines()[-1].split("): ")[-1])

    clip.AddObserver(vtk.vtkCommand.ErrorEvent, heard)
    clip.Update()
    if errors:
        raise Failed(errors[0])
    return pyvista.wrap(clip.GetOutput())


def vtk_cap_area(clipped, normal):
    labels = clipped.cell_data["Labels"]
    caps = clipped.extract_cells(np.flatnonzero(labels == 1)).extract_surface(algorithm="geometry").triangulate()
    return projected_area(caps.points.astype(float), caps.regular_faces, normal)


def pyvista_cap(data, origin, normal):
    """The same filter with the checks that PyVista puts before it."""
    try:
        return data.clip_closed_surface(normal=normal, origin=origin)
    except ValueError as refusal:
        raise Refused(f"ValueError: {refusal}") from refusal


def pyvista_cap_area(clipped, origin, normal):
    # It does not pass on the error of the filter: what says so is that its result, which is to be closed, is open.
    if clipped.n_open_edges:
        raise Failed(f"n_open_edges of the result is {clipped.n_open_edges}")
    flat = clipped.triangulate()
    points = flat.points.astype(float)
    return projected_area(points, cap_faces(points, flat.regular_faces, origin, normal), normal)


# manifold3d


def as_manifold(mesh):
    """A Manifold; what it says where the mesh makes none."""
    arrays = manifold3d.Mesh64(
        vert_properties=np.ascontiguousarray(mesh.vertices, np.float64),
        tri_verts=np.ascontiguousarray(mesh.faces, np.uint64),
    )
    solid = manifold3d.Manifold(arrays)
    if solid.status() != manifold3d.Error.NoError:
        raise Refused(f"status() is {solid.status()}")
    return solid.as_original()


def manifold_trim(solid, origin, normal):
    """The kept part; counting its triangles makes the lazy evaluation happen."""
    kept = solid.trim_by_plane(list(normal), float(origin @ normal))
    kept.num_tri()
    return kept


def faces_from_others(result, own):
    """Positions, and the triangles that do not come from an original."""
    mesh = result.to_mesh64()
    starts = np.asarray(mesh.run_index, int) // 3
    ids = np.asarray(mesh.run_original_id)
    of_others = [np.arange(a, b) for a, b, i in zip(starts[:-1], starts[1:], ids) if i != own]
    faces = np.asarray(mesh.tri_verts, int)
    picked = np.concatenate(of_others) if of_others else np.empty(0, int)
    return np.asarray(mesh.vert_properties)[:, :3], faces[picked]


def manifold_cap_area(kept, solid, normal):
    vertices, faces = faces_from_others(kept, solid.original_id())
    return projected_area(vertices, faces, normal)


def manifold_slice(solid, origin, normal):
    """The section as polygons. It slices across z alone: the solid is turned first, which is part of the task."""
    u, v = frame(normal)
    turn = np.column_stack([np.stack([u, v, normal]), np.zeros(3)])
    return solid.transform(turn).slice(float(origin @ normal))
