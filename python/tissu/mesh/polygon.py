"""Faces of any number of corners as triangles and quads."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tissu.counted import counted

Block = tuple[str, NDArray[Any]]


def face_blocks(sizes: NDArray[Any], corners: NDArray[Any]) -> tuple[list[Block], list[str]]:
    """Blocks of triangles and quads, and notes.

    Faces of five and more corners become fans of triangles, right for convex ones.

    Args:
        sizes: number of corners (f,) of each face.
        corners: node numbers of all faces, one face after the other.
    """
    start = np.cumsum(sizes) - sizes
    triangles, notes = [_rows(corners, start, sizes, 3)], []
    large = int(np.sum(sizes > 4))
    for size in np.unique(sizes[sizes > 4]):
        polygon = _rows(corners, start, sizes, int(size))
        triangles += [polygon[:, [0, i, i + 1]] for i in range(1, int(size) - 1)]
    if large:
        notes.append(f"{counted(large, 'face')} of more than four corners split into triangles")
    degenerate = int(np.sum(sizes < 3))
    if degenerate:
        notes.append(f"{counted(degenerate, 'face')} of fewer than three corners left out")
    blocks = [("triangle", np.concatenate(triangles)), ("quad", _rows(corners, start, sizes, 4))]
    return [block for block in blocks if len(block[1])], notes


def _rows(
    corners: NDArray[Any], start: NDArray[Any], sizes: NDArray[Any], size: int
) -> NDArray[Any]:
    """The faces (f, size) that have `size` corners."""
    first = start[sizes == size]
    return np.asarray(corners[first[:, None] + np.arange(size)]).reshape(-1, size)
