"""The command `tissu`."""

from __future__ import annotations

import signal
import sys

from tissu.cli.interruption import leave
from tissu.cli.outcome import BAD_INPUT, INTERRUPTED, complain, ended, prepare_streams


def main() -> None:
    """Entry point of the command `tissu`."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is not signal.SIG_IGN:  # as under nohup
            signal.signal(number, leave)
    prepare_streams()
    sys.exit(ended(_run()))


def _run() -> int:
    """Runs the command; its exit code."""
    try:
        from tissu.cli.app import app

        app(prog_name="tissu")
    except SystemExit as asked:
        return asked.code if isinstance(asked.code, int) else BAD_INPUT if asked.code else 0
    except KeyboardInterrupt:  # before a run has begun: there is nothing to complete
        complain("interrupted, nothing was written")
        return INTERRUPTED
    except BrokenPipeError:
        return 0
    except OSError as error:  # stdout is full: what a command writes elsewhere, it reports itself
        if error.filename is not None:
            raise
        complain(f"the output cannot be written: {error.strerror or error}")
        return BAD_INPUT
    return 0


__all__ = ["main"]
