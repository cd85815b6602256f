"""What methods in time remember of forces does not act between pieces that a cut has parted."""

from collections.abc import Callable

import numpy as np
import pytest

import tissu as ts
from severing_scenes import MIDDLE, hanging

SOLVED = ts.Newton(iterations=30, tolerance=1e-10)
STEPS: dict[str, Callable[[], ts.ImplicitEuler]] = {
    "bdf2": lambda: ts.BDF2(4e-3, newton=SOLVED),
    "newmark": lambda: ts.Newmark(4e-3, newton=SOLVED),
    "implicit_midpoint": lambda: ts.ImplicitMidpoint(4e-3, newton=SOLVED),
}


def spinning(step: ts.ImplicitEuler, method: str) -> ts.Simulation:
    """A bar at 20 rad/s that is stretched by its rotation."""
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.1, 0.02, 0.02), cells=(10, 2, 2), cell="tetra"),
        law=ts.StableNeoHooke(young=1e5, poisson=0.35),
        density=1000,
        start=ts.Start(spin=(0, 0, 20)),
    )
    scene = ts.Scene(bodies={"bar": body}, step=step, editing=ts.Editing(method=method))
    simulation = scene.compile()
    for _ in simulation.run(0.02):
        pass
    return simulation


def across(simulation: ts.Simulation) -> ts.Plane:
    """The plane across the middle of the bar."""
    places = simulation.positions["bar"]
    axis = places[-1] - places[0]
    axis[2] = 0.0
    return ts.Plane(tuple(places.mean(axis=0)), tuple(axis))


def momenta(simulation: ts.Simulation, where: list[np.ndarray]) -> np.ndarray:
    """Of each group of nodes [kg m/s] (k, 3)."""
    mass = simulation.mass_matrix().diagonal().reshape(-1, 3)[:, :1]
    impulses = (mass * simulation._core.velocities)[simulation.rows("bar")]
    return np.array([impulses[nodes].sum(axis=0) for nodes in where])


def pieces(simulation: ts.Simulation) -> list[np.ndarray]:
    """The nodes of each piece, by what its cells share."""
    mesh = simulation.meshes["bar"]
    group = np.arange(len(mesh.points))
    changed = True
    while changed:
        before = group.copy()
        for block in mesh.cells:
            least = group[block.nodes].min(axis=1, keepdims=True)
            np.minimum.at(group, block.nodes, np.broadcast_to(least, block.nodes.shape))
        changed = bool((group != before).any())
    used = np.unique(np.concatenate([block.nodes.ravel() for block in mesh.cells]))
    return [used[group[used] == g] for g in np.unique(group[used])]


@pytest.mark.parametrize("method", ["virtual", "subdivide", "snap"])
@pytest.mark.parametrize("step", STEPS)
def test_a_piece_keeps_its_momentum(step: str, method: str) -> None:
    """No force acts on a free piece, to Newton's tolerance of 1e-10 of what acts in each step.

    With the change of velocity of before the cut, in which the other half pulled, BDF2 changed it
    by 4.8 %, and with the acceleration of before Newmark's method by 0.9 %.
    """
    simulation = spinning(STEPS[step](), method)
    simulation.cut("bar", across(simulation))
    halves = pieces(simulation)
    assert len(halves) == 2
    before = momenta(simulation, halves)
    for report in simulation.run(0.1):
        assert report.converged
    size = np.linalg.norm(before, axis=1).max()
    assert np.abs(momenta(simulation, halves) - before).max() < 1e-8 * size


@pytest.mark.parametrize("step", STEPS)
def test_a_run_after_a_cut_is_repeated_to_the_bit(step: str) -> None:
    """Back to before the cut, and from a checkpoint right after it."""
    simulation = spinning(STEPS[step](), "virtual")
    mark = simulation.mark()
    ends = []
    for _ in range(2):
        simulation.cut("bar", across(simulation))
        for _ in simulation.run(0.02):
            pass
        ends.append(simulation.positions["bar"].copy())
        simulation.rewind(mark)
    assert np.array_equal(*ends)


def incised(step: ts.ImplicitEuler) -> np.ndarray:
    """Where a bar ends that swings while a blade opens it a little before each step of 4 ms."""
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.1, 0.02, 0.02), cells=(10, 2, 2), cell="tetra"),
        law=ts.StableNeoHooke(young=2e4, poisson=0.35),
        density=1000,
    )
    held = ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))
    scene = ts.Scene(bodies={"bar": body}, fixed=[held], step=step, editing=ts.Editing())
    simulation = scene.compile()
    places = simulation.positions["bar"]
    nodes = len(places)
    simulation.velocities["bar"][:, 2] = 0.1 * (places[:, 0] / 0.1) ** 2
    for k in range(20):
        blade = ts.Disc((0.0525, 0.001 * k, 0.02), (1, 0, 0), 1e-3)
        assert len(simulation.cut("bar", blade).pieces) == 1
        for _ in simulation.run(4e-3):
            pass
    return simulation.positions["bar"][:nodes].copy()


def test_a_cut_that_parts_nothing_keeps_what_was_before() -> None:
    """An incision goes on by the second order of BDF2.

    If every cut made it begin anew, each step would be one of backward Euler, and the errors of
    both would be the same.
    """
    right = incised(ts.BDF2(1.25e-4, newton=SOLVED))
    error = np.abs(incised(ts.BDF2(4e-3, newton=SOLVED)) - right).max()
    first = np.abs(incised(ts.ImplicitEuler(4e-3, newton=SOLVED)) - right).max()
    assert error < 0.5 * first


@pytest.mark.parametrize("step", ["newmark", "bdf2"])
def test_a_body_that_tissue_let_go_falls_from_what_it_is(
    step: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It goes on as from a state that the method has not seen, also without momentum given back.

    A change of one velocity in its last digits makes the method begin anew. With the pull of before
    the block ended 1.6 mm from there; 1e-12 m/s for 40 ms are 4e-14 m.
    """
    monkeypatch.setattr("tissu.simulation.severing.give_back_to", lambda *_: None)
    ends = []
    for touched in (0.0, 1e-12):
        simulation = hanging(step=STEPS[step]()).compile()
        for report in simulation.run(0.06):
            assert report.converged
        assert simulation.cut("fascia", MIDDLE).links_severed > 10
        simulation.velocities["lower"][0, 0] += touched
        for report in simulation.run(0.04):
            assert report.converged
        ends.append(simulation.positions["lower"].copy())
    assert np.abs(ends[0] - ends[1]).max() < 1e-11
