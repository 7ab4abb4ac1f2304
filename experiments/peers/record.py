"""What the runs write: rows of areas and times, and what must be known to repeat them.

Times are taken in rounds in which each contender has its turn, so that what disturbs the machine disturbs all of them. The first
round warms up and is not counted. All samples are kept; they are told by their median and the median absolute deviation (MAD).
"""

import importlib.metadata
import json
import os
import platform
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Callable

# A contender whose warm-up takes longer than this many seconds is not called again: that call is its only sample.
PATIENCE_S = 2.0

PACKAGES = ["manifold3d", "mapbox_earcut", "numpy", "pyvista", "scipy", "shapely", "trimesh", "vtk"]


class Refused(Exception):
    """A tool says, in its own words, that it does not do this."""


class Failed(Exception):
    """A tool says, in its own words, that it did not do it."""


@dataclass
class Contender:
    """A tool at one task. `act` is timed; `area_of` reads the area from what it returned, and is not."""

    tool: str
    clock: str
    act: Callable[[], object]
    area_of: Callable[[object], float | None]
    command: str | None = None
    outcome: str = "done"
    reason: str | None = None
    result: object = None
    samples: list = field(default_factory=list)


def samples_of(milliseconds):
    """Samples with their median and MAD, as all records of this project hold them; None where there are none."""
    if not milliseconds:
        return None
    middle = median(milliseconds)
    return {
        "median": middle,
        "mad": median(abs(s - middle) for s in milliseconds),
        "samples": list(milliseconds),
    }


def take_turns(contenders, rounds):
    """Times all contenders in turns. One that fails drops out, with its own words."""
    for number in range(rounds + 1):
        # Nobody is always the one who comes after the slowest.
        turn = number % max(len(contenders), 1)
        for contender in contenders[turn:] + contenders[:turn]:
            one_turn(contender, is_warm_up=number == 0)


def one_turn(contender, is_warm_up):
    if contender.outcome != "done" or (not is_warm_up and contender.samples and contender.samples[0] > PATIENCE_S * 1e3):
        return
    began = time.perf_counter()
    try:
        result = contender.act()
        took_ms = (time.perf_counter() - began) * 1e3
    except Refused as refusal:
        contender.outcome, contender.reason = "refused", str(refusal)
        return
    # Whatever a peer raises is its answer: the run goes on.
    except Exception as fault:
        contender.outcome, contender.reason = "failed", words_of(fault)
        return
    if is_warm_up:
        contender.result = result
    if not is_warm_up or took_ms > PATIENCE_S * 1e3:
        contender.samples.append(took_ms)


def words_of(fault):
    """What a tool says, without the stack that it says it on."""
    return str(fault) if isinstance(fault, Failed) else f"{type(fault).__name__}: {fault}"


def row_of(mesh, cut, contender):
    """The row of a contender that had its turns."""
    area, outcome, reason = None, contender.outcome, contender.reason
    if outcome == "done":
        try:
            area = contender.area_of(contender.result)
        except Exception as fault:
            outcome, reason = "failed", words_of(fault)
    return row(
        mesh, cut, contender.tool, contender.clock, area, samples_of(contender.samples), outcome, reason, contender.command
    )


def row(mesh, cut, tool, clock, area, time_ms, outcome="done", reason=None, command=None):
    """One line of a record."""
    return {
        "mesh": mesh.name,
        "triangles": len(mesh.faces),
        "cut": cut,
        "tool": tool,
        "area": None if area is None else float(area),
        "area_unit": "model units^2",
        "time_ms": time_ms if outcome == "done" else None,
        "clock": clock,
        "outcome": outcome,
        "reason": reason,
        "command": command,
    }


def check(mesh, cut, tool, area, truth, bound, bound_is):
    """Whether the area of a tool is what it must be, and how sure that is."""
    off = abs(area - truth)
    return {
        "mesh": mesh.name,
        "cut": cut,
        "tool": tool,
        "area": float(area),
        "truth": float(truth),
        "off": float(off),
        "bound": float(bound),
        "bound_is": bound_is,
        "holds": bool(off <= bound),
    }


def write(path, what, cutaway, command, rows, checks):
    """Writes a record whole."""
    record = {
        "format": 1,
        "what": what,
        "machine": machine(),
        "versions": {"python": platform.python_version()} | {p: importlib.metadata.version(p) for p in PACKAGES},
        "cutaway": cutaway,
        "command": command,
        "rows": rows,
        "checks": checks,
    }
    draft = path.with_suffix(".part")
    draft.write_text(json.dumps(record, indent=1, allow_nan=False) + "\n")
    draft.replace(path)


def machine():
    """The machine, in the same fields as `run.json` of `cutaway measure`."""
    processor = platform.processor()
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [line.split(":", 1)[1].strip() for line in info.read_text().splitlines() if line.startswith("model name")]
        processor = names[0] if names else processor
    memory = None
    if hasattr(os, "sysconf") and "SC_PHYS_PAGES" in os.sysconf_names:
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return {
        "system": f"{platform.system().lower()} {platform.machine()}",
        "processor": processor,
        "cores": cores,
        "memory": memory,
        "load": LOAD_BEFORE,
    }


def load_now():
    """Processes that wanted to run, in the mean over the last minute; None where the system does not tell."""
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else None


# Taken when the run begins: later it is our own.
LOAD_BEFORE = load_now()


def commit_of_sources():
    """Commit of the sources this script lies in, with `+` where they differ from it; None outside of a repository."""
    folder = Path(__file__).parent

    def git(*words):
        return subprocess.run(["git", "-C", folder, *words], capture_output=True, text=True)

    head = git("rev-parse", "HEAD")
    if head.returncode:
        return None
    return head.stdout.strip() + ("+" if git("status", "--porcelain", "-uno").stdout.strip() else "")
