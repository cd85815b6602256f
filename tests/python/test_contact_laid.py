"""Bodies that are laid exactly on something at the start."""

import numpy as np
import pytest

import tissu as ts

SIDE = 0.05
GRAVITY = (0, 0, -9.81)
STEPS = [
    ts.ImplicitEuler(1e-3),
    ts.BDF2(1e-3),
    ts.Newmark(1e-3),
    ts.ImplicitMidpoint(1e-3),
    ts.SymplecticEuler(),
]


def cube(z: float, x: float = 0.0) -> ts.Body:
    mesh = ts.bar_mesh(
        size=(SIDE, SIDE, SIDE), cells=(3, 3, 3), cell="hexahedron", origin=(x, 0, z)
    )
    return ts.Body(mesh=mesh, law=ts.StableNeoHooke(young=1e7, poisson=0.4), density=1000)


def scene(bodies: dict[str, ts.Body], **fields) -> ts.Scene:
    return ts.Scene(
        bodies=bodies,
        obstacles={"floor": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact("all", friction=0.3)],
        gravity=GRAVITY,
        **fields,
    )


@pytest.mark.parametrize("step", STEPS, ids=lambda step: step.type)
@pytest.mark.parametrize("z", [0.0, 2e-4])
def test_a_cube_laid_on_a_floor_stays_there(step, z):
    """It is lifted as a whole, so that nothing is strained, and does not jump.

    Its lowest nodes alone were moved to the gap before, which stored 0.23 J: the cube rose by 4 mm
    in implicit Euler and by 46 mm in Newmark's method. Under its weight it sinks by less than 3 um.
    """
    simulation = scene({"cube": cube(z)}, step=step).compile()
    assert simulation.energy()["elastic"] < 1e-9
    gap = simulation.overlaps()
    assert simulation.crossings() == [] and not gap
    start = simulation.positions["cube"].copy()
    assert np.ptp(start[:, 2] - cube(z).mesh.points[:, 2]) < 1e-12
    while simulation.time < 0.1:
        assert simulation.step().converged
        assert np.abs(simulation.positions["cube"] - start).max() < 2e-5


def test_a_pile_that_touches_is_lifted_cube_by_cube():
    """Each cube of three is a gap above what it stands on, and nothing is strained."""
    bodies = {f"cube{i}": cube(i * SIDE) for i in range(3)}
    simulation = scene(bodies, step=ts.Newmark(1e-3)).compile()
    assert simulation.energy()["elastic"] < 1e-9
    lowest = [simulation.positions[name][:, 2].min() for name in bodies]
    lifted = np.array(lowest) - SIDE * np.arange(3)
    gap = lifted[0]
    assert gap > 0
    # Sides of a pair share what they miss, pair after pair, until all are at their gaps.
    np.testing.assert_allclose(lifted, gap * np.arange(1, 4), rtol=1e-6)
    while simulation.time < 0.1:
        assert simulation.step().converged
        assert simulation.crossings() == []
    top = simulation.positions["cube2"][:, 2].max()
    assert top == pytest.approx(3 * SIDE + 3 * gap, abs=5e-5)


def test_a_cube_that_is_clamped_is_still_moved_apart():
    """Between two walls that both touch it no way as a whole leads to a gap: its faces give way."""
    walls = {
        "left": ts.PlaneObstacle((0, 0, 0), (1, 0, 0)),
        "right": ts.PlaneObstacle((SIDE, 0, 0), (-1, 0, 0)),
    }
    simulation = ts.Scene(
        bodies={"cube": cube(0.0)},
        obstacles=walls,
        contacts=[ts.Contact("all")],
        step=ts.ImplicitEuler(1e-3),
    ).compile()
    x = simulation.positions["cube"][:, 0]
    assert 0 < x.min() < 1e-3 and 0 < SIDE - x.max() < 1e-3
    assert x.mean() == pytest.approx(SIDE / 2, abs=1e-9)
    assert simulation.energy()["elastic"] > 1e-3
    assert simulation.step().converged


def test_cubes_side_by_side_part_by_half_each():
    """Two free cubes that touch each go half the gap, and their common centre stays."""
    bodies = {"one": cube(1.0), "other": cube(1.0, SIDE)}
    simulation = scene(bodies, step=ts.ImplicitEuler(1e-3)).compile()
    one = simulation.positions["one"][:, 0].max()
    other = simulation.positions["other"][:, 0].min()
    assert other - one > 1e-4
    assert (one + other) / 2 == pytest.approx(SIDE, abs=1e-12)
    assert simulation.energy()["elastic"] < 1e-9
