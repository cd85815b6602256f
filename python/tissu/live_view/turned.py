"""Surfaces of revolution: balls, capsules and arrows as triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SIDES = 24
_RINGS = 6


def turned(profile: ArrayLike) -> tuple[Floats, Ints]:
    """Points and triangles, facing out, of a profile that goes about the z axis.

    Args:
        profile: (k, 2) radii and heights [m], upwards, with radius 0 at both ends.
    """
    rows = np.asarray(profile, dtype=float)
    angle = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    rings = rows[:, :1, None] * circle
    heights = np.broadcast_to(rows[:, 1:, None], (len(rows), _SIDES, 1))
    points = np.concatenate([rings, heights], axis=2).reshape(-1, 3)
    here = np.arange(_SIDES)
    side = np.concatenate(
        [
            np.stack([here, np.roll(here, -1), np.roll(here, -1) + _SIDES], axis=1),
            np.stack([here, np.roll(here, -1) + _SIDES, here + _SIDES], axis=1),
        ]
    )
    triangles = (_SIDES * np.arange(len(rows) - 1)[:, None, None] + side).reshape(-1, 3)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    flat = ~np.cross(b - a, c - a).any(axis=1)  # at the ends one of two has no area
    return points, triangles[~flat]


def capsule(start: ArrayLike, end: ArrayLike, radius: float) -> tuple[Floats, Ints]:
    """A rod with round ends; a ball where both ends are one point."""
    foot, along = np.asarray(start, dtype=float), np.subtract(end, start)
    length = float(np.linalg.norm(along))
    angle = 0.5 * np.pi * np.arange(_RINGS + 1) / _RINGS
    cosine, sine = np.cos(angle), np.sin(angle)
    cosine[-1] = 0.0
    lower = np.stack([cosine[::-1], -sine[::-1]], axis=1) * radius
    upper = np.stack([cosine, sine], axis=1) * radius + [0.0, length]
    points, triangles = turned(np.concatenate([lower, upper if length > 0.0 else upper[1:]]))
    if length > 0.0:
        points = points @ to_axis(along / length).T
    return foot + points, triangles


def arrow(shaft: float, head: float, length: float) -> tuple[Floats, Ints]:
    """An arrow from the origin to a height of 1.

    Args:
        shaft: radius of the shaft, as a share of its length.
        head: radius of the head.
        length: of the head.
    """
    neck = 1.0 - length
    return turned([(0.0, 0.0), (shaft, 0.0), (shaft, neck), (head, neck), (0.0, 1.0)])


def to_axis(axis: Floats) -> Floats:
    """A rotation (3, 3) that takes e_z to a unit vector."""
    across = np.cross(np.eye(3)[int(np.abs(axis).argmin())], axis)
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(axis, across), axis], axis=1)
