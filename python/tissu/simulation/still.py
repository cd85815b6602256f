"""Which nodes of a body a cut must not move, beside those that the core knows."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tissu.mesh import Mesh

Ints = NDArray[np.int32]


def still_nodes(
    mesh: Mesh, rows: Iterable[NDArray[np.integer[Any]]], first: int, count: int
) -> Ints:
    """Nodes of grabs, and those on the border of a named region, ascending.

    Args:
        mesh: of the body as it is now.
        rows: of the unknowns, of the nodes of each grab.
        first: row of the body's first node.
        count: of its nodes.
    """
    still = np.zeros(count, dtype=bool)
    for nodes in rows:
        own = np.asarray(nodes) - first
        still[own[(own >= 0) & (own < count)]] = True
    for cells in mesh.regions.values():
        inside = np.zeros(mesh.cell_count, dtype=bool)
        inside[cells] = True
        within, outside = np.zeros(count, dtype=bool), np.zeros(count, dtype=bool)
        start = 0
        for block in mesh.cells:
            of_block = inside[start : start + len(block.nodes)]
            within[block.nodes[of_block]] = True
            outside[block.nodes[~of_block]] = True
            start += len(block.nodes)
        still |= within & outside
    return np.flatnonzero(still).astype(np.int32)
