"""Height fields: the relief of a clip-surface as a closed mesh that can be subtracted.

The surface is `(P - O).N = -f Sz`, where f is bilinear between the texel centres of a map, as in this project's definition. Lines
of the grid run through all texel centres and divide what is between them, so that a map without twist (saw-tooth, where height
varies along U alone) is met exactly; elsewhere two triangles stand for a bilinear quad, and their error falls by four with each
doubling of `divide`.
"""

from dataclasses import dataclass

import numpy as np


@dataclass
class Relief:
    """A map of shape (rows, columns), heights in 0..1, on a plane. `repeat` or clamp."""

    name: str
    texels: np.ndarray
    repeat: bool
    origin: np.ndarray
    u: np.ndarray
    v: np.ndarray
    scale: tuple
    more: str

    @property
    def frame(self):
        """Rows U/|U|, V/|V|, N."""
        u, v = (x / np.linalg.norm(x) for x in (self.u, self.v))
        return np.stack([u, v, np.cross(u, v)])

    @property
    def lengths(self):
        """Length of the map along U and along V."""
        return np.array([np.linalg.norm(self.u) / self.scale[0], np.linalg.norm(self.v) / self.scale[1]])

    def local(self, points):
        """Distances from the origin along U, V and N."""
        return (points - self.origin) @ self.frame.T

    def world(self, local):
        return self.origin + local @ self.frame

    def heights(self, along_u, along_v):
        """-f Sz on a grid of distances along U and V: shape (len(along_v), len(along_u))."""
        rows, columns = self.texels.shape
        x, x_part = self.cells(along_u / self.lengths[0] * columns - 0.5, columns)
        y, y_part = self.cells(along_v / self.lengths[1] * rows - 0.5, rows)
        across = self.texels[:, x[0]] * (1 - x_part) + self.texels[:, x[1]] * x_part
        f = across[y[0]] * (1 - y_part)[:, None] + across[y[1]] * y_part[:, None]
        return -f * self.scale[2]

    def cells(self, at, count):
        """Texels to both sides, and the share of the second."""
        # A line through a texel centre is meant to be there exactly.
        near = np.round(at)
        at = np.where(np.abs(at - near) < 1e-9, near, at)
        cell = np.floor(at).astype(int)
        both = (cell, cell + 1)
        wrapped = [c % count if self.repeat else c.clip(0, count - 1) for c in both]
        return wrapped, at - cell

    def lines(self, axis, least, most, divide):
        """Distances from `least` to `most`: both, the texel centres between them, and `divide` parts of each cell."""
        texel = self.lengths[axis] / self.texels.shape[1 - axis]
        first, last = np.ceil(least / texel - 0.5), np.floor(most / texel - 0.5)
        centres = (np.arange(first, last + 1) + 0.5) * texel
        if self.texels.shape[1 - axis] == 1 or self.is_straight(axis):
            centres, divide = centres[:0], 1
        elif not self.repeat:
            centres = centres[(centres > 0) & (centres < self.lengths[axis])]
        knots = np.unique(np.concatenate([[least], centres, [most]]))
        parts = [a + (b - a) * np.arange(divide) / divide for a, b in zip(knots[:-1], knots[1:])]
        return np.concatenate([*parts, [most]])

    def is_straight(self, axis):
        """Whether heights do not vary along U (0) or V (1)."""
        along = 1 - axis
        return np.all(self.texels == np.take(self.texels, [0], axis=along))


@dataclass
class Field:
    """The removed side below a relief, over a rectangle: a closed mesh, and the heights of its triangles."""

    relief: Relief
    along_u: np.ndarray
    along_v: np.ndarray
    heights: np.ndarray
    vertices: np.ndarray
    faces: np.ndarray

    def height_at(self, local):
        """Height of the triangles, not of the bilinear surface, below points in the frame of the relief."""
        i = np.searchsorted(self.along_u, local[:, 0], side="right").clip(1, len(self.along_u) - 1) - 1
        j = np.searchsorted(self.along_v, local[:, 1], side="right").clip(1, len(self.along_v) - 1) - 1
        s = (local[:, 0] - self.along_u[i]) / (self.along_u[i + 1] - self.along_u[i])
        t = (local[:, 1] - self.along_v[j]) / (self.along_v[j + 1] - self.along_v[j])
        a, b, c, d = (self.heights[j + y, i + x] for x, y in [(0, 0), (1, 0), (1, 1), (0, 1)])
        return np.where(s >= t, a + (b - a) * s + (c - b) * t, a + (c - d) * s + (d - a) * t)


def field_of(relief, mesh, divide):
    """The field over the bounds of a mesh and a margin, down past its lowest point."""
    local = relief.local(mesh.vertices)
    margin = 0.03 * mesh.diagonal
    least, most = local.min(axis=0) - margin, local.max(axis=0) + margin
    along_u = relief.lines(0, least[0], most[0], divide)
    along_v = relief.lines(1, least[1], most[1], divide)
    heights = relief.heights(along_u, along_v)
    floor = min(least[2], heights.min() - margin)
    x, y = np.meshgrid(along_u, along_v)
    top = np.stack([x.ravel(), y.ravel(), heights.ravel()], axis=1)
    bottom = np.stack([x.ravel(), y.ravel(), np.full(x.size, floor)], axis=1)
    columns, count = len(along_u), x.size
    i, j = (k.ravel() for k in np.meshgrid(np.arange(columns - 1), np.arange(len(along_v) - 1)))
    a = j * columns + i
    b, c, d = a + 1, a + 1 + columns, a + columns
    up = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    # Counter-clockwise from above, as the upper faces run.
    ring = np.concatenate(
        [
            np.arange(columns),
            np.arange(2, len(along_v)) * columns - 1,
            count - 1 - np.arange(columns),
            np.arange(len(along_v) - 2, 0, -1) * columns,
        ]
    )
    after = np.roll(ring, -1)
    walls = np.concatenate(
        [np.stack([ring, ring + count, after], axis=1), np.stack([after, ring + count, after + count], axis=1)]
    )
    faces = np.concatenate([up, up[:, ::-1] + count, walls])
    return Field(relief, along_u, along_v, heights, relief.world(np.concatenate([top, bottom])), faces)
