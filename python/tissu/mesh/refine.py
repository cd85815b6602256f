"""A mesh of half the cell size: every cell cut into eight, nodes kept."""

from __future__ import annotations

import dataclasses
import itertools
import reprlib
from typing import TYPE_CHECKING

import numpy as np

from tissu.errors import MeshError
from tissu.mesh.cell import CellBlock, Floats, Ints
from tissu.mesh.quadratic import into_quadratic

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh

_ACCEPTED = ("tetra", "hexahedron")
# Of a tetrahedron with the middles 4 to 9 of its edges 01, 12, 02, 03, 13, 23.
_AT_CORNERS = ((0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3))
# Between them an octahedron: an inner diagonal, and the ring of nodes around it.
_DIAGONALS = (((4, 9), (5, 6, 7, 8)), ((5, 7), (4, 6, 9, 8)), ((6, 8), (4, 5, 9, 7)))
_CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))


def refined(mesh: Mesh) -> Mesh:
    """The same volume with every tetrahedron and hexahedron cut into eight of half its size.

    The nodes of the mesh come first, with their numbers; the new ones stand in the middles of
    edges, of hexahedra's faces and of hexahedra. Regions follow; faces and lines are left out.

    Args:
        mesh: a mesh of tetrahedra and hexahedra with straight edges.

    Raises:
        MeshError: it is not a mesh, or there are other volume cells.
    """
    if not hasattr(mesh, "volume_blocks"):
        text = f"found {reprlib.repr(mesh)}; a Mesh is accepted, such as read_mesh('liver.vtu')"
        raise MeshError(f"{text} gives")
    wrong = [block.type for block in mesh.volume_blocks if block.type not in _ACCEPTED]
    if wrong:
        raise MeshError(f"found cells of type {wrong[0]}; {', '.join(_ACCEPTED)} are accepted")
    middles = into_quadratic(mesh, centres=True)
    cells = tuple(
        CellBlock(block.type, _eight(block.type, rich.nodes, middles.points))
        for block, rich in zip(mesh.volume_blocks, middles.volume_blocks, strict=True)
    )
    eighth = np.arange(8, dtype=np.int32)
    regions = {n: (8 * numbers[:, None] + eighth).ravel() for n, numbers in mesh.regions.items()}
    return dataclasses.replace(
        middles,
        cells=cells,
        regions=regions,
        source=None,
        notes=(*mesh.notes, "cells cut into eight"),
    )


def _eight(cell_type: str, nodes: Ints, points: Floats) -> Ints:
    """The eight cells (8 e, k) of each cell (e, 10 or 27), cell by cell."""
    parts = _of_tetrahedra(nodes, points) if cell_type == "tetra" else _of_hexahedra(nodes)
    return parts.reshape(-1, parts.shape[2])


def _of_tetrahedra(nodes: Ints, points: Floats) -> Ints:
    """Tetrahedra (e, 8, 4): four at the corners, four around the shortest inner diagonal."""
    lengths = [
        np.linalg.norm(points[nodes[:, a]] - points[nodes[:, b]], axis=1)
        for (a, b), _ in _DIAGONALS
    ]
    shortest = np.argmin(lengths, axis=0)
    inner = np.array(
        [[(*ends, ring[i], ring[(i + 1) % 4]) for i in range(4)] for ends, ring in _DIAGONALS]
    )
    at_corners = nodes[:, np.array(_AT_CORNERS)]
    around = np.take_along_axis(nodes, inner[shortest].reshape(len(nodes), 16), axis=1)
    cells: Ints = np.concatenate([at_corners, around.reshape(-1, 4, 4)], axis=1)
    edges = points[cells[..., 1:]] - points[cells[..., :1]]
    turned = np.linalg.det(edges) < 0.0
    cells[turned] = cells[turned][:, [0, 2, 1, 3]]
    return cells


def _of_hexahedra(nodes: Ints) -> Ints:
    """Hexahedra (e, 8, 8) on the lattice of 27 nodes."""
    from tissu import _core

    edges = _core.cell_edges(cell_type="hexahedron")
    faces = {row[-1]: row[:4] for _, row in _core.cell_faces(cell_type="hexahedron27")}
    around = [*([n] for n in range(8)), *edges, *(faces[n] for n in sorted(faces)), list(range(8))]
    corners = np.array(_CORNERS)
    place = {tuple(corners[row].mean(axis=0).astype(int)): n for n, row in enumerate(around)}
    parts = [
        [place[tuple(np.array(low) + corner // 2)] for corner in corners]
        for low in itertools.product((0, 1), repeat=3)
    ]
    return np.asarray(nodes[:, np.array(parts)])
