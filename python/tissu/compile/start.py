"""The state in which bodies begin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.simulation import Simulation


def begin(simulation: Simulation, prepared: Prepared) -> None:
    """Put bodies that ask for it into their first state; nodes that are held keep theirs."""
    for name, body in prepared.scene.bodies.items():
        if body.start is None:
            continue
        free = _free(prepared, name, simulation.positions[name].shape)
        places, velocities = body.start.state(simulation.positions[name])
        simulation.positions[name][free] = places[free]
        simulation.velocities[name][free] = velocities[free]
        if body.start.spin is not None and body.has_rotations:
            turning = free.all(axis=1)
            spins = simulation._core.velocities[simulation.rows(name, rotations=True)]
            spins[turning] = np.array(body.start.spin)


def _free(prepared: Prepared, name: str, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Components that no support gives."""
    free = np.ones(shape, dtype=bool)
    for held in prepared.held:
        if held.support.body == name:
            for axis in range(3):
                if held.support.axes_mask >> axis & 1:
                    free[held.nodes, axis] = False
    return free
