"""Numbers of things in a sentence: "1 cell is", "3 cells are"."""

from __future__ import annotations


def counted(count: int, noun: str) -> str:
    """The number and its noun, which takes an s unless there is one: "1 cell", "0 cells"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def are(count: int) -> str:
    """The verb that goes with a number of things."""
    return "is" if count == 1 else "are"
