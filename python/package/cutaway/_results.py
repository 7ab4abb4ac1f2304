"""Results of scene methods: arrays with names and measures."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _native


class CutawayWarning(UserWarning):
    """A result may be wrong: a mesh is open, a cut misses every part, or a buffer was too small."""


def warn(doubts: Sequence[str]) -> None:
    """Issues warnings for a public method; each refers to the line that called the method."""
    for doubt in doubts:
        warnings.warn(doubt, CutawayWarning, stacklevel=3)


@dataclass(frozen=True, repr=False)
class Layers:
    """Visible surface or cap of each pixel. Arrays have the shape (h, w), rows from the top, at pixel centres."""

    kind: npt.NDArray[np.uint8]
    """0 background, 1 surface, 2 cap."""
    part: npt.NDArray[np.int32]
    """Number of the part in :attr:`parts`; -1 for background."""
    surface: npt.NDArray[np.int32]
    """Number of the clip-surface in :attr:`surfaces` that made the cap; 255 for the near plane, -1 where there is no cap."""
    depth: npt.NDArray[np.float32]
    """Distance from the eye along the viewing direction, in units of the model; infinite for background."""
    normal: npt.NDArray[np.float32]
    """(h, w, 3): unit normals along the axes of the model, facing the eye; zero for background."""
    unreliable: npt.NDArray[np.bool_]
    """Pixels that the strategy marked: the crossings along the ray do not determine inside and outside, or a buffer was too small."""
    may_be_wrong: npt.NDArray[np.bool_]
    """The subset of ``unreliable`` pixels in which a cap may be missing or wrongly shown."""
    overlap: npt.NDArray[np.bool_]
    """Caps at which several solids overlap, if the strategy detects overlaps."""
    parts: list[str]
    """Names of the parts."""
    surfaces: list[str]
    """For each clip-surface, by number, the name of its cut."""

    BACKGROUND = 0
    SURFACE = 1
    CAP = 2

    def __repr__(self) -> str:
        count = {name: int((self.kind == k).sum()) for k, name in enumerate(("background", "surface", "cap"))}
        size = "x".join(map(str, self.kind.shape[::-1]))
        return f"Layers({size}, " + ", ".join(f"{name}={n} px" for name, n in count.items()) + ")"


@dataclass(frozen=True, repr=False, eq=False)
class Picture:
    """A picture. Notebooks display it; numpy reads it as an array of shape (h, w, 4), uint8, sRGB, alpha not premultiplied.

    ``rgba, layers = picture`` unpacks it.
    """

    rgba: npt.NDArray[np.uint8]
    layers: Layers | None = None
    strategy: str = ""
    """Strategy that drew the picture."""

    def __iter__(self) -> Iterator[Any]:
        return iter((self.rgba, self.layers))

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        array = self.rgba if dtype is None else self.rgba.astype(dtype, copy=False)
        return array.copy() if copy else array

    def png(self) -> bytes:
        """The bytes of a PNG file."""
        rgba = np.asarray(self.rgba)
        if rgba.ndim != 3 or rgba.shape[2] != 4 or rgba.dtype != np.uint8:
            raise ValueError(
                f"picture of shape {rgba.shape} and type {rgba.dtype}: it must be (h, w, 4) and uint8"
                "\n  help: give the array `rgba` of a picture"
            )
        return _native.png(np.ascontiguousarray(rgba))

    def save(self, path: Any) -> None:
        """Writes a PNG file."""
        with open(path, "wb") as file:
            file.write(self.png())

    def _repr_png_(self) -> bytes:
        return self.png()

    def __repr__(self) -> str:
        height, width = self.rgba.shape[:2]
        return f"Picture({width}x{height}, strategy={self.strategy!r})"


class Polygon(NamedTuple):
    """One polygon of a section, for ``shapely.Polygon(*polygon)``. The first point of a ring is not repeated at its end."""

    outer: npt.NDArray[np.float64]
    """(n, 2): the outer ring, counter-clockwise."""
    holes: list[npt.NDArray[np.float64]]
    """One array of shape (m, 2) per hole: its ring, clockwise."""


@dataclass(frozen=True, repr=False, eq=False)
class Section:
    """Section of the parts by a plane. ``polygons, area = section`` unpacks it.

    Points are coordinates along ``u`` and ``v`` from ``origin``, the point of the plane nearest to the world origin. For a plane
    ``z=..`` they are x and y, for ``x=..`` y and z, for ``y=..`` z and x.
    """

    polygons: list[Polygon]
    area: float
    """Sum of the areas of all parts, in square units; the overlap of two solids counts twice."""
    parts: list[str]
    """For each polygon, the name of its part."""
    perimeter: float
    """Length of all outlines."""
    origin: npt.NDArray[np.float64]
    u: npt.NDArray[np.float64]
    v: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    """``u`` x ``v``; points to the side that a cut by this plane would keep."""
    doubts: list[str] = field(default_factory=list)
    """Warnings about outlines that do not close because the mesh is open, or that cross themselves because the mesh does."""

    def __iter__(self) -> Iterator[Any]:
        return iter((self.polygons, self.area))

    def to_world(self, uv: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Converts points of the plane, shape (n, 2), to points in world space, shape (n, 3)."""
        uv = np.asarray(uv, dtype=np.float64)
        return self.origin + uv[..., :1] * self.u + uv[..., 1:] * self.v

    def __repr__(self) -> str:
        return f"Section({len(self.polygons)} polygons, area={self.area:.6g})"


@dataclass(frozen=True, repr=False, eq=False)
class Solid:
    """One half of one part or of all parts, as one mesh, for ``trimesh.Trimesh(*solid.arrays)``."""

    name: str
    vertices: npt.NDArray[np.float64]
    """(n, 3), in world space."""
    faces: npt.NDArray[np.int64]
    """(m, 3): vertex indices, counter-clockwise as seen from outside. The faces of the original mesh come before the caps."""
    caps: npt.NDArray[np.int32]
    """(m,): for each face of a cap, the number of its clip-surface; -1 for faces of the original mesh."""
    volume: float
    """In cubic units."""
    cap_area: float
    """In square units."""

    @property
    def arrays(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
        """Vertices and faces."""
        return self.vertices, self.faces

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r}, {len(self.faces)} faces, volume={self.volume:.6g}, cap_area={self.cap_area:.6g})"


def together(solids: Sequence[Solid]) -> Solid:
    """Joins solids into one mesh; no vertices are merged."""
    first = np.cumsum([0] + [len(s.vertices) for s in solids])
    stacked = lambda arrays, empty: np.concatenate(arrays) if arrays else empty  # noqa: E731
    return Solid(
        name="+".join(s.name for s in solids),
        vertices=stacked([s.vertices for s in solids], np.zeros((0, 3))),
        faces=stacked([s.faces + n for s, n in zip(solids, first)], np.zeros((0, 3), np.int64)),
        caps=stacked([s.caps for s in solids], np.zeros(0, np.int32)),
        volume=float(sum(s.volume for s in solids)),
        cap_area=float(sum(s.cap_area for s in solids)),
    )


class Half(Solid):
    """One half of a cut scene, kept or removed, as one mesh and part by part."""

    parts: dict[str, Solid]
    """This half of each part, by the name of the part."""
    removed: Half
    """The other half. Its cap vertices equal those of this half bit for bit, and its ``removed`` is this half."""
    relief_off: float
    """Largest distance between a cap and its relief, in units of the model."""

    @classmethod
    def pair(cls, kept: Sequence[Solid], removed: Sequence[Solid], relief_off: float) -> Half:
        """Makes both halves, each the ``removed`` of the other, and returns the kept one."""
        halves = []
        for solids in (kept, removed):
            half = cls(**vars(together(solids)))
            object.__setattr__(half, "parts", {s.name: s for s in solids})
            object.__setattr__(half, "relief_off", relief_off)
            halves.append(half)
        object.__setattr__(halves[0], "removed", halves[1])
        object.__setattr__(halves[1], "removed", halves[0])
        return halves[0]
