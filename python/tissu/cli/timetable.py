"""When something that is done again and again is due."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class Timetable:
    """At the multiples of a simulated time; they do not shift when a run begins between two.

    Attributes:
        every: simulated time between two of them [s].
        due: the next one [s].
    """

    every: float
    due: float = 0.0

    def is_due(self, time: float) -> bool:
        """Whether the next one has come."""
        return time > self.due - 1e-6 * self.every

    def wait(self, time: float) -> None:
        """Looks for the first one after a time."""
        self.due = self.every * (int(time / self.every + 1e-6) + 1)
