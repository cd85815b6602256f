"""The hand of a trocar on a page: of the browser or of the scene, its words and its curves."""

from pathlib import Path

import numpy as np
import pytest
from trocar_scenes import PORT, device, stepped, tissue
from typer.testing import CliRunner

import tissu as ts
from tissu.cli.app import app
from tissu.live_view.tools.hold_trocar import HoldTrocar, rotation_of
from tissu.live_view.tools.obstacle import quaternion
from tissu.live_view.trocars.browser_hand import DEAD, SILENT, SPEED, TURN, BrowserHand
from tissu.live_view.trocars.curve import CURVES, data_of
from tissu.live_view.trocars.frame import COLUMNS
from tissu.live_view.trocars.gamepad import reader, sticks_of
from tissu.live_view.trocars.history import WINDOW, History
from tissu.trocar import kinematics

LIMITS = ts.TrocarLimits()
ROOT = Path(__file__).resolve().parents[3]


class TestBrowserHand:
    Q = np.array([0.1, -0.2, 0.4, 0.12])

    def test_it_finds_the_joints_of_a_tip(self):
        hand = BrowserHand(LIMITS, (0, 0, 0, 0.1))
        hand.to_tip(kinematics.position(self.Q), kinematics.rotation(self.Q))
        np.testing.assert_allclose(hand.joints, self.Q, atol=1e-12)
        hand.to_tip(kinematics.position((0.3, 0.1, 0, 0.2)))
        np.testing.assert_allclose(hand.joints, (0.3, 0.1, 0.4, 0.2), atol=1e-12)

    def test_it_stays_within_the_limits(self):
        hand = BrowserHand(LIMITS, self.Q)
        hand.to((2.0, -2.0, 9.0, 1.0))
        np.testing.assert_allclose(hand.joints, (LIMITS.tilt, -LIMITS.tilt, 9.0, LIMITS.depth))
        hand.to_tip((0.0, 0.0, -0.5))
        assert hand.joints[3] == LIMITS.least_depth

    def test_sticks_are_speeds_of_the_tip(self):
        hand = BrowserHand(LIMITS, self.Q)
        hand.hear((1.0, -1.0, 0.0, 0.0), now=5.0)
        before = kinematics.position(hand.joints)
        hand.pass_time(0.1, now=5.1)
        way = kinematics.position(hand.joints) - before
        np.testing.assert_allclose(way, 0.1 * SPEED * np.array([1, -1, 0]), atol=1e-12)
        hand.hear((0.0, 0.9 * DEAD, 0.5 + DEAD / 2, -1.0), now=6.0)
        before = hand.joints
        hand.pass_time(0.1, now=6.0)
        change = (0, 0, -0.1 * TURN, 0.1 * SPEED * 0.5)
        np.testing.assert_allclose(hand.joints - before, change, atol=1e-12)

    def test_a_gamepad_that_is_silent_stands_still(self):
        hand = BrowserHand(LIMITS, self.Q)
        hand.hear((1, 1, 1, 1), now=1.0)
        hand.pass_time(0.1, now=1.0 + 1.01 * SILENT)
        assert np.array_equal(hand.joints, self.Q)

    def test_words_of_a_gamepad(self):
        np.testing.assert_allclose(sticks_of("gamepad 1: 0.5 -1 0.25 0 #7"), (0.5, 1, -0.25, 0))
        for text in ("", "gamepad 1: at rest", "gamepad 1: 1 2 3 4", "x: nan 0 0 0", "x: 0 0 0"):
            with pytest.raises(ts.ParameterError, match="four numbers from -1 to 1"):
                sticks_of(text)
        assert "pads[1]" not in reader(1) and "place = 1" in reader(1)


class TestHands:
    def test_the_browser_takes_the_tool_where_it_is_and_leads_it(self, live):
        trocars = live(device(hand=None), steps=3, hand="browser")
        one = trocars.each[0]
        tool = HoldTrocar([one.simulation], trocars)
        (gizmo,) = tool.gizmos([one.simulation])
        np.testing.assert_allclose(gizmo.place, np.subtract(PORT, (0, 0, 0.1)), atol=1e-4)
        there = np.array([0.01, -0.005, 0.11])
        turn = one.trocar.port.frame() @ kinematics.rotation((0, 0, 0.5, 0.1))
        place = np.array(PORT) + one.trocar.port.frame() @ there
        tool.turn([one.simulation], type(gizmo)("right", 0, place, quaternion(turn)))
        stepped(trocars, 60)
        # Friction of 0.3 N on a spring of 400 N/m, and 6 mN m on 0.1 m of arm: 1 mm; the touch too.
        np.testing.assert_allclose(one.controller.report().tip, place, atol=2e-3)
        assert one.controller.report().q[2] == pytest.approx(0.5, abs=0.02)
        (gizmo,) = tool.gizmos([one.simulation])
        np.testing.assert_allclose(gizmo.place, place, atol=1e-12)

    def test_a_quaternion_gives_its_rotation_back(self):
        R = kinematics.rotation((0.3, -0.5, 2.0, 0.1))
        np.testing.assert_allclose(rotation_of(quaternion(R)), R, atol=1e-12)

    def test_from_one_hand_to_the_other_the_tip_does_not_jump(self, live):
        """A quarter of the limit of 2 m/s leads the hand, whose weak damper at most doubles it."""
        trocars = live(steps=30)
        one = trocars.each[0]
        places = []

        def follow(steps):
            for _ in range(steps):
                trocars.step(one.simulation)
                places.append(kinematics.position(one.held.device.joints))

        one.hold("browser")
        follow(40)
        # It holds the tool amid a touch: a force below 1.2 N on the hand's spring of 400 N/m.
        assert np.linalg.norm(places[-1] - places[0]) < 3e-3
        one.want(3, 0.07)
        follow(60)
        assert one.controller.report().q[3] == pytest.approx(0.07, abs=1.5e-3)
        one.hold("scene")
        follow(120)
        assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() < 2 * 0.5 * 0.01
        wanted = one.held.device.hand_force
        assert one.controller.report().q[3] > 0.114 and wanted[2] > 0.2  # presses as the path asks

    def test_only_a_simulated_device_takes_another_hand(self, live):
        one = live().each[0]
        held, one.held = one.held, None
        for wish in (lambda: one.hold("browser"), lambda: one.take(None), lambda: one.want(3, 0.1)):
            with pytest.raises(ts.ParameterError, match="only a simulated one takes it"):
                wish()
        assert one.hand == "device"
        one.held = held
        with pytest.raises(ts.ParameterError, match="accepted: probe, thin, none"):
            one.take("scalpel")

    def test_a_view_refuses_hands_that_are_none(self):
        bare = tissue(trocars={}).compile()
        with pytest.raises(ts.ParameterError, match="for a scene without trocars"):
            ts.view(bare, browser=False, hand="browser")
        with pytest.raises(ts.ParameterError, match="scene and browser are accepted"):
            ts.view(bare, browser=False, hand="mine")

    def test_the_command_refuses_them_too(self):
        scene = ROOT / "examples" / "trocar.yaml"
        done = CliRunner().invoke(app, ["view", str(scene), "--no-browser", "--hand", "mine"])
        assert done.exit_code == 2 and "scene and browser are accepted" in done.output


class TestCurves:
    def test_a_history_forgets_what_is_old_and_what_is_later(self):
        history = History(1)
        for k in range(3000):
            history.add(0.01 * k, (float(k),))
        shown = history.shown()
        assert len(shown) <= 500 and shown[-1, 1] == 2999
        assert shown[0, 0] >= 29.99 - WINDOW - 0.011
        history.add(28.0, (-1.0,))  # time was set back
        shown = history.shown()
        assert shown[-1, 1] == -1.0 and (np.diff(shown[:, 0]) > 0).all()

    def test_each_is_a_column_in_its_unit(self, live):
        trocars = live(steps=45)
        history = trocars.each[0].frame(0.1).history
        assert history.shape == (45, len(COLUMNS))
        times, fast, slow = data_of(history, "force [N]")
        assert times[-1] == pytest.approx(0.45) and fast[-1] > 0.3 and slow[-1] > 0.3
        _, depth = data_of(history, "depth [mm]")
        assert depth[-1] == pytest.approx(1e3 * trocars.each[0].controller.report().q[3])
        for name in CURVES:
            assert all(len(column) == 45 for column in data_of(history, name))
