"""States in which the tests of cuts begin."""

from __future__ import annotations

from typing import Any

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


def damped_bar(cell: Any) -> ts.Body:
    """A soft bar of 10 x 4 x 4 cm with cells of 2 cm, which soon comes to rest."""
    return ts.Body(
        mesh=ts.BarMesh(size=(0.1, 0.04, 0.04), cells=(5, 2, 2), cell=cell),
        law=ts.StVK(young=8e3, poisson=0.3),
        density=1000.0,
        viscosity=ts.Rayleigh(mass=20.0, stiffness=0.01),
    )
