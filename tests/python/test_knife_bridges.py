"""A blade that has passed through a body leaves no bridge, however slowly it went."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import tissu as ts
from tissu import _core

SIZE = np.array((0.2, 0.1, 0.1))
VOLUME = float(SIZE.prod())


def jittered(random: np.random.Generator) -> ts.Mesh:
    """A bar whose inner nodes are moved at random, so that blades meet no regular cells."""
    mesh = ts.bar_mesh(size=tuple(SIZE), cells=(6, 3, 3), cell="tetra")
    points = mesh.points.copy()
    inner = ((points > 1e-6) & (points < SIZE - 1e-6)).all(axis=1)
    points[inner] += random.uniform(-4e-3, 4e-3, (int(inner.sum()), 3))
    return dataclasses.replace(mesh, points=points)


def scene(mesh: ts.Mesh, knives: dict[str, ts.Knife], young: float = 5e5) -> ts.Scene:
    """Held at both ends."""
    return ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=ts.StVK(young=young, poisson=0.3), density=1e3)},
        fixed=[ts.Fixed("bar", on=ts.Plane((x, 0, 0), (1, 0, 0))) for x in (0, 0.2)],
        step=ts.ImplicitEuler(dt=0.01),
        editing=ts.Editing(room="400 %"),
        instruments=knives,
    )


def volumes(simulation: ts.Simulation) -> list[float]:
    found = [piece.volume for piece in simulation.pieces("bar")]
    assert sum(found) == pytest.approx(VOLUME, rel=1e-12)
    return sorted(found)


@pytest.mark.parametrize("seed", [0, 3, 6])
@pytest.mark.parametrize(("young", "toughness"), [(5e5, 20.0), (5e4, 5.0)])
def test_a_slow_tough_knife_leaves_no_bridge(young: float, toughness: float, seed: int) -> None:
    """On a tilted way, by a fortieth of a cell in each step, while the bar gives way to it.

    When a sweep began where the points of the edge were, in place of where the last one had ended,
    each of these bars stayed in one piece.
    """
    random = np.random.default_rng(seed)
    mesh = jittered(random)
    x, way, tilt, yaw = random.uniform(-1, 1, 4) * (0.03, 0.03, 0.06, 0.3)
    knife = ts.Knife(
        [(0, -0.03, 0), (0, 0.13, 0)],
        cuts=["bar"],
        toughness=toughness,
        path=ts.ToolPath(
            times=(0, 1.5),
            positions=[(0.1 + x, 0, 0.115), (0.1 + x + way, 0, -0.05)],
            rotations=[(tilt, 0, yaw), (-tilt, 0, yaw)],
        ),
    )
    simulation = scene(mesh, {"scalpel": knife}, young).replace(gravity=(0, 0, -9.81)).compile()
    reports = [report for _ in range(150) for report in simulation.step().cuts]
    assert len(volumes(simulation)) == 2
    assert not any(report.unresolved for report in reports)


@pytest.mark.parametrize("seed", [0, 1, 4])
@pytest.mark.parametrize("toughness", [None, 20.0])
@pytest.mark.parametrize("steps", [10, 100])
def test_knives_that_cross_leave_four_pieces(
    steps: int, toughness: float | None, seed: int
) -> None:
    """Both go down at once, across each other: one divides cells at the front of the other.

    In 100 steps none of these bars parted when a sweep overlapped the last one by one row only.
    """
    mesh = jittered(np.random.default_rng(seed))
    x, y, a, b = np.random.default_rng(500 + seed).uniform(-1, 1, 4) * (0.02, 0.012, 0.2, 0.1)
    end = 0.01 * steps
    along = ts.ToolPath(
        times=(0, end),
        positions=[(0.1 + x, 0.05, 0.12), (0.1 + x, 0.05, -0.05)],
        rotations=[(0.05, 0, a), (-0.05, 0, a)],
    )
    across = ts.ToolPath(
        times=(0, end),
        positions=[(0.1, 0.05 + y, 0.12), (0.1, 0.05 + y, -0.05)],
        rotations=[(0, 0.05, b), (0, -0.05, b)],
    )
    one = ts.Knife([(0, -0.08, 0), (0, 0.08, 0)], cuts=["bar"], toughness=toughness, path=along)
    two = ts.Knife([(-0.13, 0, 0), (0.13, 0, 0)], cuts=["bar"], toughness=toughness, path=across)
    simulation = scene(mesh, {"one": one, "two": two}).compile()
    for _ in range(steps):
        simulation.step()
    assert len(volumes(simulation)) == 4


def swept(seed: int, parts: int) -> list[float]:
    """Volumes of the pieces of a bar at rest, cut by a flat, slanted blade in so many sweeps."""
    random = np.random.default_rng(seed)
    simulation = scene(jittered(random), {}).compile()
    x, way = random.uniform(-0.03, 0.03, 2)
    edge = np.linspace((0.1 + x, -0.03, 0.115), (0.1 + x, 0.13, 0.115), 10)
    share = np.linspace(0.0, 1.0, parts + 1)[:, None, None]
    rows = edge + share * np.array((way, 0.0, -0.165))
    for k in range(1, parts + 1):
        part = rows[max(0, k - 2) : k + 1]
        sweep = _core.edge_sweep(
            places=np.ascontiguousarray(part.reshape(-1, 3)),
            moments=len(part),
            points=part.shape[1],
            incision=7,
            past=0,
        )
        assert not simulation._cut_along("bar", sweep).unresolved
    return volumes(simulation)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_cut_in_many_sweeps_parts_the_same_volumes(seed: int) -> None:
    """Whether an end of an edge is on the cut may follow from another edge in another order.

    A crossing within 2 % of an end goes there, which moves the cut by at most that share of the
    longest edge, the diagonal of a cell. So the volumes differ by less than it times the area.
    """
    whole = swept(seed, 1)
    assert len(whole) == 2
    bound = 0.02 * np.sqrt(3.0) * 0.1 / 3 * 0.1 * 0.1 * np.hypot(0.165, 0.03) / 0.165
    for parts in (10, 100, 1000):
        np.testing.assert_allclose(swept(seed, parts), whole, rtol=0, atol=bound)
