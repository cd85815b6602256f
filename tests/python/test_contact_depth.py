"""What a converged step says of the depth of its contacts."""

import numpy as np
import pytest

import tissu as ts

GRAVITY = (0, 0, -9.81)

STEPS = (ts.ImplicitEuler, ts.BDF2, ts.ImplicitMidpoint, ts.Newmark)


def thrown(seed):
    """A soft block is thrown on another one, on a table."""
    random = np.random.default_rng(seed)
    step, dt = random.choice(STEPS), random.choice([5e-3, 1e-2])
    cell, n = random.choice(["wedge", "tetra", "hexahedron"]), int(random.choice([2, 3]))
    below, above = 10.0 ** random.uniform(3, 4.5, 2)
    speed, side = random.uniform(0.3, 1), random.uniform(-0.5, 0.5)
    lower = ts.Body(
        mesh=ts.bar_mesh(
            size=(0.06, 0.06, 0.03), cells=(n + 1, n + 1, n), cell=cell, origin=(0, 0, 0.001)
        ),
        law=ts.StableNeoHooke(young=below, poisson=0.4),
        density=1000,
    )
    upper = ts.Body(
        mesh=ts.bar_mesh(
            size=(0.04, 0.04, 0.04), cells=(n, n, n), cell=cell, origin=(0.013, 0.007, 0.033)
        ),
        law=ts.StableNeoHooke(young=above, poisson=0.4),
        density=1000,
        start=ts.Start(velocity=(speed * side, 0.3 * speed, -speed)),
    )
    return ts.Scene(
        bodies={"lower": lower, "upper": upper},
        gravity=GRAVITY,
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact("all", friction=random.choice([0, 0.2, 0.5]))],
        step=step(dt),
    )


@pytest.mark.parametrize("seed", [1, 15, 63, 72, 96, 107])
def test_no_converged_step_has_a_contact_deeper_than_half_the_gap(seed):
    """Half the gap is what the guide says. A vertex that slid over an edge pressed from behind."""
    simulation = thrown(seed).compile()
    try:
        for _ in range(40):
            report = simulation.step()
            assert not report.converged or report.least_gap >= 0.5
    except ts.Diverged as error:
        assert "energy has grown" in str(error)
