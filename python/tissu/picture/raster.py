"""Which triangle is seen at each pixel: a z-buffer over the spans of all triangles at once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

FRAGMENTS = 3_000_000  # pixels of triangles that are held at once


@dataclass(frozen=True, slots=True)
class Seen:
    """What is seen at the covered pixels.

    Attributes:
        pixel: (p,) number of the pixel, row times width plus column.
        triangle: (p,) number of the triangle seen there.
        weights: (p,3) barycentric coordinates of the pixel's middle in that triangle.
        nearness: (p,) distance towards the viewer, in the unit of the corners.
    """

    pixel: Integers
    triangle: Integers
    weights: Array
    nearness: Array


def rasterise(corners: Array, triangles: Integers, size: tuple[int, int]) -> Seen:
    """The nearest triangle at the middle of each pixel.

    Args:
        corners: (n,3) column, row, nearness of each point, as from `Camera.project`.
        triangles: (t,3) numbers of the corners.
        size: width and height [pixels].
    """
    nearest = np.full(size[0] * size[1], -np.inf)
    owner = np.full(size[0] * size[1], -1, dtype=np.int64)
    plane = _planes(corners, triangles)
    depth = corners[:, 2][triangles]
    farthest, closest = depth.min(axis=1), depth.max(axis=1)
    for triangle, row, column in _fragments(corners, triangles, size):
        at = plane[triangle]
        z = at[:, 0] + at[:, 1] * (column + 0.5) + at[:, 2] * (row + 0.5)
        z = np.clip(z, farthest[triangle], closest[triangle])
        pixel = row * size[0] + column
        np.maximum.at(nearest, pixel, z)
        won = z == nearest[pixel]
        owner[pixel[won]] = triangle[won]
    pixel = np.flatnonzero(owner >= 0)
    middles = np.stack([pixel % size[0] + 0.5, pixel // size[0] + 0.5], axis=1)
    weights = _weights(corners[triangles[owner[pixel]]][:, :, :2], middles)
    return Seen(pixel, owner[pixel], weights, nearest[pixel])


def _planes(corners: Array, triangles: Integers) -> Array:
    """(t,3): nearness = a + b column + c row on each triangle."""
    a, b, c = (corners[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    steep = np.abs(normal[:, 2]) < 1e-12 * np.maximum(np.abs(normal).max(axis=1, initial=0), 1e-300)
    normal[steep] = (0.0, 0.0, 1.0)
    slope = -normal[:, :2] / normal[:, 2:]
    return np.column_stack([a[:, 2] - (slope * a[:, :2]).sum(axis=1), slope])


def _repeat(first: Integers, count: Integers) -> tuple[Integers, Integers]:
    """Runs first, first + 1, ... of `count` numbers each: which run, and the numbers."""
    run = np.repeat(np.arange(len(count)), count)
    start = np.cumsum(count) - count
    return run, first[run] + np.arange(len(run)) - start[run]


def _fragments(
    corners: Array, triangles: Integers, size: tuple[int, int]
) -> Iterator[tuple[Integers, Integers, Integers]]:
    """Triangle, row and column of every pixel whose middle a triangle covers, in portions."""
    triangle, row, first, count = _spans(corners, triangles, size)
    total = np.cumsum(count)
    start = 0
    while start < len(total):
        before = total[start - 1] if start else 0
        stop = max(int(np.searchsorted(total, before + FRAGMENTS, side="right")), start + 1)
        run, column = _repeat(first[start:stop], count[start:stop])
        yield triangle[start:stop][run], row[start:stop][run], column
        start = stop


def _spans(
    corners: Array, triangles: Integers, size: tuple[int, int]
) -> tuple[Integers, Integers, Integers, Integers]:
    """Triangle, row, first column and number of columns of every row that a triangle covers."""
    height = corners[:, 1][triangles]
    top = np.ceil(height.min(axis=1) - 0.5).clip(0, size[1]).astype(np.int64)
    bottom = np.ceil(height.max(axis=1) - 0.5).clip(0, size[1]).astype(np.int64)
    triangle, row = _repeat(top, bottom - top)
    y = row + 0.5
    left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    ordered = np.sort(triangles, axis=1)  # an edge is cut at the same place from both its sides
    for i, j in ((0, 1), (1, 2), (0, 2)):
        a, b = corners[ordered[triangle, i]], corners[ordered[triangle, j]]
        crosses = (a[:, 1] <= y) != (b[:, 1] <= y)
        rise = np.where(crosses, b[:, 1] - a[:, 1], 1.0)
        x = a[:, 0] + (y - a[:, 1]) / rise * (b[:, 0] - a[:, 0])
        left = np.where(crosses, np.minimum(left, x), left)
        right = np.where(crosses, np.maximum(right, x), right)
    reached = right > left
    triangle, row, left, right = triangle[reached], row[reached], left[reached], right[reached]
    first = np.ceil(left - 0.5).clip(0, size[0]).astype(np.int64)
    count = np.ceil(right - 0.5).clip(0, size[0]).astype(np.int64) - first
    some = count > 0
    return triangle[some], row[some], first[some], count[some]


def _weights(corners: Array, at: Array) -> Array:
    """Barycentric coordinates (p,3) of points (p,2) in triangles (p,3,2), kept within [0, 1]."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    u, v, w = b - a, c - a, at - a
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    area = np.where(np.abs(area) < 1e-300, 1e-300, area)
    second = ((w[:, 0] * v[:, 1] - w[:, 1] * v[:, 0]) / area).clip(0, 1)
    third = ((u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0]) / area).clip(0, 1)
    weights = np.column_stack([(1 - second - third).clip(0, 1), second, third])
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))
