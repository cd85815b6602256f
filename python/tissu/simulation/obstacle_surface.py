"""Obstacles as triangles, for pictures, pages and files; contact has their exact shapes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_ROUND = 24
"""Sides of a rod."""
_RINGS = 6
"""Rings of triangles on the half of a ball."""
_WIDE = 1.2
"""Side of the square that stands for a plane, as a share of the extent of the bodies at rest."""


class ObstacleSurface(NamedTuple):
    """The surface of an obstacle.

    Attributes:
        rest: points of it at rest (n, 3) [m]; those of round ones lie on the exact surface.
        points: where they are now (n, 3) [m].
        triangles: numbers of points (t, 3), anticlockwise seen from outside.
        endless: whether it stands for a plane, which has no end: a square that the plane holds.
    """

    rest: Floats
    points: Floats
    triangles: Ints
    endless: bool


def plane_square(origin: Floats, normal: Floats, bodies: Floats) -> tuple[Floats, Ints]:
    """A square of the plane below or above the middle of points (n, 3) of the bodies."""
    low, high = bodies.min(axis=0), bodies.max(axis=0)
    half = 0.5 * _WIDE * (float(np.linalg.norm(high - low)) or 1.0)
    middle = (low + high) / 2.0
    middle = middle - ((middle - origin) @ normal) * normal
    first, second = _across(normal)
    corners = [middle + half * (a * first + b * second) for a, b in _SQUARE]
    return np.array(corners), np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)


_SQUARE = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))


def round_surface(
    vertices: Floats, triangles: Ints, edges: Ints, points: Ints, radius: Floats
) -> tuple[Floats, Ints]:
    """Triangles as they are, a rod with round ends for each edge, and a ball for each point."""
    places, faces = [vertices[:0]], [np.empty((0, 3), dtype=np.int32)]
    if len(triangles):
        places, faces = [vertices], [triangles]
    ends = [(int(a), int(b)) for a, b in edges] + [(int(a), int(a)) for a in points]
    for a, b in ends:
        at, of_rod = _rod(vertices[a], vertices[b], float(radius[a]))
        faces.append(of_rod + sum(map(len, places)))
        places.append(at)
    return np.concatenate(places), np.concatenate(faces).astype(np.int32)


def _rod(start: Floats, end: Floats, radius: float) -> tuple[Floats, Ints]:
    """A rod with round ends; a ball where both ends are one point."""
    along = end - start
    length = float(np.linalg.norm(along))
    axis = along / length if length > 0.0 else np.array([0.0, 0.0, 1.0])
    first, second = _across(axis)
    turn = 2.0 * np.pi * np.arange(_ROUND) / _ROUND
    circle = np.cos(turn)[:, None] * first + np.sin(turn)[:, None] * second
    quarter = 0.5 * np.pi * np.arange(1, _RINGS + 1) / _RINGS
    lower = [(start, np.sin(a), -np.cos(a)) for a in quarter]
    upper = [(end, np.sin(a), np.cos(a)) for a in quarter[::-1]]
    rings = lower + (upper if length > 0.0 else upper[1:])  # a ball has one ring in its middle
    places = [start - radius * axis]
    for centre, out, up in rings:
        places.extend(centre + radius * (out * circle + up * axis))
    places.append(end + radius * axis)
    return np.array(places), _rings_joined(len(rings))


def _rings_joined(count: int) -> Ints:
    """Triangles between rings, and between them and a point at either end, seen from outside."""
    here = np.arange(_ROUND)
    beside = (here + 1) % _ROUND
    faces = [np.stack([np.zeros_like(here), 1 + beside, 1 + here], axis=1)]
    for ring in range(count - 1):
        low = 1 + ring * _ROUND
        high = low + _ROUND
        faces.append(np.stack([low + here, low + beside, high + beside], axis=1))
        faces.append(np.stack([low + here, high + beside, high + here], axis=1))
    low = 1 + (count - 1) * _ROUND
    top = np.full_like(here, low + _ROUND)
    faces.append(np.stack([top, low + here, low + beside], axis=1))
    return np.concatenate(faces).astype(np.int32)


def _across(axis: Floats) -> tuple[Floats, Floats]:
    """Two directions that make a right-handed frame with an axis of length 1."""
    first = np.cross(np.eye(3)[np.abs(axis).argmin()], axis)
    first /= np.linalg.norm(first)
    return first, np.cross(axis, first)
