"""Files that end too early, where meshio would look for their end for ever."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path

_PATIENCE = 100  # times that a reader may ask for a line after the last one

_TEXT = ("tecplot",)
_BYTES = ("mdpa", "ply")


class _TextFile(io.TextIOWrapper):
    """A text file whose end is an error when it is asked for again and again."""

    asked = 0

    def readline(self, size: int = -1, /) -> str:  # type: ignore[override]
        line = super().readline(size)
        self.asked = 0 if line else self.asked + 1
        _require(self.asked)
        return line


class _ByteFile(io.BufferedReader):
    """The same for bytes."""

    asked = 0

    def readline(self, size: int | None = -1, /) -> bytes:
        line = super().readline(size)
        self.asked = 0 if line else self.asked + 1
        _require(self.asked)
        return line


def _require(asked: int) -> None:
    if asked > _PATIENCE:
        raise EOFError("the file ends too early; is it truncated?")


def _require_brackets(content: bytes) -> None:
    """An open bracket sends meshio's pattern for .wkt through every way to split the numbers."""
    if content.count(b"(") != content.count(b")"):
        raise EOFError("brackets do not match; is it truncated?")


@contextlib.contextmanager
def finite(path: Path, name: str) -> Iterator[Path | _TextFile | _ByteFile]:
    """What to hand to meshio's reader of a format: the path, or a file that has an end.

    Raises:
        EOFError: the file ends too early, in here or while it is read.
    """
    if name in _TEXT:
        with _TextFile(io.FileIO(path), encoding="utf-8") as text:
            yield text
    elif name in _BYTES:
        with _ByteFile(io.FileIO(path)) as content:
            yield content
    else:
        if name == "wkt":
            _require_brackets(path.read_bytes())
        yield path
