"""States in which the tests of cuts begin."""

from __future__ import annotations

import numpy as np

import tissu as ts

SOLVED = ts.Newton(iterations=30, tolerance=1e-11)
"""For pieces compared with others built apart: whether a linearised step is iterated on
hangs on what acts on the whole body."""


def shaken(simulation: ts.Simulation, seed: int = 1) -> ts.Simulation:
    """Bodies that are deformed and move, each node in its own way."""
    random = np.random.default_rng(seed)
    for body in simulation.bodies:
        places = simulation.positions[body]
        places += 2e-3 * random.standard_normal(places.shape)
        simulation.velocities[body][:] = random.standard_normal(places.shape)
    return simulation
