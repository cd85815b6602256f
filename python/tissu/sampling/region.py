"""What points can be placed in: anything that knows its bounds, its inside and its volume."""

from __future__ import annotations

import math
from operator import index
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.errors import ParameterError
from tissu.mesh.cell import Floats

Bools = NDArray[np.bool_]
Indices = NDArray[np.int64]

MOST_CELLS = 50_000_000
"""Grids of more cells than this are refused: the memory of a few hundred megabytes."""


class Region(Protocol):
    """A bounded part of space.

    Attributes:
        bounds: smallest and largest coordinates (2, 3) [m].
        volume: [m3], positive.
    """

    @property
    def bounds(self) -> Floats:
        """Smallest and largest coordinates (2, 3) [m]."""

    @property
    def volume(self) -> float:
        """Volume [m3]."""

    def inside(self, points: ArrayLike) -> Bools:
        """Whether each of the points (n, 3) [m] is inside: (n,)."""


def positions(points: ArrayLike) -> Floats:
    """Points as an array (n, 3) [m].

    Raises:
        ParameterError: another shape, or a number that is not finite.
    """
    found = np.asarray(points, dtype=np.float64)
    if found.ndim != 2 or found.shape[1] != 3:
        raise ParameterError(f"found points of shape {found.shape}; an array (n, 3) is accepted")
    wrong = np.flatnonzero(~np.isfinite(found).all(axis=1))
    if len(wrong):
        raise ParameterError(
            f"found {len(wrong)} of {len(found)} points whose position is not finite (first: "
            f"{wrong[0]}); finite numbers [m] are accepted: leave these points out"
        )
    return found


def fitting(region: Region, length: float, name: str) -> float:
    """A length that is positive, at most the region's longest side, and makes no endless grid.

    Raises:
        ParameterError: it is not.
    """
    sides = np.ptp(region.bounds, axis=0)
    longest = float(sides.max())
    value = positive(length, name)
    if value > longest * (1.0 + 1e-9):
        raise ParameterError(
            f"found {name} {value:g} m, which is larger than the body: its longest side is "
            f"{longest:g} m; lengths up to that are accepted: take a smaller one"
        )
    count = math.prod(float(side) / value + 1.0 for side in sides)
    if count > MOST_CELLS:
        raise ParameterError(
            f"found {name} {value:g} m, which makes a grid of {count:.2g} cells; up to "
            f"{MOST_CELLS:.0e} are accepted: take a larger one"
        )
    return value


def drawn(seed: int) -> np.random.Generator:
    """Random numbers that a seed decides.

    Raises:
        ParameterError: the seed is not a whole number from 0 on.
    """
    try:
        return np.random.default_rng(index(seed))
    except (TypeError, ValueError):
        raise ParameterError(f"found seed {seed!r}; a whole number from 0 on is accepted") from None


def positive(length: float, name: str) -> float:
    """A length [m] that is a positive finite number.

    Raises:
        ParameterError: it is not.
    """
    try:
        value = float(length)
    except (TypeError, ValueError):
        value = math.nan
    if not (math.isfinite(value) and value > 0.0):
        raise ParameterError(f"found {name} {length!r}; a positive length [m] is accepted")
    return value
