"""The cells that elements live on: corners, edges and faces in meshio's names and VTK's order.

One exception, meshio's own: the wedge's triangle 0 1 2 looks towards 3 4 5. In VTK's linear wedge
it looks away; meshio turns it round when it reads and writes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy
from sympy import Rational

AXES = sympy.symbols("x y z", real=True)
"""The reference coordinates; an element of dimension m has the first m."""

Node = tuple[Any, ...]
Nodes = tuple[Node, ...]


def _nodes(rows: Sequence[Sequence[int]]) -> Nodes:
    return tuple(tuple(sympy.Integer(c) for c in row) for row in rows)


_SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))

CORNERS: dict[str, Nodes] = {
    "line": _nodes([[-1], [1]]),
    "triangle": _nodes([[0, 0], [1, 0], [0, 1]]),
    "quad": _nodes(_SQUARE),
    "tetra": _nodes([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    "hexahedron": _nodes([[x, y, z] for z in (-1, 1) for x, y in _SQUARE]),
    "wedge": _nodes([[x, y, z] for z in (-1, 1) for x, y in ((0, 0), (1, 0), (0, 1))]),
    "pyramid": _nodes([*([x, y, 0] for x, y in _SQUARE), [0, 0, 1]]),
}
"""Corners of each reference cell."""

EDGES: dict[str, Sequence[tuple[int, ...]]] = {
    "line": [(0, 1)],
    "triangle": [(0, 1), (1, 2), (2, 0)],
    "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "tetra": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "hexahedron": [
        *((0, 1), (1, 2), (2, 3), (3, 0)),
        *((4, 5), (5, 6), (6, 7), (7, 4)),
        *((0, 4), (1, 5), (2, 6), (3, 7)),
    ],
    "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "pyramid": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
}
"""Corners that end each edge, in VTK's order of the nodes in their middles."""

FACES: dict[str, Sequence[tuple[int, ...]]] = {
    "quad": [(0, 1, 2, 3)],
    "hexahedron": [
        *((0, 3, 7, 4), (1, 2, 6, 5)),
        *((0, 1, 5, 4), (3, 2, 6, 7)),
        *((0, 1, 2, 3), (4, 5, 6, 7)),
        (0, 1, 2, 3, 4, 5, 6, 7),
    ],
}
"""Corners around the nodes in the middle of faces (-x +x -y +y -z +z) and of the cell itself."""


def middles(cell: str, groups: Sequence[tuple[int, ...]]) -> Nodes:
    """The mean of each group of corners."""
    corners = CORNERS[cell]
    return tuple(
        tuple(
            sum(c) * Rational(1, len(group)) for c in zip(*(corners[a] for a in group), strict=True)
        )
        for group in groups
    )
