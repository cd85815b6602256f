"""Nothing passes through anything, however fast: in parts, held back, or refused."""

import re

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped
from tissu.errors import TissuError

BALL = (0.1, 0.1, 0.08)
"""Centre of a ball of 2 cm [m]."""


def thin_slab(**fields):
    """A slab of 20 cm x 20 cm x 1 cm, held at its rim, under a ball."""
    slab = block(size=(0.2, 0.2, 0.01), cells=(8, 8, 1), young=2e4, viscosity=damped())
    return ts.Scene(
        bodies={"slab": slab},
        fixed=[
            ts.Fixed("slab", on=ts.Plane(point=(0, 0, 0), normal=(1, 0, 0))),
            ts.Fixed("slab", on=ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0))),
        ],
        obstacles={"ball": ts.SphereObstacle(BALL, 0.02)},
        contacts=[ts.Contact(("slab", "ball"))],
        step=ts.ImplicitEuler("1 ms"),
        **fields,
    )


def test_a_fast_tool_is_felt_and_never_through():
    """At 10 m/s, one cell in 2.5 steps: the slab gives way before it."""
    simulation = thin_slab().compile()
    ball = simulation.obstacle("ball")
    ball.move((0, 0, -0.1), over=0.01)
    most = 0.0
    for _ in range(12):
        audited_unless_unsolved(simulation, 1)
        most = max(most, ball.force[2])
    low = ball.place_of(BALL)[2] - 0.02
    assert low == pytest.approx(-0.04, abs=1e-12)
    under = np.hypot(*(simulation.positions["slab"][:, :2] - BALL[:2]).T) < 0.02
    assert simulation.positions["slab"][under, 2].max() < low + 0.005
    # The mass before the ball, some 20 g, is brought to 10 m/s within 10 ms: 20 N.
    assert most > 5.0


def audited_unless_unsolved(simulation, steps):
    """The promise is that nothing crosses, whether or not a step met its tolerance."""
    for _ in range(steps):
        report = simulation.step()
        assert simulation.crossings() == [], report
        assert all(np.isfinite(simulation.positions[b]).all() for b in simulation.bodies)


def test_a_tool_at_100_m_per_s_is_refused_with_speed_and_dt_or_felt():
    """10 cm in a step of 1 ms, through a slab of 1 cm."""
    simulation = thin_slab().compile()
    ball = simulation.obstacle("ball")
    before = simulation.positions["slab"].copy()
    ball.move((0, 0, -0.1), over=0.001)
    try:
        simulation.step()
    except TissuError as error:
        assert re.search(r"dt = 0\.001 s", str(error))
        assert re.search(r"100 m/s", str(error))
        # What was refused leaves the state whole.
        assert np.array_equal(simulation.positions["slab"], before)
        assert simulation.time == 0.0
    assert simulation.crossings() == []


def test_a_way_of_too_many_parts_is_refused_and_the_state_is_whole():
    """10 km in one step: more than 64 times 64 parts of half an edge."""
    simulation = thin_slab().compile()
    audited(simulation, 2)
    before = simulation.positions["slab"].copy(), simulation.velocities["slab"].copy()
    simulation.obstacle("ball").move((0, 0, -1e4))
    with pytest.raises(TissuError) as refused:
        simulation.step()
    # The step is tried in sixty-four parts, whose first names its own dt.
    assert re.search(r"led .* m, at 1e\+07 m/s", str(refused.value)), str(refused.value)
    assert "dt = " in str(refused.value)
    assert np.array_equal(simulation.positions["slab"], before[0])
    assert np.array_equal(simulation.velocities["slab"], before[1])
    assert simulation.time == pytest.approx(2e-3)
    # It goes on when led elsewhere.
    simulation.obstacle("ball").move((0, 0, 0))
    audited(simulation, 2)


@pytest.mark.parametrize("dt", ["1 ms", "10 ms"])
def test_a_soft_cube_at_100_m_per_s_does_not_pass_a_sheet(dt):
    """A led or fixed thing is not needed: both sides are soft."""
    mesh = ts.BarMesh(size=(0.3, 0.3, 0), cells=(6, 6, 0), cell="quad", origin=(-0.1, -0.1, -0.02))
    law = ts.StVK(young=1e5, poisson=0.3)
    sheet = ts.Body(mesh=mesh, law=law, density=1000.0, thickness=0.002)
    cube = block(start=ts.Start(velocity=(0, 0, -100.0)), viscosity=damped())
    rims = [ts.Plane(point=(x, 0, 0), normal=(1, 0, 0)) for x in (-0.1, 0.2)]
    simulation = ts.Scene(
        bodies={"sheet": sheet, "cube": cube},
        fixed=[ts.Fixed("sheet", on=rim) for rim in rims],
        contacts=[ts.Contact(("sheet", "cube"))],
        step=ts.ImplicitEuler(dt),
    ).compile()
    audited_unless_unsolved(simulation, 12)
    # 1 kg at 100 m/s against 180 g of sheet that is held at two rims.
    assert simulation.velocities["cube"][:, 2].mean() > -95.0


def test_a_path_leads_as_a_hand_does():
    """The motion of an obstacle and `move` over the same time: the same answer to round-off."""
    path = ts.Motion(times=(0, 0.05), displacements=((0, 0, 0), (0, 0, -0.06)))
    led = thin_slab().replace(obstacles={"ball": ts.SphereObstacle(BALL, 0.02, motion=path)})
    one, two = led.compile(), thin_slab().compile()
    two.obstacle("ball").move((0, 0, -0.06), over=0.05)
    audited(one, 50)
    audited(two, 50)
    assert np.abs(one.displacements("slab")).max() > 0.005
    # Obstacle places differ by round-off, which sticking and sliding do not amplify much.
    assert np.abs(one.positions["slab"] - two.positions["slab"]).max() < 1e-6
    force = one.force_on("ball").force
    assert two.force_on("ball").force == pytest.approx(force, rel=1e-2)


def test_a_sheet_falls_on_a_sphere_and_hangs():
    mesh = ts.BarMesh(
        size=(0.2, 0.2, 0), cells=(10, 10, 0), cell="quad", origin=(-0.1, -0.1, 0.055)
    )
    law = ts.StVK(young=1e4, poisson=0.3)
    sheet = ts.Body(
        mesh=mesh, law=law, density=1000.0, thickness=0.002, viscosity=damped(3.0, 0.002)
    )
    simulation = ts.Scene(
        bodies={"sheet": sheet},
        obstacles={"ball": ts.SphereObstacle((0.003, 0.001, 0), 0.05)},
        contacts=[ts.Contact(("sheet", "ball"), friction=0.8), ts.SelfContact("sheet")],
        gravity=(0, 0, -GRAVITY),
        step=ts.ImplicitEuler("5 ms"),
    ).compile()
    audited_unless_unsolved(simulation, 60)
    distance = np.linalg.norm(simulation.positions["sheet"] - (0.003, 0.001, 0), axis=1)
    assert distance.min() > 0.05 + 0.001  # the radius and half the thickness
    assert simulation.positions["sheet"][:, 2].min() < 0.03  # it hangs down
