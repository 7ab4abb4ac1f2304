"""Opens the window, which is the separate program ``cutaway-viewer``."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from typing import Any

from ._scene import Scene

PROGRAM = "cutaway-viewer"


def show(what: Any, *, wait: bool = False) -> subprocess.Popen[bytes]:
    """Opens a scene, a mesh or a file in the window.

    The window works on a copy of the scene in a separate file; changes made in the window do not affect this scene. The file stays in the
    folder for temporary files, so that the window can read it again.

    ``wait``: return only when the window is closed.

    Raises ``FileNotFoundError`` if ``cutaway-viewer`` is not installed.
    """
    program = shutil.which(PROGRAM)
    if program is None:
        raise FileNotFoundError(
            f"{PROGRAM}: there is no such program on the PATH"
            "\n  help: install it from the cutaway repository: cargo install --path crates/viewer"
        )
    scene = _scene_of(what)
    folder = tempfile.mkdtemp(prefix="cutaway-")
    file = os.path.join(folder, "scene.toml")
    scene.save(file)
    window = subprocess.Popen([program, "view", file], stdin=subprocess.DEVNULL)
    if wait:
        window.wait()
    return window


def _scene_of(what: Any) -> Scene:
    if isinstance(what, Scene):
        return what
    return Scene.open(what) if isinstance(what, (str, os.PathLike)) else Scene(what)
