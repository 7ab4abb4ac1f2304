"""Capped halves: what `cutaway export` writes, read back by others, and its time and memory beside theirs.

    target/peers-venv/bin/python experiments/peers/halves.py [--cutaway PATH] check DATA [--only WORD] [--plant]
    target/peers-venv/bin/python experiments/peers/halves.py [--cutaway PATH] time MESH [--rounds N]

`check` cuts every mesh of a folder in five ways, both halves to PLY (f64) and to STL (f32). Of each part that came in closed it asks,
without any code of ours: has every directed edge its opposite, and do the volumes of the halves add up to the whole? Of the files it
asks trimesh and manifold3d whether they are closed. Ends with 1 where a half is open; `--plant` takes a triangle away, and must.

`time` cuts a mesh in the middle by each tool in a process of its own, from the start of the process to two STL files, and tells the
median of the time and the largest memory.
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import manifold3d
import numpy as np
import trimesh

CUTS = {
    "plane in the middle": ["--section", "x=50%"],
    "plane in a face or through a vertex": None,
    "oblique plane": ["--section", "0.31,0.52,-0.79@50%,50%,50%"],
    "box": ["--box", "20%,30%,25%:70%,80%,75%"],
    "wide wedge and a plane": ["--wedge", "y:0:250", "--section", "-z=90%"],
}
FORMATS = {".stl", ".ply", ".obj", ".glb", ".gz"}
# Of the whole.
VOLUME = 1e-9


def read_ply(path):
    """Positions in f64 and triangles, part by part: the layout that `cutaway export` writes."""
    raw = Path(path).read_bytes()
    end = raw.index(b"end_header\n") + 11
    counts = {w[1]: int(w[2]) for w in (l.split() for l in raw[:end].decode().splitlines()) if w[0] == "element"}
    vertices = np.frombuffer(raw, "<f8", 3 * counts["vertex"], end).reshape(-1, 3)
    face = np.dtype([("n", "u1"), ("corners", "<i4", 3), ("color", "u1", 3), ("part", "<i4"), ("cap", "u1")])
    faces = np.frombuffer(raw, face, counts["face"], end + 24 * counts["vertex"])
    names = [l.split(" ", 3)[3] for l in raw[:end].decode().splitlines() if l.startswith("comment part ")]
    return vertices, {name: faces["corners"][faces["part"] == i] for i, name in enumerate(names)}


def net(triangles):
    """How many edges have not each direction as often as the other, and how many an odd number of faces."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    key = edges.min(axis=1) << 32 | edges.max(axis=1)
    _, index = np.unique(key, return_inverse=True)
    way = np.where(edges[:, 0] < edges[:, 1], 1, -1)
    return int((np.bincount(index, way) != 0).sum()), int((np.bincount(index) % 2).sum())


def terms(vertices, triangles, middle):
    """Volumes of tetrahedra to a point. By the sides of triangles: of bodies far from the point the products of their corners cancel."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    return np.einsum("ij,ij->i", a - middle, np.cross(b - a, c - a)) / 6


def rounding(vertices, triangles):
    """What moving all vertices by the rounding of the largest coordinate makes of a volume: thin walls have an area, and hardly a volume."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    return float(np.finfo(float).eps * np.abs(vertices).max() * area)


def face_cut(cutaway, path, work):
    """A plane in the largest face across an axis, or through a vertex; the whole as parts."""
    whole = work / "whole.ply"
    # A plane beyond the mesh keeps all of it.
    done = run(cutaway, path, ["--section", "x=-1000%"], whole, both=False)
    if done.returncode == 2:
        return None, None
    vertices, parts = read_ply(whole)
    triangles = np.concatenate([t for t in parts.values()])
    best = (0.0, 1, vertices[len(vertices) // 2][1])
    corners = vertices[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    for axis in range(3):
        heights = corners[:, :, axis]
        across = (heights == heights[:, :1]).all(axis=1) & (heights[:, 0] > low[axis]) & (heights[:, 0] < high[axis])
        at, index = np.unique(heights[across][:, 0], return_inverse=True)
        if len(at):
            areas = np.bincount(index, area[across])
            if areas.max() > best[0]:
                best = (areas.max(), axis, at[areas.argmax()])
    return ["--section", f"{'xyz'[best[1]]}={float(best[2])!r}"], (vertices, parts)


def run(cutaway, path, cut, output, both=True):
    words = [cutaway, "export", str(path), *cut, "-o", str(output), "--json", str(output) + ".json", "--quiet"]
    return subprocess.run(words + ["--both"] * both, capture_output=True, text=True)


def judge(path):
    """What trimesh and manifold3d say of a file whose vertices are one where they are equal. By itself trimesh joins what is nearer
    than 1e-8, whatever the size of the model: of one in metres, or where a plane passes vertices by less, that makes walls of nothing."""
    soup = trimesh.load(path, process=False)
    at, index = np.unique(soup.vertices.view(np.ndarray) + 0.0, axis=0, return_inverse=True)
    mesh = trimesh.Trimesh(at, index.reshape(-1)[soup.faces], process=False)
    solid = manifold3d.Manifold(manifold3d.Mesh64(at, np.asarray(mesh.faces, np.uint64)))
    is_taken = solid.status() == manifold3d.Error.NoError
    own = trimesh.load(path)
    return bool(mesh.is_watertight), bool(mesh.is_winding_consistent), is_taken, bool(own.is_watertight)


def check(options):
    tally = {"parts": 0, "halves": 0, "open": 0, "unoriented": 0, "worst": 0.0, "worst_f32": 0.0}
    said = {"files": 0, "trimesh": 0, "consistent": 0, "manifold3d": 0, "trimesh joining": 0}
    wrong = []
    work = Path(tempfile.mkdtemp())
    files = sorted(p for p in Path(options.folder).rglob("*") if p.suffix in FORMATS and "compressed" not in p.parts)
    for path in files:
        if options.only and options.only not in str(path):
            continue
        through, whole = face_cut(options.cutaway, path, work)
        if whole is None:
            print(f"{path.name}: cannot be cut", flush=True)
            continue
        vertices, parts = whole
        middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
        sound = {n: net(t) for n, t in parts.items()}
        for cut, words in CUTS.items():
            output = work / "half.ply"
            output.with_suffix(".removed.ply").unlink(missing_ok=True)
            done = run(options.cutaway, path, words or through, output)
            if done.returncode == 2:
                print(f"{path.name}, {cut}: {done.stderr.strip().splitlines()[0]}", flush=True)
                continue
            halves = [read_ply(output), read_ply(work / "half.removed.ply")]
            if options.plant:
                halves[0] = (halves[0][0], {n: t[1:] for n, t in halves[0][1].items()})
            for name, triangles in parts.items():
                unoriented, odd = sound[name]
                if odd:
                    continue
                tally["parts"] += 1
                own = [(v, p[name]) for v, p in halves if name in p]
                for half in own:
                    found = net(half[1])
                    tally["halves"] += 1
                    tally["open"] += found[1]
                    tally["unoriented"] += 0 if unoriented else found[0]
                    if found[1] or (found[0] and not unoriented):
                        wrong.append(f"{path.name}, {name}, {cut}: {found}")
                if unoriented:
                    continue
                total = terms(vertices, triangles, middle)
                volume = abs(math.fsum(total))

                def lost(positions):
                    halves = np.concatenate([terms(positions(v), t, middle) for v, t in own])
                    return abs(math.fsum([*halves, *-total]))

                off = lost(lambda v: v)
                bound = max(VOLUME * volume, rounding(vertices, triangles))
                if off > bound:
                    wrong.append(f"{path.name}, {name}, {cut}: volumes off by {off:.1e} of {volume:.1e}")
                elif off > VOLUME * volume:
                    print(f"{path.name}, {name}, {cut}: thin: volumes off by {off / volume:.1e}", flush=True)
                else:
                    tally["worst"] = max(tally["worst"], off / volume)
                    off = lost(lambda v: v.astype(np.float32).astype(np.float64))
                    tally["worst_f32"] = max(tally["worst_f32"], off / volume)
            if any(odd or u for u, odd in sound.values()) or options.plant:
                continue
            output = work / "half.stl"
            run(options.cutaway, path, words or through, output)
            for one in (output, work / "half.removed.stl"):
                tight, consistent, taken, joined = judge(one)
                said["files"] += 1
                said["trimesh"] += tight
                said["consistent"] += consistent
                said["manifold3d"] += taken
                said["trimesh joining"] += joined
                if not (tight and taken):
                    print(f"{path.name}, {cut}, {one.name}: trimesh {tight}, manifold3d {taken}", flush=True)
    print(json.dumps(tally), json.dumps(said), sep="\n")
    print("\n".join(wrong))
    return 1 if wrong else 0


PEERS = {
    "trimesh": """
import trimesh, numpy as np
m = trimesh.load(mesh)
o = m.bounds.mean(axis=0)
for s, n in (("a", 1.0), ("b", -1.0)):
    trimesh.intersections.slice_mesh_plane(m, [n, 0, 0], o, cap=True, engine="earcut").export(out + s + ".stl")
""",
    "PyVista": """
import pyvista as pv
m = pv.read(mesh)
o = m.center
for s, n in (("a", 1.0), ("b", -1.0)):
    m.clip_closed_surface(normal=(n, 0, 0), origin=o).save(out + s + ".stl")
""",
    "VTK": """
import pyvista as pv, vtk
m = pv.read(mesh)
o = m.center
for s, n in (("a", 1.0), ("b", -1.0)):
    plane = vtk.vtkPlane()
    plane.SetOrigin(o)
    plane.SetNormal(n, 0, 0)
    planes = vtk.vtkPlaneCollection()
    planes.AddItem(plane)
    clip = vtk.vtkClipClosedSurface()
    clip.SetInputData(m)
    clip.SetClippingPlanes(planes)
    clip.Update()
    pv.wrap(clip.GetOutput()).triangulate().save(out + s + ".stl")
""",
    "manifold3d": """
import trimesh, manifold3d, numpy as np
m = trimesh.load(mesh)
s = manifold3d.Manifold(manifold3d.Mesh(np.asarray(m.vertices, np.float32), np.asarray(m.faces, np.uint32)))
assert s.status() == manifold3d.Error.NoError, s.status()
o = m.bounds.mean(axis=0)
for k, h in zip("ab", s.split_by_plane([1.0, 0, 0], float(o[0]))):
    h = h.to_mesh()
    trimesh.Trimesh(h.vert_properties[:, :3], h.tri_verts, process=False).export(out + k + ".stl")
""",
}


def measured(words):
    """Seconds, and the most memory in MiB."""
    start = time.monotonic()
    child = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    error = child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    if status:
        raise RuntimeError(error.decode().strip().splitlines()[-1])
    return time.monotonic() - start, usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime


def timed(options):
    work = tempfile.mkdtemp()
    tools = {
        "cutaway": [options.cutaway, "export", options.mesh, "--section", "x=50%", "-o", f"{work}/c.stl", "--both", "-q"]
    }
    for name, code in PEERS.items():
        code = f"mesh, out = {options.mesh!r}, {work + '/' + name!r}\n{code}"
        tools[name] = [sys.executable, "-c", code]
    samples = {name: [] for name in tools}
    for _ in range(options.rounds):
        for name, words in tools.items():
            try:
                samples[name].append(measured(words))
            except RuntimeError as e:
                print(f"{name}: {e}", flush=True)
    print(f"load before: {os.getloadavg()}, cores: {len(os.sched_getaffinity(0))}")
    for name, of in samples.items():
        if of:
            s, mib, cpu = (statistics.median(x) for x in zip(*of))
            print(f"{name:12} {s:7.2f} s {cpu:7.2f} s of CPU {mib:8.0f} MiB   {[round(x[0], 2) for x in of]}")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cutaway", default="target/release/cutaway", help="before the word that says what to do")
    commands = parser.add_subparsers(required=True)
    one = commands.add_parser("check")
    one.add_argument("folder")
    one.add_argument("--only")
    one.add_argument("--plant", action="store_true")
    one.set_defaults(act=check)
    two = commands.add_parser("time")
    two.add_argument("mesh")
    two.add_argument("--rounds", type=int, default=5)
    two.set_defaults(act=timed)
    options = parser.parse_args()
    return options.act(options)


if __name__ == "__main__":
    sys.exit(main())
