"""A device over UDP in a second process that goes wrong in every way, and what becomes of it.

Both sides are stepped in turn: the device carries out a command, then the controller takes a tick.
So no test depends on the speed of the machine.
"""

import subprocess
import sys
from pathlib import Path

import faulty_device
import numpy as np
import pytest

import tissu as ts
from tissu.trocar.controller import Controller
from tissu.trocar.model import LocalModel
from tissu.trocar.states import Reason, State

COUPLING = ts.Coupling((10.0, 10.0, 0.2, 500.0))
FORCE = 400 * 500 / 900 * 0.002
"""N, of a wall at 110 mm of 400 N/m behind a coupling of 500 N/m, 2 mm deep."""


class Player:
    """The second process, with its pipes."""

    def __init__(self, port=0):
        script = Path(faulty_device.__file__)
        self.process = subprocess.Popen(
            [sys.executable, str(script), str(port)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.port = int(self.process.stdout.readline())

    def does(self, what):
        """Send a command; return the latest order: enable, largest torque, answers."""
        self.process.stdin.write(f"{what}\n")
        self.process.stdin.flush()
        enable, torque, answers = self.process.stdout.readline().split()
        return int(enable), float(torque), int(answers)

    def close(self):
        """It ends, or has ended."""
        self.process.kill()
        self.process.communicate()


@pytest.fixture
def player():
    made = [Player()]
    yield made
    for one in made:
        one.close()


def controller_of(player):
    """A trocar over the player's line, at the origin, with its axis down."""
    udp = ts.UdpDevice("127.0.0.1", player.port, delay=0.0)
    port = ts.Port((0, 0, 0), (0, 0, -1))
    return Controller(ts.Trocar(port=port, device=udp, coupling=COUPLING))


def ticks(controller, player, what, count=1):
    """So many ticks, before each of which the device does something; the last report, and told."""
    for _ in range(count):
        told = player.does(what)
        report = controller.step(1)
        if report.state.gives_force and report.tick % 20 == 0:
            controller.publish(
                LocalModel.plane(report.q, through=(0, 0, 0.11), normal=(0, 0, -1), stiffness=400.0)
            )
    return report, told


def pressed(player):
    """A controller that has felt the wall for 0.5 s."""
    controller = controller_of(player)
    controller.start()
    report, told = ticks(controller, player, "good", 500)
    assert report.state is State.contact
    assert report.force[2] == pytest.approx(FORCE, rel=1e-3)
    assert told[0] == 1
    assert told[1] == pytest.approx(FORCE, rel=1e-3)
    return controller


def is_off(controller, player, reason):
    """No torque, and the device was told so; the report says why, and what to do."""
    report, _ = ticks(controller, player, "nothing")
    assert (report.state, report.reason) == (State.fault, reason)
    assert "stop the trocar and start it again" in report.problem
    assert not report.torque.any()
    enable, torque, answers = player.does("nothing")
    assert (enable, torque) == (0, 0.0)
    assert answers > 0


def is_cured(controller, player):
    """Good frames alone cure nothing; stop and start do, and the force comes back by a ramp."""
    report, _ = ticks(controller, player, "good", 50)
    assert report.state is State.fault
    controller.stop()
    assert player.does("good")[:2] == (0, 0.0)
    controller.start()
    forces = []
    for _ in range(500):
        report, _ = ticks(controller, player, "good")
        forces.append(np.linalg.norm(report.force))
    assert report.state is State.contact
    assert report.force[2] == pytest.approx(FORCE, rel=1e-3)
    assert max(np.diff(forces)) < 0.1 * FORCE
    controller.stop()


@pytest.mark.parametrize("what", ["nothing", "twice", "version", "short"])
def test_frames_that_stop_or_are_none_end_in_a_fault(player, what):
    """Four ticks without a frame keep the torque; at the fifth the motors are off."""
    (device,) = player
    controller = pressed(device)
    for _ in range(4):
        report, told = ticks(controller, device, what)
        assert report.state is State.contact
        assert report.torque[3] == pytest.approx(-FORCE, rel=1e-3)
        assert told[0] == 1
    report, _ = ticks(controller, device, what)
    assert report.state is State.fault
    is_off(controller, device, Reason.reads_failed)
    is_cured(controller, device)


@pytest.mark.parametrize("what", ["late", "twice"])
def test_frames_out_of_order_or_twice_among_good_ones_change_nothing(player, what):
    """What was sent before, or comes again, says 5 cm more: nothing jumps."""
    (device,) = player
    controller = pressed(device)
    for _ in range(50):
        report, _ = ticks(controller, device, what)
        assert report.q[3] == pytest.approx(0.112, abs=1e-12)
        assert report.force[2] == pytest.approx(FORCE, rel=1e-3)
        ticks(controller, device, "good")
    assert report.state is State.contact
    controller.stop()


def test_counts_with_the_bits_of_nan_are_a_jump_that_is_held(player):
    """A frame has no floating point: the counts are 2,143,289,344, faster than 2 m/s."""
    (device,) = player
    controller = pressed(device)
    report, _ = ticks(controller, device, "nan")
    assert (report.state, report.reason) == (State.held, Reason.too_fast)
    assert np.isfinite(report.q).all()
    assert np.isfinite(report.torque).all()
    report, told = ticks(controller, device, "good", 20)
    assert report.state is State.held
    assert told[1] == 0.0  # the slew takes the torque back in five ticks
    assert "acknowledge it" in report.problem
    controller.acknowledge()
    report, _ = ticks(controller, device, "good", 400)
    assert report.state is State.contact
    assert report.force[2] == pytest.approx(FORCE, rel=1e-3)
    controller.stop()


def test_a_fault_that_the_device_reports(player):
    (device,) = player
    controller = pressed(device)
    report, _ = ticks(controller, device, "fault")
    assert report.state is State.fault
    is_off(controller, device, Reason.device_fault)
    is_cured(controller, device)


def test_a_device_whose_process_is_killed_and_comes_back(player):
    """Its port refuses: a fault in the next tick. It counts its frames from 1 again."""
    (device,) = player
    controller = pressed(device)
    device.close()
    controller.step(1)  # its answer finds no one
    report = controller.step(1)
    assert (report.state, report.reason) == (State.fault, Reason.reads_failed)
    assert not report.torque.any()
    controller.step(200)  # nothing is thrown in the loop
    assert controller.report().state is State.fault
    again = Player(device.port)
    player.append(again)
    controller.step(1)  # an answer, by which the device learns who it is
    is_off(controller, again, Reason.reads_failed)
    is_cured(controller, again)


def test_a_trocar_is_stopped_while_its_device_is_gone(player):
    """Stop throws nothing, and a new controller finds no device."""
    (device,) = player
    controller = pressed(device)
    device.close()
    controller.step(10)
    controller.stop()
    assert controller.report().state is State.off
    del controller
    with pytest.raises(ts.TissuError, match=r"no device answers at 127\.0\.0\.1"):
        controller_of(device)
