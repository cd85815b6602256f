"""A ration of time: work is begun no more often than a share of the time allows."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable


class Ration:
    """What a piece of work cost says how long the next one waits.

    Attributes:
        share: of the time, that the work may take.
    """

    def __init__(self, share: float, *, shortest: float = 0.0, longest: float) -> None:
        """Begin with no wait.

        Args:
            share: of the time, above 0 and at most 1.
            shortest: from one beginning to the next [s].
            longest: the same; beyond it work is begun at any cost [s].
        """
        self.share = share
        self._shortest, self._longest = shortest, longest
        self._due = -float("inf")

    def is_due(self, now: float) -> bool:
        """Whether the next piece may begin."""
        return now >= self._due

    def spent(self, cost: float, *, begun: float) -> None:
        """Count a piece of work.

        Args:
            cost: time that it took [s].
            begun: when it began [s], by the clock of `is_due`.
        """
        wait = min(max(cost / self.share, self._shortest), self._longest)
        # Work that begins a little late, between two steps, makes the next one no later.
        late = begun - self._due
        self._due = (self._due if 0.0 <= late <= self._shortest else begun) + wait


def processor_time(threads: Iterable[int]) -> float:
    """Time that a processor worked for living threads of this process [s].

    Where the system does not say it of another thread, that of the calling one only.

    Args:
        threads: their numbers, as `threading.get_ident` gives them.
    """
    if sys.platform == "linux":
        clocks = [time.pthread_getcpuclockid(thread) for thread in threads]
        return sum(time.clock_gettime(clock) for clock in clocks)
    return time.thread_time()
