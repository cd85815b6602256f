"""The command `tissu`."""

from __future__ import annotations

import signal
import sys

from tissu.cli.interruption import leave


def main() -> None:
    """Entry point of the command `tissu`."""
    signal.signal(signal.SIGTERM, leave)
    try:
        from tissu.cli.app import app

        app(prog_name="tissu")
    except KeyboardInterrupt:  # before a run has begun: there is nothing to complete
        print("tissu: interrupted, nothing was written", file=sys.stderr)
        sys.exit(130)


__all__ = ["main"]
