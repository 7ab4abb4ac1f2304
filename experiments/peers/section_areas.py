#!/usr/bin/env python3
"""Section areas of this crate against those of two others: trimesh with shapely, and VTK.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install trimesh shapely networkx vtk
    cargo test --test slice areas_of_closed -- --nocapture | grep '^section ' > sections.txt
    /tmp/peers/bin/python experiments/peers/section_areas.py DATA < sections.txt

Each line of input is `section FILE px py pz nx ny nz area perimeter`; FILE is relative to DATA, in which each file is one part.
trimesh slices by its own tolerance and shapely polygonises what it gives; VTK cuts, strips lines into loops, and the shoelace
formula takes their areas. Both read the file by themselves and weld equal corners. Areas are even-odd: loops by symmetric
difference. Prints one row per section and the worst relative differences; ends with 1 if one is beyond 1e-6.
"""

import sys
from pathlib import Path

import numpy as np
import shapely
import trimesh
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

LIMIT = 1e-6


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


def area_by_trimesh(mesh, origin, normal):
    segments = trimesh.intersections.mesh_plane(mesh, normal, origin)
    if len(segments) == 0:
        return 0.0
    u, v = frame(normal)
    flat = (segments - origin) @ np.stack([u, v], axis=1)
    scale = np.abs(flat).max()
    path = trimesh.load_path(flat / scale)
    loops = [np.asarray(p) for p in path.discrete if np.allclose(p[0], p[-1], atol=1e-9)]
    return even_odd(loops) * scale**2


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


def area_by_vtk(data, origin, normal):
    plane = vtk.vtkPlane()
    plane.SetOrigin(*origin)
    plane.SetNormal(*normal)
    cutter = vtk.vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.SetInputData(data)
    stripper = vtk.vtkStripper()
    stripper.SetInputConnection(cutter.GetOutputPort())
    stripper.JoinContiguousSegmentsOn()
    stripper.SetMaximumLength(10_000_000)
    stripper.Update()
    out = stripper.GetOutput()
    if out.GetNumberOfPoints() == 0:
        return 0.0
    u, v = frame(normal)
    flat = (vtk_to_numpy(out.GetPoints().GetData()).astype(float) - origin) @ np.stack([u, v], axis=1)
    lines = out.GetLines()
    starts, ids = (vtk_to_numpy(a) for a in (lines.GetOffsetsArray(), lines.GetConnectivityArray()))
    strips = [ids[a:b] for a, b in zip(starts[:-1], starts[1:])]
    return even_odd([flat[strip] for strip in strips if strip[0] == strip[-1]])


def main():
    folder = Path(sys.argv[1])
    print(f"trimesh {trimesh.__version__}, shapely {shapely.__version__}, VTK {vtk.vtkVersion.GetVTKVersion()}")
    print("| file | area by us | trimesh | VTK | relative differences |\n| --- | --- | --- | --- | --- |")
    meshes, worst = {}, {}
    for line in sys.stdin:
        _, name, *numbers = line.split()
        origin, normal = np.array(numbers[:3], float), np.array(numbers[3:6], float)
        ours = float(numbers[6])
        if name not in meshes:
            mesh = trimesh.load_mesh(folder / name, process=False, force="mesh")
            mesh.merge_vertices(merge_tex=True, merge_norm=True, digits_vertex=15)
            meshes = {name: (mesh, as_vtk(mesh))}
        mesh, data = meshes[name]
        theirs = [area_by_trimesh(mesh, origin, normal), area_by_vtk(data, origin, normal)]
        off = [abs(ours - area) / max(ours, area, 1e-300) for area in theirs]
        worst[name] = [max(pair) for pair in zip(worst.get(name, [0, 0]), off)]
        print(f"| {name} | {ours:.12g} | {theirs[0]:.12g} | {theirs[1]:.12g} | {off[0]:.1e} {off[1]:.1e} |")
    print("\nworst relative differences (trimesh, VTK)")
    for name, pair in worst.items():
        print(f"{name}: {pair[0]:.1e} {pair[1]:.1e}")
    sys.exit(any(max(pair) > LIMIT for pair in worst.values()))


if __name__ == "__main__":
    main()
