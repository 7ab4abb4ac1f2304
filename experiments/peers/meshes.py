"""The meshes all tools cut: made here, or read from a folder of files.

Peers get arrays, ours gets the file: bit-equal positions are welded here as it welds them, and nothing else is repaired. Faces
that are no triangle once welded are left out, since peers take them for a defect.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import trimesh

# Relative to the folder of data, where one is given. Units differ by five orders of magnitude; depth by twenty.
CLOSED = [
    "cad/adis16480.stl",
    "cad/couplingdown.obj",
    "cad/spool_base.stl",
    "organic/spot.obj",
    "organic/armadillo.obj",
    "assembly/car_tires.stl",
    "dense/cheese.obj",
    "dense/menger_sponge_3.glb",
    "large/scallop.glb",
]
# Not closed, or not simple: there is no one area, so none is compared. Who refuses them, and who does not, is the question.
DEFECTIVE = [
    "organic/stanford_bunny.obj",
    "messy/b9_shell.obj",
    "messy/self_intersect_a.obj",
    "messy/triangle_soup.stl",
    "assembly/cycloidal_drive.ply",
]
QUICK = ["cad/adis16480.stl", "organic/spot.obj", "dense/cheese.obj", "organic/stanford_bunny.obj", "messy/triangle_soup.stl"]


@dataclass
class Mesh:
    """Positions of shape (n, 3), f64; triangles of shape (m, 3); the file that holds the same."""

    name: str
    path: Path
    vertices: np.ndarray
    faces: np.ndarray
    is_sound: bool = True

    @property
    def least(self):
        return self.vertices.min(axis=0)

    @property
    def most(self):
        return self.vertices.max(axis=0)

    @property
    def diagonal(self):
        return float(np.linalg.norm(self.most - self.least))

    def at(self, share):
        """The point at a share of the bounds."""
        return self.least + share * (self.most - self.least)

    @cached_property
    def trimesh(self):
        return trimesh.Trimesh(self.vertices, self.faces, process=False)


def torus(segments, sides, major=1.0, minor=0.4):
    """A ring around the y axis: `2 * segments * sides` triangles."""
    a = np.arange(segments) * 2 * np.pi / segments
    b = np.arange(sides) * 2 * np.pi / sides
    a, b = (x.ravel() for x in np.meshgrid(a, b, indexing="ij"))
    radius = major + minor * np.cos(b)
    positions = np.stack([radius * np.cos(a), minor * np.sin(b), -radius * np.sin(a)], axis=1)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(segments), np.arange(sides), indexing="ij"))

    def corner(i, j):
        return (i % segments) * sides + j % sides

    p, q, r, s = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
    return positions, np.concatenate([np.stack([p, q, r], axis=1), np.stack([p, r, s], axis=1)])


def sphere(subdivisions):
    """A ball of `20 * 4 ** subdivisions` triangles."""
    ball = trimesh.creation.icosphere(subdivisions=subdivisions)
    return np.array(ball.vertices, float), np.array(ball.faces)


def write_ply(path, vertices, faces):
    """Binary PLY with positions in f64: what is read back is what was written."""
    head = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
        f"element face {len(faces)}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    rows = np.empty(len(faces), dtype=[("n", "u1"), ("corners", "<u4", 3)])
    rows["n"], rows["corners"] = 3, faces
    path.write_bytes(head.encode() + vertices.astype("<f8").tobytes() + rows.tobytes())


def made(folder, quick):
    """Meshes that need no data."""
    kinds = {"sphere-20k": sphere(5), "torus-100k": torus(354, 142)}
    if not quick:
        kinds["torus-1M"] = torus(1000, 500)
    for name, (vertices, faces) in kinds.items():
        path = folder / f"{name}.ply"
        write_ply(path, vertices, faces)
        yield Mesh(name, path, vertices, faces)


def read(path, name, is_sound):
    """A file, welded."""
    loaded = trimesh.load_mesh(path, process=False, force="mesh")
    # Adding zero turns -0 into 0: the two are one place.
    vertices, of = np.unique(np.asarray(loaded.vertices, float) + 0.0, axis=0, return_inverse=True)
    faces = of.reshape(-1)[np.asarray(loaded.faces)]
    a, b, c = faces.T
    return Mesh(name, path, vertices, faces[(a != b) & (b != c) & (c != a)], is_sound)


def all_meshes(work, data, quick):
    """All meshes of a run, one at a time."""
    yield from made(work, quick)
    for names, is_sound in [(CLOSED, True), (DEFECTIVE, False)]:
        for name in names:
            if data and (not quick or name in QUICK):
                yield read(data / name, name, is_sound)
