"""Plane cuts: the area of the section, and the time to cut and cap.

Peers must agree with `cutaway section` to one part in a million, and the picture to what counting pixels allows.
"""

import numpy as np

import ours
import sections
from meshes import all_meshes
from record import Contender, Refused, check, row_of, take_turns

# Of the area; summation and the rounding of cut points stay far below.
RELATIVE = 1e-6

DIRECTIONS = {"across z": (0.0, 0.0, 1.0), "oblique": (0.31, 0.2, 1.0)}
# Not the middle: symmetric meshes have vertices and faces there.
SHARE = 0.473


def planes_of(mesh):
    for name, direction in DIRECTIONS.items():
        normal = np.array(direction)
        yield name, (mesh.at(SHARE), normal / np.linalg.norm(normal))


def peers(mesh, plane):
    """All ways of the peers to make the same cut."""
    origin, normal = plane
    t, v = mesh.trimesh, sections.as_vtk(mesh)
    p = sections.pyvista.wrap(v)
    made = []

    def add(tool, clock, act, area_of):
        made.append(Contender(tool, clock, act, area_of))

    def cap_of_trimesh():
        # It keeps what it worked out; without this, only the first call would be the task.
        t._cache.clear()
        return sections.trimesh_cap(t, origin, normal)

    add(
        "trimesh slice_plane",
        "cut and cap",
        cap_of_trimesh,
        lambda cut: sections.trimesh_cap_area(cut, origin, normal),
    )
    add(
        "trimesh section",
        "outline alone",
        lambda: sections.trimesh_section(t, origin, normal),
        sections.even_odd,
    )
    add(
        "vtkClipClosedSurface",
        "cut and cap",
        lambda: sections.vtk_cap(v, origin, normal),
        lambda cut: sections.vtk_cap_area(cut, normal),
    )
    add(
        "vtkCutter",
        "outline alone",
        lambda: sections.vtk_loops(v, origin, normal),
        sections.even_odd,
    )
    add(
        "PyVista clip_closed_surface",
        "check, cut and cap",
        lambda: sections.pyvista_cap(p, origin, normal),
        lambda cut: sections.pyvista_cap_area(cut, origin, normal),
    )
    add(
        "manifold3d Manifold",
        "taking the mesh, without a cut",
        lambda: sections.as_manifold(mesh),
        lambda _: None,
    )
    try:
        solid = sections.as_manifold(mesh)
    except sections.Refused:
        # The contender before says it in the record.
        return made
    add(
        "manifold3d trim_by_plane",
        "cut and cap of a mesh it has taken",
        lambda: sections.manifold_trim(solid, origin, normal),
        lambda kept: sections.manifold_cap_area(kept, solid, normal),
    )
    add(
        "manifold3d slice",
        "turn, outline and fill of a mesh it has taken",
        lambda: sections.manifold_slice(solid, origin, normal),
        lambda region: region.area(),
    )
    return made


def run(cutaway, work, options):
    """Rows and checks of all meshes and planes."""
    rows, checks = [], []
    for mesh in all_meshes(work, options.data, options.quick):
        for cut, plane in planes_of(mesh):
            print(f"planar: {mesh.name}, {cut}", flush=True)
            found = one(cutaway, work, mesh, cut, plane, options)
            rows += found[0]
            checks += found[1]
    return rows, checks


def one(cutaway, work, mesh, cut, plane, options):
    origin, normal = plane
    # The planted fault: peers cut elsewhere.
    theirs = (origin + normal * (0.005 * mesh.diagonal if options.plant else 0.0), normal)
    words = ours.section_words(mesh, plane)
    section = Contender(
        "cutaway section",
        "the whole command: start, open the file, weld, slice, fill, write all outlines",
        lambda: cutaway.section(mesh, plane),
        lambda report: report["area"],
        command=ours.command(words),
    )
    contenders = [section, *peers(mesh, theirs)]
    take_turns(contenders, options.rounds)
    if section.outcome != "done":
        raise Refused(section.reason)
    rows = [row_of(mesh, cut, c) for c in contenders]

    u, v = sections.frame(normal)
    scene = work / f"planar-{stem(mesh.name)}-{stem(cut)}.toml"
    surface = {"origin": origin, "u": u, "v": v, "scale": (1, 1, 1), "more": ""}
    height = ours.write_scene(scene, mesh, surface)
    report = cutaway.compare(scene, ours.PLANAR, options.pixels, options.rounds)
    words = ours.compare_words(scene, ours.PLANAR, options.pixels, options.rounds)
    pictured = list(ours.rows_of(mesh, cut, report, words, height))
    checks = checks_of(mesh, cut, rows, pictured, section.result, height / options.pixels) if mesh.is_sound else []
    return rows + pictured, checks


def checks_of(mesh, cut, rows, pictured, truth, pixel):
    """Every area against that of `section`."""
    area = truth["area"]
    checks = []
    for r in rows[1:]:
        if r["area"] is not None:
            checks.append(check(mesh, cut, r["tool"], r["area"], area, RELATIVE * area, "1e-6 of the area"))
    exact = pictured[0]
    bound = ours.counting_error(truth["perimeter"], pixel)
    checks.append(check(mesh, cut, exact["tool"], exact["area"], area, bound, ours.COUNTING))
    return checks


def stem(name):
    """A name that files may have."""
    return "".join(c if c.isalnum() else "-" for c in name)
