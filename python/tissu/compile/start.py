"""The state in which bodies begin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.scene.support import Prescribed

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.simulation import Simulation

Components = NDArray[np.bool_]
Floats = NDArray[np.float64]


def begin(simulation: Simulation, prepared: Prepared) -> None:
    """Put bodies that ask for it into their first state.

    What supports hold keeps its own, and what motions lead begins with their velocity: it may
    drift with its body, and strains nothing then.
    """
    for name, body in prepared.scene.bodies.items():
        if body.start is None:
            continue
        free, turning = _free(prepared, name, simulation.positions[name].shape)
        rest = simulation.positions[name].copy()
        places, velocities = body.start.state(rest)
        simulation.positions[name][free] = places[free]
        simulation.velocities[name][free] = velocities[free]
        if body.start.spin is not None and body.has_rotations:
            spins = simulation._core.velocities[simulation.rows(name, rotations=True)]
            spins[turning] = np.broadcast_to(body.start.spin, spins.shape)[turning]
        _begin_led(simulation, prepared, name, rest)
    simulation._core.keep_held_velocities()


def _begin_led(simulation: Simulation, prepared: Prepared, name: str, rest: Floats) -> None:
    """Give what motions lead the velocity of its motion."""
    for held in prepared.held:
        support = held.support
        if support.body != name or not isinstance(support, Prescribed):
            continue
        led, spin = support.start_velocities(held.nodes, rest[held.nodes])
        velocities = simulation.velocities[name]
        for axis in range(3):
            if support.axes_mask >> axis & 1:
                velocities[held.nodes, axis] = led[:, axis]
        if not prepared.has_rotations(name) or support.rotation is None:
            continue
        if support.rotations_mask:
            spins = simulation._core.velocities[simulation.rows(name, rotations=True)]
            spins[held.nodes] = spin


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
