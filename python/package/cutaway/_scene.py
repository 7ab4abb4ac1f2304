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
"""Keys of ``camera`` that calls take as they are."""


class Scene:
    """What is cut, how, and from where it is seen.

    A scene is a document, as a scene file has it: :meth:`get` and :meth:`set` take the paths that ``cutaway scene`` lists, :meth:`save` writes
    the file. It always makes sense: a change that does not is refused, and leaves it as it was.

    Files are read once; a file that changed is read again by a new scene. Scenes may be used from several threads; what draws is one
    device, and frames take turns on it. Ctrl-C is raised within a second; what was under way goes on to its end beside,
    and the next call that needs the same scene or the device waits for it.

    ``copy.copy`` and ``copy.deepcopy`` make an independent scene. A pickled scene holds its arrays, and names files by their whole paths:
    they are read again where it is unpickled.
    """

    def __init__(self, *models: Any) -> None:
        """An empty scene, or one of models: whatever :meth:`add` takes."""
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
        """A scene file (``.toml``), a mesh file (``.stl``, ``.ply``, ``.obj``, ``.glb``, ``.gltf``, ``.3mf``) or ``shape:NAME``.

        Raises ``FileNotFoundError`` for a file that is not there, and ``ValueError`` for one that is not what its name says.
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

        ``add("tube", vertices, faces)``: a name and arrays, (n, 3) numbers and (m, 3) whole numbers from 0, counter-clockwise seen from
        outside. Vertices of equal coordinates become one where the mesh is open, as those of files do.

        ``add(mesh)``: what has ``vertices`` and ``faces`` (trimesh) or ``points`` and ``faces`` (PyVista).

        ``add("bracket.stl")``: a file of meshes, or a built-in shape, ``"shape:crank?throws=3"``.

        ``fields`` are keys of ``[[part]]``: ``role="interior"``, ``translate=[0, 0, 1]``, ``material={"color": "#8a94a6"}``.
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
                    "give the name of a file, a mesh of trimesh or PyVista, or a name and two arrays",
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
        """Adds a cut. Within one call what all of its words remove is removed; several cuts remove what any of them does.

        ``sections``: planes, of which the side of the normal stays: ``"z=10"``, ``"-z=50%"`` (of the bounds), ``"nx,ny,nz@px,py,pz"``.

        ``relief``: makes a section ragged: ``"fractal:amplitude=4%,seed=7"``, or ``sawtooth``, ``waves``, ``cracks``, ``steps`` or an image file;
        of several sections a list. ``flip`` keeps the other side.

        ``box``: ``"0,0,0:1,1,1"`` or ``"50%,50%,50%:"``. ``wedge``: ``"z:0:90"``. ``cutter``: a mesh file or ``shape:NAME``.
        ``cutout`` and ``breakaway``: ``True``, or their words.

        ``applies_to``, ``exclude``: globs of the names of parts.
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
        """The value at a path, as it was set: a bool, number, text, list or dict."""
        return self._scene.get(_text("path", path))

    def remove(self, path: str) -> None:
        """Takes a value away, so that the usual one holds; also a part or a cut."""
        self._scene.remove(_text("path", path))

    @property
    def parts(self) -> list[str]:
        """Names of the parts, in the order of their numbers in layers."""
        return self._scene.parts()[0]

    @property
    def cuts(self) -> list[str]:
        """Names of the cuts, by which paths go on: ``cut.NAME.surfaces.0.section``."""
        return self._scene.cuts()

    @property
    def notes(self) -> list[str]:
        """What was welded, left out or left open in what was read."""
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
        """Draws it: a picture, which unpacks into an array of shape (h, w, 4), uint8, and :class:`Layers`.

        ``size``: width and height in pixels; that of the scene, or (1024, 768). ``strategy``: how caps are drawn, ``"auto"`` by itself;
        ``"exact"`` on the CPU. ``style``: ``"technical"`` by itself, or another name or file. ``supersample``: 1 to 4; 2 by itself.
        ``background``: ``"transparent"``, ``"paper"``, ``"gradient"`` or a colour. ``time``: seconds, of a scene that moves.

        ``camera``: ``azimuth_deg``, ``elevation_deg``, ``position``, ``focal_point``, ``view_up``, ``view`` (``"iso"``, ``"cut"``, ``"front"``, ...),
        ``zoom``, ``pan``, ``fit``, ``up``, ``fov_y_deg``. ``set``: any values of the scene by their paths.

        All of them hold for this picture alone. What is drawn is what ``cutaway render`` draws. Warns where it may be wrong.
        """
        asked = _asked(size, time, set)
        for path, value in (("style", style), ("supersample", supersample), ("background", background), ("strategy.name", strategy)):
            if value is not None:
                asked[path] = value
        drawn = self._scene.render(asked, _camera(camera, orthographic))
        warn(drawn["doubts"])
        return Picture(drawn["rgba"], Layers(**drawn["layers"]), drawn["strategy"])

    def section(self, plane: str, *, time: float | None = None) -> Section:
        """What a plane cuts out of the parts as they stand, whatever the cuts of the scene are: polygons with holes, and their area.

        ``polygons, area = scene.section("z=50%")``; ``shapely.Polygon(*polygon)`` takes each. Computed in float64; needs no device.
        Warns where an outline does not close.
        """
        found = self._scene.section(_text("plane", plane), _asked(None, time, None))
        warn(found["doubts"])
        vectors = {key: np.array(found[key]) for key in ("origin", "u", "v", "normal")}  # type: ignore[literal-required]
        polygons = [Polygon(outer, holes) for outer, holes in found["polygons"]]
        return Section(polygons, found["area"], found["parts"], found["perimeter"], doubts=found["doubts"], **vectors)

    def capped(self, *, relief_cells: int = 256, watertight: bool = True, time: float | None = None) -> Half:
        """What the cuts leave, and what they remove, as meshes with caps: ``trimesh.Trimesh(*scene.capped().arrays)``.

        Each part is a solid of its own. Planes cut exactly; reliefs and cutters cut closed meshes, reliefs with so many cells along the
        longer side of a part. Computed in float64; needs no device.

        ``watertight``: raise ``ValueError`` where a half is open, with the part and a place; without it that is a warning.
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
                        f"part `{part['name']}`: what is {which} is open at {count} edges, one at ({place})"
                        "\n  help: close the mesh there before it is added, or take it as it is by capped(watertight=False)"
                    )
                if len(flat["faces"]):
                    solids.append(Solid(name=part["name"], **flat))
            doubts += faults
        if doubts and watertight:
            raise ValueError(doubts[-1] if len(doubts) == 1 else f"{doubts[-1]}\n  beside: {len(doubts) - 1} more of this kind")
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
        """Strategies against the exact reference: their errors, times and bytes, as the JSON of ``cutaway compare`` has them.

        ``rounds``: how often time is taken, after one to warm up. ``Ctrl-C`` ends it after the present frame.
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
        """Writes a scene file, from which the command and the window draw the same. Arrays become ``.ply`` files beside it.

        Raises ``FileExistsError`` where a file would be replaced by another, but for ``overwrite``. A file is written as a whole or not at all.
        """
        name = _path("path", path)
        if not name.lower().endswith(".toml"):
            raise refuse(name, "a scene file ends in .toml", "give another name; pictures are saved by Picture.save")
        text, beside = self._scene.saved(name)
        folder = os.path.dirname(os.path.abspath(name))
        if not os.path.isdir(folder):
            raise FileNotFoundError(f"{folder}: there is no such folder\n  help: make it, or save elsewhere")
        files = [(os.path.join(folder, file), data) for file, data in beside]
        files.append((os.path.abspath(name), text.encode()))
        for file, data in files:
            if not overwrite and os.path.exists(file) and not _holds(file, data):
                raise FileExistsError(f"{file}: it holds something else\n  help: save elsewhere, or with overwrite=True")
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
            raise refuse(what, "it is no text in Unicode", "give a text") from None
        return value
    raise refuse(f"{what} of type {type(value).__name__}", "it is no text", "give a text")


def _path(what: str, value: Any) -> str:
    try:
        path = os.fspath(value)
    except TypeError:
        raise refuse(f"{what} of type {type(value).__name__}", "it is no path", "give the name of a file") from None
    return _text(what, os.fsdecode(path) if isinstance(path, bytes) else path)


def _texts(what: str, values: Any) -> list[str]:
    if isinstance(values, str):
        return [values]
    if not isinstance(values, Iterable):
        raise refuse(f"{what} of type {type(values).__name__}", "it is no text", "give a text, or a list of them")
    return [_text(what, v) for v in values]


def _each(what: str, values: Any, words: list[str], without: Any) -> list[Any]:
    """One value for each section: of a list its own, of one value that of the only section."""
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
        raise TypeError(f"unexpected keyword argument {unknown[0]!r}; of a camera there are: {', '.join(CAMERA)}")
    aimed = {key: value for key, value in camera.items() if value is not None}
    if orthographic:
        aimed["projection"] = "orthographic"
    return aimed
