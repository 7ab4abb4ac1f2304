"""Cuts solid triangle meshes with planes and relief clip-surfaces, and draws the caps.

>>> import cutaway
>>> scene = cutaway.Scene("shape:gears")
>>> scene.cut("x=50%", relief="fractal:amplitude=4%")
>>> rgba, layers = scene.render(size=(640, 480))
>>> polygons, area = scene.section("z=50%")
>>> half = scene.capped()

Lengths are in units of the model, angles in degrees (``_deg``), times in seconds. Arrays that go in are copied.

Errors: ``ValueError`` for what makes no sense, with a ``help:`` line; ``FileNotFoundError`` for a file that is not there;
``RuntimeError`` where there is nothing to draw on. Doubts about a result are warnings of the class :class:`CutawayWarning`.
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
