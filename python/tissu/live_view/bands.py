"""Filled contours: triangles cut where a value at their corners passes from one band to the next.

The page paints a mesh in one colour, so that a field is a mesh for each of its bands.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Band:
    """The part of a surface whose values lie in one band.

    Attributes:
        number: of the band, from 0.
        points: (p, 3) float32.
        triangles: (t, 3) numbers of points.
    """

    number: int
    points: NDArray[np.float32]
    triangles: NDArray[np.uint32]


def bands(
    points: NDArray[np.float32],
    triangles: Ints,
    values: Floats,
    *,
    limits: tuple[float, float],
    count: int,
) -> list[Band]:
    """The surface in bands between the limits; values beyond them are in the first or last one.

    Between the corners of a triangle the value is linear. Points that triangles of a band share are
    shared in it too, so that shading stays smooth.

    Args:
        points: (n, 3) [m].
        triangles: (t, 3) numbers of points.
        values: (n,); where one is not finite it is in the first band.
        limits: values at the lower end of the first band and at the upper end of the last one.
        count: of bands.
    """
    low, high = limits
    scale = count / (high - low) if high > low else 0.0
    level = np.clip(np.nan_to_num((values - low) * scale, nan=0.0), 0.0, count * (1.0 - 1e-9))
    of_corner = np.floor(level).astype(np.int64)[triangles]
    inside = (of_corner == of_corner[:, :1]).all(axis=1)
    crossed = triangles[~inside]
    found = []
    for number in range(count):
        whole = triangles[inside & (of_corner[:, 0] == number)]
        parts = [(points[whole.ravel()], whole.ravel()), _cut(points, crossed, level, number)]
        at = np.concatenate([part for part, _ in parts])
        keys, first, place = np.unique(
            np.concatenate([key for _, key in parts]), return_index=True, return_inverse=True
        )
        if len(keys):
            found.append(Band(number, at[first], place.reshape(-1, 3).astype(np.uint32)))
    return found


def _cut(
    points: NDArray[np.float32], triangles: Ints, level: Floats, number: int
) -> tuple[NDArray[np.float32], Ints]:
    """Corners (3 m, 3) of what lies in one band of triangles that lie in several, with their keys.

    Equal keys are equal points: the number of a node, or one for a level on an edge.
    """
    lowest, highest = level[triangles].min(axis=1), level[triangles].max(axis=1)
    some = triangles[(lowest < number + 1) & (highest > number)]
    order = np.argsort(level[some], axis=1, kind="stable")
    a, b, c = np.take_along_axis(some, order, axis=1).T
    odd = (order[:, 0] > order[:, 1]) ^ (order[:, 1] > order[:, 2]) ^ (order[:, 0] > order[:, 2])
    low, high = np.maximum(number, level[a]), np.minimum(number + 1, level[c])
    middle = np.clip(level[b], low, high)

    def on(start: Ints, end: Ints, at: Floats) -> tuple[NDArray[np.float32], Ints]:
        span = level[end] - level[start]
        share = np.where(span > 0, (at - level[start]) / np.where(span > 0, span, 1.0), 0.0)
        place = points[start] + share[:, None].astype(np.float32) * (points[end] - points[start])
        first, last = np.minimum(start, end), np.maximum(start, end)
        edge = (first * len(points) + last) * 2 + (at > number) + len(points)
        return place, np.where(share <= 0, start, np.where(share >= 1, end, edge))

    def along(at: Floats) -> tuple[NDArray[np.float32], Ints]:
        """On the way from a over b to c."""
        early = at < level[b]
        return on(np.where(early, a, b), np.where(early, b, c), at)

    corners = [on(a, c, low), on(a, c, high), along(high), along(middle), along(low)]
    at = np.stack([place for place, _ in corners], axis=1)  # (m, 5, 3)
    keys = np.stack([key for _, key in corners], axis=1)
    fan = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    turned = np.where(odd[:, None, None], fan, fan[:, ::-1])  # (m, 3, 3)
    rows = np.arange(len(some))[:, None, None]
    at, keys = at[rows, turned].reshape(-1, 3, 3), keys[rows, turned].reshape(-1, 3)
    real = (keys[:, 0] != keys[:, 1]) & (keys[:, 1] != keys[:, 2]) & (keys[:, 0] != keys[:, 2])
    return at[real].reshape(-1, 3), keys[real].ravel()
