"""Nodes of small copies in a cut shell, which have little mass, turn far.

Neither they nor the steps in which they do so add energy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, damped

LENGTH = 0.1
"""[m]"""
WEIGHT = LENGTH * 0.08 * 0.0005 * 1000.0 * GRAVITY
"""[N]"""
GAINED = 1e-4 * WEIGHT * LENGTH
"""Of what it falls by: a linearised step misses its equation by the square of its turns."""


def thin_shell(**fields: Any) -> ts.Body:
    """Half a millimetre thick, so soft in bending that it hangs down at once."""
    return ts.Body(
        mesh=ts.bar_mesh(size=(LENGTH, 0.08, 0), cells=(6, 6, 0), cell="triangle"),
        law=ts.Hooke(young="100 kPa", poisson=0.3),
        model=ts.Shell(),
        density="1 g/cm^3",
        thickness="0.5 mm",
        **fields,
    )


def fallen(body: ts.Body, **fields: Any) -> ts.Simulation:
    scene = ts.Scene(
        **{
            "bodies": {"shell": body},
            "gravity": (0, 0, -GRAVITY),
            "step": ts.ImplicitEuler("5 ms"),
            "editing": ts.Editing(room="1000 %"),
        }
        | fields
    )
    simulation = scene.compile()
    for _ in range(60):
        simulation.step()
    return simulation


def follow(simulation: ts.Simulation, steps: int) -> None:
    before = simulation.energy()["total"]
    for _ in range(steps):
        report = simulation.step()
        after = simulation.energy()["total"]
        assert report.converged, report
        assert after - before <= GAINED, report
        before = after


@pytest.mark.parametrize(
    ("seed", "viscosity"), [(70, damped()), (44, None), (127, None), (193, None)]
)
def test_a_cut_shell_that_hangs_gains_no_energy(seed: int, viscosity: ts.Rayleigh | None) -> None:
    """In undamped ones energy had grown a thousandfold, and the damped one had flown apart."""
    body = thin_shell() if viscosity is None else thin_shell(viscosity=viscosity)
    held = ts.Fixed("shell", on=ts.Plane((0, 0, 0), (1, 0, 0)))
    simulation = fallen(body, fixed=[held])
    random = np.random.default_rng(seed)
    places = simulation.positions["shell"]
    low, high = places.min(axis=0), places.max(axis=0)
    point = (low + (high - low) * random.uniform(0.1, 0.9, 3)).round(4)
    angle = random.uniform(0, np.pi)
    normal = (round(np.cos(angle), 2), round(np.sin(angle), 2), 0)
    report = simulation.cut("shell", ts.Disc(point, normal, 0.03))
    assert len(report.pieces) == 1
    follow(simulation, 60)


def test_a_copy_that_turns_over_on_a_ball_leaves_the_shell_in_one_place() -> None:
    """It had turned by 169 degrees in a step, and the run had diverged."""
    simulation = fallen(
        thin_shell(viscosity=damped()),
        obstacles={
            "ball": ts.SphereObstacle((0.05, 0.04, -0.018), radius=0.015),
            "table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1)),
        },
        contacts=[ts.Contact(("shell", name), friction=0.2) for name in ("ball", "table")],
    )
    simulation.cut("shell", ts.Plane((0.0453, 0.0437, -0.0207), (0.51, 0.86, 0)))
    follow(simulation, 60)
