"""Meshes that tests share, and where real ones are."""

import os
import signal
from pathlib import Path

import numpy as np
import pytest

import cutaway

# A shell starts processes in the background with interrupts ignored, and Python keeps that.
signal.signal(signal.SIGINT, signal.default_int_handler)


def data_folder() -> Path | None:
    """Real meshes, which are not part of the repository: in ``$CUTAWAY_DATA``, or in ``../shared/data``."""
    beside = Path(__file__).resolve().parents[2].parent / "shared" / "data"
    folder = Path(os.environ.get("CUTAWAY_DATA", beside))
    return folder if folder.is_dir() else None


@pytest.fixture
def data() -> Path:
    folder = data_folder()
    if folder is None:
        pytest.skip("NOT CHECKED: there are no real meshes here; $CUTAWAY_DATA may name a folder of them")
    return folder


def box(size=(1.0, 1.0, 1.0), at=(0.0, 0.0, 0.0)):
    """A box from ``at``, as 8 vertices and 12 faces that face outward."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    faces = np.array(
        [
            [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
            [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
        ]
    )  # fmt: skip
    return corners * np.array(size) + np.array(at), faces


@pytest.fixture
def cube():
    return box()


@pytest.fixture
def scene(cube):
    """A unit cube of which the lower half in x is removed."""
    scene = cutaway.Scene()
    scene.add("cube", *cube)
    scene.cut("x=50%", name="front")
    return scene
