"""The Rust part of the module. Use :mod:`cutaway` instead, which documents the values."""

from os import PathLike
from typing import Any, TypedDict

import numpy as np
import numpy.typing as npt

__version__: str

def adapter() -> dict[str, Any]:
    """The graphics adapter: ``name``, ``backend``, ``driver``, and ``software``, true if it runs on the CPU.

    Raises ``RuntimeError`` if there is no adapter, and names the package that provides a driver.
    """

def values() -> list[dict[str, Any]]:
    """Values of a scene by ``path``: ``takes``, ``unit``, ``help``, ``example``, ``moves``, and ``range``, the minimum and the maximum."""

def png(rgba: npt.NDArray[np.uint8]) -> bytes: ...

class _Picture(TypedDict):
    rgba: npt.NDArray[np.uint8]
    layers: dict[str, Any]
    strategy: str
    doubts: list[str]

class _Section(TypedDict):
    polygons: list[tuple[npt.NDArray[np.float64], list[npt.NDArray[np.float64]]]]
    parts: list[str]
    area: float
    perimeter: float
    origin: list[float]
    u: list[float]
    v: list[float]
    normal: list[float]
    doubts: list[str]

class _Flat(TypedDict):
    vertices: npt.NDArray[np.float64]
    faces: npt.NDArray[np.int64]
    caps: npt.NDArray[np.int32]
    volume: float
    cap_area: float
    open: tuple[int, list[float]] | None

class _Divided(TypedDict):
    name: str
    kept: _Flat
    removed: _Flat
    relief_off: float
    doubts: list[str]

class Scene:
    def __init__(self) -> None: ...
    @staticmethod
    def read(path: str | PathLike[str]) -> Scene: ...
    def copied(self) -> Scene: ...
    def pickled(self) -> tuple[str, str | PathLike[str], list[tuple[str, bytes]]]: ...
    @staticmethod
    def unpickled(text: str, path: str | PathLike[str], arrays: list[tuple[str, bytes]]) -> Scene: ...
    def add_model(self, model: str, fields: dict[str, Any]) -> None: ...
    def add_arrays(
        self,
        name: str,
        vertices: npt.NDArray[np.float64],
        faces: npt.NDArray[np.uint32],
        fields: dict[str, Any],
    ) -> None: ...
    def cut(
        self,
        sections: list[tuple[str, str | None, bool]],
        boxes: list[str],
        wedges: list[str],
        cutter: str | None,
        cutout: str | None,
        breakaway: str | None,
        exclude: list[str],
        fields: dict[str, Any],
    ) -> None: ...
    def set(self, path: str, value: Any) -> None: ...
    def get(self, path: str) -> Any: ...
    def remove(self, path: str) -> None: ...
    def parts(self) -> tuple[list[str], list[str]]: ...
    def cuts(self) -> list[str]: ...
    def saved(self, path: str | PathLike[str]) -> tuple[str, list[tuple[str, bytes]]]: ...
    def text(self) -> str: ...
    def render(self, set: dict[str, Any], camera: dict[str, Any]) -> _Picture: ...
    def section(self, spec: str, set: dict[str, Any]) -> _Section: ...
    def capped(self, relief_cells: int, set: dict[str, Any]) -> list[_Divided]: ...
    def compare(
        self,
        strategies: list[str],
        rounds: int,
        set: dict[str, Any],
        camera: dict[str, Any],
        command: str,
    ) -> str: ...
