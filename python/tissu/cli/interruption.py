"""Ctrl-C (SIGINT), SIGTERM and SIGHUP: a run that is asked to stop completes its files first.

It stops between two iterations of the step that it is in, and stands at the end of the one before.
"""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from types import FrameType

_WORDS = {
    signal.SIGINT: "interrupted",
    signal.SIGTERM: "terminated",
    signal.SIGHUP: "left by its terminal",
}


@dataclass(slots=True)
class Interruption:
    """Which signal has asked the run to stop; 0: none."""

    number: int = 0

    @property
    def word(self) -> str:
        """What has happened, in a word."""
        return _WORDS.get(signal.Signals(self.number), "interrupted")

    @property
    def code(self) -> int:
        """Exit code, as shells have it: 130 after Ctrl-C, 143 after SIGTERM, 129 after SIGHUP."""
        return 128 + self.number


@contextlib.contextmanager
def interruption() -> Iterator[Interruption]:
    """Notes a signal instead of dying of it; the second one stops at once."""
    noted = Interruption()
    if threading.current_thread() is not threading.main_thread():
        yield noted
        return

    def note(number: int, frame: FrameType | None) -> None:
        noted.number = number
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        # The terminal is gone: a second SIGHUP, of its session, is not another wish.

    from tissu import _core

    # A signal that is ignored, as under nohup, stays ignored.
    heard = [number for number in _WORDS if signal.getsignal(number) is not signal.SIG_IGN]
    before = {number: signal.signal(number, note) for number in heard}
    _core.interrupt_on(heard)
    try:
        yield noted
    finally:
        _core.interrupt_on([])
        for number, handler in before.items():
            signal.signal(number, handler)


def leave(number: int, frame: FrameType | None) -> None:
    """Handler of SIGTERM and SIGHUP outside a run: there is nothing to complete."""
    with contextlib.suppress(OSError):
        word = _WORDS.get(signal.Signals(number), "terminated")
        print(f"tissu: {word}, nothing was written", file=sys.stderr)
    raise SystemExit(128 + number)
