"""What calls of a scene give: arrays with a few words about them."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _native


class CutawayWarning(UserWarning):
    """A doubt about a result: an open mesh, a cut that misses, a buffer that was too small."""


def warn(doubts: Sequence[str]) -> None:
    """Warns of doubts, for a public method: of the line that called it."""
    for doubt in doubts:
        warnings.warn(doubt, CutawayWarning, stacklevel=3)


@dataclass(frozen=True, repr=False)
class Layers:
    """What each pixel shows. Arrays have the shape (h, w), rows from the top, at pixel centres."""

    kind: npt.NDArray[np.uint8]
    """0 background, 1 surface, 2 cap."""
    part: npt.NDArray[np.int32]
    """Number of the part in :attr:`parts`; -1 for background."""
    surface: npt.NDArray[np.int32]
    """Number of the clip-surface in :attr:`surfaces` that made the cap; 255 for the near plane, -1 where there is no cap."""
    depth: npt.NDArray[np.float32]
    """Distance from the eye along the viewing direction, in units of the model; infinite for background."""
    normal: npt.NDArray[np.float32]
    """(h, w, 3): unit normals in the axes of the model, towards the eye; zero for background."""
    unreliable: npt.NDArray[np.bool_]
    """Marked by the strategy: crossings along the ray do not tell inside from outside, or a buffer was too small."""
    may_be_wrong: npt.NDArray[np.bool_]
    """Those marked pixels in which a cap may be missing, or shown where there is none."""
    overlap: npt.NDArray[np.bool_]
    """Caps at which several solids overlap, where the strategy says so."""
    parts: list[str]
    """Names of the parts."""
    surfaces: list[str]
    """Names of the cuts that clip-surfaces belong to, by number."""

    BACKGROUND = 0
    SURFACE = 1
    CAP = 2

    def __repr__(self) -> str:
        count = {name: int((self.kind == k).sum()) for k, name in enumerate(("background", "surface", "cap"))}
        size = "x".join(map(str, self.kind.shape[::-1]))
        return f"Layers({size}, " + ", ".join(f"{name}={n} px" for name, n in count.items()) + ")"


@dataclass(frozen=True, repr=False, eq=False)
class Picture:
    """A picture that a notebook shows, and numpy takes as an array of shape (h, w, 4), uint8, sRGB, alpha not premultiplied.

    ``rgba, layers = picture`` takes it apart.
    """

    rgba: npt.NDArray[np.uint8]
    layers: Layers | None = None
    strategy: str = ""
    """What drew it."""

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
                "\n  help: give the array of a picture"
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
    """A piece of a section: ``shapely.Polygon(*polygon)``. The first point of a ring is not repeated at its end."""

    outer: npt.NDArray[np.float64]
    """(n, 2): the ring around it, counter-clockwise."""
    holes: list[npt.NDArray[np.float64]]
    """(m, 2) each: the rings around its holes, clockwise."""


@dataclass(frozen=True, repr=False, eq=False)
class Section:
    """What a plane cuts out of the parts. ``polygons, area = section`` takes it apart.

    Points are coordinates along ``u`` and ``v`` from ``origin``, the point of the plane that is nearest to that of the world: in
    ``z=..`` they are x and y, in ``x=..`` y and z, in ``y=..`` z and x.
    """

    polygons: list[Polygon]
    area: float
    """Sum over the parts, in square units: where solids overlap it counts twice."""
    parts: list[str]
    """The part of each polygon."""
    perimeter: float
    """Length of all outlines."""
    origin: npt.NDArray[np.float64]
    u: npt.NDArray[np.float64]
    v: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    """Towards the side that such a cut would keep; ``u`` x ``v``."""
    doubts: list[str] = field(default_factory=list)
    """Outlines that do not close or cross themselves, because the mesh is open or does."""

    def __iter__(self) -> Iterator[Any]:
        return iter((self.polygons, self.area))

    def to_world(self, uv: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The places in space, (n, 3), of points of the plane, (n, 2)."""
        uv = np.asarray(uv, dtype=np.float64)
        return self.origin + uv[..., :1] * self.u + uv[..., 1:] * self.v

    def __repr__(self) -> str:
        return f"Section({len(self.polygons)} polygons, area={self.area:.6g})"


@dataclass(frozen=True, repr=False, eq=False)
class Solid:
    """What is left of one part, or of all of them, as one mesh: ``trimesh.Trimesh(*solid.arrays)``."""

    name: str
    vertices: npt.NDArray[np.float64]
    """(n, 3), in world space."""
    faces: npt.NDArray[np.int64]
    """(m, 3): numbers of vertices, counter-clockwise seen from outside. Faces of the mesh come before its caps."""
    caps: npt.NDArray[np.int32]
    """(m,): of each face the number of the clip-surface whose cap it is a part of; -1 for faces of the mesh."""
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
    """Solids as one mesh; each keeps its own vertices."""
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
    """What cuts leave of all parts as one mesh, and by part; and the same of what they remove."""

    parts: dict[str, Solid]
    """What is left of each part, by its name."""
    removed: Half
    """What is removed. It shares its vertices on the caps to the last bit, and its own ``removed`` is what is left."""
    relief_off: float
    """Largest distance between caps and the reliefs that they follow, in units of the model."""

    @classmethod
    def pair(cls, kept: Sequence[Solid], removed: Sequence[Solid], relief_off: float) -> Half:
        """Both halves, of which each knows the other."""
        halves = []
        for solids in (kept, removed):
            half = cls(**vars(together(solids)))
            object.__setattr__(half, "parts", {s.name: s for s in solids})
            object.__setattr__(half, "relief_off", relief_off)
            halves.append(half)
        object.__setattr__(halves[0], "removed", halves[1])
        object.__setattr__(halves[1], "removed", halves[0])
        return halves[0]
