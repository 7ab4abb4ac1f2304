"""Scenes: parts, cuts, a camera and a look."""

from __future__ import annotations

import json
import operator
import os
import tempfile
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from . import _native
from ._arrays import arrays_of, faces_of, refuse, vertices_of
from ._results import Half, Layers, Picture, Polygon, Section, Solid, warn

CAMERA = ("azimuth_deg", "elevation_deg", "position", "focal_point", "view_up", "view", "zoom", "pan", "fit", "up", "fov_y_deg")
"""Keys of ``camera`` that methods accept as keyword arguments of the same name."""


class Scene:
    """Parts, the cuts that apply to them, a camera and a style.

    A scene holds the contents of a scene file: :meth:`get` and :meth:`set` take the paths that ``cutaway scene`` lists, and :meth:`save`
    writes the file. A change that would make the scene invalid raises an error and leaves the scene unchanged.

    A scene reads each file once; to read a changed file, make a new scene. Scenes may be used from several threads, but all share one
    device, which draws one frame at a time. Ctrl-C is raised within a second. The interrupted work still runs to its end in the
    background, and the next call that needs the same scene or the device waits for it.

    ``copy.copy`` and ``copy.deepcopy`` make an independent scene. A pickled scene contains its arrays, but refers to
    files by absolute path: they are read again when the scene is unpickled.
    """

    def __init__(self, *models: Any) -> None:
        """Makes a scene of models, each as for :meth:`add`; without models an empty scene."""
        self._scene = _native.Scene()
        for model in models:
            self.add(model)

    def __copy__(self) -> Scene:
        return self._with(self._scene.copied())

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        return self._with(self._scene.copied())

    def _with(self, scene: _native.Scene) -> Scene:
        other = type(self).__new__(type(self))
        other.__dict__.update(self.__dict__)
        other._scene = scene
        return other

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_scene": self._scene.pickled()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._scene = _native.Scene.unpickled(*state["_scene"])

    @classmethod
    def open(cls, path: str | os.PathLike[str]) -> Scene:
        """Opens a scene file (``.toml``), a mesh file (``.stl``, ``.ply``, ``.obj``, ``.glb``, ``.gltf``, ``.3mf``) or ``shape:NAME``.

        Raises ``FileNotFoundError`` for a missing file, and ``ValueError`` for a file whose contents do not match its extension.
        """
        scene = cls()
        name = _path("path", path)
        if name.lower().endswith(".toml") and not name.startswith("shape:"):
            scene._scene = _native.Scene.read(name)
        else:
            scene.add(name)
        return scene

    def add(self, model: Any, vertices: Any = None, faces: Any = None, *, name: str | None = None, **fields: Any) -> None:
        """Adds parts.

        ``add("tube", vertices, faces)``: a name, (n, 3) coordinates and (m, 3) vertex indices from 0, counter-clockwise seen from outside.
        If the mesh is open, vertices with equal coordinates are merged, as for mesh files.

        ``add(mesh)``: an object with ``vertices`` and ``faces`` (trimesh), or with ``points`` and ``faces`` (PyVista).

        ``add("bracket.stl")``: a mesh file, or a built-in shape such as ``"shape:crank?throws=3"``.

        ``fields``: keys of ``[[part]]``, for example ``role="interior"``, ``translate=[0, 0, 1]``, ``material={"color": "#8a94a6"}``.
        """
        if (vertices is None) != (faces is None):
            missing, there = ("faces", "vertices") if faces is None else ("vertices", "faces")
            raise refuse(missing, f"there are {there} and no {missing}", "scene.add(\"tube\", vertices, faces)")
        if vertices is not None:
            name = _text("name", model if name is None else name)
            self._add_arrays(name, vertices, faces, fields)
        elif isinstance(model, (str, os.PathLike)):
            if name is not None:
                fields["name"] = _text("name", name)
            self._scene.add_model(_path("model", model), fields)
        else:
            arrays = arrays_of(model)
            if arrays is None:
                raise refuse(
                    f"model of type {type(model).__name__}",
                    "it has no vertices and faces",
                    "give a file name, a trimesh or PyVista mesh, or a name and two arrays",
                )
            self._add_arrays(self._free_name() if name is None else _text("name", name), *arrays, fields)

    def _add_arrays(self, name: str, vertices: Any, faces: Any, fields: dict[str, Any]) -> None:
        points = vertices_of(vertices)
        self._scene.add_arrays(name, points, faces_of(faces, len(points)), fields)

    def _free_name(self) -> str:
        taken = set(self.parts)
        names = ("mesh" if n == 1 else f"mesh {n}" for n in range(1, len(taken) + 2))
        return next(name for name in names if name not in taken)

    def cut(
        self,
        *sections: str,
        relief: str | Sequence[str | None] | None = None,
        flip: bool | Sequence[bool] = False,
        box: str | Sequence[str] = (),
        wedge: str | Sequence[str] = (),
        cutter: str | os.PathLike[str] | None = None,
        cutout: str | bool | None = None,
        breakaway: str | bool | None = None,
        applies_to: str | Sequence[str] | None = None,
        exclude: str | Sequence[str] = (),
        name: str | None = None,
        **fields: Any,
    ) -> None:
        """Adds a cut. It removes the points that lie on the removed side of all its surfaces; several cuts remove the union.

        ``sections``: planes; the side that the normal points to is kept: ``"z=10"``, ``"-z=50%"`` (of the bounds), ``"nx,ny,nz@px,py,pz"``.

        ``relief``: makes a section ragged: ``"fractal:amplitude=4%,seed=7"``, or ``sawtooth``, ``waves``, ``cracks``, ``steps`` or an image file;
        for several sections give a list. ``flip``: keep the other side.

        ``box``: ``"0,0,0:1,1,1"`` or ``"50%,50%,50%:"``. ``wedge``: ``"z:0:90"``. ``cutter``: a mesh file or ``shape:NAME``.
        ``cutout`` and ``breakaway``: ``True``, or their options as a text.

        ``applies_to``, ``exclude``: glob patterns for part names.
        """
        words = [_text("section", s) for s in sections]
        reliefs = _each("relief", relief, words, None)
        flips = _each("flip", flip, words, False)
        if applies_to is not None:
            fields["applies_to"] = _texts("applies_to", applies_to)
        if name is not None:
            fields["name"] = _text("name", name)
        boxes, wedges = _texts("box", box), _texts("wedge", wedge)
        opening = {key: ("" if word is True else _text(key, word)) if word not in (None, False) else None
                   for key, word in (("cutout", cutout), ("breakaway", breakaway))}
        if not (words or boxes or wedges or cutter is not None or any(o is not None for o in opening.values()) or fields.get("surfaces")):
            raise refuse("cut", "there is nothing to cut by", "scene.cut(\"z=50%\")")
        self._scene.cut(
            [(s, None if r is None else _text("relief", r), bool(f)) for s, r, f in zip(words, reliefs, flips)],
            boxes,
            wedges,
            None if cutter is None else _path("cutter", cutter),
            opening["cutout"],
            opening["breakaway"],
            _texts("exclude", exclude),
            fields,
        )

    def set(self, path: str, value: Any) -> None:
        """Sets a value of the scene: ``set("cut.front.surfaces.0.amplitude", 0.1)``, ``set("camera.azimuth_deg", 20)``."""
        self._scene.set(_text("path", path), value)

    def get(self, path: str) -> Any:
        """Returns the value at a path, as it was set: a bool, number, text, list or dict."""
        return self._scene.get(_text("path", path))

    def remove(self, path: str) -> None:
        """Removes a value, so that its default applies; or removes a part or a cut."""
        self._scene.remove(_text("path", path))

    @property
    def parts(self) -> list[str]:
        """Names of the parts; the index of a name is the part number in :class:`Layers`."""
        return self._scene.parts()[0]

    @property
    def cuts(self) -> list[str]:
        """Names of the cuts, for use in paths: ``cut.NAME.surfaces.0.section``."""
        return self._scene.cuts()

    @property
    def notes(self) -> list[str]:
        """Notes on the meshes that were read: vertices welded, faces left out, edges left open."""
        return self._scene.parts()[1]

    def render(
        self,
        size: tuple[int, int] | None = None,
        *,
        strategy: str | None = None,
        style: str | None = None,
        supersample: int | None = None,
        background: str | None = None,
        time: float | None = None,
        orthographic: bool = False,
        set: dict[str, Any] | None = None,
        **camera: Any,
    ) -> Picture:
        """Draws the scene. The picture unpacks into an array of shape (h, w, 4), uint8, and :class:`Layers`.

        ``size``: width and height in pixels; by default that of the scene, or (1024, 768). ``strategy``: how caps are drawn; default
        ``"auto"``, and ``"exact"`` runs on the CPU. ``style``: a name or file; default ``"technical"``. ``supersample``: 1 to 4; default 2.
        ``background``: ``"transparent"``, ``"paper"``, ``"gradient"`` or a colour. ``time``: the time in seconds of a moving scene.

        ``camera``: ``azimuth_deg``, ``elevation_deg``, ``position``, ``focal_point``, ``view_up``, ``view`` (``"iso"``, ``"cut"``, ``"front"``, ...),
        ``zoom``, ``pan``, ``fit``, ``up``, ``fov_y_deg``. ``set``: any values of the scene, by path.

        All arguments apply to this picture only. It equals that of ``cutaway render``. Warns if the picture may be wrong.
        """
        asked = _asked(size, time, set)
        for path, value in (("style", style), ("supersample", supersample), ("background", background), ("strategy.name", strategy)):
            if value is not None:
                asked[path] = value
        drawn = self._scene.render(asked, _camera(camera, orthographic))
        warn(drawn["doubts"])
        return Picture(drawn["rgba"], Layers(**drawn["layers"]), drawn["strategy"])

    def section(self, plane: str, *, time: float | None = None) -> Section:
        """Section of the parts at a time by a plane, as polygons with holes, and its area. The cuts of the scene are ignored.

        ``polygons, area = scene.section("z=50%")``; make each a ``shapely.Polygon(*polygon)``. Computed in float64; needs no device.
        Warns if an outline does not close.
        """
        found = self._scene.section(_text("plane", plane), _asked(None, time, None))
        warn(found["doubts"])
        vectors = {key: np.array(found[key]) for key in ("origin", "u", "v", "normal")}  # type: ignore[literal-required]
        polygons = [Polygon(outer, holes) for outer, holes in found["polygons"]]
        return Section(polygons, found["area"], found["parts"], found["perimeter"], doubts=found["doubts"], **vectors)

    def capped(self, *, relief_cells: int = 256, watertight: bool = True, time: float | None = None) -> Half:
        """The kept and the removed half of the scene as meshes with caps: ``trimesh.Trimesh(*scene.capped().arrays)``.

        Each part is a separate solid. Planes cut exactly. Reliefs and cutters can cut only closed meshes; a relief is approximated by
        ``relief_cells`` cells along the longer side of a part. Computed in float64; needs no device.

        ``watertight``: if a half is open, raise a ``ValueError`` that names the part and a position; if false, only warn.
        """
        try:
            relief_cells = min(max(operator.index(relief_cells), 0), 2**32 - 1)
        except TypeError:
            raise refuse("relief_cells", f"{relief_cells!r} is no whole number", "256 is usual") from None
        divided = self._scene.capped(relief_cells, _asked(None, time, None))
        halves: dict[str, list[Solid]] = {"kept": [], "removed": []}
        doubts = []
        for part in divided:
            faults = [f"part `{part['name']}`: {doubt}" for doubt in part["doubts"]]
            for which, solids in halves.items():
                flat = dict(part[which])  # type: ignore[literal-required]
                opened = flat.pop("open")
                if opened is not None:
                    count, at = opened
                    place = ", ".join(f"{c:.6g}" for c in at)
                    faults.append(
                        f"part `{part['name']}`: its {which} half is open at {count} edges, one at ({place})"
                        "\n  help: close the mesh there before adding it, or accept open halves with capped(watertight=False)"
                    )
                if len(flat["faces"]):
                    solids.append(Solid(name=part["name"], **flat))
            doubts += faults
        if doubts and watertight:
            raise ValueError(doubts[-1] if len(doubts) == 1 else f"{doubts[-1]}\n  and {len(doubts) - 1} more of this kind")
        warn(doubts)
        off = max((part["relief_off"] for part in divided), default=0.0)
        return Half.pair(halves["kept"], halves["removed"], off)

    def compare(
        self,
        strategies: str | Iterable[str] = "all",
        *,
        size: tuple[int, int] | None = None,
        rounds: int = 9,
        time: float | None = None,
        orthographic: bool = False,
        set: dict[str, Any] | None = None,
        **camera: Any,
    ) -> dict[str, Any]:
        """Compares strategies with the exact reference. Returns their errors, times and bytes, as in the JSON of ``cutaway compare``.

        ``rounds``: number of timed rounds, after one warm-up round. ``Ctrl-C`` ends the comparison after the current frame.
        """
        names = _texts("strategies", strategies)
        try:
            count = operator.index(rounds)
        except TypeError:
            count = 0
        if not 1 <= count <= 10_000:
            raise refuse("rounds", f"{rounds!r} is not from 1 to 10000", "9 is usual")
        asked = _asked(size, time, set)
        command = f"scene.compare({names!r}, rounds={count})"
        return json.loads(self._scene.compare(names, count, asked, _camera(camera, orthographic), command))

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes a scene file; the command and the window draw the same from it. Arrays become ``.ply`` files in the same folder.

        Without ``overwrite``, raises ``FileExistsError`` if a file exists with other contents. No file is ever written partially.
        """
        name = _path("path", path)
        if not name.lower().endswith(".toml"):
            raise refuse(name, "a scene file ends in .toml", "give another name; pictures are saved by Picture.save")
        text, beside = self._scene.saved(name)
        folder = os.path.dirname(os.path.abspath(name))
        if not os.path.isdir(folder):
            raise FileNotFoundError(f"{folder}: there is no such folder\n  help: create it, or save elsewhere")
        files = [(os.path.join(folder, file), data) for file, data in beside]
        files.append((os.path.abspath(name), text.encode()))
        for file, data in files:
            if not overwrite and os.path.exists(file) and not _holds(file, data):
                raise FileExistsError(f"{file}: it holds something else\n  help: save elsewhere, or pass overwrite=True")
        for file, data in files:
            _write(file, data)

    def __str__(self) -> str:
        return self._scene.text()

    def __repr__(self) -> str:
        return f"Scene(parts={self.parts!r}, cuts={self.cuts!r})"


def _holds(file: str, data: bytes) -> bool:
    try:
        with open(file, "rb") as there:
            return there.read() == data
    except OSError:
        return False


def _write(file: str, data: bytes) -> None:
    handle, beside = tempfile.mkstemp(dir=os.path.dirname(file), prefix=".cutaway-")
    try:
        with os.fdopen(handle, "wb") as out:
            out.write(data)
        os.chmod(beside, 0o644)
        os.replace(beside, file)
    except BaseException:
        os.unlink(beside)
        raise


def _text(what: str, value: Any) -> str:
    if isinstance(value, str):
        try:
            value.encode()
        except UnicodeEncodeError:
            raise refuse(what, "it is no valid Unicode text", "give a text") from None
        return value
    raise refuse(f"{what} of type {type(value).__name__}", "it is no text", "give a text")


def _path(what: str, value: Any) -> str:
    try:
        path = os.fspath(value)
    except TypeError:
        raise refuse(f"{what} of type {type(value).__name__}", "it is no path", "give a file name") from None
    return _text(what, os.fsdecode(path) if isinstance(path, bytes) else path)


def _texts(what: str, values: Any) -> list[str]:
    if isinstance(values, str):
        return [values]
    if not isinstance(values, Iterable):
        raise refuse(f"{what} of type {type(values).__name__}", "it is no text", "give a text, or a list of them")
    return [_text(what, v) for v in values]


def _each(what: str, values: Any, words: list[str], without: Any) -> list[Any]:
    """Returns one value per section. A list must have one entry per section; a single value requires a single section."""
    if values is None or isinstance(values, (str, bool)):
        if values in (None, False):
            return [without] * len(words)
        values = [values]
    values = list(values)
    if len(values) != len(words):
        raise refuse(what, f"there are {len(values)} for {len(words)} sections", "give a list with one for each section")
    return values


def _asked(size: Any, time: Any, values: dict[str, Any] | None) -> dict[str, Any]:
    asked = dict(values or {})
    for path in asked:
        _text("path", path)
    if size is not None:
        asked["resolution"] = size
    if time is not None:
        asked["time_s"] = time
    return asked


def _camera(camera: dict[str, Any], orthographic: bool) -> dict[str, Any]:
    unknown = [key for key in camera if key not in CAMERA]
    if unknown:
        raise TypeError(f"unexpected keyword argument {unknown[0]!r}; the arguments of the camera are: {', '.join(CAMERA)}")
    aimed = {key: value for key, value in camera.items() if value is not None}
    if orthographic:
        aimed["projection"] = "orthographic"
    return aimed
