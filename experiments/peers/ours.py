"""This project's side: what `cutaway` says of the same files.

`section` slices in f64 and gives the area. `compare` counts pixels: seen along the normal in parallel rays, from the removed side,
a pixel shows the cap exactly where the clip-surface is inside the solid, so pixels times their size are the projected area. The
camera is given outright in a scene file, with the height of the picture in units of the model.
"""

import json
import math
import shlex
import subprocess
from pathlib import Path

import numpy as np

from record import Refused, row, samples_of

# Strategies that are timed: one that is exact, and the paper's.
PLANAR = ["planar", "stencil", "raycast+mask"]
RELIEF = ["raycast+mask", "grid:256+vds:1024"]

# The camera is rolled by this angle about N.
TURN_RAD = 0.6


def counting_error(perimeter, pixel):
    """What the count of pixels may be off by, in units of area. Each pixel on the outline errs by less than half its area to either
    side, without a pattern: the errors of n add up as the square root of n does. Six times that is never met by chance."""
    return 6 * pixel**2 * math.sqrt(perimeter / pixel)


COUNTING = "6 pixels x the square root of the outline in pixels"


class Cutaway:
    """The command."""

    def __init__(self, path):
        self.path = Path(path).resolve()

    def version(self):
        return self.run(["--version"]).split()[-1]

    def run(self, words):
        """Standard output; its own words where it ends with 2. 1 is a finding: an outline that does not close."""
        done = subprocess.run([self.path, *words], capture_output=True, text=True)
        if done.returncode not in (0, 1):
            raise Refused(done.stderr.strip())
        return done.stdout

    def section(self, mesh, plane):
        """Area and whether all outlines close."""
        report = json.loads(self.run(section_words(mesh, plane)))
        return report["sections"][0]

    def compare(self, scene, strategies, pixels, rounds):
        return json.loads(self.run(compare_words(scene, strategies, pixels, rounds)))


def spec(plane):
    """A plane as `--section` takes it, with every digit."""
    origin, normal = plane
    return "--section=" + ",".join(repr(float(x)) for x in normal) + "@" + ",".join(repr(float(x)) for x in origin)


def section_words(mesh, plane):
    return ["section", str(mesh.path), spec(plane), "--json", "-", "-q"]


def compare_words(scene, strategies, pixels, rounds):
    names = ",".join(strategies)
    size = f"{pixels},{pixels}"
    return ["compare", str(scene), "--strategies", names, "--resolution", size, "--rounds", str(rounds), "--json", "-", "-q"]


def command(words):
    return shlex.join(["cutaway", *words])


def numbers(vector):
    return "[" + ", ".join(repr(float(x)) for x in vector) + "]"


def write_scene(path, mesh, surface, relief=""):
    """A scene with one clip-surface in the paper's own form, seen along N from the removed side. Returns the picture's height in
    units of the model. `surface` has `origin`, `u`, `v`, `scale` and the rest of its keys in `more`."""
    u, v = (np.asarray(surface[k], float) for k in "uv")
    u_hat, v_hat = u / np.linalg.norm(u), v / np.linalg.norm(v)
    normal = np.cross(u_hat, v_hat)
    middle = mesh.at(0.5)
    flat = (mesh.vertices - middle) @ np.stack([u_hat, v_hat], axis=1)
    height = float(2.04 * np.linalg.norm(flat, axis=1).max())
    # Straight edges of the model would err all along by the same part of a pixel if they ran along its rows.
    view_up = np.sin(TURN_RAD) * u_hat + np.cos(TURN_RAD) * v_hat
    eye = middle - 2 * mesh.diagonal * normal
    path.write_text(
        f'[camera]\nprojection = "orthographic"\nheight = {height!r}\n'
        f"position = {numbers(eye)}\nfocal_point = {numbers(middle)}\nview_up = {numbers(view_up)}\n\n"
        f'[[part]]\nname = "solid"\nmesh = {json.dumps(str(mesh.path.resolve()))}\n\n{relief}'
        f'[[cut]]\nname = "front"\nsurfaces = [{{ origin = {numbers(surface["origin"])}, u = {numbers(u)}, v = {numbers(v)}, '
        f"scale = {numbers(surface['scale'])}{surface['more']} }}]\n"
    )
    return float(height)


def rows_of(mesh, cut, report, words, height):
    """Rows of `exact` and of each strategy, with the projected areas that their pixels make."""
    exact = report["exact"]
    pixel_area = (height / report["resolution"][1]) ** 2
    size = "x".join(map(str, report["resolution"]))
    repeat = command(words)
    clock = f"reference: every pixel of {size}, in f64, without opening the file"
    truth = exact["cap_px"] * pixel_area
    yield row(mesh, cut, "cutaway exact", clock, truth, samples_of([exact["time_ms"]]), command=repeat)
    for strategy in report["strategies"]:
        yield from rows_of_strategy(mesh, cut, strategy, exact["cap_px"], pixel_area, size, repeat)


CLOCKS = {
    "solid": "solid: what is built anew when the mesh changes",
    "cut": "cut: what is built anew when the clip-surface changes",
    "frame": "frame: a picture of {size} from the finished scene",
}


def rows_of_strategy(mesh, cut, strategy, cap_px, pixel_area, size, repeat):
    tool = f"cutaway {strategy['name']}"
    if strategy["outcome"] == "refused":
        yield row(mesh, cut, tool, "frame", None, None, "refused", strategy["reason"], repeat)
        return
    shown_px = cap_px - strategy["missed_cap_px"] + strategy["leaked_cap_px"]
    # What overflowed is incomplete: it is no area, and no time of the task.
    outcome = "done" if strategy["outcome"] == "complete" else "failed"
    for clock, text in CLOCKS.items():
        times = strategy["time_ms"][clock]
        if times["samples"]:
            area = shown_px * pixel_area if clock == "frame" and outcome == "done" else None
            yield row(mesh, cut, tool, text.format(size=size), area, times, outcome, strategy["reason"], repeat)
