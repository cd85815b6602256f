"""Meshes of a cube of 50 mm: for bench/apparent_modulus.py."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

import tissu as ts
from tissu.mesh import CellBlock

SIDE = 0.05  # m


def five(cells: int) -> ts.Mesh:
    """Cubes cut into five, diagonals to and fro."""
    return ts.bar_mesh(size=(SIDE,) * 3, cells=(cells,) * 3, cell="tetra", split="five")


def centred(cells: int, moved: float = 0.0) -> ts.Mesh:
    """Cubes cut into twelve around their centres; points moved at random, those on faces not."""
    count = cells + 1
    grid = np.indices((count,) * 3).reshape(3, -1).T
    points, tetrahedra = [*grid.astype(float)], []
    for corner in np.indices((cells,) * 3).reshape(3, -1).T:
        for axis, side in itertools.product(range(3), (0, 1)):
            base = corner + side * np.eye(3, dtype=int)[axis]
            u, v = (np.eye(3, dtype=int)[i] for i in range(3) if i != axis)
            square = [base, base + u, base + u + v, base + v]
            first = int(base.sum()) % 2  # diagonals to and fro, alike from both sides
            a, b, c, d = (square[(first + i) % 4] @ [count**2, count, 1] for i in range(4))
            tetrahedra += [(a, b, c, len(points)), (a, c, d, len(points))]
        points.append(corner + 0.5)
    place = SIDE / cells * np.array(points)
    shift = np.random.default_rng(3).uniform(-moved, moved, place.shape) * SIDE / cells
    shift[(place < 1e-9) | (place > SIDE - 1e-9)] = 0.0
    return ts.Mesh(points=place + shift, cells=(CellBlock("tetra", _upright(place, tetrahedra)),))


def _upright(points: NDArray[np.float64], tetrahedra: list[tuple[int, ...]]) -> NDArray[np.int64]:
    nodes = np.array(tetrahedra)
    edges = points[nodes[:, 1:]] - points[nodes[:, :1]]
    turned = np.linalg.det(edges) < 0
    nodes[turned] = nodes[turned][:, [1, 0, 2, 3]]
    return nodes


def uneven() -> ts.Mesh:
    """A cube whose cells are seven times as wide at one side as at the other."""
    even = centred(4)
    points = even.points.copy()
    points[:, 0] = SIDE * (points[:, 0] / SIDE) ** 2
    return ts.Mesh(points=points, cells=even.cells)
