"""The point of a set of triangles that is nearest to a point, by a tree of boxes."""

from __future__ import annotations

import math

import numpy as np

from tissu import _core
from tissu.mesh.cell import Floats


class TriangleTree:
    """Triangles in a tree of boxes, which the core walks down."""

    def __init__(self, corners: Floats) -> None:
        """Corners (t, 3, 3) [m]."""
        self._corners = corners
        self._tree = _core.TriangleTree(corners=np.ascontiguousarray(corners))
        self._threads = int(_core.build_info()["threads_available"])

    @property
    def bounds(self) -> Floats:
        """Smallest and largest coordinates (2, 3) [m]."""
        return np.array([self._corners.min(axis=(0, 1)), self._corners.max(axis=(0, 1))])

    @property
    def nodes(self) -> Floats:
        """Positions (n, 3) [m] of the corners, each once."""
        return np.unique(self._corners.reshape(-1, 3), axis=0)

    def nearest(self, points: Floats, limit: float | Floats = math.inf) -> tuple[Floats, Floats]:
        """Nearest points (n, 3) and their distances (n,) [m]; NaN and infinity beyond `limit`.

        The limit is one [m], or one for each point (n,). All threads of the machine look, and find
        the same on any number.
        """
        return self._tree.nearest(
            points=np.ascontiguousarray(points), reach=np.asarray(limit), threads=self._threads
        )


def closest_on_triangles(points: Floats, corners: Floats) -> Floats:
    """The point (n, 3) of triangle i (n, 3, 3) that is nearest to point i (n, 3)."""
    best = _on_segment(points, corners[:, 0], corners[:, 1])
    square = _square(best - points)
    for i, j in ((1, 2), (2, 0)):
        other = _on_segment(points, corners[:, i], corners[:, j])
        nearer = _square(other - points) < square
        best[nearer] = other[nearer]
        square = _square(best - points)
    a = corners[:, 0]
    ab, ac, ap = corners[:, 1] - a, corners[:, 2] - a, points - a
    bb, bc, cc, pb, pc = _dot(ab, ab), _dot(ab, ac), _dot(ac, ac), _dot(ap, ab), _dot(ap, ac)
    det = bb * cc - bc * bc
    u, v = cc * pb - bc * pc, bb * pc - bc * pb
    within = (u > 0.0) & (v > 0.0) & (u + v < det)
    u, v = u[within] / det[within], v[within] / det[within]
    best[within] = a[within] + u[:, None] * ab[within] + v[:, None] * ac[within]
    return best


def _on_segment(points: Floats, a: Floats, b: Floats) -> Floats:
    edge = b - a
    length = _dot(edge, edge)
    t = np.clip(_dot(points - a, edge) / np.where(length > 0.0, length, 1.0), 0.0, 1.0)
    return np.asarray(a + t[:, None] * edge)


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(np.einsum("ij,ij->i", a, b))


def _square(vectors: Floats) -> Floats:
    return _dot(vectors, vectors)
