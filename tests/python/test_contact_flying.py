"""Bodies that collide while they fly together: what they have in common is not lost."""

import numpy as np
import pytest

import tissu as ts
from contact_audit import block
from test_contact_balance import masses, momentum

RELATIVE = 20.0
"""[m/s]: twice the edge of a body in a step, so that ways are cut"""


def two_cubes(common, step=ts.ImplicitEuler):
    """One flies into the other, off its centre, while both fly with a common velocity [m/s]."""
    given = {"law": ts.StableNeoHooke(young=1e5, poisson=0.3)}
    common = np.array(common, dtype=float)
    starts = {"low": common + np.array([0, 0, RELATIVE]), "high": common}
    places = {"low": (0, 0, 0), "high": (0.01, 0.015, 0.112)}
    bodies = {
        name: block(places[name], start=ts.Start(velocity=tuple(starts[name])), **given)
        for name in places
    }
    return ts.Scene(
        bodies=bodies,
        contacts=[ts.Contact(("low", "high"))],
        step=step("10 ms", solver=ts.Cholesky()),
    )


@pytest.mark.parametrize("step", [ts.ImplicitEuler, ts.BDF2])
@pytest.mark.parametrize("common", [(0, 0, 300), (300, 0, 0), (200, 100, -250)])
def test_the_momentum_stays_where_ways_are_cut(common, step):
    """To the tolerance of the linear solver in 12 steps; the bodies fly on, and part."""
    simulation = two_cubes(common, step).compile()
    start = momentum(simulation)
    held = 0
    for _ in range(12):
        report = simulation.step()
        assert simulation.crossings() == []
        held += report.held_back
    assert held > 0
    size = sum(masses(simulation, body).sum() for body in simulation.bodies)
    assert np.abs(momentum(simulation) - start).max() <= 1e-9 * size * (
        RELATIVE + np.abs(common).max()
    )
