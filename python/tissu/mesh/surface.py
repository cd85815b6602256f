"""The outer surface of a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.mesh import thin
from tissu.mesh.cell import CellBlock, Floats, Ints, corners

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """Faces that belong to one cell only, anticlockwise seen from outside.

    Attributes:
        triangles: node numbers (t, 3) int32, those between the nodes of the faces of quadratic
            cells too; the last 2 q rows are the halves of the quads.
        cells: number (t,) int32 of the cell each triangle belongs to, across the volume blocks.
        quads: node numbers (q, 4) int32 of the faces with four nodes; quad i is split along its
            corners 0 and 2 into the triangles t - 2 q + 2 i and the next one.
    """

    triangles: Ints
    cells: Ints
    quads: Ints

    @property
    def nodes(self) -> Ints:
        """Numbers (k,) int32 of the nodes on the surface, increasing."""
        return np.unique(self.triangles).astype(np.int32)

    @property
    def faces(self) -> tuple[CellBlock, ...]:
        """The faces as cells: triangles that are not half of a quad, then quads; no empty block."""
        whole = self.triangles[: len(self.triangles) - 2 * len(self.quads)]
        blocks = (CellBlock("triangle", whole), CellBlock("quad", self.quads))
        return tuple(block for block in blocks if len(block))


@lru_cache(maxsize=8)  # a mesh never changes, and is asked for its surface again and again
def boundary(mesh: Mesh) -> Surface:
    """The outer surface of the volume cells and the sheets that are not on it.

    For a mesh without simulated cells, its own faces.
    """
    if mesh.body_blocks:
        found = _core.boundary_surface(positions=mesh.points, blocks=mesh.native_blocks())
        return _surface(*(_with_sheets(found, thin.faces(mesh)) if mesh.thin_blocks else found))
    triangles = np.concatenate([np.empty((0, 3), np.int32), *corners(mesh.cells, "triangle", 3)])
    quads = np.concatenate([np.empty((0, 4), np.int32), *corners(mesh.cells, "quad", 4)])
    first = np.arange(len(triangles), dtype=np.int32)
    second = np.arange(len(triangles), len(triangles) + len(quads), dtype=np.int32)
    return _surface(triangles, first, quads, second)


_Faces = tuple[Ints, Ints, Ints, Ints]


def _with_sheets(outer: _Faces, sheets: _Faces) -> _Faces:
    """The outer faces, then those of sheets that do not lie on one of them."""
    triangles, of_triangles, quads, of_quads = sheets
    keep, other = _absent(triangles, outer[0]), _absent(quads, outer[2])
    return (
        np.concatenate([outer[0], triangles[keep]]),
        np.concatenate([outer[1], of_triangles[keep]]),
        np.concatenate([outer[2], quads[other]]),
        np.concatenate([outer[3], of_quads[other]]),
    )


def _absent(faces: Ints, among: Ints) -> NDArray[np.bool_]:
    """Which faces have nodes that none of the others has."""
    known = {tuple(row) for row in np.sort(among, axis=1).tolist()}
    found = [tuple(row) not in known for row in np.sort(faces, axis=1).tolist()]
    return np.array(found, dtype=bool)


def _surface(triangles: Ints, triangle_cells: Ints, quads: Ints, quad_cells: Ints) -> Surface:
    halves = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    parts = (
        np.concatenate([triangles, halves]),
        np.concatenate([triangle_cells, np.repeat(quad_cells, 2)]),
        quads,
    )
    for part in parts:
        part.flags.writeable = False
    return Surface(*parts)


def area(points: Floats, triangles: Ints) -> Floats:
    """Area (t,) of each triangle [m2]."""
    a, b, c = points[triangles].swapaxes(0, 1)
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0)


def enclosed_volume(points: Floats, triangles: Ints) -> float:
    """Volume inside a closed surface [m3], negative when it is wound inwards.

    A third of the flux of x through it (divergence theorem).
    """
    if not len(triangles):
        return 0.0
    a, b, c = (points - points.mean(axis=0))[triangles].swapaxes(0, 1)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def edge_faults(triangles: Ints) -> tuple[int, int]:
    """Edges that only one triangle has, and edges that two triangles run along in the same sense.

    A closed surface that is wound one way throughout has neither.
    """
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    ascending = edges[:, 0] < edges[:, 1]
    key = np.sort(edges, axis=1) @ np.array([edges.max(initial=0) + 1, 1])
    _, number, count = np.unique(key, return_inverse=True, return_counts=True)
    sense = np.bincount(number, weights=np.where(ascending, 1.0, -1.0), minlength=len(count))
    return int(np.sum(count == 1)), int(np.sum((count > 1) & (sense != 0)))
