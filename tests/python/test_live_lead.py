"""Supports that are led live go like a motion of the scene, and give its reactions."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts
from led_scenes import (
    AXIS,
    CENTER,
    DT,
    END,
    LAST,
    LENGTH,
    ROOT,
    SIDE,
    STEPS,
    STEPS_TAKEN,
    TURN,
    YOUNG,
    follow,
    led_body,
    led_by_scene,
    led_motion,
    led_scene,
)


@pytest.mark.parametrize("kind", ["fem", "frames", "shell"])
@pytest.mark.parametrize("name", STEPS)
def test_it_follows_the_path_of_a_scene_s_motion(name: str, kind: str) -> None:
    step = STEPS[name]
    if kind == "shell" and name in ("explicit", "stages"):
        step = step.replace(dt=2e-5)
    dt = float(step.dt)
    duration = STEPS_TAKEN * dt
    given, live = led_by_scene(step, duration, kind), led_scene(step, kind).compile()
    for _ in range(STEPS_TAKEN):
        follow(live, duration, dt)
        given.step()
        live.step()
    # The angle and the displacement at a time are sums of other roundings: places of 0.4 m, and of
    # their changes over dt the forces of an iteration that stops at its tolerance.
    moved = np.abs(given.displacements("bar")).max()
    assert moved > 0.02
    assert live.positions["bar"] == pytest.approx(given.positions["bar"], abs=1e-9 * moved)
    largest = np.abs(given.reactions("bar")).max()
    assert live.reactions("bar") == pytest.approx(given.reactions("bar"), abs=1e-6 * largest)
    if kind != "fem":
        turned = given.rotations("bar")
        assert live.rotations("bar") == pytest.approx(turned, abs=1e-9)
        assert np.abs(turned - np.eye(3)).max() > 0.5


def test_the_conserving_method_follows_too() -> None:
    """At a centimetre a second: it takes no end that sets off at metres a second."""
    step, duration = ts.EnergyMomentum(DT), 2.0
    given, live = led_by_scene(step, duration), led_scene(step).compile()
    for _ in range(STEPS_TAKEN):
        follow(live, duration, DT)
        given.step()
        live.step()
    moved = np.abs(given.displacements("bar")).max()
    assert live.positions["bar"] == pytest.approx(given.positions["bar"], abs=1e-9 * moved)


def test_one_target_over_a_time_is_the_way_at_a_constant_rate() -> None:
    step = STEPS["implicit"]
    duration = STEPS_TAKEN * DT
    given, live = led_by_scene(step, duration), led_scene(step).compile()
    hand = live.lead("hand")
    hand.move(LAST, angle=f"{TURN} rad", axis=AXIS, center=CENTER, over=f"{1e3 * duration} ms")
    for _ in range(STEPS_TAKEN + 3):
        given.step()
        live.step()
        assert live.positions["bar"] == pytest.approx(given.positions["bar"], abs=1e-12)
    assert hand.positions == pytest.approx(hand.target, abs=1e-15)
    assert live.velocities["bar"][hand.nodes] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("kind", ["fem", "frames", "shell"])
def test_static_steps_turn_by_the_arc(kind: str) -> None:
    """A turn of 120 degrees about the bar's own axis in one static step."""
    static = ts.Static(newton=ts.Newton(iterations=60), solver=ts.Cholesky())
    angle, axis = 2.0 * np.pi / 3.0, (1.0, 0.0, 0.0)
    height = 0.0 if kind == "shell" else 0.05
    rotation = ts.Rotation(axis=axis, center=(LENGTH, 0.05, height), angles=[0.0, angle])
    motion = ts.Prescribed("bar", on=END, times=[0.0, 1.0], rotation=rotation)
    given = led_scene(static, kind, fixed=[ROOT], prescribed=[motion]).compile()
    live = led_scene(static, kind).compile()
    live.lead("hand").move(angle=angle, axis=axis, center=(LENGTH, 0.05, height))
    assert given.step(1.0).converged
    assert live.step(1.0).converged
    # Newton's tolerance, 1e-9 of the reactions.
    assert live.positions["bar"] == pytest.approx(given.positions["bar"], abs=1e-6 * LENGTH)
    assert live.energy()["elastic"] == pytest.approx(given.energy()["elastic"], rel=1e-6)
    assert given.energy()["elastic"] > 0.0


def test_a_bar_that_is_drawn_pulls_back() -> None:
    """F = E A u / L of a bar without lateral contraction, of each live target."""
    law = ts.Hooke(young=YOUNG, poisson=0.0)
    static = ts.Static(solver=ts.Cholesky())
    simulation = led_scene(static, bodies={"bar": led_body().replace(law=law)}).compile()
    hand = simulation.lead("hand")
    for drawn in (0.01, -0.004, 0.02):
        hand.move((drawn, 0, 0))
        assert simulation.step().converged
        # Newton's tolerance of 1e-9 of the reactions.
        force = YOUNG * SIDE**2 * drawn / LENGTH
        assert hand.force == pytest.approx((force, 0, 0), abs=1e-7 * abs(force))
    hand.release()
    simulation.step()
    assert hand.released
    assert hand.force == pytest.approx(np.zeros(3), abs=1e-8)


def test_nodes_go_to_places_of_their_own() -> None:
    simulation = led_scene(STEPS["implicit"]).compile()
    hand = simulation.lead("hand")
    places = hand.positions + 0.01 * np.random.default_rng(3).standard_normal((len(hand.nodes), 3))
    start = hand.positions
    assert simulation.lead("hand", places, over=4 * DT).target == pytest.approx(places, abs=1e-16)
    simulation.step()
    assert hand.positions == pytest.approx(start + 0.25 * (places - start), abs=1e-15)
    velocities = simulation.velocities["bar"][hand.nodes]
    assert velocities == pytest.approx((places - start) / (4 * DT), abs=1e-11)
    hand.target = start
    simulation.step()
    assert hand.positions == pytest.approx(start, abs=1e-15)


def test_rotations_stay_while_nodes_are_placed() -> None:
    simulation = led_scene(STEPS["implicit"], "frames").compile()
    hand = simulation.lead("hand")
    hand.move(angle="40 deg", center=CENTER)
    simulation.step()
    turned = simulation.rotations("bar")[hand.nodes]
    angle = np.deg2rad(40)
    about_z = [
        [np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]
    ]  # fmt: skip
    assert turned == pytest.approx(np.tile(about_z, (len(turned), 1, 1)), abs=1e-14)
    hand.place(hand.positions + np.array((0.01, 0, 0)), over=3 * DT)
    simulation.step()
    assert simulation.rotations("bar")[hand.nodes] == pytest.approx(turned, abs=1e-14)


@pytest.mark.parametrize("kind", ["fem", "frames"])
def test_released_it_goes_back_to_the_scene_s_motion(kind: str) -> None:
    step, duration = STEPS["implicit"], 20 * DT
    named = {"fixed": [ROOT], "prescribed": [led_motion(duration, name="hand")]}
    simulation = led_scene(step, kind, **named).compile()
    given = led_by_scene(step, duration, kind)
    hand = simulation.lead(simulation.scene.prescribed[0])
    simulation.step()
    given.step()
    assert np.array_equal(simulation.positions["bar"], given.positions["bar"])
    hand.move((0.0, 0.02, 0.0), angle=-0.2, axis=AXIS, center=CENTER)
    simulation.step()
    given.step()
    hand.release(over=3 * DT)
    for _ in range(6):
        simulation.step()
        given.step()
    # On the own path again: the same places and velocities, by the same sums.
    rows = hand.nodes
    assert np.abs(simulation.positions["bar"] - given.positions["bar"]).max() > 1e-4
    there = given.positions["bar"][rows]
    assert simulation.positions["bar"][rows] == pytest.approx(there, abs=1e-15)
    assert simulation.velocities["bar"][rows] == pytest.approx(
        given.velocities["bar"][rows], abs=1e-12
    )
    if kind == "frames":
        turned = given.rotations("bar")[rows]
        assert simulation.rotations("bar")[rows] == pytest.approx(turned, abs=1e-14)
