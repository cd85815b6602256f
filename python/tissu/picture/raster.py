"""Which triangle is seen at each pixel: a z-buffer, filled by the core."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tissu import _core

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


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

    def part(self, which: slice) -> Seen:
        """Some of the pixels."""
        return Seen(
            self.pixel[which], self.triangle[which], self.weights[which], self.nearness[which]
        )


def rasterise(corners: Array, triangles: Integers, size: tuple[int, int]) -> Seen:
    """The nearest triangle at the middle of each pixel.

    Args:
        corners: (n,3) column, row, nearness of each point, as from `Camera.project`.
        triangles: (t,3) numbers of the corners.
        size: width and height [pixels].
    """
    return Seen(
        *_core.rasterise(
            corners=np.ascontiguousarray(corners, dtype=np.float64),
            triangles=np.ascontiguousarray(triangles, dtype=np.int64).reshape(-1, 3),
            width=size[0],
            height=size[1],
        )
    )
