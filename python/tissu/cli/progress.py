"""The bar that shows how far a run is; nothing where the output is not a terminal."""

from __future__ import annotations

import contextlib
import sys
import time
from types import TracebackType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress


class RunProgress:
    """Simulated time, steps per second, real-time factor and time left, while a run goes on.

    Args:
        duration: simulated time of the whole run [s].
        quiet: show nothing.
        start: simulated time at which it goes on [s].
    """

    def __init__(self, duration: float, *, quiet: bool, start: float = 0.0) -> None:
        self._duration = duration
        self._start = start
        self._progress: Progress | None = None
        self._begin = time.perf_counter()
        self._steps = 0
        if not quiet and sys.stdout is not None and sys.stdout.isatty():
            self._progress = _columns()
            self._task = self._progress.add_task("run", total=duration, words="")

    def __enter__(self) -> RunProgress:
        if self._progress is not None:
            self._progress.start()
        self._begin = time.perf_counter()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._progress is not None:
            with contextlib.suppress(OSError):  # of a terminal that is gone
                self._progress.stop()

    def advance(self, simulated: float) -> None:
        """One more step, after which `simulated` seconds of the run are done."""
        self._steps += 1
        if self._progress is not None:
            elapsed = max(time.perf_counter() - self._begin, 1e-9)
            rate = (simulated - self._start) / elapsed
            words = progress_words(simulated, self._duration, self._steps / elapsed, rate)
            with contextlib.suppress(OSError):
                self._progress.update(self._task, completed=simulated, words=words)


def progress_words(simulated: float, duration: float, steps: float, rate: float) -> str:
    """What is said beside the bar: steps a second, and simulated time over elapsed time."""
    left = max(duration - simulated, 0.0) / rate if rate > 0 else float("inf")
    shown = f"{left:.0f} s left" if left < 1e6 else ""
    return (
        f"{simulated:.2f} of {duration:.2f} s   {steps:.0f} steps/s   "
        f"{rate:.2f}x real time   {shown}"
    )


def _columns() -> Progress:
    from rich.progress import BarColumn, Progress, TextColumn

    return Progress(BarColumn(), TextColumn("{task.fields[words]}"), transient=True)
