"""A mesh of quadratic cells from one of linear cells."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.errors import MeshError
from tissu.mesh.cell import CellBlock, Floats, Ints

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh

_QUADRATIC = {
    "tetra": "tetra10",
    "hexahedron": "hexahedron20",
    "wedge": "wedge15",
    "pyramid": "pyramid13",
}


def into_quadratic(mesh: Mesh, *, centres: bool = False) -> Mesh:
    """The same cells with a node in the middle of every edge, shared by the cells around it.

    Regions stay; faces and lines are left out.

    Args:
        mesh: a mesh of linear volume cells.
        centres: whether hexahedra have 27 nodes, with one in the middle of each face and one in the
            centre, instead of 20; then the mesh may also have tetrahedra, but no other cells.

    Raises:
        MeshError: there are cells that are not linear or cannot stand beside the hexahedra.
    """
    blocks = mesh.volume_blocks
    accepted = ("tetra", "hexahedron") if centres else tuple(_QUADRATIC)
    wrong = [block.type for block in blocks if block.type not in accepted]
    if wrong:
        raise MeshError(f"found cells of type {wrong[0]}; {', '.join(accepted)} are accepted")
    groups = [_groups(block, centres) for block in blocks]
    numbers, middles = _numbered(groups, mesh)
    names = _QUADRATIC | ({"hexahedron": "hexahedron27"} if centres else {})
    cells = tuple(
        CellBlock(names[block.type], np.hstack([block.nodes, new]))
        for block, new in zip(blocks, numbers, strict=True)
    )
    points = np.vstack([mesh.points, middles])
    return dataclasses.replace(mesh, points=points, cells=cells, border_regions={}, source=None)


def _groups(block: CellBlock, centres: bool) -> Ints:
    """Corners (e, m, 8) around each of the m new nodes of each cell, increasing, filled with -1."""
    rows = _core.cell_edges(cell_type=block.type)
    if centres and block.type == "hexahedron":
        faces = {nodes[-1]: nodes[:4] for _, nodes in _core.cell_faces(cell_type="hexahedron27")}
        rows += [faces[node] for node in sorted(faces)] + [list(range(8))]
    groups = np.full((len(block), len(rows), 8), -1, dtype=np.int32)
    for m, row in enumerate(rows):
        groups[:, m, : len(row)] = np.sort(block.nodes[:, row], axis=1)
    return groups


def _numbered(groups: list[Ints], mesh: Mesh) -> tuple[list[Ints], Floats]:
    """Numbers (e, m) of the new nodes of each block's cells, and the positions of the new nodes."""
    if not groups:
        return [], np.empty((0, 3))
    every = np.concatenate([group.reshape(-1, 8) for group in groups])
    around, number = np.unique(every, axis=0, return_inverse=True)
    numbers: Ints = np.asarray(number.reshape(-1) + mesh.node_count, dtype=np.int32)
    ends = np.cumsum([group.shape[0] * group.shape[1] for group in groups])[:-1]
    parts: list[Ints] = np.split(numbers, ends)
    shaped = [np.reshape(p, g.shape[:2]) for p, g in zip(parts, groups, strict=True)]
    inside = around >= 0
    sums = np.where(inside[:, :, None], mesh.points[around], 0.0).sum(axis=1)
    return shaped, np.asarray(sums / inside.sum(axis=1, keepdims=True))
