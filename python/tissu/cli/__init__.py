"""The command `tissu`."""

from __future__ import annotations


def main() -> None:
    """Entry point of the command `tissu`."""
    from tissu.cli.app import app

    app(prog_name="tissu")


__all__ = ["main"]
