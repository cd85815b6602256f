"""The state in which bodies begin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.scene.start import Start
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]


def begin(simulation: Simulation, prepared: Prepared) -> None:
    """Put bodies that ask for it into their first state; nodes that are held keep theirs."""
    for name, body in prepared.scene.bodies.items():
        if body.start is None:
            continue
        free = _free(prepared, name, simulation.positions[name].shape)
        places, velocities = _first(body.start, simulation.positions[name])
        simulation.positions[name][free] = places[free]
        simulation.velocities[name][free] = velocities[free]


def _free(prepared: Prepared, name: str, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Components that no support gives."""
    free = np.ones(shape, dtype=bool)
    for held in prepared.held:
        if held.support.body == name:
            for axis, letter in enumerate("xyz"):
                if letter in held.support.axes:
                    free[held.nodes, axis] = False
    return free


def _first(start: Start, rest: Floats) -> tuple[Floats, Floats]:
    """Positions and velocities of all nodes; the centre is that of the nodes."""
    centre = rest.mean(axis=0)
    places = rest.copy()
    if start.shape == "point":
        places[:] = centre
    elif start.shape == "plane":
        places[:, 2] = centre[2]
    elif start.shape == "inside_out":
        places[:, 2] = 2.0 * centre[2] - places[:, 2]
    elif start.shape == "random":
        random = np.random.default_rng(start.seed)
        places = random.uniform(rest.min(axis=0), rest.max(axis=0), rest.shape)
    velocities = np.zeros_like(rest)
    if start.velocity is not None:
        velocities += np.array(start.velocity)
    if start.spin is not None:
        velocities += np.cross(np.array(start.spin), places - centre)
    return places, velocities
