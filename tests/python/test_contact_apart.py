"""Rigid bodies that start nearer to each other than they rest are moved apart; none flies off."""

from __future__ import annotations

from typing import Any

import pytest

import tissu as ts

GAP = 1e-3
H = 5e-4
TABLE = ts.PlaneObstacle((0, 0, 0), (0, 0, 1))


def box(low: float, high: float, shift: float = 0.0) -> ts.BoxObstacle:
    return ts.BoxObstacle((shift, 0, low), (0.1 + shift, 0.1, high), mass=1.0)


def ball(middle: float) -> ts.SphereObstacle:
    return ts.SphereObstacle((0.05, 0.05, middle), radius=0.02, mass=1.0)


def pile(count: int, between: float) -> list[Any]:
    step = 0.03 + between
    return [box(between + k * step, between + k * step + 0.03) for k in range(count)]


PILES = {
    "a box, half a gap and more": ([box(0.7e-3, 0.0307)], [0.016]),
    "a ball, half a gap and more": ([ball(0.0207)], [0.021]),
    "two boxes": (pile(2, 0.3e-3), [0.016, 0.047]),
    "boxes beside each other's middles": (
        [box(0.3e-3, 0.0303), box(0.0306, 0.0606, 0.03)],
        [0.016, 0.047],
    ),
    "six boxes that touch": (pile(6, 0.0), [0.016 + 0.031 * k for k in range(6)]),
    "two balls": ([ball(0.0203), ball(0.0606)], [0.021, 0.062]),
    "a ball on a box": ([box(0.3e-3, 0.0303), ball(0.0506)], [0.016, 0.052]),
}


@pytest.mark.parametrize("step", [ts.ImplicitEuler, ts.BDF2, ts.SymplecticEuler])
@pytest.mark.parametrize("name", PILES)
def test_a_pile_begins_where_it_rests(name: str, step: Any) -> None:
    """Each thing stands a gap above the one below it, from the table on, and stays there.

    Without gravity nothing acts. What is missing of a gap, 1e-9 of it at most in each of six, makes
    a speed of 6e-9 GAP over the part of a step in which it is closed, an eighth at least; 3/2 of
    it in BDF2.
    """
    things, heights = PILES[name]
    names = [f"thing {k}" for k in range(len(things))]
    scene = ts.Scene(
        bodies={},
        obstacles={"table": TABLE, **dict(zip(names, things, strict=True))},
        contacts=[ts.Contact("all", gap=GAP)],
        step=step(H),
    )
    simulation = scene.compile()
    for name_of, height in zip(names, heights, strict=True):
        assert simulation.rigid(name_of).position[2] == pytest.approx(height, abs=1e-8 * GAP)
    for _ in range(20):
        assert simulation.step().converged
    for name_of in names:
        assert abs(simulation.rigid(name_of).velocity).max() < 1.5 * 6e-9 * GAP / (H / 8)


def test_a_pile_that_was_moved_apart_stays_at_rest_under_gravity() -> None:
    """Three boxes of 1 kg: the table bears all of them, in the mean over 0.1 s.

    The impulse of the mean's error is the momentum at the end, of speeds below 0.001 GAP a step.
    """
    names = ["low", "middle", "high"]
    scene = ts.Scene(
        bodies={},
        gravity=(0, 0, -9.81),
        obstacles={"table": TABLE, **dict(zip(names, pile(3, 0.3e-3), strict=True))},
        contacts=[ts.Contact("all", gap=GAP)],
        step=ts.ImplicitEuler("2 ms"),
    )
    simulation = scene.compile()
    start = [simulation.rigid(name).position[2] for name in names]
    impulse = 0.0
    for _ in range(50):
        assert simulation.step().converged
        impulse += 2e-3 * simulation.force_on("table").force[2]
    for name, height in zip(names, start, strict=True):
        assert simulation.rigid(name).position[2] == pytest.approx(height, abs=1e-3 * GAP)
    error = 3 * 1.0 * 1e-3 * GAP / 2e-3
    assert impulse == pytest.approx(-3 * 9.81 * 0.1, abs=error)
