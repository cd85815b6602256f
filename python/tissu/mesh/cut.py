"""Grid cells, numbered as hexahedra, cut into cells of other types.

A face that is cut into triangles is cut along the same diagonal in every grid cell, from the corner
with the smallest coordinates to that with the largest, so neighbours match.
Source of the cuts: X. Faure, Approche formelle pour la simulation interactive de modèles mixtes,
thesis, Lyon, 2014, appendix C; the transition is ours.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from tissu.mesh.cell import Ints

Cells = Iterator[tuple[str, Ints]]

# Outward faces -x +x -y +y -z +z; each begins with an end of its diagonal.
_FACES = ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7))

_SIX = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))

_UPRIGHT = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))
_LYING = ((0, 3, 7, 1, 2, 6), (0, 7, 4, 1, 6, 5))

LEFT, RIGHT = 0, 1
"""Places of the faces -x and +x."""


def into_six(corners: Ints) -> Cells:
    """Six tetrahedra of each grid cell (e, 8), around its diagonal."""
    yield "tetra", _rows(corners, _SIX)


def into_wedges(corners: Ints, *, triangles_along_x: bool) -> Cells:
    """Two wedges of each grid cell (e, 8): triangles at -x and +x, or at -z and +z."""
    yield "wedge", _rows(corners, _LYING if triangles_along_x else _UPRIGHT)


def into_pyramids(corners: Ints, centres: Ints) -> Cells:
    """Six pyramids of each grid cell (e, 8), a face each, their tips at its centre (e,)."""
    yield "pyramid", _pyramids(corners, centres, tuple(range(6)))


def into_transition(corners: Ints, centres: Ints, quads: tuple[int, ...]) -> Cells:
    """A pyramid on each face of the grid cells that stays a quad, two tetrahedra on the others."""
    yield "pyramid", _pyramids(corners, centres, quads)
    halves = [
        (face[0], face[second + 1], face[second])
        for f, face in enumerate(_FACES)
        if f not in quads
        for second in (1, 2)
    ]
    yield "tetra", _on_centres(corners, centres, halves)


def _pyramids(corners: Ints, centres: Ints, faces: tuple[int, ...]) -> Ints:
    return _on_centres(corners, centres, [_FACES[f][::-1] for f in faces])


def _on_centres(corners: Ints, centres: Ints, bases: Sequence[tuple[int, ...]]) -> Ints:
    """Cells between bases that look inwards and the centre, grid cell by grid cell."""
    foot = corners[:, np.array(bases)]
    tip = np.broadcast_to(centres[:, None, None], (*foot.shape[:2], 1))
    return np.concatenate([foot, tip], axis=2).reshape(-1, foot.shape[2] + 1)


def _rows(corners: Ints, cells: tuple[tuple[int, ...], ...]) -> Ints:
    return corners[:, np.array(cells)].reshape(-1, len(cells[0]))
