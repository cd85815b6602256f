"""What is heavy on what is light: the light one lies between the heavy one and the table.

A contact's stiffness against coming nearer is that of its lightest side, which is far too soft for
what rests on it. Multipliers that grow by it need hundreds of systems.
"""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts

GRAVITY = 9.81
GAP = 1e-4
TABLE = ts.PlaneObstacle((0, 0, 0), (0, 0, 1))


def on_membrane(step: ts.Step, mass: float) -> ts.Simulation:
    """A ball that falls by half a millimetre on a membrane of 12.8 g on a table."""
    thickness = 2e-3
    skin = ts.Body(
        mesh=ts.BarMesh(
            size=(0.08, 0.08, 0),
            cells=(10, 10, 0),
            cell="triangle",
            origin=(0, 0, GAP + thickness / 2),
        ),
        law=ts.StVK(young=1e5, poisson=0.3),
        density=1000,
        thickness=thickness,
        viscosity=ts.Rayleigh(mass=10, stiffness="5 ms"),
    )
    above = 2 * GAP + thickness + 0.5e-3
    ball = ts.SphereObstacle((0.04, 0.04, above + 0.008), radius=0.008, mass=mass)
    return ts.Scene(
        bodies={"skin": skin},
        obstacles={"table": TABLE, "ball": ball},
        contacts=[ts.Contact("all", friction=0.3, gap=GAP)],
        gravity=(0, 0, -GRAVITY),
        step=step,
    ).compile()


@pytest.mark.parametrize("mass", [0.02, 0.1])
@pytest.mark.parametrize("step", [ts.ImplicitEuler("5 ms"), ts.BDF2("5 ms")])
def test_a_ball_comes_to_rest_on_a_membrane_on_a_table(step: ts.Step, mass: float) -> None:
    """At two gaps, a thickness and its radius, or lower by a gap at most.

    A ball meets faces at points between which it sinks by a gap. On a node it stands as on a bump
    of this height, and what it gains by rolling down from it is sqrt(2 g gap).

    No step adds to the energy more than a twentieth of what the fall took (half of it before
    contacts became stiffer); the table bears both weights in the mean, to 3 %: the ball rolls on.
    """
    simulation = on_membrane(step, mass)
    ball = simulation.rigid("ball")
    fall = mass * GRAVITY * 0.5e-3
    energy = simulation.energy()["total"]
    borne = []
    for report in simulation.run("0.4 s"):
        assert report.converged, report.message
        assert report.least_gap > 1.0 - 0.5 * GAP / (1e-3 + GAP)
        now = simulation.energy()["total"]
        assert now - energy < 0.05 * fall
        energy = now
        borne.append(simulation.force_on("table")[0][2])
        assert not simulation.crossings()
    assert ball.position[2] == pytest.approx(2 * GAP + 2e-3 + 0.008, abs=GAP)
    assert np.linalg.norm(ball.velocity) < np.sqrt(2 * GRAVITY * GAP)
    weight = GRAVITY * (mass + 1000 * 2e-3 * 0.08**2)
    assert np.mean(borne[-40:]) == pytest.approx(-weight, rel=0.03)


@pytest.mark.parametrize("masses", [(0.1, 0.1, 0.1, 0.1, 10.0), (1.0, 0.1, 1.0, 0.1, 1.0)])
def test_heavy_boxes_stand_on_light_ones(masses: tuple[float, ...]) -> None:
    """Five boxes fall by 1 to 21 mm on each other, and come to rest at their gaps.

    Each to a tenth of a gap for each below; the table bears all, in the mean of the last steps,
    to 3 % of the weight: it takes 8 % to move 10 kg by a hundredth of the gap in a step of 5 ms.
    """
    boxes = {
        f"box{i}": ts.BoxObstacle((0, 0, low), (0.1, 0.1, low + 0.1), mass=mass)
        for i, mass in enumerate(masses)
        for low in [1e-3 + i * 0.105]
    }
    simulation = ts.Scene(
        obstacles={"table": TABLE, **boxes},
        contacts=[ts.Contact("all", friction=0.4, gap=2e-3)],
        gravity=(0, 0, -GRAVITY),
        step=ts.ImplicitEuler("5 ms"),
    ).compile()
    borne = []
    for report in simulation.run("0.4 s"):
        assert report.converged, report.message
        borne.append(simulation.force_on("table")[0][2])
    assert not simulation.crossings()
    for i, name in enumerate(boxes):
        place = (0.05, 0.05, 0.05 + i * 0.1 + (i + 1) * 2e-3)
        assert simulation.rigid(name).position == pytest.approx(place, abs=2e-4 * (i + 1))
    assert np.mean(borne[-20:]) == pytest.approx(-GRAVITY * sum(masses), rel=0.03)
