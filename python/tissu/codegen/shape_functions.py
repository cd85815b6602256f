"""Shape functions by formulae: one at their own node, zero at the others.

Lagrange and serendipity: Zienkiewicz and Taylor, The Finite Element Method, vol. 1. Pyramids:
Bedrosian, Int. J. Numer. Meth. Eng. 35 (1992).
"""

from __future__ import annotations

from math import prod
from typing import Any

from tissu.codegen.reference_cells import AXES, CORNERS, EDGES, Nodes, middles


def _barycentric(dimension: int) -> tuple[Any, ...]:
    axes = AXES[:dimension]
    return (1 - sum(axes), *axes)


def simplex_1(cell: str, nodes: Nodes) -> tuple[Any, ...]:
    """The barycentric coordinates L: 1 - x - y - z, x, y, z."""
    return _barycentric(len(nodes[0]))


def simplex_2(cell: str, nodes: Nodes) -> tuple[Any, ...]:
    """L (2 L - 1) at corners, 4 L_a L_b on edges; L are the barycentric coordinates."""
    L = _barycentric(len(nodes[0]))
    return (*(a * (2 * a - 1) for a in L), *(4 * L[a] * L[b] for a, b in EDGES[cell]))


def lagrange(cell: str, nodes: Nodes) -> tuple[Any, ...]:
    """Products of the line's Lagrange polynomials through the coordinates that the nodes have."""
    places = sorted({c for node in nodes for c in node})

    def along(s: Any, at: Any) -> Any:
        return prod((s - c) / (at - c) for c in places if c != at)

    return tuple(prod(along(s, c) for s, c in zip(AXES, node, strict=False)) for node in nodes)


def serendipity(cell: str, nodes: Nodes) -> tuple[Any, ...]:
    """Node c, S = sum c s: prod (1 + c s)/2 (S - m + 1), on edges with (1 - s^2) where c = 0."""
    m = len(nodes[0])
    shapes = []
    for node in nodes:
        bilinear = prod((1 + c * s) / 2 for s, c in zip(AXES, node, strict=False) if c != 0)
        if all(node):
            shapes.append(bilinear * (sum(c * s for s, c in zip(AXES, node, strict=False)) - m + 1))
        else:
            shapes.append(bilinear * (1 - AXES[node.index(0)] ** 2))
    return tuple(shapes)


def wedge_1(cell: str, nodes: Nodes) -> tuple[Any, ...]:
    """L (1 +- z)/2; L are the barycentric coordinates of the triangle."""
    z = AXES[2]
    return tuple(L * (1 + end * z) / 2 for end in (-1, 1) for L in _barycentric(2))


def wedge_2(cell: str, nodes: Nodes) -> tuple[Any, ...]:
    """L (1 + e z)(2 L - 2 + e z)/2 at corners, e = +-1; 2 L_a L_b (1 + e z); L (1 - z^2)."""
    z = AXES[2]
    L = _barycentric(2)
    ends = (-1, 1)
    corners = [a * (1 + e * z) * (2 * a - 2 + e * z) / 2 for e in ends for a in L]
    around = [2 * L[a] * L[b] * (1 + e * z) for e in ends for a, b in EDGES["triangle"]]
    return (*corners, *around, *(a * (1 - z**2) for a in L))


def pyramid_1(cell: str, nodes: Nodes) -> tuple[Any, ...]:
    """N = (1 - z +- x)(1 - z +- y) / (4 (1 - z)) on the base, z at the apex."""
    x, y, z = AXES
    base = CORNERS["pyramid"][:4]
    return (*((1 - z + a * x) * (1 - z + b * y) / (4 * (1 - z)) for a, b, _ in base), z)


def pyramid_2(cell: str, nodes: Nodes) -> tuple[Any, ...]:
    """Bedrosian's, from those of five nodes, here N.

    N (+-x +- y - 1) at the corners of the base, z (2 z - 1) at the apex, 4 z N on edges to it;
    (1 - z + x)(1 - z - x)(1 - z +- y) / (2 (1 - z)), x and y also changed, on edges of the base.
    """
    x, y, z = AXES
    base = CORNERS["pyramid"][:4]
    linear = pyramid_1(cell, nodes)[:4]
    corners = [N * (a * x + b * y - 1) for N, (a, b, _) in zip(linear, base, strict=True)]
    around = []
    for a, b, _ in middles("pyramid", EDGES["pyramid"][:4]):
        along, across = (x, b * y) if a == 0 else (y, a * x)
        around.append((1 - z + along) * (1 - z - along) * (1 - z + across) / (2 * (1 - z)))
    return (*corners, z * (2 * z - 1), *around, *(4 * z * N for N in linear))
