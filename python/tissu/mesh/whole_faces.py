"""The faces that loads act on: whole, as cells of their own type."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.mesh.cell import CellBlock, Floats, Ints, dimension

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh

_CORNERS = {"triangle": 3, "triangle6": 3, "quad": 4, "quad8": 4, "quad9": 4}


@lru_cache(maxsize=8)
def whole_faces(mesh: Mesh) -> tuple[CellBlock, ...]:
    """Faces of the volume that one cell only has, anticlockwise seen from outside, then sheets.

    A sheet that lies on a face of the volume is left out: a load acts there once.
    """
    outer: list[tuple[str, Ints]] = []
    if mesh.volume_blocks:
        blocks = [(block.type, block.nodes) for block in mesh.volume_blocks]
        found = _core.boundary_faces(positions=mesh.points, blocks=blocks)
        outer = [(kind, nodes) for kind, nodes, _ in found]
    sheets = [block for block in mesh.thin_blocks if dimension(block.type) == 2]
    if sheets:
        known = {key for kind, nodes in outer for key in _keys(kind, nodes)}
        for block in sheets:
            alone = [key not in known for key in _keys(block.type, block.nodes)]
            outer.append((block.type, block.nodes[np.array(alone, dtype=bool)]))
    return tuple(CellBlock(kind, nodes) for kind, nodes in outer if len(nodes))


def _keys(kind: str, nodes: Ints) -> list[tuple[int, ...]]:
    return [tuple(row) for row in np.sort(nodes[:, : _CORNERS[kind]], axis=1).tolist()]


def nodal_areas(mesh: Mesh, faces: tuple[CellBlock, ...], *, thickness: float = 0.0) -> Floats:
    """Each node's share (n,) of the area of the faces [m2], the integral of N_a.

    Edges of a flat body have its thickness [m].
    """
    shares = np.zeros(mesh.node_count)
    for block in faces:
        shares += _core.face_areas(
            type=block.type, positions=mesh.points, faces=block.nodes, thickness=thickness
        )
    return shares


def nodal_normals(mesh: Mesh, faces: tuple[CellBlock, ...], *, thickness: float = 0.0) -> Floats:
    """Each node's share (n, 3) of the outward normal of the faces [m2], the integral of N_a n."""
    shares = np.zeros((mesh.node_count, 3))
    for block in faces:
        shares += _core.face_normals(
            type=block.type, positions=mesh.points, faces=block.nodes, thickness=thickness
        )
    return shares
