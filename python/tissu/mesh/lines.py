"""A text file taken line by line; what is wrong is said with the line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tissu.errors import MeshError
from tissu.mesh.cell import Floats


def text_of(path: Path) -> str:
    """The text of a file.

    Raises:
        MeshError: the file is not text.
    """
    content = path.read_bytes()
    if b"\0" in content:
        raise MeshError(f"{path}: found binary data; a {path.suffix} file is accepted as text")
    return content.decode("utf-8-sig", errors="replace")


class Lines:
    """The lines of a text file that are neither empty nor comments, one after the other."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._rows: list[tuple[int, list[str]]] = []
        for number, line in enumerate(text_of(path).splitlines(), start=1):
            words = line.split("#", 1)[0].split()
            if words:
                self._rows.append((number, words))
        self._next = 0

    @property
    def done(self) -> bool:
        """Whether no line is left."""
        return self._next >= len(self._rows)

    @property
    def left(self) -> int:
        """Number of lines that are left."""
        return len(self._rows) - self._next

    @property
    def number(self) -> int:
        """Number of the line taken last."""
        return self._rows[self._next - 1][0] if self._next else 0

    def words(self, what: str) -> list[str]:
        """The words of the next line, which should hold `what`."""
        if self.done:
            raise MeshError(
                f"{self.path}: the file ends after line {self.number}, where {what} is expected; "
                "is it truncated?"
            )
        self._next += 1
        return self._rows[self._next - 1][1]

    def peek(self) -> list[str]:
        """The words of the next line without taking it; empty at the end."""
        return [] if self.done else self._rows[self._next][1]

    def count(self, what: str) -> int:
        """A line with one number of things."""
        words = self.words(f"the number of {what}")
        if not words[0].isdecimal():
            raise self.error(words, f"the number of {what}")
        return int(words[0])

    def rows(self, count: int, what: str) -> list[list[str]]:
        """The words of the next `count` lines."""
        if count > self.left:
            raise MeshError(
                f"{self.path}: {count} {what} are announced before line {self.number + 1}, and "
                f"{self.left} lines follow; is the file truncated?"
            )
        taken = [words for _, words in self._rows[self._next : self._next + count]]
        self._next += count
        return taken

    def table(self, count: int, columns: int, what: str) -> Floats:
        """The first `columns` numbers (count, columns) of the next `count` lines."""
        first = self._next
        rows = self.rows(count, what)
        try:
            return np.array([row[:columns] for row in rows], dtype=float).reshape(-1, columns)
        except ValueError:
            for offset, row in enumerate(rows):
                if not _are_numbers(row[:columns], columns):
                    self._next = first + offset + 1
                    raise self.error(row, f"{columns} numbers ({what})") from None
            raise

    def error(self, words: Sequence[str], accepted: str) -> MeshError:
        """What to raise when the line taken last does not hold what it should."""
        found = " ".join(words)
        found = found if len(found) <= 60 else f"{found[:60]}..."
        return MeshError(
            f"{self.path}, line {self.number}: found '{found}'; {accepted} is accepted"
        )


def whole(lines: Lines, table: np.ndarray[Any, np.dtype[np.float64]], what: str) -> Any:
    """A table of whole numbers as int64."""
    if not (np.isfinite(table).all() and (table == np.round(table)).all()):
        raise MeshError(f"{lines.path}: found {what} that are not whole numbers")
    return table.astype(np.int64)


def _are_numbers(words: Sequence[str], count: int) -> bool:
    try:
        return len([float(word) for word in words]) == count
    except ValueError:
        return False
