"""With springs in explicit steps, reported forces are the rate of change of momentum."""

import numpy as np
import pytest

import tissu as ts
from test_contact_balance import masses

DT, STEPS, GAP = 2e-5, 2000, 2e-4
MASSES = {"hull": 0.05, "box": 0.5}


def hit_at_random(seed):
    """A soft block, a hull and a box that hit each other: stops are met again and again."""
    mesh = ts.BarMesh(size=(0.06, 0.06, 0.03), cells=(3, 3, 2), cell="hexahedron")
    block = ts.Body(mesh=mesh, law=ts.StableNeoHooke(young=2e4, poisson=0.4), density=1000.0)
    points = [0.035, 0.028, 0.055] + 0.018 * np.random.default_rng(seed).uniform(-1, 1, (10, 3))
    hull = ts.ConvexObstacle(
        points=points.tolist(), mass=MASSES["hull"], velocity=(0.1, 0, -1), spin=(20, 5, -10)
    )
    box = ts.BoxObstacle(
        (0, 0, 0.08), (0.02, 0.03, 0.1), mass=MASSES["box"], velocity=(0, 0, -2), spin=(0, 30, 7)
    )
    return ts.Scene(
        bodies={"block": block},
        obstacles={"hull": hull, "box": box},
        contacts=[
            ts.Contact(("block", ("hull", "box")), friction=0.5, gap=GAP),
            ts.Contact(("hull", "box"), friction=0.5, gap=GAP),
        ],
        contact=ts.ContactSettings(method="penalty"),
        step=ts.RK4(DT),
    ).compile()


@pytest.mark.parametrize("seed", [0, 3])
def test_reported_forces_change_the_momentum(seed):
    """To 1e-9 of the largest: round-off of 1 m/s over steps of 20 us, beside forces of 100 N."""
    simulation = hit_at_random(seed)
    lumped = masses(simulation, "block")

    def momenta():
        rigid = [MASSES[name] * np.asarray(simulation.rigid(name).velocity) for name in MASSES]
        return np.array([lumped @ simulation.velocities["block"], *rigid])

    before, wrong, largest = momenta(), 0.0, 0.0
    for _ in range(STEPS):
        assert simulation.step().converged
        after = momenta()
        forces = np.array([simulation.force_on(name).force for name in ("block", *MASSES)])
        wrong = max(wrong, np.abs(after - before - forces * DT).max())
        largest = max(largest, np.abs(forces).max() * DT)
        before = after
    assert largest > 1e-4
    assert wrong < 1e-9 * largest
