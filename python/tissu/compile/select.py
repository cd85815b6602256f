"""Which faces of a mesh the selected nodes mean."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.prepared import Ints
from tissu.mesh.cell import CellBlock
from tissu.mesh.flat_edges import flat_edges
from tissu.mesh.whole_faces import whole_faces

if TYPE_CHECKING:
    from tissu.mesh import Mesh


def selected_faces(nodes: Ints, mesh: Mesh, *, flat: bool = False) -> tuple[CellBlock, ...]:
    """Whole faces of the surface, outward, whose nodes are all among `nodes`.

    The surface of a flat body is its rim.
    """
    chosen = np.zeros(mesh.node_count, dtype=bool)
    chosen[nodes] = True
    faces = flat_edges(mesh) if flat else whole_faces(mesh)
    kept = ((b.type, b.nodes[chosen[b.nodes].all(axis=1)]) for b in faces)
    return tuple(CellBlock(kind, faces) for kind, faces in kept if len(faces))
