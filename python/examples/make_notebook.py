"""Writes ``capping.ipynb``, the example, from the cells below: text in ``#`` comments, then code. Outputs are left to whoever runs it.

``python make_notebook.py`` writes it, ``python make_notebook.py --check`` says whether it is what these cells make.
"""

import json
import sys
from pathlib import Path

NOTEBOOK = Path(__file__).with_name("capping.ipynb")

CELLS = '''
# # Capping a cut mesh: trimesh, PyVista and cutaway
#
# A mesh is a hollow shell. Whoever cuts it wants the other half back as a solid: closed, with a cap, and with the volume that it should
# have. Here the same meshes are cut by three packages, and the same is asked of each result.

import time

import numpy as np
import pyvista
import trimesh

import cutaway

# ## Meshes
#
# A tube, two balls one within the other, and two boxes that overlap: a union would be one solid, but a file of parts often is this.

tube = trimesh.creation.annulus(r_min=1, r_max=2, height=3, sections=64)
shell = trimesh.util.concatenate([trimesh.creation.icosphere(subdivisions=4, radius=2), trimesh.creation.icosphere(subdivisions=4, radius=1.5)])
outer, inner = np.split(shell.faces, 2)
shell.faces = np.vstack([outer, inner[:, ::-1]])
boxes = trimesh.util.concatenate([trimesh.creation.box((2, 2, 2)), trimesh.creation.box((2, 2, 2), trimesh.transformations.translation_matrix((1, 1, 1)))])
meshes = {"tube": tube, "shell": shell, "boxes": boxes}

# ## Three ways to cut
#
# Each keeps the side to which the normal points, of a plane through x = 0.1 that is a little askew.

origin, normal = np.array([0.1, 0, 0]), np.array([1, 0.2, 0.3]) / np.linalg.norm([1, 0.2, 0.3])


def by_trimesh(mesh):
    return mesh.slice_plane(origin, normal, cap=True)


def by_pyvista(mesh):
    half = pyvista.wrap(mesh).clip_closed_surface(normal=normal, origin=origin).triangulate()
    return trimesh.Trimesh(half.points, half.faces.reshape(-1, 4)[:, 1:])


def by_cutaway(mesh):
    scene = cutaway.Scene(mesh)
    n, o = normal.tolist(), origin.tolist()
    scene.cut(f"{n[0]},{n[1]},{n[2]}@{o[0]},{o[1]},{o[2]}")
    return trimesh.Trimesh(*scene.capped().arrays)


# A mesh is closed where each edge is used in both directions equally often. `is_watertight` of trimesh asks for exactly two faces at each edge,
# which two bodies that overlap need not have: the cap is there twice where both are cut, and some of its edges have four faces.


def is_closed(mesh):
    ends = np.sort(mesh.edges, axis=1)
    _, number = np.unique(ends, axis=0, return_inverse=True)
    return not np.bincount(number.ravel(), np.where(mesh.edges[:, 0] < mesh.edges[:, 1], 1, -1)).any()


# The half of each mesh: whether it is closed, and its volume.

rows = []
halves = {}
for name, mesh in meshes.items():
    for tool in (by_trimesh, by_pyvista, by_cutaway):
        begun = time.perf_counter()
        try:
            half = tool(mesh)
            closed, volume = is_closed(half), half.volume
            halves[name, tool.__name__] = half
        except Exception as error:
            closed, volume = f"{type(error).__name__}", float("nan")
        rows.append((name, tool.__name__[3:], closed, volume, 1e3 * (time.perf_counter() - begun)))

print(f"{'mesh':8}{'by':10}{'closed':12}{'volume':>10}{'ms':>8}")
for name, tool, closed, volume, ms in rows:
    print(f"{name:8}{tool:10}{closed!s:12}{volume:10.4f}{ms:8.1f}")

# ## The halves
#
# Each is drawn uncut, from the side of the cap: a cap that is missing shows the inside of the shell.

pictures = []
for name in meshes:
    row = []
    for tool in ("by_trimesh", "by_pyvista", "by_cutaway"):
        if (name, tool) in halves:
            scene = cutaway.Scene(halves[name, tool])
            row.append(np.asarray(scene.render(size=(240, 200), azimuth_deg=-60, elevation_deg=20)))
        else:
            row.append(np.full((200, 240, 4), 255, np.uint8))
    pictures.append(np.hstack(row))

cutaway.Picture(np.vstack(pictures))

# ## What the others do not do
#
# A picture of the cut without cutting the mesh at all, along a ragged break, with hatched caps; its layers; and the outline of a section.

scene = cutaway.Scene()
scene.add("tube", tube.vertices, tube.faces)
scene.cut("x=50%", relief="fractal:amplitude=4%", name="break")
scene.render(size=(640, 480))

# The arrays behind it.

rgba, layers = scene.render(size=(640, 480))
polygons, area = scene.section("z=50%")
print(layers)
print(f"{len(polygons)} polygon with {len(polygons[0].holes)} hole, {area:.4f} square units; pi (2^2 - 1^2) is {np.pi * 3:.4f}")

# The ragged half is a mesh too, and closed.

ragged = scene.capped()
print(ragged, trimesh.Trimesh(*ragged.arrays).is_watertight)

# How well strategies draw it, against the exact reference.

found = scene.compare(["raycast+mask", "grid:64+vds:256"], size=(320, 240), rounds=3)
for strategy in found["strategies"]:
    print(f"{strategy['name']:16} {strategy['decided_wrong_px']:5} px wrong, {strategy['time_ms']['frame']['median']:7.1f} ms")
'''


def cells():
    """Blocks of comment lines are text, what is between them is code; the last empty line of both is left out."""
    found = []
    for line in CELLS.strip("\n").split("\n"):
        is_text = line == "#" or line.startswith("# ")
        kind = "markdown" if is_text else "code"
        line = line[2:] if is_text else line
        if found and found[-1][0] == kind:
            found[-1][1].append(line)
        else:
            found.append((kind, [line]))
    for kind, lines in found:
        text = "\n".join(lines).strip("\n")
        if text:
            yield kind, text


def notebook():
    made = []
    for number, (kind, text) in enumerate(cells()):
        lines = [line + "\n" for line in text.split("\n")]
        lines[-1] = lines[-1][:-1]
        cell = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": lines}
        if kind == "code":
            cell |= {"execution_count": None, "outputs": []}
        made.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}}
    return json.dumps({"cells": made, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}, indent=1) + "\n"


if __name__ == "__main__":
    if "--check" in sys.argv:
        sys.exit(NOTEBOOK.read_text() != notebook() and f"{NOTEBOOK} is not what make_notebook.py makes: run it")
    NOTEBOOK.write_text(notebook())
