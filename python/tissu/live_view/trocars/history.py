"""What a trocar felt of late, for its curves."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

WINDOW = 5.0
"""Simulated time that curves show [s]."""
_MOST = 500
"""Points of a curve on the page."""
_KEPT = 20_000
"""Steps that are kept at most."""


class History:
    """Rows of numbers with their times, of the latest seconds."""

    def __init__(self, width: int) -> None:
        """Nothing yet; `width` numbers in each row, beside its time."""
        self._width = width
        self._rows: deque[tuple[float, ...]] = deque(maxlen=_KEPT)

    def add(self, time: float, numbers: Sequence[float]) -> None:
        """Keep a row, and forget those that are older than the window or later than it."""
        rows = self._rows
        while rows and rows[-1][0] >= time:  # time was set back
            rows.pop()
        rows.append((time, *numbers))
        while rows[0][0] < time - WINDOW:
            rows.popleft()

    def clear(self) -> None:
        """Forget everything."""
        self._rows.clear()

    def shown(self) -> Floats:
        """The rows (k, 1 + width), time first, thinned evenly to what a page can draw."""
        if not self._rows:
            return np.zeros((0, 1 + self._width))
        every = -(-len(self._rows) // _MOST)
        rows = list(self._rows)
        return np.array(rows[(len(rows) - 1) % every :: every])
