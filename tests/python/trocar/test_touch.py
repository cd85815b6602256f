"""A trocar in a scene: what the hand feels of the tissue, and what the tissue feels of the hand."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from tissu.trocar.controller import Controller
from tissu.trocar.touch import Felt, Touch

EXAMPLES = Path(__file__).parents[3] / "examples"
DEPTH = 0.13


def scene(**changes: Any) -> ts.Scene:
    """A sphere through a port 12 cm above a block; the hand goes 1 cm into it and stays."""
    block = ts.Body(
        mesh=ts.BarMesh(size=(0.08, 0.08, 0.04), cells=(4, 4, 2)),
        law=ts.NeoHooke(young="5 kPa", poisson=0.3),
        density=1050,
        viscosity=ts.Rayleigh(mass=5, stiffness="10 ms"),
    )
    hand = ts.Hand(times=(0, "0.3 s", "1 s"), points=((0, 0, 0.1), (0, 0, DEPTH), (0, 0, DEPTH)))
    trocar = ts.Trocar(
        port=ts.Port(at=(0.04, 0.04, 0.16), axis=(0, 0, -1)),
        device=ts.SimulatedDevice(hand=hand),
        tools={1: "probe"},
    )
    made = ts.Scene(
        bodies={"block": block},
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        obstacles={"probe": ts.SphereObstacle((0.04, 0.04, 0.065), radius=0.005)},
        contacts=[ts.Contact(("block", "probe"), friction=0.2)],
        trocars={"right": trocar},
        step=ts.ImplicitEuler("10 ms"),
    )
    return made.replace(**changes)


def palpated(steps: int = 100, **changes: Any) -> tuple[ts.Simulation, list[Felt]]:
    """What every step felt; none leaves a crossing."""
    simulation = scene(**changes).compile()
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        found = []
        for _ in range(steps):
            found.append(touch.step())
            assert not simulation.scene.contacts or len(simulation.crossings()) == 0
    return simulation, found


def test_the_hand_and_the_tissue_feel_one_force() -> None:
    """At rest the ticks' force is the tissue's, and the tissue gives it back at its support.

    An axis of the device has steps of 0.1 mm, of which K_c = 1600 N/m makes 0.16 N; the hand is
    still, and the proxy follows to within one of them.
    """
    simulation, found = palpated()
    late = found[-10:]
    slow = np.mean([one.force for one in late], axis=0)
    fast = np.mean([one.fast for one in late], axis=0)
    assert slow[2] > 0.3
    np.testing.assert_allclose(fast, slow, atol=0.02 * slow[2])
    support = simulation.reactions("block").sum(axis=0)
    np.testing.assert_allclose(support, simulation.force_on("probe").force, atol=0.02 * slow[2])


def test_the_hand_is_the_spring_of_the_device_deeper_than_the_tool() -> None:
    """The coupling's force is K_c times what the device is ahead of the proxy (depth axis)."""
    simulation = scene().compile()
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        for _ in range(100):
            felt = touch.step()
        report = controller.report()
        ahead = report.q[3] - (report.q + report.torque / controller.stiffness())[3]
        assert ahead > 0.0
        assert controller.stiffness()[3] * ahead == pytest.approx(-report.torque[3], rel=1e-12)
        assert -report.torque[3] == pytest.approx(felt.fast[2], rel=2e-2)


def test_a_model_knows_how_far_the_tissue_gives() -> None:
    """W of one contact against the displacement of a step under a unit force, by an own solve."""
    simulation, _ = palpated(60)
    from tissu.trocar.touched import compliance, nearest, pressing

    (one, *_) = pressing(simulation, "probe") or nearest(simulation, "probe")
    W = compliance(simulation.compliance(), [one], np.eye(3)[None])
    free = simulation.free_axes().ravel()
    h = simulation.dt
    A = (
        simulation.mass_matrix() + h * simulation.damping() + h**2 * simulation.stiffness()
    ).toarray()
    A = A[np.ix_(free, free)]
    H = np.zeros((3, len(free)))
    for node, weight in zip(one.nodes, one.weights, strict=True):
        H[:, 3 * node : 3 * node + 3] += weight * np.eye(3)
    H = H[:, free]
    np.testing.assert_allclose(W, h**2 * H @ np.linalg.solve(A, H.T), rtol=1e-10, atol=1e-16)
    assert np.linalg.eigvalsh(W).min() > 0.0


@pytest.mark.parametrize("way", ["factor", "cg", "warped"])
def test_every_way_of_compliance_ends_at_one_force(way: str) -> None:
    """At rest anchor + W lambda is the tissue's place, whatever W is."""
    trocar = scene().trocars["right"].replace(compliance=way)
    simulation, found = palpated(trocars={"right": trocar})
    slow = np.mean([one.force[2] for one in found[-10:]])
    fast = np.mean([one.fast[2] for one in found[-10:]])
    assert slow > 0.3
    assert fast == pytest.approx(slow, rel=0.03)
    assert f"compliance {'by the conjugate' if way == 'cg' else ''}" in str(simulation.plan())


def test_condensed_compliance_needs_a_stiffness_that_stays() -> None:
    """Refused in one sentence where the law is not linear."""
    trocar = scene().trocars["right"].replace(compliance="condensed")
    with pytest.raises(ts.SceneError, match="take factor or warped"):
        palpated(trocars={"right": trocar})


def test_a_hand_stronger_than_the_limit_goes_on_alone() -> None:
    """The tool stays where the tissue gives 0.4 N back; the device is centimetres deeper."""
    hand = ts.Hand(times=(0, "0.8 s"), points=((0, 0, 0.1), (0, 0, 0.15)))
    base = scene().trocars["right"]
    trocar = base.replace(
        device=ts.SimulatedDevice(hand=hand), limits=base.limits.replace(force=0.4)
    )
    simulation = scene(trocars={"right": trocar}).compile()
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        felt = [touch.step() for _ in range(150)]
        deep = controller.report().q[3]
    late = felt[-20:]
    assert all(one.limited for one in late)
    assert np.mean([one.force[2] for one in late]) == pytest.approx(0.4, rel=0.03)
    assert max(one.force[2] for one in felt) < 1.5 * 0.4  # the step that meets the tissue
    assert deep - late[-1].joints[3] > 0.01


def test_the_same_bits_twice() -> None:
    """Stepped ticks and the scene, forty steps."""
    first, second = palpated(40)[1], palpated(40)[1]
    for one, other in zip(first, second, strict=True):
        assert one.force.tobytes() == other.force.tobytes()
        assert one.fast.tobytes() == other.fast.tobytes()


def test_a_knife_is_led_through_the_port() -> None:
    """Its edge goes 1 cm deep, and to the side: it cuts, and the block has an incision."""
    hand = ts.Hand(
        times=(0, "0.2 s", "0.5 s"),
        points=((-0.03, 0, 0.11), (-0.03, 0, 0.13), (0.03, 0, 0.13)),
    )
    base = scene().trocars["right"]
    trocar = base.replace(device=ts.SimulatedDevice(hand=hand), tools={1: "scalpel"})
    knife = ts.Knife(edge=((0, 0, 0), (0, 0, -0.03)), cuts=("block",))
    simulation, found = palpated(
        60,
        obstacles={},
        contacts=(),
        instruments={"scalpel": knife},
        editing=True,
        trocars={"right": trocar},
    )
    assert found[-1].tool == "scalpel"
    assert simulation.surface("block").cut.any()


@pytest.mark.parametrize("dt", ["0.3 ms", "1.5 ms", "2.5 ms"])
def test_both_clocks_go_on_together(dt: str) -> None:
    """Steps that are not a multiple of a 1 ms tick: the remainder counts in the next step."""
    simulation = scene(step=ts.ImplicitEuler(dt)).compile()
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        first = controller.report().time
        for _ in range(40):
            touch.step()
        assert controller.report().time - first == pytest.approx(simulation.time, abs=1.001e-3)


def test_a_tool_that_is_taken_out_leaves_the_tissue() -> None:
    """Its obstacle goes back to where the scene has it, and presses on nothing."""
    simulation = scene().compile()
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        for _ in range(60):
            felt = touch.step()
        assert felt.force[2] > 0.3
        controller.device.set_tool(0, False)
        for _ in range(30):
            felt = touch.step()
    assert felt.tool is None
    assert not simulation.force_on("probe").force.any()
    at_rest = (0.04, 0.04, 0.065)
    np.testing.assert_allclose(simulation.obstacle("probe").place_of(at_rest), at_rest, atol=1e-12)


REFUSED = {
    "no contact": ({"contacts": []}, "which no contact of the scene names"),
    "free": (
        {"obstacles": {"probe": ts.SphereObstacle((0.04, 0.04, 0.065), radius=0.005, mass=1)}},
        "is led by its hand alone",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused(case: str) -> None:
    """By the check of the scene, before anything runs."""
    changes, words = REFUSED[case]
    with pytest.raises(ts.SceneError, match=words):
        scene(**changes)  # type: ignore[arg-type]


def test_a_trocar_without_tools_of_the_scene_is_refused() -> None:
    """Ticks run with any tool; tissue is touched by one that the scene has."""
    simulation = scene(trocars={"right": scene().trocars["right"].replace(tools={})}).compile()
    with (
        Controller(simulation.scene.trocars["right"]) as controller,
        pytest.raises(ts.ParameterError, match="found no obstacle and no instrument"),
    ):
        Touch(simulation, controller)


@pytest.mark.parametrize("other", [None, 3, scene()])
def test_what_is_not_a_simulation_or_a_controller_is_refused(other: Any) -> None:
    """In a sentence that says where to get one."""
    simulation = scene().compile()
    with Controller(simulation.scene.trocars["right"]) as controller:
        with pytest.raises(ts.ParameterError, match="a compiled scene is accepted"):
            Touch(other, controller)
        with pytest.raises(ts.ParameterError, match="the one of a trocar is accepted"):
            Touch(simulation, other)


def test_end_stops_are_no_force_of_the_tissue() -> None:
    """A blade at the end stop of the depth: `fast` has the blade alone."""
    hand = ts.Hand(times=(0, "0.3 s"), points=((0, 0, 0.1), (0, 0, 0.14)))
    base = scene().trocars["right"]
    trocar = base.replace(
        device=ts.SimulatedDevice(hand=hand),
        tools={1: "scalpel"},
        limits=base.limits.replace(depth=0.11),
    )
    knife = ts.Knife(edge=((0, 0, 0), (0, 0, -0.03)), cuts=("block",), toughness="50 J/m^2")
    simulation = scene(
        obstacles={},
        contacts=(),
        instruments={"scalpel": knife},
        editing=True,
        trocars={"right": trocar},
    ).compile()
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        for _ in range(60):
            felt = touch.step()
        report = controller.report()
    assert report.torque[3] < -1.0  # of the stop, towards the hand
    assert not felt.fast.any()


def test_the_example_palpates() -> None:
    """It feels about a newton, and nothing when the tool is out again."""
    found = runpy.run_path(str(EXAMPLES / "palpate.py"))
    simulation = found["scene"]().compile()
    felt = found["felt"](simulation, 170)
    deep = [np.linalg.norm(one.force) for one in felt[80:140]]
    assert 0.5 < np.mean(deep) < 2.0
    fast = [np.linalg.norm(one.fast) for one in felt[80:140]]
    assert np.mean(fast) == pytest.approx(np.mean(deep), rel=0.05)
    assert np.linalg.norm(felt[-1].fast) == 0.0


@pytest.mark.parametrize("how", ["fault", "held"])
def test_after_a_fault_the_tissue_feels_the_tool_again_by_and_by(how: str) -> None:
    """The hand stays 1 cm deep in the tissue; the force comes back within the ramp of K_c.

    Tissue and hand feel one force on the way.
    """
    simulation = scene().compile()
    trocar = simulation.scene.trocars["right"]
    with Controller(trocar) as controller:
        touch = Touch(simulation, controller)
        pressed = [touch.step() for _ in range(80)][-1].force[2]
        assert pressed > 0.3
        if how == "fault":
            controller.device.set_fault(True)
            assert [touch.step() for _ in range(20)][-1].state == "fault"
            controller.device.set_fault(False)
            controller.stop()
            controller.start()
        else:
            controller.device.jump(3, 1000)
            assert touch.step().state == "held"
            controller.device.jump(3, -1000)
            assert not [touch.step() for _ in range(20)][-1].force.any()
            controller.acknowledge()
        back = [touch.step() for _ in range(60)]
    forces = np.array([one.force[2] for one in back])
    hand = np.array([one.fast[2] for one in back])
    assert forces[-1] == pytest.approx(pressed, rel=0.03)
    # A third of it is of the way within the tissue, in 10 steps of 10 ms, which the tissue's
    # viscosity meets with up to a fifth in the first; a tool that is there at once has all of it.
    assert np.diff(forces, prepend=0.0).max() < pressed / 3.0
    assert np.diff(hand, prepend=0.0).max() < pressed / 3.0
    assert np.abs(forces - hand).max() < pressed / 3.0
    assert len(simulation.crossings()) == 0


@pytest.mark.parametrize("depth", [0.125, 0.13, 0.135])
def test_walls_of_a_pit_all_bear(depth: float) -> None:
    """A tip that is deep in coarse tissue has contacts around one node: the ticks feel each.

    At rest both forces are one up to a step of the device, as in the test of one contact above.
    """
    block = scene().bodies["block"].replace(law=ts.StableNeoHooke(young="5 kPa", poisson=0.4))
    hand = ts.Hand(
        times=(0, "0.2 s", "0.9 s"), points=((0, 0, 0.1), (0, 0, 0.1), (0, 0, depth)), tremor=0
    )
    trocar = (
        scene()
        .trocars["right"]
        .replace(
            device=ts.SimulatedDevice(hand=hand),
            port=ts.Port(at=(0.04, 0.04, 0.15), axis=(0, 0, -1)),
        )
    )
    _, found = palpated(
        150,
        bodies={"block": block},
        trocars={"right": trocar},
        obstacles={"probe": ts.SphereObstacle((0.04, 0.04, 0.06), radius=0.005)},
    )
    slow = np.mean([one.force for one in found[-20:]], axis=0)
    fast = np.mean([one.fast for one in found[-20:]], axis=0)
    assert found[-1].contacts > 1
    assert slow[2] > 1.5
    np.testing.assert_allclose(fast, slow, atol=0.02 * slow[2])
