"""Relief cuts: the area of the cap as seen along N, and the time to make it.

Peers subtract a solid whose upper side is the relief; here pixels are counted that show the cap. They must agree to what
counting pixels allows, plus what two triangles in place of a bilinear quad change, which is measured by cells of twice the size.
"""

import numpy as np
from PIL import Image

import booleans
import ours
import sections
from field import Relief, field_of
from meshes import all_meshes
from planar import SHARE, stem
from record import Contender, Refused, check, row_of, take_turns

# Cells of the map are divided into so many along U and V.
DIVIDE = 4
TEXELS = 64

MESHES = ["sphere-20k", "torus-100k", "organic/spot.obj", "organic/armadillo.obj", "dense/cheese.obj", "cad/spool_base.stl"]
# One that no Boolean takes.
DEFECTIVE = ["organic/stanford_bunny.obj"]
QUICK = ["sphere-20k", "torus-100k", "organic/spot.obj", "organic/stanford_bunny.obj"]


def rough():
    """Heights from 0 to 1 in 16 bits without a symmetry: what flips or turns the map shows in the area."""
    y, x = np.mgrid[0:TEXELS, 0:TEXELS] / TEXELS
    sum_of_waves = np.zeros((TEXELS, TEXELS))
    for k, (a, b, phase) in enumerate([(1, 2, 0.3), (3, -1, 1.9), (4, 5, 4.0), (9, -7, 2.2), (13, 11, 5.5)]):
        sum_of_waves += np.sin(2 * np.pi * (a * x + b * y) + phase) / (k + 1)
    sum_of_waves += 1.5 * x * x + 0.8 * y
    least, most = sum_of_waves.min(), sum_of_waves.max()
    return np.round((sum_of_waves - least) / (most - least) * 65535).astype(np.uint16)


def sawtooth_of(mesh):
    """The 2 x 2 map that repeats: a zigzag along U. 12 teeth along the diagonal."""
    u, v = sections.frame(np.array([0.0, 0.0, 1.0]))
    period, height = mesh.diagonal / 12, mesh.diagonal * 0.03
    return Relief(
        "sawtooth",
        np.array([[0.0, 1.0], [0.0, 1.0]]),
        True,
        mesh.at(SHARE) + 0.5 * height * np.cross(u, v),
        u * period,
        v * period,
        (1.0, 1.0, height),
        ', relief = "heights"',
    )


def image_of(mesh):
    """An image over all of the model, clamped, across an oblique direction."""
    normal = np.array([0.31, 0.2, 1.0])
    normal /= np.linalg.norm(normal)
    u, v = sections.frame(normal)
    side, height = mesh.diagonal, mesh.diagonal * 0.08
    texels = (rough() / 65535).astype(np.float32).astype(float)
    corner = mesh.at(SHARE) - 0.5 * side * (u + v) + 0.5 * height * normal
    return Relief(
        "image, oblique", texels, False, corner, u * side, v * side, (1.0, 1.0, height), ', relief = "heights", wrap = "clamp"'
    )


def table_of(relief, work):
    """The relief as a scene file states it."""
    if relief.repeat:
        return '[relief.heights]\nkind = "sawtooth"\n\n'
    path = work / "rough.png"
    Image.fromarray(rough()).save(path)
    return f'[relief.heights]\nimage = "{path.name}"\n\n'


def run(cutaway, work, options):
    """Rows and checks of all meshes and reliefs."""
    rows, checks = [], []
    for mesh in all_meshes(work, options.data, options.quick):
        if mesh.name not in (QUICK if options.quick else MESHES + DEFECTIVE):
            continue
        for relief in (sawtooth_of(mesh), image_of(mesh)):
            print(f"relief: {mesh.name}, {relief.name}", flush=True)
            found = one(cutaway, work, mesh, relief, options)
            rows += found[0]
            checks += found[1]
    return rows, checks


def peers(mesh, removed, field):
    """All ways of the peers to subtract the field; and none of those that refuse the mesh."""
    made = []
    task = f"difference with a solid of {len(removed.faces)} triangles"

    def add(tool, clock, act, area_of):
        made.append(Contender(tool, clock, act, area_of))

    def taken():
        return sections.as_manifold(mesh), sections.as_manifold(removed)

    add("manifold3d Manifold", "taking the mesh and the field, without a cut", taken, lambda _: None)
    try:
        solids = taken()
        add(
            "manifold3d difference",
            f"{task}; both taken before",
            lambda: booleans.manifold_cut(*solids),
            lambda kept: booleans.manifold_cap(kept, solids[0], field)[0],
        )
    except Refused:
        # The contender before says it in the record.
        pass
    t, r = mesh.trimesh, removed.trimesh
    add(
        "trimesh difference",
        f"{task}; by manifold3d, which takes both anew",
        lambda: booleans.trimesh_cut(t, r),
        lambda kept: booleans.found_cap(kept.vertices, kept.faces, field, mesh.diagonal)[0],
    )
    add(
        "vtkBooleanOperationPolyDataFilter",
        f"{task}; in a process of its own",
        lambda: booleans.vtk_cut(mesh, removed),
        lambda kept: booleans.found_cap(*kept, field, mesh.diagonal)[0],
    )
    return made


def one(cutaway, work, mesh, relief, options):
    surface = {"origin": relief.origin, "u": relief.u, "v": relief.v, "scale": relief.scale, "more": relief.more}
    scene = work / f"relief-{stem(mesh.name)}-{stem(relief.name)}.toml"
    height = ours.write_scene(scene, mesh, surface, table_of(relief, work))
    # The planted fault: peers subtract a solid that is too high.
    if options.plant:
        relief.origin = relief.origin + 0.05 * mesh.diagonal * relief.frame[2]
    field = field_of(relief, mesh, DIVIDE)
    removed = Removed(field)
    contenders = peers(mesh, removed, field)
    take_turns(contenders, options.rounds)
    rows = [row_of(mesh, relief.name, c) for c in contenders]
    note_of_peers(rows)

    report = cutaway.compare(scene, ours.RELIEF, options.pixels, options.rounds)
    words = ours.compare_words(scene, ours.RELIEF, options.pixels, options.rounds)
    pictured = list(ours.rows_of(mesh, relief.name, report, words, height))
    checks = checks_of(mesh, relief, rows, pictured[0]["area"], height / options.pixels) if mesh.is_sound else []
    return rows + pictured, checks


def note_of_peers(rows):
    """Where peers make different areas of one and the same solid, their rows say so: that is between them."""
    areas = {r["tool"]: r["area"] for r in rows if r["area"] is not None}
    truth = areas.get("manifold3d difference")
    for r in rows:
        if truth and r["area"] is not None and abs(r["area"] - truth) > 1e-6 * truth:
            share = (r["area"] / truth - 1) * 100
            r["reason"] = f"{share:+.2g} % against manifold3d, which subtracted the same solid"


class Removed:
    """A field as the peers' functions take meshes."""

    def __init__(self, field):
        self.vertices, self.faces = field.vertices, field.faces
        self.trimesh = booleans.as_trimesh(self)


def checks_of(mesh, relief, rows, exact, pixel):
    """The area of exact against those of the peers."""
    solid = sections.as_manifold(mesh)
    made = []
    for divide in (DIVIDE, DIVIDE // 2):
        field = field_of(relief, mesh, divide)
        kept = booleans.manifold_cut(solid, sections.as_manifold(Removed(field)))
        made.append(booleans.manifold_cap(kept, solid, field))
    (area, perimeter), (coarse, _) = made
    bound = ours.counting_error(perimeter, pixel) + abs(area - coarse)
    told = f"{ours.COUNTING} + what cells of twice the size change"
    # Who disagrees with Manifold about the same solid is not held against us: the row says so. Manifold always is.
    held = [r for r in rows if r["area"] is not None and not r["reason"]]
    return [check(mesh, relief.name, r["tool"], r["area"], exact, bound, told) for r in held]
