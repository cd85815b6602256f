"""Momenta of the pieces of a body, for the tests of what pieces exchange."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import tissu as ts

Array = npt.NDArray[np.float64]
Nodes = npt.NDArray[Any]


def momenta(simulation: ts.Simulation, body: str, nodes: Nodes) -> tuple[Array, Array]:
    """Linear momentum, and angular momentum about the origin."""
    rows = simulation.rows(body)
    mass = simulation.mass_matrix().diagonal().reshape(-1, 3)[rows][nodes]
    p = mass * simulation.velocities[body][nodes]
    return p.sum(axis=0), np.cross(simulation.positions[body][nodes], p).sum(axis=0)


def pieces(simulation: ts.Simulation, body: str) -> list[Nodes]:
    """The nodes of each piece, from left to right."""
    cells = np.vstack([block.nodes for block in simulation.meshes[body].body_blocks])
    place = {cell: i for i, cell in enumerate(simulation.remaining_cells(body))}
    found = [np.unique(cells[[place[c] for c in p.cells]]) for p in simulation.pieces(body)]
    return sorted(found, key=lambda nodes: float(simulation.positions[body][nodes, 0].mean()))
