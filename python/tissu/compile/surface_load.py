"""Loads on faces: areas that nodes carry, and triangles that stand for the faces."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.compile.prepared import Floats, Ints
from tissu.compile.select import selected_quads
from tissu.mesh.cell import cell_table

if TYPE_CHECKING:
    from tissu.mesh import Mesh

_SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))
_MIDDLES = ((0, -1), (1, 0), (0, 1), (-1, 0))
_NODES = {
    6: ((0, 0), (1, 0), (0, 1), (0.5, 0), (0.5, 0.5), (0, 0.5)),
    8: (*_SQUARE, *_MIDDLES),
    9: (*_SQUARE, *_MIDDLES, (0, 0)),
}
"""Nodes of the quadratic faces in reference coordinates: corners, middles of edges, centre."""
_PLANE = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
_TERMS = {
    6: _PLANE,
    8: (*_PLANE, (2, 1), (1, 2)),
    9: (*_PLANE, (2, 1), (1, 2), (2, 2)),
}
"""Exponents (i, j) of the terms x^i y^j that their shape functions are made of."""


def traction_shares(mesh: Mesh, nodes: Ints, triangles: Ints) -> Floats:
    """Area (n,) that each node carries [m2]: int N_a dA over the faces whose nodes are selected.

    On triangles a third each. A quad takes the mean of its two cuts, which is its integral when it
    is flat. On quadratic faces by Gauss points, so that a constant traction is a constant stress.

    Args:
        mesh: the body's mesh.
        nodes: numbers of the selected nodes.
        triangles: the surface's triangles (t, 3) among them; the last ones are halves of quads.
    """
    quads = selected_quads(nodes, mesh)
    whole = triangles[: len(triangles) - 2 * len(quads)]
    faces = _quadratic_faces(mesh, nodes)
    whole = _outside(whole, faces)
    corners = (([0, 1, 2], 0.5), ([0, 2, 3], 0.5), ([0, 1, 3], 0.5), ([1, 2, 3], 0.5))
    shares = np.zeros(mesh.node_count)
    for rows, weight in [(whole, 1.0), *((quads[:, three], half) for three, half in corners)]:
        a, b, c = (mesh.points[rows[:, corner]] for corner in range(3))
        areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
        np.add.at(shares, rows, weight * areas[:, None] / 3.0)
    for rows in faces:
        np.add.at(shares, rows, _integrals(mesh.points[rows]))
    return shares


def pressure_triangles(mesh: Mesh, nodes: Ints, triangles: Ints) -> tuple[Ints, float]:
    """Triangles (t, 3) that carry a follower pressure, and the share of it that each carries.

    A quad is the mean of its two cuts: a constant pressure on flat quads is then a constant stress.
    On the faces of quadratic cells a third of each triangle between their nodes goes to its
    corners, which is right in sum but not node by node.

    Args:
        mesh: the body's mesh.
        nodes: numbers of the selected nodes.
        triangles: the surface's triangles (t, 3) among them; the last ones are halves of quads.
    """
    quads = selected_quads(nodes, mesh)
    if not len(quads):
        return triangles, 1.0
    whole = triangles[: len(triangles) - 2 * len(quads)]
    cuts = [quads[:, three] for three in ([0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3])]
    return np.ascontiguousarray(np.concatenate([whole, whole, *cuts])), 0.5


def _quadratic_faces(mesh: Mesh, nodes: Ints) -> list[Ints]:
    """Outer faces (f, k) of quadratic cells whose nodes are all selected, by number of nodes."""
    chosen = np.zeros(mesh.node_count, dtype=bool)
    chosen[nodes] = True
    by_size: dict[int, list[Ints]] = {}
    for block in mesh.volume_blocks:
        if cell_table()[block.type].order == 1:
            continue
        for _, face in _core.cell_faces(cell_type=block.type):
            rows = block.nodes[:, face]
            by_size.setdefault(len(face), []).append(rows[chosen[rows].all(axis=1)])
    found = [_once(np.concatenate(rows)) for rows in by_size.values()]
    return [rows for rows in found if len(rows)]


def _once(faces: Ints) -> Ints:
    """The faces (f, k) that one cell has; those inside the body occur twice."""
    _, first, count = np.unique(
        np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    return np.asarray(faces[first[count == 1]])


def _outside(triangles: Ints, faces: list[Ints]) -> Ints:
    """The triangles that are no part of one of the faces."""
    of_node: dict[int, set[int]] = {}
    number = 0
    for rows in faces:
        for row in rows.tolist():
            for node in row:
                of_node.setdefault(node, set()).add(number)
            number += 1
    none: set[int] = set()
    apart = [
        not (of_node.get(a, none) & of_node.get(b, none) & of_node.get(c, none))
        for a, b, c in triangles.tolist()
    ]
    return np.asarray(triangles[np.array(apart, dtype=bool)])


def _integrals(corners: Floats) -> Floats:
    """Integrals of N_a (f, k) [m2] over faces with nodes at (f, k, 3)."""
    N, dN, weights = _rule(corners.shape[1])
    along_x = np.einsum("fai,ga->fgi", corners, dN[:, :, 0])
    along_y = np.einsum("fai,ga->fgi", corners, dN[:, :, 1])
    areas = np.linalg.norm(np.cross(along_x, along_y), axis=2)
    return np.asarray(np.einsum("fg,g,ga->fa", areas, weights, N))


@cache
def _rule(nodes: int) -> tuple[Floats, Floats, Floats]:
    """Shape functions (g, k), their gradients (g, k, 2) and weights (g,) at Gauss points."""
    t, w = np.polynomial.legendre.leggauss(4)
    x, y = (v.ravel() for v in np.meshgrid(t, t))
    weights = np.outer(w, w).ravel()
    if nodes == 6:  # the square collapsed onto the triangle
        x, y = (1 + x) * (1 - y) / 4, (1 + y) / 2
        weights = weights * (1 - y) / 4
    terms = _TERMS[nodes]
    a, b = np.array(_NODES[nodes], dtype=float).T
    coefficients = np.linalg.inv(np.stack([a**i * b**j for i, j in terms], axis=1))
    values = np.stack([x**i * y**j for i, j in terms], axis=1)
    by_x = np.stack([i * x ** max(i - 1, 0) * y**j for i, j in terms], axis=1)
    by_y = np.stack([j * x**i * y ** max(j - 1, 0) for i, j in terms], axis=1)
    gradients = np.stack([by_x @ coefficients, by_y @ coefficients], axis=2)
    return values @ coefficients, gradients, weights
