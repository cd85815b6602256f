"""Pressure through contacts against closed forms: plates, meshes that match or not, a ball."""

import math

import numpy as np
import pytest

import tissu as ts
from contact_audit import audited, block, damped

A = 0.1
"""edge of a block [m]"""


def pressed(cells, other, pressure):
    """Two blocks on a plate, which is smooth, under a pressure; sides free, nu = 0."""
    law = ts.Hooke(young=1e5, poisson=0.0)
    gap = 5e-4
    fields = {"law": law, "viscosity": damped(20.0, 0.002)}
    low = block((0, 0, gap), cells=(cells,) * 3, **fields)
    high = block((0, 0, A + 2 * gap), cells=(other,) * 3, **fields)
    top = ts.Plane(point=(0, 0, 2 * A + 2 * gap), normal=(0, 0, 1))
    return ts.Scene(
        bodies={"low": low, "high": high},
        obstacles={"plate": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("low", ("plate", "high")), gap=gap)],
        fixed=[
            ts.Fixed(body, on=ts.Plane(point=(0, 0, 0), normal=normal), axes=axes)
            for body in ("low", "high")
            for normal, axes in (((1, 0, 0), "x"), ((0, 1, 0), "y"))
        ],
        loads=[ts.Traction("high", on=top, traction=(0, 0, -pressure))],
        step=ts.ImplicitEuler("10 ms"),
    )


def axial_stress(simulation, body):
    """sigma_zz of every cell (cells,) [Pa]."""
    return simulation.field("cauchy_stress", at="cells", body=body)[:, 2, 2]


def test_matching_blocks_pass_the_patch_test():
    """sigma = -p in every cell of both, and sigma = E strain in the displacement.

    A step ends where the forces of contacts change by less than 1 %: 5 Pa, three times that in
    cells at the rim, which two contacts share with one. Contacts may be a tenth of the gap deep.
    """
    pressure = 500.0
    simulation = pressed(3, 3, pressure).compile()
    audited(simulation, 150)
    for body in ("low", "high"):
        assert axial_stress(simulation, body) == pytest.approx(-pressure, abs=15.0)
    force = simulation.force_on("plate").force
    assert force[2] == pytest.approx(-pressure * A * A, rel=1e-3)
    z = simulation.positions["low"][:, 2]
    assert np.ptp(z) == pytest.approx(A * (1 - pressure / 1e5), abs=5e-5)


def test_other_meshes_carry_the_same_force():
    """The whole force is exact; node by node it is not, as with all contact of points."""
    pressure = 500.0
    simulation = pressed(3, 4, pressure).compile()
    audited(simulation, 150)
    force = simulation.force_on("plate").force
    assert force[2] == pytest.approx(-pressure * A * A, rel=1e-3)
    between = -simulation.force_on("high").force[2]
    assert between == pytest.approx(-pressure * A * A, rel=1e-3)
    points = simulation.meshes["low"].points
    # One cell away from the joint the stress is the mean again, within 5 % of the design.
    height = np.sort(np.unique(np.round(points[:, 2], 9)))
    cells = simulation.meshes["low"].volume_blocks[0].nodes
    lowest = points[cells][:, :, 2].max(axis=1) < height[1] + 1e-9
    assert axial_stress(simulation, "low")[lowest] == pytest.approx(-pressure, rel=0.05)


def homogeneous(stretch, mu, lame):
    """Force on a block of area A^2 pressed to a stretch with free sides [N].

    Stable neo-Hooke, Smith, de Goes and Kim (2018), equation 14 with the map of section 3.4:
    W = mu/2 (I - 3) + lame/2 (J - alpha)^2 - mu/2 log(I + 1), I = 2 s^2 + F^2, J = s^2 F.
    """
    mu, lame = 4 / 3 * mu, lame + 5 / 6 * mu
    alpha = 1 + mu / lame - mu / (4 * lame)

    def slopes(side):
        """Derivatives of W by the stretch of one side and by that of the axis."""
        of_first = mu / 2 * (1 - 1 / (2 * side**2 + stretch**2 + 1))
        of_volume = lame * (side**2 * stretch - alpha)
        return (
            2 * of_first * side + of_volume * side * stretch,
            2 * of_first * stretch + of_volume * side**2,
        )

    low, high = 0.5, 3.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if slopes(middle)[0] < 0 else (low, middle)
    return slopes(low)[1] * A * A


@pytest.mark.parametrize("stretch", [0.7, 0.5])
def test_a_block_between_smooth_plates_gives_the_homogeneous_force(stretch):
    """Within the 0.5 % of the design."""
    young, poisson = 1e4, 0.3
    law = ts.StableNeoHooke(young=young, poisson=poisson)
    gap = 1e-3
    body = block((0, 0, gap), law=law, viscosity=damped(20.0, 0.005))
    way = A * (1 - stretch)
    lowered = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -way)))
    simulation = ts.Scene(
        bodies={"block": body},
        obstacles={
            "table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1)),
            "press": ts.PlaneObstacle((0, 0, A + 2 * gap), (0, 0, -1), motion=lowered),
        },
        contacts=[ts.Contact(("block", ("table", "press")), gap=gap)],
        step=ts.ImplicitEuler("10 ms"),
    ).compile()
    audited(simulation, 150)
    assert len(simulation.inverted_cells("block")) == 0
    table = simulation.force_on("table").force
    press = simulation.force_on("press").force
    size = np.abs(table).max()
    assert np.abs(table + press).max() <= 1e-4 * size
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    mu = young / (2 * (1 + poisson))
    assert table[2] == pytest.approx(homogeneous(stretch, mu, lame), rel=5e-3)


def under_a_ball(radius, gap, cells, aside=(0.0, 0.0)):
    """A block of 10 kPa on a held bottom, into which a led ball goes 2 mm deep."""
    law = ts.StVK(young=1e4, poisson=0.3)
    viscosity = damped(20.0, 0.01)
    body = block((0, 0, 0), size=(A, A, A), cells=(cells,) * 3, law=law, viscosity=viscosity)
    center = (A / 2 + aside[0], A / 2 + aside[1], A + radius + gap)
    path = ts.Motion(times=(0, 0.2), displacements=((0, 0, 0), (0, 0, -0.002)))
    return ts.Scene(
        bodies={"block": body},
        fixed=[ts.Fixed("block", on=ts.Plane(point=(0, 0, 0), normal=(0, 0, 1)))],
        obstacles={"ball": ts.SphereObstacle(center, radius, motion=path)},
        contacts=[ts.Contact(("block", "ball"), gap=gap)],
        step=ts.ImplicitEuler("20 ms"),
    ).compile()


def test_a_ball_pressed_into_a_block_follows_hertz():
    """F = 4/3 E* sqrt(R) delta^1.5 for a half-space; delta/R = 2 %.

    The contact's radius sqrt(R delta) is 1.7 edges, where the stiffness of points is some 10 % off.
    """
    young, poisson, radius, depth = 1e4, 0.3, 0.1, 0.002
    simulation = under_a_ball(radius, 1e-4, 12)
    audited(simulation, 40)
    effective = young / (1 - poisson**2)
    hertz = 4 / 3 * effective * math.sqrt(radius) * depth**1.5
    assert simulation.force_on("ball").force[2] == pytest.approx(hertz, rel=0.1)


@pytest.mark.parametrize("radius", [0.1, 0.03, 0.01, 0.005])
def test_a_ball_that_rests_in_its_dent_is_pressed_steadily(radius):
    """Whether the dent is of many faces or of one: nothing moves, nor does the force.

    1e-3 is a tenth of the change of forces at which a step ends.
    """
    gap = 1.6e-4
    # Off the middle, so that no face is before the ball alone.
    simulation = under_a_ball(radius, gap, 8, aside=(0.001, 0.0005))
    audited(simulation, 30)
    forces = []
    for _ in range(10):
        audited(simulation, 1)
        forces.append(simulation.force_on("ball").force[2])
    assert np.ptp(forces) <= 1e-3 * np.mean(forces)
    assert simulation.contacts().gaps.min() > -0.1 * gap
