"""Trocars of a view without a page: their steps, what is drawn, tools, faults, undo."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from trocar_scenes import PORT, device, stepped, tissue

import tissu as ts
from tissu.live_view.tools.instrument import MoveInstrument
from tissu.live_view.tools.obstacle import MoveObstacle
from tissu.live_view.trocars.drawing import tube
from tissu.live_view.trocars.trocars import LiveTrocars
from tissu.live_view.undo import Undo
from tissu.trocar import kinematics
from tissu.trocar.controller import Controller
from tissu.trocar.touch import Touch

ROOT = Path(__file__).resolve().parents[3]


def bits(simulation):
    return [simulation.positions["block"].tobytes(), simulation.velocities["block"].tobytes()]


class TestSteps:
    def test_they_are_those_of_a_run(self, live):
        """The same bits as Controller and Touch give; again after a reset."""
        simulation = tissue().compile()
        with Controller(simulation.scene.trocars["right"]) as controller:
            touch = Touch(simulation, controller)
            felt = [touch.step() for _ in range(45)][-1]
        assert felt.force[2] > 0.3
        trocars = live(steps=45)
        (one,) = trocars.each
        assert bits(one.simulation) == bits(simulation)
        assert one.felt.fast.tobytes() == felt.fast.tobytes()
        one.simulation.reset()
        trocars.reset([one.simulation])
        assert one.felt is None and not len(one.frame(0.1).history)
        stepped(trocars, 45)
        assert bits(one.simulation) == bits(simulation)

    def test_two_simulations_beside_each_other_have_a_trocar_each(self):
        soft = tissue().bodies["block"].replace(law=ts.NeoHooke(young="2 kPa", poisson=0.3))
        both = [tissue().compile(), tissue(bodies={"block": soft}).compile()]
        trocars = LiveTrocars(both)
        for _ in range(45):
            for simulation in both:
                trocars.step(simulation)
        trocars.close()
        stiff, soft = trocars.frames()
        assert (stiff.lane, soft.lane) == (0, 1) and trocars.names == ["right"]
        assert 0.2 < soft.fast < 0.7 * stiff.fast


class TestMarks:
    def drawn(self, trocars):
        (layer,) = [trocars.layer]
        one = trocars.each[0]
        assert layer.on and layer.offered(one.simulation)
        return layer.begin(one.simulation)()

    def test_the_tool_goes_through_the_pivot_to_its_tip(self, live):
        trocars = live(steps=45)
        one = trocars.each[0]
        marks = self.drawn(trocars)
        rings = [m for m in marks[:7] if len(m.lines)]
        assert len(rings) == 1  # of its state
        np.testing.assert_allclose(rings[0].lines[:, 0].mean(axis=0), PORT, atol=1e-12)
        shaft = marks[8].surface.reshape(-1, 3)
        tip = np.array(PORT) - one.felt.joints[3] * np.array([0, 0, 1])  # tilted by 1e-3 at most
        lowest, highest = shaft[shaft[:, 2].argmin()], shaft[shaft[:, 2].argmax()]
        assert lowest[2] - tip[2] == pytest.approx(5e-3, abs=1e-4)
        assert highest[2] > PORT[2] + 0.03
        # Its axis: all corners lie at the radius from the line through pivot and tip.
        along = kinematics.axis(one.felt.joints) * [1, -1, -1]  # the port's axes in the scene
        off = (shaft - PORT) - np.outer((shaft - PORT) @ along, along)
        distance = np.linalg.norm(off, axis=1)
        assert distance.max() == pytest.approx(2.5e-3, rel=1e-9)
        sphere = one.simulation.obstacle_surface("probe").points
        assert sphere[:, 2].min() == pytest.approx(tip[2], abs=2e-5)  # what is drawn meets it

    def test_hand_and_tool_are_apart_by_the_coupling(self, live):
        """K_c (q_d - q_p) is the torque that is felt; along the depth at 1 N about 0.6 mm."""
        trocars = live(steps=45)
        one = trocars.each[0]
        before = one.controller.report()
        trocars.step(one.simulation)
        apart = before.torque / one.controller.stiffness()
        np.testing.assert_allclose(one.joints - one.felt.joints, -apart, atol=1e-15)
        frame = one.frame(0.1)
        assert frame.ahead == pytest.approx(abs(apart[3]), rel=2e-2) and frame.ahead > 2e-4
        hand = self.drawn(trocars)[11]
        assert hand.points[0][2] < one.simulation.obstacle_surface("probe").points[:, 2].min()

    def test_the_arrow_is_the_force_on_the_hand(self, live):
        trocars = live(steps=45)
        one = trocars.each[0]
        trocars.arrow = 0.03
        (arrow,) = self.drawn(trocars)[10].arrows
        np.testing.assert_allclose(arrow[1] - arrow[0], 0.03 * one.felt.fast, rtol=1e-9)
        assert one.felt.fast[2] > 0.3
        label = self.drawn(trocars)[7].labels[0][1]
        assert label == f"right: contact, probe, {np.linalg.norm(one.felt.fast):.2f} N"
        assert not len(self.drawn(live())[10].arrows)

    def test_a_tube_is_closed_and_faces_out(self):
        """Areas as vectors add up to zero; its volume is that of its prism of 16 sides."""
        a, b, c = tube(-0.2, 0.3, 0.1).transpose(1, 0, 2)
        area = 0.5 * np.cross(b - a, c - a)
        np.testing.assert_allclose(area.sum(axis=0), 0.0, atol=1e-15)
        prism = 0.5 * 16 * np.sin(2 * np.pi / 16) * 0.1**2 * 0.5
        assert (area * (a + b + c) / 3).sum() / 3 == pytest.approx(prism, rel=1e-12)


class TestToolsAndFaults:
    def test_a_tool_is_taken_out_and_another_one_comes_in(self, live):
        trocars = live(steps=45)
        one = trocars.each[0]
        one.take("thin")
        states = []
        for _ in range(8):
            trocars.step(one.simulation)
            states.append((one.felt.state, one.felt.tool, one.controller.report().tag))
        # Out before the other one is in, so that no tag changes while a tool is in.
        assert ("empty", 0) in [(state, tag) for state, _, tag in states]
        assert states[-1][1:] == ("thin", 0x51A1) and "held" not in [state for state, *_ in states]
        one.take(None)
        stepped(trocars, 4)
        assert one.felt.state == "empty" and one.frame(0.1).tool is None

    def test_a_fault_is_said_and_cured(self, live):
        trocars = live(steps=20)
        one = trocars.each[0]
        one.held.device.unplug()
        stepped(trocars, 3)
        frame = one.frame(0.1)
        assert frame.state == "fault" and "gave no sample five times in a row" in frame.problem
        one.cure()
        stepped(trocars, 3)
        assert one.frame(0.1).state == "free" and not one.frame(0.1).problem
        # The hand goes on along its path: half a second later it presses.
        stepped(trocars, 45)
        assert one.felt.state == "contact"

    def test_a_trocar_that_is_held_goes_on(self, live):
        trocars = live(steps=10)
        one = trocars.each[0]
        one.held.device.jump(3, 1000)
        stepped(trocars, 2)
        assert one.frame(0.1).state == "held" and "faster than its limit" in one.frame(0.1).problem
        one.held.device.jump(3, -1000)
        stepped(trocars, 5)
        one.cure()
        stepped(trocars, 3)
        assert one.frame(0.1).state == "free"

    def test_a_device_without_a_zero_goes_home_first(self, live):
        trocars = live(device(homed=False), steps=1)
        one = trocars.each[0]
        assert one.felt.state == "homing"


class TestUndo:
    def test_it_goes_back_to_before_the_latest_touch(self, live):
        trocars = live()
        one = trocars.each[0]
        simulations, undo = [one.simulation], Undo(trocars)
        trocars.before_touch.append(undo.remember)
        with pytest.raises(ts.ParameterError, match="found nothing to undo"):
            undo.back(simulations)
        seen = {}
        for _ in range(45):
            seen[round(one.simulation.time, 6)] = (bits(one.simulation), one.held.device.joints)
            trocars.step(one.simulation)
        assert one.felt.force[2] > 0.3
        undo.back(simulations)
        now = round(one.simulation.time, 6)
        assert 0.1 < now < 0.4 and bits(one.simulation) == seen[now][0]
        # The tool is where it was then, but for the few ticks in which it comes in again.
        np.testing.assert_allclose(one.held.device.joints, seen[now][1], atol=3e-4)
        assert one.held.path_time == pytest.approx(now, abs=0.02)
        stepped(trocars, 60)
        assert one.felt.force[2] > 0.3 and one.simulation.crossings() == []
        undo.forget()
        with pytest.raises(ts.ParameterError, match="Reset begins again"):
            undo.back(simulations)

    def test_an_incision_through_the_port_is_undone(self, live):
        points = ((-0.03, 0, 0.1), (-0.03, 0, 0.12), (0.03, 0, 0.12))
        hand = ts.Hand(times=(0, "0.2 s", "0.5 s"), points=points)
        right = tissue().trocars["right"]
        knife = ts.Knife(((0, 0, 0), (0, 0, -0.03)), cuts=["block"])
        scene = tissue(
            obstacles={},
            contacts=[],
            instruments={"scalpel": knife},
            editing=True,
            trocars={
                "right": right.replace(device=ts.SimulatedDevice(hand=hand), tools={1: "scalpel"})
            },
        )
        trocars = live(scene)
        one = trocars.each[0]
        undo = Undo(trocars)
        trocars.before_touch.append(undo.remember)
        stepped(trocars, 60)
        assert one.simulation.surface("block").cut.any()
        (edge,) = trocars.layer.begin(one.simulation)()[-1].lines
        np.testing.assert_allclose(edge, one.simulation.instruments["scalpel"].edge)
        undo.back([one.simulation])
        assert one.simulation.time < 0.1 and not one.simulation.surface("block").cut.any()
        stepped(trocars, 60)
        assert one.simulation.surface("block").cut.any()


def test_what_a_trocar_leads_no_other_tool_moves():
    simulation = tissue().compile()
    assert not MoveObstacle.offered(simulation) and not MoveInstrument.offered(simulation)
    assert MoveObstacle.offered(tissue(trocars={}).compile())


def test_a_view_without_trocars_loads_nothing_of_them():
    script = (
        "import sys, tissu as ts; sys.path.insert(0, 'tests/python/view')\n"
        "from trocar_scenes import tissue\n"
        "with ts.view(tissue(trocars={}).compile(), browser=False, playing=False) as view:\n"
        "    view.step()\n"
        "names = [n for n in sys.modules if 'trocar' in n and not n.startswith('tissu.scene')]\n"
        "print(names, 'tissu._haptic' in sys.modules)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["['trocar_scenes']", "False"]
