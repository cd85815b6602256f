"""Cut sheets without stiffness in bending fold into creases.

There, their layers are nearer than they are thick."""

from __future__ import annotations

import pytest

import tissu as ts
from contact_audit import GRAVITY, damped

MASS = 0.1 * 0.08 * 0.0005 * 1000.0
"""[kg]"""
NODES = 49
GAP = 3.38e-4
"""[m]"""
STEP = 0.005
"""[s]"""
PLANES = (
    ((0.0725, 0.0222, -0.0221), (-0.04, 1.0, 0)),
    ((0.0744, 0.0309, -0.0221), (0.52, 0.86, 0)),
    ((0.0500, 0.0451, -0.0221), (0.92, 0.39, 0)),
    ((0.0658, 0.0322, -0.0221), (-0.57, 0.82, 0)),
)
"""Without rest distances of their own, pairs in creases gave 17 to 46 uJ in one step."""


def hung_over_a_ball() -> ts.Simulation:
    """A sheet of 10 by 8 cm, half a millimetre thick, after its fall onto a ball of 3 cm."""
    sheet = ts.Body(
        mesh=ts.bar_mesh(size=(0.1, 0.08, 0), cells=(6, 6, 0), cell="triangle"),
        law=ts.StVK(young="100 kPa", poisson=0.3),
        density="1 g/cm^3",
        thickness="0.5 mm",
        viscosity=damped(),
    )
    simulation = ts.Scene(
        bodies={"sheet": sheet},
        gravity=(0, 0, -GRAVITY),
        obstacles={
            "ball": ts.SphereObstacle((0.05, 0.04, -0.018), radius=0.015),
            "table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1)),
        },
        contacts=[
            ts.Contact(("sheet", "ball"), friction=0.2, gap=GAP),
            ts.Contact(("sheet", "table"), friction=0.2, gap=GAP),
            ts.SelfContact("sheet", gap=GAP),
        ],
        step=ts.ImplicitEuler(STEP),
        editing=True,
    ).compile()
    for _ in range(60):
        simulation.step()
    return simulation


@pytest.mark.parametrize(("point", "normal"), PLANES)
def test_a_pair_that_becomes_a_contact_in_a_crease_gives_no_energy(
    point: tuple[float, float, float], normal: tuple[float, float, float]
) -> None:
    simulation = hung_over_a_ball()
    simulation.cut("sheet", ts.Plane(point, normal))
    # What begins less than a tenth of the gap inside it may open in an eighth of a step.
    speed = 0.1 * GAP / (STEP / 8)
    least = 0.5 * MASS / NODES * speed**2
    before = simulation.energy()["total"]
    for _ in range(30):
        report = simulation.step()
        after = simulation.energy()["total"]
        assert report.converged, report
        assert after - before <= least, report
        before = after
    assert simulation.crossings() == []
