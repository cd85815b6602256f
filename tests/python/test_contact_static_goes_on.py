"""Static steps whose searches of augmented contacts do not end: the barrier goes on from there."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts

GAP = 8e-4
"""between the blocks at the start [m]"""


def block(cell, cells, size, origin=(0.0, 0.0, 0.0)):
    return ts.Body(
        mesh=ts.BarMesh(size=size, cells=cells, cell=cell, origin=origin),
        law=ts.StableNeoHooke(young=8e3, poisson=0.4),
        density=1000.0,
        viscosity=ts.Rayleigh(mass=40.0, stiffness=0.05),
    )


def pressed(depth, *, cell="tetra", upper=(3, 3, 2), friction=0.4, step=None):
    """A soft block under a narrower one, whose top is led down, held for 2 s, and led back up."""
    low, high = (0.06, 0.06, 0.03), (0.05, 0.05, 0.03)
    top = low[2] + GAP + high[2]
    return ts.Scene(
        bodies={
            "low": block(cell, (4, 4, 2), low),
            "high": block(cell, upper, high, (0.01, 0.005, low[2] + GAP)),
        },
        fixed=[ts.Fixed("low", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        prescribed=[
            ts.Prescribed(
                "high",
                on=ts.Plane((0, 0, top), (0, 0, 1)),
                times=(0, 1, 3, 4),
                displacements=((0, 0, 0), (0, 0, -depth), (0, 0, -depth), (0, 0, 0)),
            )
        ],
        contacts=[ts.Contact(("low", "high"), friction=friction)],
        step=step or ts.Static(),
    ).compile()


@pytest.mark.parametrize(
    ("cell", "depth", "friction", "at_gap"),
    [
        ("tetra", 0.006, 0.4, True),
        ("hexahedron", 0.006, 0.4, False),
    ],
)
def test_two_soft_blocks_are_pressed_together_with_friction(cell, depth, friction, at_gap):
    """Forces balance, nothing crosses, and the report says by what the equilibrium was found."""
    simulation = pressed(depth, cell=cell, friction=friction)
    report = simulation.step(1.0)
    assert report.converged
    assert "the barrier went on" in report.message
    assert simulation.crossings() == []
    assert 0.1 < report.least_gap < (1.01 if at_gap else 2.0)
    assert ("up to two gaps apart" in report.message) != at_gap
    assert 0.0 < report.residual <= simulation.scene.step.newton.tolerance
    force = simulation.force_on("high").force
    assert force[2] > 2.0
    # Newton's tolerance is 1e-6 of the load.
    for body, sign in (("low", 1.0), ("high", -1.0)):
        reaction = simulation.reactions(body).sum(axis=0)
        np.testing.assert_allclose(reaction, sign * force, atol=1e-6 * force[2])


def test_the_way_back_parts_them():
    """What the barrier left is where augmented contacts go on from."""
    simulation = pressed(0.006)
    simulation.step(1.0)
    report = simulation.step(3.0)
    assert report.converged
    assert simulation.crossings() == []
    np.testing.assert_allclose(simulation.force_on("high").force, 0.0, atol=1e-9)


def test_the_force_is_that_of_bodies_that_come_to_rest_in_time():
    """Without friction there is one equilibrium.

    The barrier leaves surfaces nearer than their gap by up to a third of it (0.8 below sigma =
    0.6), as a share of the depth 5 mm - 0.8 mm the force may be larger by 2 %.
    """
    at_once = pressed(0.005, upper=(4, 4, 2), friction=0.0)
    report = at_once.step(1.0)
    assert "the barrier went on" in report.message
    in_time = pressed(0.005, upper=(4, 4, 2), friction=0.0, step=ts.ImplicitEuler(0.02))
    for _ in in_time.run(3.0):
        pass
    held = in_time.positions["high"].copy()
    assert in_time.crossings() == []
    force = in_time.force_on("high").force[2]
    assert at_once.force_on("high").force[2] == pytest.approx(force, rel=0.02)
    assert np.abs(at_once.positions["high"] - held).max() < GAP


def test_a_load_that_has_no_equilibrium_is_refused_by_both():
    """On a slope above the angle of friction; the barrier's reason is said too, where it tried."""
    slope = ts.Scene(
        bodies={"cube": block("tetra", (2, 2, 2), (0.03, 0.03, 0.03), (0.0, 0.0, 2e-4))},
        obstacles={"plane": ts.PlaneObstacle(point=(0, 0, 0), normal=(0, 0, 1))},
        contacts=[ts.Contact(("cube", "plane"), friction=0.3)],
        gravity=(5.0, 0.0, -8.0),
        step=ts.Static(),
    ).compile()
    before = slope.positions["cube"].copy()
    with pytest.raises(ts.Diverged, match="no equilibrium was found"):
        slope.step()
    np.testing.assert_array_equal(slope.positions["cube"], before)
