"""Live leads stand in the state: checkpoints, roll back, edits; and what they refuse."""

from __future__ import annotations

import threading
from typing import Any

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
    STEPS,
    TURN,
    led_motion,
    led_scene,
)


@pytest.mark.parametrize("name", STEPS)
def test_a_checkpoint_on_the_way_goes_on_bit_for_bit(name: str, tmp_path: Any) -> None:
    simulation = led_scene(STEPS[name]).compile()
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
    straight, simulation = (led_scene(STEPS["explicit"]).compile() for _ in range(2))
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
    scene = led_scene(STEPS["implicit"])
    one, two = scene.compile(), scene.compile()
    one.lead("hand").move(LAST)
    one.step()
    two.step()
    assert np.abs(one.displacements("bar")).max() > 0.01
    assert np.abs(two.displacements("bar")).max() < 1e-15  # round-off of forces at rest


def test_a_name_alone_changes_no_bit() -> None:
    heavy = {"gravity": (0, 0, -9.81)}
    plain = led_scene(STEPS["iterated"], fixed=[ROOT, ts.Fixed("bar", on=END)], **heavy).compile()
    named = led_scene(STEPS["iterated"], **heavy).compile()
    for _ in range(5):
        plain.step()
        named.step()
    assert np.array_equal(plain.positions["bar"], named.positions["bar"])
    assert "live leads" in plain.plan().absent
    assert "live leads" not in named.plan().absent


def test_cells_may_go_while_it_is_led() -> None:
    simulation = led_scene(STEPS["implicit"], editing=True).compile()
    hand = simulation.lead("hand")
    hand.move(LAST, over=4 * DT)
    simulation.step()
    simulation.remove_cells(body="bar", cells=[5])
    for _ in range(3):
        simulation.step()
    assert hand.positions == pytest.approx(hand.target, abs=1e-15)


def test_energy_that_a_lead_gives_is_no_divergence() -> None:
    """The watch over an undamped method rests meanwhile, and goes on afterwards."""
    simulation = led_scene(ts.Newmark(DT)).compile()
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
    simulation = led_scene(STEPS["implicit"]).compile()
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
    hand = led_scene(STEPS["implicit"]).compile().lead("hand")
    with pytest.raises(ts.ParameterError, match=text):
        hand.move(**given)
    assert hand.released


def test_what_places_are_refused() -> None:
    simulation = led_scene(STEPS["implicit"]).compile()
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
    simulation = led_scene(STEPS["implicit"]).compile()
    with pytest.raises(ts.ParameterError, match=r"'hnad'; did you mean 'hand'\? accepted: hand"):
        simulation.lead("hnad")
    with pytest.raises(ts.ParameterError, match="a support of 'bar' without a name; give it one"):
        simulation.lead(simulation.scene.fixed[0])
    nameless = led_scene(STEPS["implicit"], fixed=[ROOT]).compile()
    with pytest.raises(ts.ParameterError, match="no part of `fixed` and `prescribed` has a name"):
        nameless.lead("hand")


def test_a_name_finds_one_support() -> None:
    with pytest.raises(ts.SceneError) as refused:
        led_scene(STEPS["implicit"], prescribed=[led_motion(1.0, name="hand")])
    assert "found 'hand' twice among fixed and prescribed" in str(refused.value)
    with pytest.raises(ts.SceneError, match="an empty name"):
        led_scene(STEPS["implicit"], fixed=[ts.Fixed("bar", on=END, name="")])


def test_another_thread_waits_its_turn() -> None:
    simulation = led_scene(STEPS["implicit"]).compile()
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
