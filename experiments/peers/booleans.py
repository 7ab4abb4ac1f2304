"""Relief cuts by the peers: a height field as a solid, subtracted from the mesh.

The cap is what of the result came from the field. Manifold says so of every triangle; of the others' results, those triangles are
taken that lie in the triangles of the field.
"""

import multiprocessing
import queue

import numpy as np
import trimesh
import vtk
from vtk.util.misc import calldata_type
from vtk.util.numpy_support import vtk_to_numpy

import sections
from record import Failed, Refused

# VTK's Boolean may need for ever; it is stopped then.
LIMIT_S = 60.0


def projected(vertices, faces, field):
    """Area and perimeter of a cap as seen along N."""
    local = field.relief.local(vertices)[:, :2]
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    unique, times = np.unique(edges, axis=0, return_counts=True)
    a, b = (local[unique[times == 1, k]] for k in (0, 1))
    perimeter = float(np.linalg.norm(a - b, axis=1).sum())
    return sections.projected_area(vertices, faces, field.relief.frame[2]), perimeter


def faces_on(field, vertices, faces, within):
    """Triangles that lie in the surface of a field: corners and middle do."""
    local = field.relief.local(vertices)
    off = np.abs(local[:, 2] - field.height_at(local)) <= within
    faces = faces[off[faces].all(axis=1)]
    middles = local[faces].mean(axis=1)
    return faces[np.abs(middles[:, 2] - field.height_at(middles)) <= within]


# manifold3d


def manifold_cut(solid, removed):
    kept = solid - removed
    kept.num_tri()
    return kept


def manifold_cap(kept, solid, field):
    vertices, faces = sections.faces_from_others(kept, solid.original_id())
    return projected(vertices, faces, field)


# trimesh


def trimesh_cut(mesh, removed):
    try:
        return trimesh.boolean.difference([mesh, removed], engine="manifold")
    except ValueError as refusal:
        raise Refused(f"ValueError: {refusal}") from refusal


def found_cap(vertices, faces, field, diagonal):
    vertices = np.asarray(vertices, float)
    return projected(vertices, faces_on(field, vertices, np.asarray(faces), 1e-6 * diagonal), field)


# VTK


def vtk_difference(mesh, removed, answers):
    """In a process of its own: VTK's filter may crash."""
    errors = []
    boolean = vtk.vtkBooleanOperationPolyDataFilter()
    boolean.SetOperationToDifference()
    boolean.SetInputData(0, sections.as_vtk(mesh))
    boolean.SetInputData(1, sections.as_vtk(removed))

    @calldata_type(vtk.VTK_STRING)
    def heard(_filter, _event, words):
        errors.append(words.strip().splitlines()[-1].split("): ")[-1])

    boolean.AddObserver(vtk.vtkCommand.ErrorEvent, heard)
    boolean.Update()
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(boolean.GetOutputPort())
    triangles.Update()
    out = triangles.GetOutput()
    if errors or out.GetNumberOfPolys() == 0:
        answers.put(errors[0] if errors else "the result is empty")
        return
    points = vtk_to_numpy(out.GetPoints().GetData()).astype(float)
    answers.put((points, vtk_to_numpy(out.GetPolys().GetConnectivityArray()).reshape(-1, 3).copy()))


def vtk_cut(mesh, removed):
    """Positions and triangles of the difference."""
    context = multiprocessing.get_context("fork")
    answers = context.Queue()
    child = context.Process(target=vtk_difference, args=(mesh, removed, answers))
    child.start()
    answer = None
    for _ in range(round(LIMIT_S * 20)):
        try:
            answer = answers.get(timeout=0.05)
            break
        except queue.Empty:
            if not child.is_alive():
                break
    ended = child.exitcode
    child.kill()
    child.join()
    if answer is None:
        raise Failed(f"no answer within {LIMIT_S:.0f} s" if ended is None else f"the process ended with {ended}")
    if isinstance(answer, str):
        raise Failed(answer)
    return answer


def as_trimesh(mesh):
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
