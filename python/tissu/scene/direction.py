"""Directions of any length: brought near length one before anything is squared."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tissu.scene.selection import Floats


def scaled(direction: Sequence[float]) -> Floats:
    """The direction (3,) times the power of two that makes its largest component 1 to 2.

    A double does not hold the squares of 1e160 and of 1e-200. A power of two changes no
    digit: the unit vector of a direction has the same bits with it and without it.
    """
    values = np.asarray(direction, dtype=np.float64)
    largest = float(np.abs(values).max())
    return values if largest == 0.0 else np.ldexp(values, 1 - int(np.frexp(largest)[1]))


def unit_vector(direction: Sequence[float]) -> Floats:
    """The direction (3,) with length one."""
    values = scaled(direction)
    return np.asarray(values / np.linalg.norm(values))
