"""Depth and nearest point of points in a surface of triangles, or of thick points and lines."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_CHUNK = 200_000
"""pairs of a point and a triangle at a time: what memory bears"""


class Nearest(NamedTuple):
    """Of points, the nearest one of a surface.

    Attributes:
        distance: (n,) from the surface, below zero inside [m].
        normal: (n, 3) outward, along the shortest way.
        vertices: (n, k) those whose mean, by `weights` (n, k), is the nearest point.
    """

    distance: Floats
    normal: Floats
    vertices: Ints
    weights: Floats


def nearest_on(places: Floats, triangles: Ints, points: Floats, *, closed: bool) -> Nearest:
    """Nearest points of triangles (t, 3) between vertices `places` (v, 3) [m].

    A point is inside where the triangles subtend more than half of the sphere (Van Oosterom and
    Strackee, 1983), or, of an open surface, where it is behind the nearest triangle.
    """
    number, weights = np.empty(len(points), int), np.empty((len(points), 3))
    turns = np.zeros(len(points))
    corners = places[triangles]
    chunk = max(1, _CHUNK // max(1, len(triangles)))
    for first in range(0, len(points), chunk):
        some = slice(first, first + chunk)
        found, at = _barycentric(corners, points[some])
        number[some], weights[some] = found, at
        if closed:
            turns[some] = _turns(corners, points[some])
    nearest = np.einsum("nk,nkx->nx", weights, corners[number])
    a, b, c = np.moveaxis(corners[number], 1, 0)
    outward = np.cross(b - a, c - a)
    outward /= np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-300)
    way = points - nearest
    distance = np.linalg.norm(way, axis=1)
    inside = turns > 0.5 if closed else np.einsum("nx,nx->n", way, outward) < 0.0
    sign = np.where(inside, -1.0, 1.0)
    scale = np.linalg.norm(np.ptp(places, axis=0))
    apart = distance > 1e-9 * scale
    normal = np.where(apart[:, None], sign[:, None] * way, outward)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return Nearest(sign * distance, normal, triangles[number], weights)


def nearest_on_lines(places: Floats, edges: Ints, radius: Floats, points: Floats) -> Nearest:
    """Nearest points of lines (k, 2) of a thickness; an edge with equal ends is a ball."""
    a, b = places[edges[:, 0]], places[edges[:, 1]]
    way = b - a
    square = np.maximum(np.einsum("kx,kx->k", way, way), 1e-300)
    share = np.einsum("nkx,kx->nk", points[:, None] - a, way) / square
    share = np.clip(share, 0.0, 1.0)
    off = points[:, None] - a - share[..., None] * way
    thick = radius[edges].mean(axis=1)
    distance = np.linalg.norm(off, axis=2) - thick
    number = distance.argmin(axis=1)
    rows = np.arange(len(points))
    normal = off[rows, number]
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.where(length > 0.0, normal / np.maximum(length, 1e-300), [0.0, 0.0, 1.0])
    at = share[rows, number]
    return Nearest(distance[rows, number], normal, edges[number], np.column_stack([1 - at, at]))


def _turns(corners: Floats, points: Floats) -> Floats:
    """How often triangles (t, 3, 3) go round points (n, 3): 1 inside a closed surface."""
    a, b, c = (corners[None, :, k] - points[:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    ab, bc, ca = ((x * y).sum(axis=2) for x, y in ((a, b), (b, c), (c, a)))
    solid = np.arctan2((a * np.cross(b, c)).sum(axis=2), la * lb * lc + ab * lc + bc * la + ca * lb)
    return np.asarray(solid.sum(axis=1) / (2.0 * np.pi))


def _barycentric(corners: Floats, points: Floats) -> tuple[Ints, Floats]:
    """Of each point the nearest triangle, and the weights of its corners in the nearest point."""
    a, b, c = (corners[None, :, k] for k in range(3))
    p = points[:, None]
    ab, ac = b - a, c - a
    normal = np.cross(ab, ac)
    square = np.maximum((normal * normal).sum(axis=2), 1e-300)
    v = (np.cross(p - a, ac) * normal).sum(axis=2) / square
    w = (np.cross(ab, p - a) * normal).sum(axis=2) / square
    inside = (v >= 0.0) & (w >= 0.0) & (v + w <= 1.0)
    height = ((p - a) * normal).sum(axis=2) ** 2 / square
    best = np.where(inside, height, np.inf)
    weights = np.stack([1.0 - v - w, v, w], axis=2)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        from_, to = corners[None, :, i], corners[None, :, j]
        way = to - from_
        length = np.maximum((way * way).sum(axis=2), 1e-300)
        share = np.clip(((p - from_) * way).sum(axis=2) / length, 0.0, 1.0)
        off = p - from_ - share[..., None] * way
        far = (off * off).sum(axis=2)
        nearer = far < best
        best = np.where(nearer, far, best)
        here = np.zeros_like(weights)
        here[..., i], here[..., j] = 1.0 - share, share
        weights = np.where(nearer[..., None], here, weights)
    number = best.argmin(axis=1)
    return number.astype(np.int32), weights[np.arange(len(points)), number]
