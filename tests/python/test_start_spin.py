"""Bodies that start with a spin: frames and shells turn as a whole, with their own rotations."""

import numpy as np
import pytest

import tissu as ts
from tissu.scene import Newton

SPIN = 6.0
"""[rad/s]"""


def spinning(model):
    """A free body that spins about z, with steps of 2 ms that conserve energy."""
    flat = model == "shell"
    mesh = ts.BarMesh(
        size=(0.1, 0.1, 0.0 if flat else 0.1),
        cells=(4, 4, 0) if flat else (3, 3, 3),
        cell="triangle" if flat else "hexahedron",
    )
    given = {"thickness": 0.004} if flat else {}
    law = ts.Hooke(young="5 MPa", poisson=0.3) if flat else ts.StVK(young="50 kPa", poisson=0.3)
    start = ts.Start(spin=(0, 0, SPIN))
    body = ts.Body(mesh=mesh, law=law, density=1000.0, model=model, start=start, **given)
    step = ts.ImplicitMidpoint("2 ms", newton=Newton(iterations=20, tolerance=1e-9))
    return ts.Scene(bodies={"body": body}, step=step).compile()


@pytest.mark.parametrize("model", ["frames", "shell"])
def test_every_node_turns_with_the_body(model):
    """The centrifugal force stretches frames by rho w^2 L^2 / E = 0.7 %, and slows them as much."""
    simulation = spinning(model)
    rows = simulation.rows("body", rotations=True)
    assert np.array_equal(
        simulation._core.velocities[rows], [(0, 0, SPIN)] * len(simulation.positions["body"])
    )
    energy = simulation.energy()["total"]
    for _ in range(100):
        assert simulation.step().converged
    turned = simulation.rotations("body")
    angles = np.arctan2(turned[:, 1, 0], turned[:, 0, 0])
    assert angles == pytest.approx(0.2 * SPIN, rel=1e-2)
    assert simulation.energy()["total"] == pytest.approx(energy, rel=1e-2)


HELD = {
    "z": ("z", None, (1, 1, 1)),
    "z, about x and y": ("z", "xy", (0, 0, 1)),
    "all, turning freely": ("xyz", "free", (1, 1, 1)),
    "all": ("xyz", None, (0, 0, 0)),
    "about z": ("free", "z", (1, 1, 0)),
}


@pytest.mark.parametrize("held", HELD)
@pytest.mark.parametrize("model", ["frames", "shell"])
def test_rotations_that_nothing_holds_spin_where_nodes_are_held(model, held):
    """A support takes the components that it holds from velocities and spins, and no others."""
    axes, rotations, turning = HELD[held]
    spin = np.array((1.0, 2.0, SPIN))
    body = spinning(model).scene.bodies["body"].replace(start=ts.Start(spin=tuple(spin)))
    fixed = [ts.Fixed("body", on=ts.Nodes((0, 3)), axes=axes, rotations=rotations)]
    step = ts.ImplicitMidpoint("2 ms")
    simulation = ts.Scene(bodies={"body": body}, fixed=fixed, step=step).compile()
    x = simulation.positions["body"]
    expected = np.tile(spin, (len(x), 1))
    velocities = np.cross(spin, x - x.mean(axis=0))
    for node in (0, 3):
        expected[node] *= turning
        velocities[node] *= [axis not in axes for axis in "xyz"] if axes != "free" else 1
    spins = simulation._core.velocities[simulation.rows("body", rotations=True)]
    assert np.array_equal(spins, expected)
    assert simulation.velocities["body"] == pytest.approx(velocities, abs=1e-15)
