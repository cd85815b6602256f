"""Scenes of two blocks and the tissue between them, for the tests of blades in tissue."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

import tissu as ts

G = 9.81
STEP = ts.ImplicitEuler("5 ms", newton=ts.Newton(iterations=30, tolerance=1e-9),
                        solver=ts.Cholesky())  # fmt: skip
MIDDLE = ts.Plane((0, 0, 0.055), (0, 0, 1))
HALF = ts.Sweep([[(x, -0.01, 0.055), (x, 0.11, 0.055)] for x in (-0.01, 0.05)])
ACROSS = ts.Plane((0.05, 0, 0), (1, 0, 0))


def around(body: str) -> ts.Triangles:
    """A blade all around a block, a micrometre off."""
    points = ts.examples.scene("tissue").bodies[body].mesh.mesh().points
    low, high = points.min(axis=0) - 1e-6, points.max(axis=0) + 1e-6
    bar = ts.BarMesh(size=tuple(high - low), cells=(1, 1, 1), cell="tetra", origin=tuple(low))
    return ts.Triangles(bar.mesh().points, bar.mesh().surface().triangles)


def hanging(**fields: Any) -> ts.Scene:
    """The lower block hangs on the upper one by the tissue `fascia` alone."""
    return ts.examples.scene("tissue").replace(**{"step": STEP, "editing": True, **fields})


def flying(**fields: Any) -> ts.Scene:
    """Both blocks fly, and the lower one turns."""
    scene = hanging(gravity=None, fixed=(), **fields)
    starts = {"upper": ts.Start(velocity=(0.1, 0, 0.05)), "lower": ts.Start(spin=(1, 2, -1))}
    bodies = {name: body.replace(start=starts[name]) for name, body in scene.bodies.items()}
    return scene.replace(bodies=bodies)


def alone(scene: ts.Scene, body: str) -> ts.Scene:
    """The scene of one body, without the tissue."""
    held = [support for support in scene.fixed if support.body == body]
    return scene.replace(bodies={body: scene.bodies[body]}, tissue={}, fixed=held)


@cache
def _compiled(which: int) -> tuple[ts.Simulation, Any]:
    simulation = hanging().compile()
    return simulation, simulation.mark()


def simulated(which: int = 0) -> ts.Simulation:
    """One of some simulations of the hanging block, at rest; compiled once for all tests."""
    simulation, start = _compiled(which)
    simulation.rewind(start)
    return simulation


def steps(simulation: ts.Simulation, count: int) -> None:
    """Take steps, all of which converge."""
    for _ in range(count):
        assert simulation.step().converged


def same(a: ts.Simulation, b: ts.Simulation) -> bool:
    """Whether two simulations have the same bits."""
    names = (*a.bodies, *a.tissue)
    return all(np.array_equal(a.positions[name], b.positions[name]) for name in names)
