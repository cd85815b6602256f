"""The point of a set of triangles that is nearest to a point, by a tree of boxes."""

from __future__ import annotations

import math

import numpy as np

from tissu.mesh.cell import Floats
from tissu.sampling.region import Indices

_BRANCHES = 4
_CHUNK = 4096  # points at a time: a few ten thousand pairs at each level of the tree


class TriangleTree:
    """Boxes around triangles, around four of these boxes, and so on up to one.

    All points walk down together: of the boxes of a level, a point keeps those that can hold
    something nearer than what it has seen.
    """

    def __init__(self, corners: Floats) -> None:
        """Corners (t, 3, 3) [m]."""
        self._corners = corners[_along_a_curve(corners.mean(axis=1))]
        low, high = self._corners.min(axis=1), self._corners.max(axis=1)
        sample = self._corners[:, 0]
        self._levels = [(low, high, sample)]
        while len(low) > _BRANCHES:
            starts = np.arange(0, len(low), _BRANCHES)
            low = np.minimum.reduceat(low, starts)
            high = np.maximum.reduceat(high, starts)
            sample = sample[np.minimum(starts + _BRANCHES // 2, len(sample) - 1)]
            self._levels.append((low, high, sample))

    @property
    def bounds(self) -> Floats:
        """Smallest and largest coordinates (2, 3) [m]."""
        low, high, _ = self._levels[-1]
        return np.array([low.min(axis=0), high.max(axis=0)])

    @property
    def nodes(self) -> Floats:
        """Positions (n, 3) [m] of the corners, each once."""
        return np.unique(self._corners.reshape(-1, 3), axis=0)

    def nearest(self, points: Floats, limit: float = math.inf) -> tuple[Floats, Floats]:
        """Nearest points (n, 3) and their distances (n,) [m]; NaN and infinity beyond `limit`."""
        found, distance = np.full(points.shape, np.nan), np.full(len(points), np.inf)
        for start in range(0, len(points), _CHUNK):
            part = slice(start, start + _CHUNK)
            found[part], distance[part] = self._walk(points[part], limit)
        return found, distance

    def _walk(self, points: Floats, limit: float) -> tuple[Floats, Floats]:
        bound = np.full(len(points), limit * limit)
        top = len(self._levels[-1][0])
        who, node = np.repeat(np.arange(len(points)), top), np.tile(np.arange(top), len(points))
        for depth in range(len(self._levels) - 1, -1, -1):
            low, high, sample = self._levels[depth]
            seen = points[who]
            np.minimum.at(bound, who, _square(seen - sample[node]))
            gap = np.maximum(np.maximum(low[node] - seen, seen - high[node]), 0.0)
            least = _square(gap)
            keep = least <= bound[who] * (1.0 + 1e-12)
            who, node, least = who[keep], node[keep], least[keep]
            if depth:
                last = len(self._levels[depth - 1][0])
                who = np.repeat(who, _BRANCHES)
                node = (node[:, None] * _BRANCHES + np.arange(_BRANCHES)).ravel()
                who, node = who[node < last], node[node < last]
        found, best = np.full(points.shape, np.nan), np.full(len(points), np.inf)
        ahead = np.full(len(points), np.inf)
        np.minimum.at(ahead, who, least)
        first = least == ahead[who]  # the triangles that look nearest, then what they leave open
        self._improve(points, who[first], node[first], found, best)
        rest = ~first & (least < best[who])
        self._improve(points, who[rest], node[rest], found, best)
        beyond = best > limit * limit
        found[beyond], best[beyond] = np.nan, np.inf
        return found, np.sqrt(best)

    def _improve(
        self, points: Floats, who: Indices, triangle: Indices, found: Floats, best: Floats
    ) -> None:
        """Takes over what is nearer among pairs of a point and a triangle; squares in `best`."""
        for start in range(0, len(who), 200_000):
            part = slice(start, start + 200_000)
            seen, asked = who[part], points[who[part]]
            place = closest_on_triangles(asked, self._corners[triangle[part]])
            away = _square(place - asked)
            np.minimum.at(best, seen, away)
            nearest = away == best[seen]
            found[seen[nearest]] = place[nearest]


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


def _along_a_curve(centres: Floats) -> Indices:
    """An order in which neighbours stay together: of the bits of x, y, z in turn (Morton)."""
    low, size = centres.min(axis=0), np.ptp(centres, axis=0).max()
    places = ((centres - low) * (1023.0 / (size if size > 0.0 else 1.0))).astype(np.int64)
    key = np.zeros(len(centres), dtype=np.int64)
    for bit in range(10):
        for axis in range(3):
            key |= ((places[:, axis] >> bit) & 1) << (3 * bit + axis)
    return np.argsort(key, kind="stable")


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(np.einsum("ij,ij->i", a, b))


def _square(vectors: Floats) -> Floats:
    return _dot(vectors, vectors)
