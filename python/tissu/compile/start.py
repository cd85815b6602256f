"""The state in which bodies begin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.simulation import Simulation

Components = NDArray[np.bool_]


def begin(simulation: Simulation, prepared: Prepared) -> None:
    """Put bodies that ask for it into their first state; what supports hold keeps its own."""
    for name, body in prepared.scene.bodies.items():
        if body.start is None:
            continue
        free, turning = _free(prepared, name, simulation.positions[name].shape)
        places, velocities = body.start.state(simulation.positions[name])
        simulation.positions[name][free] = places[free]
        simulation.velocities[name][free] = velocities[free]
        if body.start.spin is not None and body.has_rotations:
            spins = simulation._core.velocities[simulation.rows(name, rotations=True)]
            spins[turning] = np.broadcast_to(body.start.spin, spins.shape)[turning]


def _free(prepared: Prepared, name: str, shape: tuple[int, ...]) -> tuple[Components, Components]:
    """The components of nodes, and those of their rotations, that no support gives."""
    free, turning = np.ones(shape, dtype=bool), np.ones(shape, dtype=bool)
    for held in prepared.held:
        if held.support.body == name:
            for axis in range(3):
                if held.support.axes_mask >> axis & 1:
                    free[held.nodes, axis] = False
                if held.support.rotations_mask >> axis & 1:
                    turning[held.nodes, axis] = False
    return free, turning
