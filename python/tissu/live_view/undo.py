"""Undo: back to a moment before something was done to the simulations."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.live_view.trocars.trocars import LiveTrocars
    from tissu.simulation import Simulation

_MOST = 16
"""Moments that are kept; the oldest goes."""
_SAME = 0.2
"""Simulated time within which two moments of one use are one [s]."""


class Undo:
    """Moments to go back to, in the thread that owns the simulations."""

    def __init__(self, trocars: LiveTrocars | None = None) -> None:
        """None is kept yet; `trocars`: that go back too."""
        self._trocars = trocars
        self._moments: deque[tuple[float, list[Any], list[Any]]] = deque(maxlen=_MOST)
        self._is_back = False  # at the latest moment, and nothing was done since

    def remember(self, simulations: Sequence[Simulation], is_press: bool = False) -> None:
        """Keep this moment; where it goes on with a use, unless one just before it is kept."""
        now = simulations[0].time
        self._is_back = False
        if not is_press and self._moments and 0.0 <= now - self._moments[-1][0] < _SAME:
            return
        marks = [simulation.mark() for simulation in simulations]
        self._moments.append((now, marks, [] if self._trocars is None else self._trocars.moments()))

    def back(self, simulations: Sequence[Simulation]) -> None:
        """Go back to the latest moment; once more, if nothing was done since, to the one before.

        Raises:
            ParameterError: no moment is kept.
        """
        if self._is_back and len(self._moments) > 1:
            self._moments.pop()
        if not self._moments:
            text = "found nothing to undo: no tool was pressed and no trocar touched anything"
            raise ParameterError(f"{text}; Reset begins again")
        _, marks, places = self._moments[-1]
        for simulation, mark in zip(simulations, marks, strict=True):
            simulation.rewind(mark)
        if self._trocars is not None:
            self._trocars.come_back(places)
        self._is_back = True

    def forget(self) -> None:
        """Keep none: the simulations have begun again."""
        self._moments.clear()
        self._is_back = False
