"""A mesh of tetrahedra from one of any volume cells, faces matching."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.errors import MeshError
from tissu.mesh.cell import CellBlock, Ints, cell_table, linear_type

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh


def into_tetrahedra(mesh: Mesh) -> Mesh:
    """The same corners and volume, every cell cut: hexahedra into six tetrahedra, wedges three.

    A cell is cut from its corner with the lowest node number, and every face along the diagonal
    through its own lowest number, so two cells cut the face between them the same way. A pyramid
    becomes two; tetrahedra stay as they are. Cells are cut by their corners: nodes in the middles
    of edges go. Regions follow; faces and lines are left out.

    Raises:
        MeshError: there is no volume cell to cut.
    """
    if not mesh.volume_blocks:
        found = ", ".join(block.type for block in mesh.cells if len(block)) or "no cells"
        raise MeshError(f"found {found} where volume cells are cut into tetrahedra")
    blocks: list[CellBlock] = []
    parents: list[Ints] = []
    first = 0
    for block in mesh.volume_blocks:
        cells, parent = _cut(block)
        blocks.append(CellBlock("tetra", cells))
        parents.append(parent + first)
        first += len(block)
    parent = np.concatenate(parents) if parents else np.zeros(0, dtype=np.int32)
    regions = {
        name: np.flatnonzero(np.isin(parent, cells)).astype(np.int32)
        for name, cells in mesh.regions.items()
    }
    note = "cells cut into tetrahedra"
    cut = dataclasses.replace(
        mesh,
        cells=tuple(blocks),
        regions=regions,
        border_regions={},
        source=None,
        notes=(*mesh.notes, note),
    )
    quadratic = any(cell_table()[block.type].order > 1 for block in mesh.volume_blocks)
    return cut.without_unused_nodes() if quadratic else cut


def _cut(block: CellBlock) -> tuple[Ints, Ints]:
    """Tetrahedra (t, 4) of the cells of a block, cell by cell, and the cell (t,) of each."""
    base = linear_type(block.type)
    corners = block.nodes[:, : cell_table()[base].corners]
    if base == "tetra":
        return corners, np.arange(len(block), dtype=np.int32)
    lowest = corners.argmin(axis=1)
    cells, parents = [], []
    for corner in range(corners.shape[1]):
        rows = np.flatnonzero(lowest == corner)
        for _, face in _core.cell_faces(cell_type=base):
            if corner not in face:
                for triangle in _triangles(corners[rows][:, face]):
                    # VTK's tetrahedron: the fourth node on the side the first three turn towards;
                    # faces turn away from the corner.
                    cells.append(np.column_stack([triangle[:, ::-1], corners[rows, corner]]))
                    parents.append(rows)
    parent = np.concatenate(parents).astype(np.int32)
    order = np.argsort(parent, kind="stable")
    return np.concatenate(cells)[order].astype(np.int32), parent[order]


def _triangles(faces: Ints) -> list[Ints]:
    """A triangle as it is; of a quad (e, 4), both halves along the diagonal at its lowest node."""
    if faces.shape[1] == 3:
        return [faces]
    turned = (faces.argmin(axis=1)[:, None] + np.arange(4)) % 4
    quads = np.take_along_axis(faces, turned, axis=1)
    return [quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]
