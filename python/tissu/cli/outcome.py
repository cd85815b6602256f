"""How a command ends: its exit code, and one message on stderr instead of a traceback."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator

import typer

from tissu.errors import Diverged, TissuError

FINISHED, DIVERGED, BAD_INPUT, UNCONVERGED, INTERRUPTED = 0, 1, 2, 3, 130


@contextlib.contextmanager
def reported(*, debug: bool) -> Iterator[None]:
    """Turns errors of tissu into a message and an exit code; `debug` keeps their traceback."""
    try:
        yield
    except TissuError as error:
        if debug:
            raise
        complain(str(error))
        raise typer.Exit(DIVERGED if isinstance(error, Diverged) else BAD_INPUT) from None
    except KeyboardInterrupt:
        if debug:
            raise
        complain("interrupted")
        raise typer.Exit(INTERRUPTED) from None
    except BrokenPipeError:  # the reader of the output has left
        raise typer.Exit(FINISHED) from None
    except MemoryError:
        if debug:
            raise
        complain("the memory of this machine is not enough; take fewer cells or steps of results")
        raise typer.Exit(BAD_INPUT) from None
    except ImportError as error:
        if debug:
            raise
        complain(str(error))
        raise typer.Exit(BAD_INPUT) from None


def complain(text: str) -> None:
    """One message on stderr, where there is one."""
    with contextlib.suppress(OSError, ValueError):
        print(f"tissu: {text}", file=sys.stderr)


def prepare_streams() -> None:
    """Makes stdout and stderr take every text: what they cannot show is escaped."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")


def ended(code: int) -> int:
    """Flushes stdout, and gives the exit code: another where what was printed was lost.

    A reader of the output that left, as `head` does, has what it wanted.
    """
    stream = sys.stdout
    try:
        if stream is not None:
            stream.flush()
    except BrokenPipeError:
        _close(stream)
    except OSError as error:
        _close(stream)
        complain(f"the output cannot be written: {error.strerror or error}")
        return code or BAD_INPUT
    return code


def _close(stream: object) -> None:
    """Drops what is left in a stream's buffer, so that the interpreter does not try again."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())  # type: ignore[attr-defined]
        os.close(nowhere)
