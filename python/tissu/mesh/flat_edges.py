"""The rim of a flat body: the edges of its sheets that loads act on."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from tissu.mesh.cell import CellBlock, Ints, dimension, thin_types

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh


@lru_cache(maxsize=8)
def flat_edges(mesh: Mesh) -> tuple[CellBlock, ...]:
    """Edges that one sheet only has, as lines along which it lies on the left seen from +z."""
    found = [
        _edges(mesh, block)
        for block in mesh.thin_blocks
        if dimension(block.type) == 2 and len(block)
    ]
    if not found:
        return ()
    ends = np.sort(np.concatenate([edges[:, :2] for edges in found]), axis=1)
    _, number, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    alone = np.split(count[number.ravel()] == 1, np.cumsum([len(edges) for edges in found])[:-1])
    kept: dict[str, list[Ints]] = {}
    for edges, outer in zip(found, alone, strict=True):
        kept.setdefault({2: "line", 3: "line3"}[edges.shape[1]], []).append(edges[outer])
    return tuple(CellBlock(kind, np.concatenate(parts)) for kind, parts in kept.items())


def _edges(mesh: Mesh, block: CellBlock) -> Ints:
    """All edges of the cells of a block: both ends, and the node between them if there is one."""
    cell_type, nodes = thin_types()[block.type], np.asarray(block.nodes)
    corners, sides = nodes[:, : cell_type.corners], []
    x, y = mesh.points[corners][..., 0], mesh.points[corners][..., 1]
    area = (x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1)
    for side in range(cell_type.corners):
        ends = np.stack([corners[:, side], corners[:, (side + 1) % cell_type.corners]], axis=1)
        ends[area < 0.0] = ends[area < 0.0, ::-1]
        middle = nodes[:, [cell_type.corners + side]] if cell_type.order == 2 else nodes[:, :0]
        sides.append(np.hstack([ends, middle]))
    return np.asarray(np.concatenate(sides), dtype=np.int32)
