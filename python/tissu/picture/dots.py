"""Integration points of connective tissue as small octahedra."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_CORNERS = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
_FACES = np.array(
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
)


def dots(points: Array, radius: float) -> tuple[Array, NDArray[np.int64]]:
    """Corners (6 n, 3) and triangles (8 n, 3) of one octahedron at each of points (n, 3)."""
    corners = (points[:, None, :] + radius * _CORNERS).reshape(-1, 3)
    first = 6 * np.arange(len(points), dtype=np.int64)
    return corners, (first[:, None, None] + _FACES).reshape(-1, 3)
