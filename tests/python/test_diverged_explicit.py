"""What the message says when an explicit scene with `dt: auto` diverges."""

from __future__ import annotations

import pytest

import tissu as ts


def two_blocks():
    def block(y):
        mesh = ts.bar_mesh(
            size=(0.03, 0.03, 0.03), cells=(2, 2, 2), cell="tetra", origin=(y, 0, 0.005)
        )
        return ts.Body(mesh=mesh, law=ts.NeoHooke(young=1e5, poisson=0.3), density=1000)

    return ts.Scene(
        bodies={"calm": block(0.1), "fast": block(0)},
        obstacles={"floor": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact("all")],
        step=ts.SymplecticEuler(),
    ).compile()


def message_of(simulation, steps=400, dt=None):
    with pytest.raises(ts.Diverged) as caught:
        for _ in range(steps):
            simulation.step(dt)
    text = str(caught.value)
    assert "an implicit method, a smaller share of the stable step as dt" in text
    assert "take dt: auto" not in text
    assert "Newton" not in text
    assert caught.value.body == "fast"
    assert '"fast"' in text
    return text


def test_the_fastest_body_is_named() -> None:
    simulation = two_blocks()
    simulation.velocities["fast"][:] = (0, 0, -100)
    assert "the fastest, had 100 m/s" in message_of(simulation)


def test_a_step_that_is_too_long_in_all_its_parts_names_a_body() -> None:
    simulation = two_blocks()
    simulation.velocities["fast"][:] = (0, 0, -1)
    assert "stable up to" in message_of(simulation, dt=1.0)
