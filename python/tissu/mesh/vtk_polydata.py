"""VTK legacy files that hold POLYDATA, text or binary, of the old layout and of version 5.

Source of the layout: "VTK file formats", VTK user's guide, section "Simple legacy formats".
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tissu.errors import MeshError
from tissu.mesh.polygon import Block, face_blocks
from tissu.mesh.raw import RawMesh

_NUMBERS = {
    "float": ">f4",
    "double": ">f8",
    "int": ">i4",
    "unsigned_int": ">u4",
    "long": ">i8",
    "vtktypeint64": ">i8",
}
_HEAD = re.compile(
    rb"# vtk DataFile[^\n]*\n[^\n]*\n\s*(ASCII|BINARY)\s+DATASET\s+POLYDATA[^\n]*\n", re.IGNORECASE
)
_CELLS = ("VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS")


def read_vtk_polydata(path: Path) -> RawMesh:
    """Polygons, triangle strips and lines; data on nodes and cells is left out.

    Raises:
        MeshError: what the file holds is not such a surface.
    """
    content = _Content(path)
    points = np.empty((0, 3))
    blocks: list[Block] = []
    notes: list[str] = []
    while words := content.line():
        if words[0] == "POINTS":
            points = content.numbers(content.count(words, 1) * 3, words[-1]).reshape(-1, 3)
        elif words[0] in _CELLS:
            more, said = _blocks(words[0], *_connectivity(content, words))
            blocks, notes = blocks + more, notes + said
        elif words[0] in ("POINT_DATA", "CELL_DATA"):
            break
        elif words[0] == "FIELD":
            for _ in range(content.count(words, 2)):
                array = content.line()
                content.numbers(content.count(array, 1) * content.count(array, 2), array[-1])
        elif words[0] == "METADATA":
            while content.line(blank=True):
                pass
        else:
            raise content.error(" ".join(words)[:40], "POINTS, " + ", ".join(_CELLS))
    return RawMesh(points, blocks, notes=notes)


class _Content:
    """A legacy file after its head, taken piece by piece."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._rest = path.read_bytes()
        head = _HEAD.match(self._rest)
        if head is None:
            raise MeshError(f"{path}: found no head of a VTK file; ASCII or BINARY is accepted")
        self._binary = head[1].upper() == b"BINARY"
        self._at = head.end()

    def line(self, *, blank: bool = False) -> list[str]:
        """Words of the next line; unless `blank`, of the next one that is not empty."""
        while self._at < len(self._rest):
            end = self._rest.find(b"\n", self._at)
            end = len(self._rest) if end < 0 else end
            words = self._rest[self._at : end].decode("latin-1").split()
            self._at = end + 1
            if words or blank:
                return words
        return []

    def peek(self) -> list[str]:
        """Words of the next line that is not empty, without taking it."""
        at = self._at
        words = self.line()
        self._at = at
        return words

    def count(self, words: list[str], place: int) -> int:
        """The number that stands at a place of a line."""
        if len(words) <= place or not words[place].isdecimal():
            raise self.error(" ".join(words)[:40], f"{words[0]} and its numbers")
        return int(words[place])

    def numbers(self, count: int, kind: str) -> NDArray[Any]:
        """The next `count` numbers."""
        if kind.lower() not in _NUMBERS:
            raise self.error(kind, ", ".join(_NUMBERS))
        number = np.dtype(_NUMBERS[kind.lower()])
        if self._binary:
            size = count * number.itemsize
            piece = self._rest[self._at : self._at + size]
            if len(piece) < size:
                raise self._truncated(count, len(piece) // number.itemsize)
            self._at += size
            return np.frombuffer(piece, dtype=number).astype(number.newbyteorder("="))
        return self._text_numbers(count, number)

    def _text_numbers(self, count: int, number: np.dtype[Any]) -> NDArray[Any]:
        words: list[str] = []
        while len(words) < count and (more := self.line()):
            words += more
        if len(words) < count:
            raise self._truncated(count, len(words))
        try:
            return np.array(words[:count], dtype=float if number.kind == "f" else np.int64)
        except ValueError:
            raise self.error(" ".join(words[:6]), f"{count} numbers") from None

    def error(self, found: str, accepted: str) -> MeshError:
        """What to raise when the file does not hold what it should."""
        return MeshError(f"{self.path}: found '{found}'; {accepted} is accepted")

    def _truncated(self, announced: int, found: int) -> MeshError:
        return MeshError(
            f"{self.path}: {announced} numbers are announced and {found} follow; "
            "is the file truncated?"
        )


def _connectivity(content: _Content, words: list[str]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Number of corners of each cell, and all corners one after the other."""
    cells, total = content.count(words, 1), content.count(words, 2)
    if content.peek()[:1] == ["OFFSETS"]:
        offsets = content.numbers(cells, content.line()[-1])
        corners = content.numbers(total, " ".join(content.line()[1:2]))
        return np.diff(offsets), corners
    flat = content.numbers(total, "int")
    sizes: list[int] = []
    pieces = [flat[:0]]
    place = 0
    for _ in range(cells):
        if place >= total:
            break
        sizes.append(int(flat[place]))
        pieces.append(flat[place + 1 : place + 1 + sizes[-1]])
        place += 1 + sizes[-1]
    if place != total or len(sizes) != cells or min(sizes, default=0) < 0:
        raise content.error(f"{words[0]} {cells} {total}", "a total that fits the cells")
    return np.array(sizes, dtype=int), np.concatenate(pieces)


def _blocks(
    keyword: str, sizes: NDArray[Any], corners: NDArray[Any]
) -> tuple[list[Block], list[str]]:
    if keyword == "POLYGONS":
        return face_blocks(sizes, corners)
    if keyword == "VERTICES" or not len(sizes):
        return [], []
    pieces = np.split(corners, np.cumsum(sizes)[:-1])
    if keyword == "LINES":
        segments = [np.stack([piece[:-1], piece[1:]], axis=1) for piece in pieces]
        return [("line", np.concatenate(segments))], []
    triangles = [np.stack([piece[:-2], piece[1:-1], piece[2:]], axis=1) for piece in pieces]
    for strip in triangles:  # every second triangle of a strip is wound the other way
        strip[1::2] = strip[1::2, ::-1]
    return [("triangle", np.concatenate(triangles))], []
