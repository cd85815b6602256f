"""When the next step begins, so that simulated time passes at a given speed."""

from __future__ import annotations

import math

_DEBT = 0.1
"""Wall time [s] by which a simulation may lag before what it lags is forgiven."""


class Pace:
    """Simulated time against wall time; a speed of infinity never waits.

    A simulation that cannot keep up is not chased: what it lags beyond a tenth of a second is
    forgiven, so that it does not race when the load is gone.
    """

    def __init__(self, speed: float = 1.0) -> None:
        """Take simulated seconds for each second of wall time."""
        self.speed = speed
        self._begun: tuple[float, float] | None = None

    def restart(self) -> None:
        """Count from the next moment on: after a pause, or when time was set back."""
        self._begun = None

    def wait(self, *, now: float, time: float) -> float:
        """How long the step from simulated `time` on has to wait, from wall time `now` on [s]."""
        if not math.isfinite(self.speed):
            return 0.0
        if self._begun is None:
            self._begun = (now, time)
        wall, simulated = self._begun
        due = wall + (time - simulated) / self.speed
        if due < now - _DEBT:
            self._begun = (now - _DEBT, time)
        return max(due - now, 0.0)
