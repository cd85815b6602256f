"""Supports that are led live: like a motion of the scene, reactions, checkpoints, refusals."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import pytest

import tissu as ts

LENGTH, SIDE, YOUNG = 0.4, 0.1, 2e4
DT, STEPS_TAKEN = 2e-3, 8
END = ts.Plane((LENGTH, 0, 0), (1, 0, 0))
ROOT = ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))
CENTER, AXIS = (LENGTH, 0.05, 0.05), (0.6, 0.0, 0.8)
LAST, TURN = np.array((0.02, 0.01, -0.03)), 0.7

STEPS = {
    "implicit": ts.ImplicitEuler(DT),
    "iterated": ts.Newmark(DT),
    "bdf2": ts.BDF2(DT),
    "explicit": ts.SymplecticEuler(1e-4),
    "midpoint": ts.ImplicitMidpoint(DT),
    "stages": ts.RK4(1e-4),
}


def _body(kind: str = "fem") -> ts.Body:
    law = ts.StVK(young=YOUNG, poisson=0.3)
    if kind == "shell":
        mesh = ts.BarMesh(size=(LENGTH, SIDE, 0.0), cells=(6, 2, 0), cell="triangle")
        return ts.Body(
            mesh=mesh, law=ts.Hooke(young=YOUNG, poisson=0.3), thickness=0.02, density=1e3,
            model="shell",
        )  # fmt: skip
    mesh = ts.BarMesh(size=(LENGTH, SIDE, SIDE), cells=(4, 2, 2), cell="hexahedron")
    return ts.Body(mesh=mesh, law=law, density=1e3, model=kind)


def _scene(step: Any, kind: str = "fem", **changes: Any) -> ts.Scene:
    fields: dict[str, Any] = {
        "bodies": {"bar": _body(kind)},
        "fixed": [ROOT, ts.Fixed("bar", on=END, name="hand")],
        "step": step,
    }
    return ts.Scene(**{**fields, **changes})


def _motion(duration: float, *, name: str | None = None) -> ts.Prescribed:
    rotation = ts.Rotation(axis=AXIS, center=CENTER, angles=[0.0, TURN])
    return ts.Prescribed(
        "bar", on=END, times=[0.0, duration], displacements=[(0, 0, 0), LAST], rotation=rotation,
        name=name,
    )  # fmt: skip


def _given(step: Any, duration: float, kind: str = "fem", **changes: Any) -> ts.Simulation:
    """The end is led by the scene."""
    moved = {"fixed": [ROOT], "prescribed": [_motion(duration)], **changes}
    return _scene(step, kind, **moved).compile()


def _follow(simulation: ts.Simulation, duration: float, dt: float) -> None:
    """A live target where the scene's motion is after the next step."""
    share = (simulation.time + dt) / duration
    simulation.lead("hand").move(share * LAST, angle=share * TURN, axis=AXIS, center=CENTER)


@pytest.mark.parametrize("kind", ["fem", "frames", "shell"])
@pytest.mark.parametrize("name", STEPS)
def test_it_follows_the_path_of_a_scene_s_motion(name: str, kind: str) -> None:
    step = STEPS[name]
    if kind == "shell" and name in ("explicit", "stages"):
        step = step.replace(dt=2e-5)
    dt = float(step.dt)
    duration = STEPS_TAKEN * dt
    given, live = _given(step, duration, kind), _scene(step, kind).compile()
    for _ in range(STEPS_TAKEN):
        _follow(live, duration, dt)
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
    given, live = _given(step, duration), _scene(step).compile()
    for _ in range(STEPS_TAKEN):
        _follow(live, duration, DT)
        given.step()
        live.step()
    moved = np.abs(given.displacements("bar")).max()
    assert live.positions["bar"] == pytest.approx(given.positions["bar"], abs=1e-9 * moved)


def test_one_target_over_a_time_is_the_way_at_a_constant_rate() -> None:
    step = STEPS["implicit"]
    duration = STEPS_TAKEN * DT
    given, live = _given(step, duration), _scene(step).compile()
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
    given = _scene(static, kind, fixed=[ROOT], prescribed=[motion]).compile()
    live = _scene(static, kind).compile()
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
    simulation = _scene(static, bodies={"bar": _body().replace(law=law)}).compile()
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
    simulation = _scene(STEPS["implicit"]).compile()
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
    simulation = _scene(STEPS["implicit"], "frames").compile()
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
    named = {"fixed": [ROOT], "prescribed": [_motion(duration, name="hand")]}
    simulation = _scene(step, kind, **named).compile()
    given = _given(step, duration, kind)
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


@pytest.mark.parametrize("name", STEPS)
def test_a_checkpoint_on_the_way_goes_on_bit_for_bit(name: str, tmp_path: Any) -> None:
    simulation = _scene(STEPS[name]).compile()
    dt = simulation.dt
    over = 9.5 * dt
    simulation.lead("hand").move(LAST, angle=TURN, axis=AXIS, center=CENTER, over=over)
    for _ in range(4):
        simulation.step()
    simulation.save_checkpoint(tmp_path / "way.tissu")
    other = simulation.scene.compile(checkpoint=tmp_path / "way.tissu")
    assert not other.lead("hand").released
    assert np.array_equal(other.lead("hand").target, simulation.lead("hand").target)
    for number in range(9):
        if number == 7:
            simulation.lead("hand").release(over=over)
            other.lead("hand").release(over=over)
        simulation.step()
        other.step()
    assert np.array_equal(simulation.positions["bar"], other.positions["bar"])
    assert np.array_equal(simulation.velocities["bar"], other.velocities["bar"])
    assert np.array_equal(simulation.lead("hand").reactions, other.lead("hand").reactions)


def test_a_step_that_is_rolled_back_leaves_the_way_as_it_was() -> None:
    straight, simulation = (_scene(STEPS["explicit"]).compile() for _ in range(2))
    for one in (straight, simulation):
        one.lead("hand").move(LAST, over=1.2e-3)
    free = np.flatnonzero(np.isclose(simulation.meshes["bar"].points[:, 0], 0.5 * LENGTH))[0]
    for _ in range(2):  # before its first step, and on its way
        simulation.velocities["bar"][free, 0] += 1e9
        with pytest.raises(ts.Diverged, match="last good step"):
            simulation.step()
        assert simulation.time == straight.time
        simulation.velocities["bar"][free] = straight.velocities["bar"][free]
        for one in (straight, simulation):
            for _ in range(6):
                one.step()
        assert np.array_equal(simulation.positions["bar"], straight.positions["bar"])
    simulation.lead("hand").move((1e6, 0, 0))
    with pytest.raises(ts.Diverged, match="last good step"):
        simulation.step()
    simulation.lead("hand").move(LAST)
    straight.lead("hand").move(LAST)
    simulation.step()
    straight.step()
    assert np.array_equal(simulation.positions["bar"], straight.positions["bar"])


def test_two_simulations_of_one_scene_have_their_own() -> None:
    scene = _scene(STEPS["implicit"])
    one, two = scene.compile(), scene.compile()
    one.lead("hand").move(LAST)
    one.step()
    two.step()
    assert np.abs(one.displacements("bar")).max() > 0.01
    assert np.abs(two.displacements("bar")).max() < 1e-15  # round-off of forces at rest


def test_a_name_alone_changes_no_bit() -> None:
    heavy = {"gravity": (0, 0, -9.81)}
    plain = _scene(STEPS["iterated"], fixed=[ROOT, ts.Fixed("bar", on=END)], **heavy).compile()
    named = _scene(STEPS["iterated"], **heavy).compile()
    for _ in range(5):
        plain.step()
        named.step()
    assert np.array_equal(plain.positions["bar"], named.positions["bar"])
    assert "live leads" in plain.plan().absent
    assert "live leads" not in named.plan().absent


def test_cells_may_go_while_it_is_led() -> None:
    simulation = _scene(STEPS["implicit"], editing=True).compile()
    hand = simulation.lead("hand")
    hand.move(LAST, over=4 * DT)
    simulation.step()
    simulation.remove_cells(body="bar", cells=[5])
    for _ in range(3):
        simulation.step()
    assert hand.positions == pytest.approx(hand.target, abs=1e-15)


def test_energy_that_a_lead_gives_is_no_divergence() -> None:
    """The watch over an undamped method rests meanwhile, and goes on afterwards."""
    simulation = _scene(ts.Newmark(DT)).compile()
    simulation.step()
    hand = simulation.lead("hand")
    for way in (0.05, -0.05, 0.05):
        hand.move((0, 0, way), over=5 * DT)
        for _ in range(5):
            assert simulation.step().converged
    assert simulation.energy()["elastic"] > 0.1
    hand.release()
    for _ in range(4):
        assert simulation.step().converged


def test_it_says_what_it_is() -> None:
    simulation = _scene(STEPS["implicit"]).compile()
    hand = simulation.lead("hand")
    assert repr(hand) == "Lead('hand' of 'bar', on its own path)"
    points = simulation.meshes["bar"].points
    assert np.array_equal(np.sort(hand.nodes), np.flatnonzero(points[:, 0] > LENGTH - 1e-9))
    assert np.array_equal(hand.target, points[hand.nodes])
    hand.move()
    assert repr(hand) == "Lead('hand' of 'bar', led live)"
    assert (hand.name, hand.body, hand.released) == ("hand", "bar", False)
    hand.release()
    hand.release()
    assert hand.released
    assert any("has the name 'hand'" in effect.why for effect in simulation.plan().effects)


REFUSED = {
    "axis": ({"axis": (0, 0, 0)}, r"the axis \(0, 0, 0\)"),
    "angle": ({"angle": "3 m"}, "angle is accepted"),
    "over": ({"over": 0.0}, "a way of 0 s; a positive time is accepted"),
    "past": ({"over": "-1 s"}, "a positive time is accepted"),
    "displacement": ({"displacement": (0, 0)}, "three components"),
    "nan": ({"displacement": (0, 0, float("nan"))}, "not finite"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_move_refuses(name: str) -> None:
    given, text = REFUSED[name]
    hand = _scene(STEPS["implicit"]).compile().lead("hand")
    with pytest.raises(ts.ParameterError, match=text):
        hand.move(**given)
    assert hand.released


def test_what_places_are_refused() -> None:
    simulation = _scene(STEPS["implicit"]).compile()
    hand = simulation.lead("hand")
    with pytest.raises(ts.ParameterError, match=r"shape \(2, 3\) for 'hand'; \(9, 3\) is accepted"):
        hand.place(np.zeros((2, 3)))
    with pytest.raises(ts.ParameterError, match="a position of 'hand' that is not finite"):
        hand.place(np.full((9, 3), np.nan))
    with pytest.raises(ts.ParameterError, match="not numbers"):
        hand.place([["a", 0, 0]] * 9)
    with pytest.raises(ts.ParameterError, match="over without positions"):
        simulation.lead("hand", over=1.0)


def test_wrong_names_say_what_there_is() -> None:
    simulation = _scene(STEPS["implicit"]).compile()
    with pytest.raises(ts.ParameterError, match=r"'hnad'; did you mean 'hand'\? accepted: hand"):
        simulation.lead("hnad")
    with pytest.raises(ts.ParameterError, match="a support of 'bar' without a name; give it one"):
        simulation.lead(simulation.scene.fixed[0])
    nameless = _scene(STEPS["implicit"], fixed=[ROOT]).compile()
    with pytest.raises(ts.ParameterError, match="no part of `fixed` and `prescribed` has a name"):
        nameless.lead("hand")


def test_a_name_finds_one_support() -> None:
    with pytest.raises(ts.SceneError) as refused:
        _scene(STEPS["implicit"], prescribed=[_motion(1.0, name="hand")])
    assert "found 'hand' twice among fixed and prescribed" in str(refused.value)
    with pytest.raises(ts.SceneError, match="an empty name"):
        _scene(STEPS["implicit"], fixed=[ts.Fixed("bar", on=END, name="")])


def test_another_thread_waits_its_turn() -> None:
    simulation = _scene(STEPS["implicit"]).compile()
    hand = simulation.lead("hand")
    refused = []

    def look() -> None:
        try:
            hand.move()
        except ts.BusyError as error:
            refused.append(str(error))

    with simulation._entry.entered("step"):
        thread = threading.Thread(target=look)
        thread.start()
        thread.join()
    assert len(refused) == 1
