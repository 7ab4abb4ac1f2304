"""Cuts solid triangle meshes with planes and relief clip-surfaces, and draws the caps.

>>> import cutaway
>>> scene = cutaway.Scene("shape:gears")
>>> scene.cut("x=50%", relief="fractal:amplitude=4%")
>>> rgba, layers = scene.render(size=(640, 480))
>>> polygons, area = scene.section("z=50%")
>>> half = scene.capped()

Lengths are in units of the model, angles in degrees (``_deg``), times in seconds. Input arrays are copied.

Errors: ``ValueError`` for invalid input, with a ``help:`` line; ``FileNotFoundError`` for a missing file; ``RuntimeError`` if no
graphics adapter is available. If a result may be wrong, a :class:`CutawayWarning` is issued.
"""

from ._native import __version__, adapter, values
from ._results import CutawayWarning, Half, Layers, Picture, Polygon, Section, Solid
from ._scene import Scene
from ._viewer import show

__all__ = [
    "CutawayWarning",
    "Half",
    "Layers",
    "Picture",
    "Polygon",
    "Scene",
    "Section",
    "Solid",
    "__version__",
    "adapter",
    "show",
    "values",
]
