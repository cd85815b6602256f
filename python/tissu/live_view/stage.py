"""From metres to the page and back: one scale for all, and a place for each lane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.picture.camera import view_axes

Floats = NDArray[np.float64]

_APART = 1.25
"""Of the extent of the scene, from one lane to the next."""


@dataclass(frozen=True, slots=True, eq=False)
class Stage:
    """Where things stand on the page.

    The page is made for things of the size of a metre or so; an organ, or a cell of one, is drawn
    by a power of ten larger or smaller.

    Attributes:
        factor: page units for each metre.
        shifts: (lanes, 3) of each lane [page units].
        centre: (3,) of everything at rest, and
        size: its diagonal [page units].
        axes: (3, 3) rows of the first view: to the right, to the top, towards the viewer.
        up: (3,) direction that is up.
    """

    factor: float
    shifts: Floats
    centre: Floats
    size: float
    axes: Floats
    up: Floats

    def on_page(self, places: ArrayLike, lane: int) -> NDArray[np.float32]:
        """Places (..., 3) [m] on the page."""
        at = np.asarray(places)
        shift = self.shifts[lane]
        if at.dtype == np.float32:  # as exact as the page, and half as much to move
            return np.asarray(at * np.float32(self.factor) + shift.astype(np.float32))
        return np.asarray(at * self.factor + shift, dtype=np.float32)

    def in_space(self, places: ArrayLike, lane: int) -> Floats:
        """Places (..., 3) of the page in space [m]."""
        at = np.asarray(places, dtype=np.float64) - self.shifts[lane]
        return np.asarray(at / self.factor)


def stage_of(rest: Sequence[ArrayLike], up: ArrayLike, *, lanes: int) -> Stage:
    """A stage for bodies with these points (n, 3) at rest [m], as often as there are lanes."""
    points = np.concatenate([np.asarray(one, dtype=np.float64).reshape(-1, 3) for one in rest])
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.linalg.norm(high - low)) or 1.0
    factor = 10.0 ** -np.floor(np.log10(size))
    up = np.asarray(up, dtype=np.float64) / np.linalg.norm(up)
    axes = view_axes(points, up)
    along = axes[0] - (axes[0] @ up) * up
    along /= np.linalg.norm(along)
    wide = _APART * float(np.ptp(points @ along)) * factor
    places = np.arange(lanes) - (lanes - 1) / 2
    shifts = places[:, None] * wide * along
    return Stage(
        factor=float(factor),
        shifts=shifts,
        centre=(low + high) / 2 * factor,
        size=size * factor + wide * (lanes - 1),
        axes=axes,
        up=up,
    )
