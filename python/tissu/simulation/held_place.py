"""Which cell of a cut body holds a place: of the copies of a cell, that with the material there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.mesh.places import holders

if TYPE_CHECKING:
    from tissu.cutting.material import Material
    from tissu.mesh import Mesh
    from tissu.mesh.places import Holder

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_SLACK = 1e-6  # a place no farther outside of a part than this share of it is in it


def holder_in_material(
    place: Floats, mesh: Mesh, numbers: Ints, material: Material
) -> Holder | None:
    """The cell whose material contains a place at rest, or None if no material is there.

    Parts of a cell are looked at in its local coordinates, in which they fill it exactly, whether
    its faces are flat or not.

    Args:
        place: (3,) [m].
        mesh: of the cells at rest, which are copies of each other where a cut has parted them.
        numbers: of these cells (e,).
        material: what is there of them.
    """
    best, least = None, _SLACK
    for holder in holders(place, mesh):
        beyond = _beyond(holder, mesh, int(numbers[holder.cell]), material)
        if beyond < least:
            best, least = holder, beyond
        if least <= 0.0:
            break
    return best


def _beyond(holder: Holder, mesh: Mesh, cell: int, material: Material) -> float:
    """How far a place is outside of the material of a cell that holds it; 0 in it."""
    least, start = np.inf, 0
    for block in material.mesh.body_blocks:
        for row in np.flatnonzero(material.cell[start : start + len(block)] == cell):
            vertices = block.nodes[row]
            own = material.nodes[vertices, 0][material.weights[vertices, 0] == 1.0]
            if np.isin(holder.nodes, own).all():
                return 0.0  # it is whole
            least = min(least, _outside(holder, mesh, vertices, material))
        start += len(block)
    return max(float(least), 0.0)


def _outside(holder: Holder, mesh: Mesh, vertices: Ints, material: Material) -> float:
    """How far a place is outside of a part of the cell, between these vertices of its material."""
    if len(vertices) != holder.corners.shape[1] + 1:
        return np.inf
    corners = holder.nodes[: len(holder.corners)]
    if len(corners) == len(vertices):  # a simplex, or half a pyramid
        rest = mesh.points[corners]
        apart = material.mesh.points[vertices] - rest[0]
        inner = np.linalg.lstsq((rest[1:] - rest[0]).T, apart.T, rcond=None)[0].T
        at = holder.corners[0] + inner @ (holder.corners[1:] - holder.corners[0])
    else:
        nodes, weights = material.nodes[vertices], material.weights[vertices]
        shares = np.where(nodes[:, :, None] == corners, weights[:, :, None], 0.0).sum(axis=1)
        at = shares @ holder.corners
    sides = (at[1:] - at[0]).T
    if np.linalg.det(sides) == 0.0:
        return np.inf
    inner = np.linalg.solve(sides, holder.local - at[0])
    return float(max(-inner.min(), inner.sum() - 1.0))
