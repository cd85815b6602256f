"""What is drawn beside the bodies: points, arrows, lines, surfaces and words in space."""

from __future__ import annotations

from collections.abc import Sequence, Sized
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Colour = tuple[int, int, int]


def _none(*shape: int) -> Floats:
    return np.empty((0, *shape))


@dataclass(frozen=True, slots=True)
class Marks:
    """Marks of one colour.

    Attributes:
        colour: red, green, blue, 0 to 255.
        points: (p, 3) [m].
        arrows: (a, 2, 3) from and to [m].
        lines: (l, 2, 3) from and to [m].
        surface: (t, 3, 3) corners of triangles [m], such as those of an obstacle.
        opacity: of the surface, 0 to 1.
        labels: places (3,) [m] and what is written there.
    """

    colour: Colour
    points: Floats = field(default_factory=lambda: _none(3))
    arrows: Floats = field(default_factory=lambda: _none(2, 3))
    lines: Floats = field(default_factory=lambda: _none(2, 3))
    surface: Floats = field(default_factory=lambda: _none(3, 3))
    opacity: float = 1.0
    labels: tuple[tuple[Floats, str], ...] = ()


def few(rows: Sized, most: int) -> NDArray[np.int64]:
    """Numbers of at most so many rows, evenly among them all."""
    count = min(len(rows), most)
    return np.linspace(0, len(rows) - 1, count).round().astype(np.int64)


def arrows_at(places: Floats, vectors: ArrayLike, *, longest: float) -> Floats:
    """Arrows (a, 2, 3) that end at places (a, 3), the longest of a given length [m]."""
    along = np.broadcast_to(np.asarray(vectors, dtype=float), places.shape)
    size = float(np.linalg.norm(along, axis=1).max(initial=0.0))
    if size == 0.0:
        return _none(2, 3)
    return np.stack([places - along * (longest / size), places], axis=1)


def extent(shapes: Sequence[ArrayLike]) -> float:
    """Diagonal of the box around all points [m]; 1 where they are one point."""
    every = np.concatenate([np.asarray(one, dtype=float).reshape(-1, 3) for one in shapes])
    size = float(np.linalg.norm(np.ptp(every, axis=0))) if len(every) else 0.0
    return size if size > 0.0 else 1.0
