"""A mesh of tetrahedra from one of hexahedra, faces matching."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

from tissu.mesh.cell import CellBlock, Ints

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh

# Of each corner of a hexahedron in VTK's order: the three faces that do not touch it.
_FACES = np.array(
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
)
_OPPOSITE = np.array([[f for f in range(6) if corner not in _FACES[f]] for corner in range(8)])


def into_tetrahedra(mesh: Mesh) -> Mesh:
    """The same nodes and volume, every hexahedron cut into six tetrahedra.

    A hexahedron is cut from its corner with the lowest node number, and every face along the
    diagonal through its own lowest number, so two cells cut the face between them the same way.
    Tetrahedra stay as they are; regions follow; other cells are left out.
    """
    blocks: list[CellBlock] = []
    parents: list[Ints] = []
    first = 0
    for block in mesh.volume_blocks:
        numbers = np.arange(first, first + len(block.nodes), dtype=np.int32)
        first += len(block.nodes)
        if block.type == "hexahedron":
            blocks.append(CellBlock("tetra", _cut(block.nodes)))
            parents.append(np.repeat(numbers, 6))
        else:
            blocks.append(block)
            parents.append(numbers)
    parent = np.concatenate(parents) if parents else np.zeros(0, dtype=np.int32)
    regions = {
        name: np.flatnonzero(np.isin(parent, cells)).astype(np.int32)
        for name, cells in mesh.regions.items()
    }
    note = "hexahedra cut into six tetrahedra each"
    return dataclasses.replace(
        mesh, cells=tuple(blocks), regions=regions, source=None, notes=(*mesh.notes, note)
    )


def _cut(hexahedra: Ints) -> Ints:
    """Six tetrahedra (6 e, 4) of each hexahedron (e, 8): a corner and the triangles opposite."""
    rows = np.arange(len(hexahedra))
    corner = hexahedra.argmin(axis=1)
    faces = hexahedra[rows[:, None, None], _FACES[_OPPOSITE[corner]]]  # (e, 3, 4), outward
    start = faces.argmin(axis=2)
    turned = np.take_along_axis(faces, (start[:, :, None] + np.arange(4)) % 4, axis=2)
    triangles = np.stack([turned[:, :, [0, 1, 2]], turned[:, :, [0, 2, 3]]], axis=2)
    apex = np.broadcast_to(hexahedra[rows, corner][:, None, None, None], (*triangles.shape[:3], 1))
    # VTK's tetrahedron: the fourth node on the side the first three turn towards; outward faces
    # turn away from the apex.
    cells = np.concatenate([triangles[..., [0, 2, 1]], apex], axis=3)
    return np.ascontiguousarray(cells.reshape(-1, 4), dtype=np.int32)
