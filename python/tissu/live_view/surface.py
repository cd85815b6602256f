"""What is seen of a body: its surface, or its lines, by the nodes that are on them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.mesh.thin import line_pieces

if TYPE_CHECKING:
    from tissu.mesh import Mesh

Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """The surface of a body, and its lines.

    Attributes:
        nodes: numbers (k,) of the body's nodes that are seen.
        triangles: (t, 3) places in `nodes`.
        cells: (t,) number of the cell of each triangle in the body's mesh.
        edges: (e, 2) places in `nodes`: sides of faces, without the diagonals of quads.
        lines: (l, 2) places in `nodes`, of line cells.
        line_cells: (l,) number of the cell of each line.
    """

    nodes: Ints
    triangles: Ints
    cells: Ints
    edges: Ints
    lines: Ints
    line_cells: Ints


@lru_cache(maxsize=16)  # a mesh never changes
def seen(mesh: Mesh) -> Seen:
    """What is seen of a mesh; of nodes that no cell joins, the nodes."""
    surface = mesh.surface()
    ends, of_lines = line_pieces(mesh)
    triangles, lines = surface.triangles.astype(np.int64), np.asarray(ends, dtype=np.int64)
    sides = [
        np.asarray(face.nodes, dtype=np.int64)[:, [k, (k + 1) % face.nodes.shape[1]]]
        for face in surface.faces
        for k in range(face.nodes.shape[1])
    ]
    edges = np.unique(np.sort(np.concatenate([np.empty((0, 2), np.int64), *sides]), axis=1), axis=0)
    parts = [triangles.ravel(), lines.ravel()]
    nodes = np.unique(np.concatenate(parts))
    if not len(nodes):
        nodes = np.arange(mesh.node_count, dtype=np.int64)
    place = np.zeros(mesh.node_count, dtype=np.int64)
    place[nodes] = np.arange(len(nodes))
    return Seen(
        nodes=nodes,
        triangles=place[triangles].reshape(-1, 3),
        cells=np.asarray(surface.cells, dtype=np.int64),
        edges=place[edges].reshape(-1, 2),
        lines=place[lines].reshape(-1, 2),
        line_cells=np.asarray(of_lines, dtype=np.int64),
    )
