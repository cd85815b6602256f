"""Filled contours: which part of each triangle lies in which band of a field.

The page paints a mesh in one colour, so that a field is a mesh for each of its bands. Bands are
found from the values alone; where their points are follows from the nodes of each moment.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Points = NDArray[np.float32]

MOST_CUT = 20_000
"""Triangles of a surface up to which contours cut them; of a finer one each has one colour."""


@dataclass(frozen=True, slots=True, eq=False)
class Band:
    """The part of a surface whose values lie in one band.

    Attributes:
        number: of the band, from 0.
        nodes: (p,) node of each point, or at the lower end of the edge that it is on.
        ends: (p,) node at the other end of that edge; None: every point is a node.
        shares: (p, 1) float32, of the way from the one to the other.
        triangles: (t, 3) numbers of points.
    """

    number: int
    nodes: Ints
    ends: Ints | None
    shares: Points
    triangles: NDArray[np.uint32]

    def points(self, at: Points) -> Points:
        """Where its points (p, 3) are when the nodes of the surface are at (n, 3)."""
        start = at[self.nodes]
        if self.ends is None:
            return start
        return np.asarray(start + self.shares * (at[self.ends] - start))


def bands(
    triangles: Ints, values: Floats, *, limits: tuple[float, float], count: int
) -> list[Band]:
    """A surface in bands between the limits; values beyond them are in the first or last one.

    Up to `MOST_CUT` triangles the contours are exact: between the corners of a triangle the value
    is linear. On more, a triangle has the band of the mean of its corners.

    Args:
        triangles: (t, 3) numbers of nodes.
        values: (n,) at the nodes; where one is not finite it is in the first band.
        limits: values at the lower end of the first band and at the upper end of the last one.
        count: of bands.
    """
    low, high = limits
    scale = count / (high - low) if high > low else 0.0
    level = np.clip(np.nan_to_num((values - low) * scale, nan=0.0), 0.0, count * (1.0 - 1e-9))
    if len(triangles) > MOST_CUT:
        return _whole_bands(triangles, level)
    return _cut_bands(triangles, level, count)


def _whole_bands(triangles: Ints, level: Floats) -> list[Band]:
    """Every triangle in one band."""
    a, b, c = triangles.T
    of_triangle = ((level[a] + level[b] + level[c]) / 3.0).astype(np.uint8)
    order = np.argsort(of_triangle, kind="stable")  # of bytes it counts, and does not compare
    numbers, begins = np.unique(of_triangle[order], return_index=True)
    found, place = [], np.zeros(len(level), dtype=np.uint32)
    for number, mine in zip(numbers, np.split(order, begins[1:]), strict=True):
        corners = triangles[mine]
        met = np.zeros(len(level), dtype=bool)
        met[corners.ravel()] = True
        nodes = np.flatnonzero(met)
        place[nodes] = np.arange(len(nodes), dtype=np.uint32)
        shares = np.zeros((len(nodes), 1), dtype=np.float32)
        found.append(Band(int(number), nodes, None, shares, place[corners]))
    return found


def _cut_bands(triangles: Ints, level: Floats, count: int) -> list[Band]:
    """Triangles cut where the level at their corners passes from one band to the next.

    Points that triangles of a band share are shared in it too, so that shading stays smooth.
    """
    of_corner = np.floor(level).astype(np.int64)[triangles]
    inside = (of_corner == of_corner[:, :1]).all(axis=1)
    crossed = triangles[~inside]
    found = []
    for number in range(count):
        whole = triangles[inside & (of_corner[:, 0] == number)].ravel()
        cut = _cut(crossed, level, number)
        kept = (whole, whole, whole, np.zeros(len(whole)))
        keys, start, end, share = (
            np.concatenate([mine, others]) for mine, others in zip(kept, cut, strict=True)
        )
        keys, first, place = np.unique(keys, return_index=True, return_inverse=True)
        if len(keys):
            shares = share[first, None].astype(np.float32)
            corners = place.reshape(-1, 3).astype(np.uint32)
            found.append(Band(number, start[first], end[first], shares, corners))
    return found


def _cut(triangles: Ints, level: Floats, number: int) -> tuple[Ints, Ints, Ints, Floats]:
    """Corners (3 m,) of what lies in one band of triangles that lie in several.

    Of each its key, the two nodes between which it is, and its share of the way. Equal keys are
    equal points: the number of a node, or one for a level on an edge.
    """
    nodes = len(level)
    lowest, highest = level[triangles].min(axis=1), level[triangles].max(axis=1)
    some = triangles[(lowest < number + 1) & (highest > number)]
    order = np.argsort(level[some], axis=1, kind="stable")
    a, b, c = np.take_along_axis(some, order, axis=1).T
    odd = (order[:, 0] > order[:, 1]) ^ (order[:, 1] > order[:, 2]) ^ (order[:, 0] > order[:, 2])
    low, high = np.maximum(number, level[a]), np.minimum(number + 1, level[c])
    middle = np.clip(level[b], low, high)

    def on(start: Ints, end: Ints, at: Floats) -> tuple[Ints, Ints, Ints, Floats]:
        span = level[end] - level[start]
        share = np.where(span > 0, (at - level[start]) / np.where(span > 0, span, 1.0), 0.0)
        first, last = np.minimum(start, end), np.maximum(start, end)
        edge = (first * nodes + last) * 2 + (at > number) + nodes
        key = np.where(share <= 0, start, np.where(share >= 1, end, edge))
        return key, start, end, share.clip(0.0, 1.0)

    def along(at: Floats) -> tuple[Ints, Ints, Ints, Floats]:
        """On the way from a over b to c."""
        early = at < level[b]
        return on(np.where(early, a, b), np.where(early, b, c), at)

    corners = [on(a, c, low), on(a, c, high), along(high), along(middle), along(low)]
    fan = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    turned = np.where(odd[:, None, None], fan, fan[:, ::-1])  # (m, 3, 3)
    rows = np.arange(len(some))[:, None, None]
    every = [np.stack(column, axis=1) for column in zip(*corners, strict=True)]  # (m, 5) each
    keys, start, end, share = (one[rows, turned].reshape(-1, 3) for one in every)
    real = (keys[:, 0] != keys[:, 1]) & (keys[:, 1] != keys[:, 2]) & (keys[:, 0] != keys[:, 2])
    return keys[real].ravel(), start[real].ravel(), end[real].ravel(), share[real].ravel()
