"""Grabs after an edit of their body: those whose material is parted or gone are released."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.simulation import grab as kept
from tissu.simulation.grab_point import point_at

if TYPE_CHECKING:
    from collections.abc import Callable

    from tissu import _core as core
    from tissu.cutting.material import Material
    from tissu.mesh import Mesh
    from tissu.simulation.grab import Record

Ints = NDArray[np.int32]


def grabs_of(simulation: core.Simulation, body: str) -> dict[int, Record]:
    """The grabs of a body by their numbers."""
    first, count = simulation.body_range(body)
    return {
        number: record
        for number, record in kept.records(simulation).items()
        if first <= record.nodes[0] < first + count
    }


def follow(
    simulation: core.Simulation,
    body: str,
    mesh: Mesh,
    *,
    copied: Ints | None = None,
    before: Mesh | None = None,
    material: Callable[[], Material] | None = None,
) -> tuple[int, ...]:
    """Let the grabs of a body follow an edit; returns the numbers of those that are released.

    A grab holds nodes, not material: it is released where one of them was copied, or where no cell
    has all of them any more. Cells may be divided or repaired, though: then it goes on in the cell
    that has its place.

    Args:
        simulation: of the core.
        body: its name.
        mesh: of its cells after the edit.
        copied: numbers of the nodes that were copied.
        before: the mesh before an edit that put other cells in the place of those that are gone.
        material: makes what is there of the cells after such an edit.
    """
    first, _ = simulation.body_range(body)
    grabs = kept.records(simulation)
    released, changed = [], False
    for number, record in grabs_of(simulation, body).items():
        nodes = record.nodes - first
        if copied is None or not np.isin(nodes, copied).any():
            if _in_a_cell(nodes, mesh):
                continue
            if before is not None and material is not None and record.frame < 0:
                place = record.weights @ before.points[nodes]
                cells = np.sort(simulation.remaining_cells(body))
                point = point_at(place, mesh, cells, material())
                if point is not None:
                    grabs[number].nodes, grabs[number].weights = first + point.nodes, point.weights
                    changed = True
                    continue
        del grabs[number]
        released.append(number)
    if released or changed:
        kept.keep(simulation, grabs)
    return tuple(released)


def _in_a_cell(nodes: NDArray[np.int64], mesh: Mesh) -> bool:
    """Whether a cell has all of these nodes."""
    return any(
        bool((np.isin(block.nodes, nodes).sum(axis=1) == len(nodes)).any())
        for block in mesh.body_blocks
    )
