"""How a command ends: its exit code, and one message on stderr instead of a traceback."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator

import typer

from tissu.errors import Diverged, TissuError

FINISHED, DIVERGED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130


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
    except BrokenPipeError:  # whoever read the output has left
        sys.stderr.close()
        raise typer.Exit(FINISHED) from None


def complain(text: str) -> None:
    """One message on stderr."""
    print(f"tissu: {text}", file=sys.stderr)
