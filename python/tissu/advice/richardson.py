"""Richardson's extrapolation: the order that three runs show, and the error left in the finest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

LOWEST, HIGHEST = 0.5, 4.0  # orders that are believed
_BISECTIONS = 60


@dataclass(frozen=True, slots=True)
class Estimate:
    """What three runs with ever finer cells, or steps, say of the finest of them.

    Attributes:
        order: p in error = C h^p.
        error: of the finest, mean over points and times [m].
    """

    order: float
    error: float


def estimate(sizes: Sequence[float], runs: Sequence[Floats]) -> Estimate | None:
    """Order and error of the finest run, where three runs approach a limit in one direction.

    With u(h) = u + C h^p: |u1 - u2| / |u2 - u3| = (h1^p - h2^p) / (h2^p - h3^p) gives p, and
    |u3 - u| = |u2 - u3| h3^p / (h2^p - h3^p).

    Args:
        sizes: of cells, or of steps; decreasing, three or more, of which the last three count.
        runs: displacements (t, p, 3) of the same points and times [m].

    Returns:
        None where there are fewer than three, where the second difference points away from the
        first, or where the order is not between 0.5 and 4.
    """
    if len(runs) < 3:
        return None
    h1, h2, h3 = (float(size) for size in sizes[-3:])
    first, second = runs[-3] - runs[-2], runs[-2] - runs[-1]
    coarse, fine = (float(np.linalg.norm(d, axis=-1).mean()) for d in (first, second))
    if not fine > 0.0 or not float((first * second).sum()) > 0.0:
        return None

    def ratio(p: float) -> float:
        return float((h1**p - h2**p) / (h2**p - h3**p))

    low, high = LOWEST, HIGHEST
    if not ratio(low) <= coarse / fine <= ratio(high):
        return None
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ratio(middle) < coarse / fine else (low, middle)
    order = 0.5 * (low + high)
    return Estimate(order, fine * h3**order / (h2**order - h3**order))
