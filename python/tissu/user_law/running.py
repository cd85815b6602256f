"""Running a file of a law: a program, whose every way to end is an error of the law."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator
from pathlib import Path
from types import FrameType

from tissu.errors import LawError


@contextlib.contextmanager
def as_law_errors(file: Path) -> Iterator[None]:
    """Whatever the file raises becomes a LawError: SystemExit too, which would end the program.

    Ctrl-C by the user stays KeyboardInterrupt.

    Raises:
        LawError: what the file raised, in a sentence.
    """
    with _noted_interruption() as asked:
        try:
            yield
        except LawError:
            raise
        except BaseException as error:  # the file is a program: anything may go wrong in it
            if isinstance(error, KeyboardInterrupt) and asked:
                raise
            said = " ".join(_text_of(error).split())[:300]
            raise LawError(f"{file}: {type(error).__name__}{f': {said}' if said else ''}") from None


def _text_of(error: BaseException) -> str:
    try:
        return str(error)
    except BaseException as worse:
        return f"its message raises {type(worse).__name__}"


@contextlib.contextmanager
def _noted_interruption() -> Iterator[list[int]]:
    """Notes whether SIGINT came, and lets it raise KeyboardInterrupt as before."""
    asked: list[int] = []
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield asked
        return

    def note(number: int, frame: FrameType | None) -> None:
        asked.append(number)
        before(number, frame)

    signal.signal(signal.SIGINT, note)
    try:
        yield asked
    finally:
        signal.signal(signal.SIGINT, before)
