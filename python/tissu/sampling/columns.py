"""Inside or outside: what a ray from the point crosses.

The winding number of a closed surface around p is the sum over the triangles above p of +1 where
they look up and -1 where they look down. Whether a triangle is above p is asked of its edges in
the plane across the ray, and an edge gives both its triangles the same answer, so that a ray
through an edge or a corner is counted once.
"""

from __future__ import annotations

import numpy as np

from tissu.mesh.cell import Floats, Ints
from tissu.sampling.nearest import closest_on_triangles
from tissu.sampling.region import Bools, Indices

ON_SURFACE = 1e-9
"""A point is on the surface when it is nearer than this part of the surface's diagonal."""
_PAIRS = 1_000_000


class Columns:
    """The triangles sorted into columns along the shortest side of their bounds."""

    def __init__(self, points: Floats, triangles: Ints) -> None:
        """Points (n, 3) [m], triangles (t, 3) of a closed surface."""
        axis = int(np.argmin(np.ptp(points[triangles], axis=(0, 1))))
        self._axes = [(axis + 1) % 3, (axis + 2) % 3, axis]  # cyclic: keeps what is right-handed
        turned = points[:, self._axes]
        self._corners = turned[triangles]
        low, high = self._corners.min(axis=1), self._corners.max(axis=1)
        self._tolerance = ON_SURFACE * float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
        self._low, self._high = low - self._tolerance, high + self._tolerance
        self._bounds = self._low.min(axis=0), self._high.max(axis=0)
        ends = triangles[:, [[0, 1], [1, 2], [2, 0]]]
        self._sense = np.where(ends[..., 0] < ends[..., 1], 1, -1)
        self._edges = turned[np.sort(ends, axis=2)][..., :2]
        a, b, c = self._corners.swapaxes(0, 1)
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        self._normal = normal / np.where(length > 0.0, length, 1.0)
        self._sort()

    def _sort(self) -> None:
        """Lists the triangles of each column: those whose bounds meet it."""
        low, high = self._bounds
        across = max(1, min(512, int(np.sqrt(len(self._corners)))))
        self._shape, self._step = across, (high - low)[:2] / across
        first, last = self._column(self._low[:, :2]), self._column(self._high[:, :2])
        size = last - first + 1
        count = size.prod(axis=1)
        triangle, place = _ranges(count)
        x = first[triangle, 0] + place % size[triangle, 0]
        y = first[triangle, 1] + place // size[triangle, 0]
        column = y * across + x
        self._listed = triangle[np.argsort(column, kind="stable")]
        self._count = np.bincount(column, minlength=across * across)
        self._start = np.concatenate([[0], np.cumsum(self._count)])[:-1]

    def _column(self, places: Floats) -> Indices:
        at = np.floor((places - self._bounds[0][:2]) / self._step).astype(np.int64)
        return np.asarray(np.clip(at, 0, self._shape - 1))

    def inside(self, points: Floats) -> Bools:
        """Which of the points (n, 3) are inside or on the surface."""
        turned = points[:, self._axes]
        low, high = self._bounds
        answer = np.zeros(len(points), dtype=bool)
        within = np.ones(len(points), dtype=bool)
        for axis in range(3):
            within &= (turned[:, axis] >= low[axis]) & (turned[:, axis] <= high[axis])
        near = np.flatnonzero(within)
        x, y = self._column(turned[near, :2]).T
        column = y * self._shape + x
        ends = np.cumsum(self._count[column])
        start = 0
        while start < len(near):
            before = ends[start - 1] if start else 0
            stop = max(start + 1, int(np.searchsorted(ends, before + _PAIRS)))
            part = slice(start, stop)
            answer[near[part]] = self._wound(turned[near[part]], column[part])
            start = stop
        return answer

    def _wound(self, points: Floats, column: Indices) -> Bools:
        who, place = _ranges(self._count[column])
        triangle = self._listed[self._start[column[who]] + place]
        for axis in range(3):  # a triangle below the point cannot cover it; one above can
            asked = points[who, axis]
            keep = asked <= self._high[triangle, axis]
            if axis < 2:
                keep &= asked >= self._low[triangle, axis]
            who, triangle = who[keep], triangle[keep]
        p = points[who]
        looks = self._looks(p, triangle)
        above = looks * (self._height(p, triangle) > p[:, 2])
        turns = np.bincount(who, weights=above, minlength=len(points))
        answer = turns > 0.5
        answer[who[self._touches(p, triangle)]] = True
        return np.asarray(answer)

    def _looks(self, p: Floats, triangle: Indices) -> Indices:
        """+1 for a triangle that covers p and looks up, -1 down, 0 that does not cover it."""
        edges = self._edges[triangle]
        s, e, q = edges[:, :, 0], edges[:, :, 1], p[:, None, :2]
        below = s[..., 1] <= q[..., 1]
        straddles = below != (e[..., 1] <= q[..., 1])
        left = (e[..., 0] - s[..., 0]) * (q[..., 1] - s[..., 1]) > (e[..., 1] - s[..., 1]) * (
            q[..., 0] - s[..., 0]
        )
        crossed = straddles & (left == below)  # to the right of p, along the first axis
        running = np.where(below, 1, -1) * self._sense[triangle]
        return np.asarray((crossed * running).sum(axis=1))

    def _height(self, p: Floats, triangle: Indices) -> Floats:
        """Where the ray meets the plane of the triangle, kept between the triangle's corners."""
        normal, a = self._normal[triangle], self._corners[triangle, 0]
        slope = normal[:, 2]
        fall = ((p - a)[:, :2] * normal[:, :2]).sum(axis=1)
        height = a[:, 2] - fall / np.where(slope == 0.0, 1.0, slope)
        low = self._low[triangle, 2] + self._tolerance
        return np.asarray(np.clip(height, low, self._high[triangle, 2] - self._tolerance))

    def _touches(self, p: Floats, triangle: Indices) -> Indices:
        """Numbers of the pairs of a point and a triangle it lies on."""
        off = np.abs(np.einsum("ij,ij->i", p - self._corners[triangle, 0], self._normal[triangle]))
        near = np.flatnonzero((off <= self._tolerance) & (p[:, 2] >= self._low[triangle, 2]))
        place = closest_on_triangles(p[near], self._corners[triangle[near]])
        return np.asarray(near[np.linalg.norm(place - p[near], axis=1) <= self._tolerance])


def _ranges(count: Indices) -> tuple[Indices, Indices]:
    """Number of the row, and number within it, for rows of the given lengths."""
    row = np.repeat(np.arange(len(count)), count)
    return row, np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
