"""Lines as thin rods, so that a picture of surfaces shows them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LINE = 0.008  # radius of the rod that stands for a line, as a share of the body's diagonal
_SIDES = 6


def rods(ends: Array, radius: float) -> tuple[Array, NDArray[np.int64]]:
    """Points (12 k, 3), triangles (12 k, 3) of the sides of a rod for each line (k, 2, 3) [m]."""
    along = ends[:, 1] - ends[:, 0]
    axis = np.eye(3)[np.abs(along).argmin(axis=1)]  # the one that the line is farthest from
    first = np.cross(along, axis)
    first /= np.maximum(np.linalg.norm(first, axis=1, keepdims=True), 1e-300)
    second = np.cross(along, first)
    second /= np.maximum(np.linalg.norm(second, axis=1, keepdims=True), 1e-300)
    angle = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    ring = np.cos(angle)[:, None] * first[:, None] + np.sin(angle)[:, None] * second[:, None]
    points = (ends[:, :, None] + radius * ring[:, None]).reshape(-1, 3)
    here, next_one = np.arange(_SIDES), (np.arange(_SIDES) + 1) % _SIDES
    side = np.concatenate(
        [
            np.stack([here, next_one, next_one + _SIDES], axis=1),
            np.stack([here, next_one + _SIDES, here + _SIDES], axis=1),
        ]
    )
    start = 2 * _SIDES * np.arange(len(ends))
    return points, (start[:, None, None] + side).reshape(-1, 3)


def rods_values(values: Array) -> Array:
    """Values (12 k,) at the points of rods from those (k, 2) at the ends of their lines."""
    return np.repeat(values, _SIDES, axis=1).ravel()
