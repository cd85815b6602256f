"""Devices, opened: from the part of a scene to what ticks read and write."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from tissu import _haptic
from tissu.errors import ParameterError
from tissu.scene.trocar.device import (
    PluginDevice,
    SerialDevice,
    SharedMemoryDevice,
    SimulatedDevice,
    UdpDevice,
)
from tissu.scene.trocar.tool import tag_of
from tissu.trocar.kinematics import Array
from tissu.trocar.settings import port_gravity

if TYPE_CHECKING:
    from pathlib import Path

    from tissu.scene.trocar.hand import Hand
    from tissu.scene.trocar.trocar import Trocar

_GRIP = np.radians(0.05)
"""Count of the grip [rad]."""
_WAIT = 1.0
"""Longest wait for the first frame [s]."""


def open_device(trocar: Trocar, tag: int, *, trust_plugins: bool = False) -> _haptic.Device:
    """The device of a trocar.

    Args:
        trocar: the part of the scene.
        tag: of the tool that is in a simulated device at the start.
        trust_plugins: whether the file of a plug-in, which is a program, may run.

    Raises:
        TissuError: it is not there, does not answer, or has another controller.
        ParameterError: the path of a hand cannot be read.
    """
    device = trocar.device
    if isinstance(device, SimulatedDevice):
        return simulated(trocar, device, tag)
    info: dict[str, Any] = {
        "count_size": [*device.counts, _GRIP],
        "torque_limit": [*trocar.limits.torques(), 0.0],
        "rate": trocar.rate,
        "delay": device.loop_delay(),
    }
    if isinstance(device, UdpDevice):
        return _haptic.open_udp(host=device.host, port=device.port, wait=_WAIT, **info)
    if isinstance(device, SerialDevice):
        return _haptic.open_serial(path=str(device.path), baud=device.baud, wait=_WAIT, **info)
    if isinstance(device, SharedMemoryDevice):
        return _haptic.open_shared_memory(name=device.name, wait=_WAIT, **info)
    assert isinstance(device, PluginDevice)
    library = device.library.resolve()
    if not trust_plugins:
        text = f"the plug-in {library} is a program, and was not run; where you trust it, take "
        raise ParameterError(f"{text}--trust-plugins, in Python trust_plugins=True")
    return _haptic.open_plugin(library=str(library), address=device.address or "")


def simulated(
    trocar: Trocar,
    device: SimulatedDevice,
    tag: int,
    *,
    joints: Array | None = None,
    since: float = 0.0,
    hand: Hand | None = None,
) -> _haptic.SimulatedDevice:
    """A simulated device of a trocar.

    Args:
        trocar: the part of the scene.
        device: its device, whose hand holds it.
        tag: of the tool that is in.
        joints: (4,) where the tool begins; absent: at the first place of the hand's path.
        since: time of the hand's path at which it begins [s].
        hand: in place of the device's.

    Raises:
        ParameterError: the path of a hand cannot be read.
    """
    line = _haptic.Line()
    line.period = 1.0 / trocar.rate
    line.count_size = [*device.counts, _GRIP]
    line.torque_limit = [*trocar.limits.torques(), 0.0]
    line.delay, line.jitter, line.lost = device.delay, device.jitter, device.lost
    line.unknown_zero, line.seed = not device.homed, device.seed
    held = hand or device.hand
    made_hand, first = None, np.array([0.0, 0.0, 0.1])
    if held is not None:
        made_hand = hand_of(held, device.seed, since=since)
        first = made_hand.wanted(0.0)[0]
    q = _haptic.Fulcrum().joints(first) if joints is None else joints
    made = _haptic.SimulatedDevice(q, _mechanism(trocar, device), line, made_hand)
    made.set_tool(tag, True)
    if device.changes is not None:
        tags = (0 if one is None else tag_of(one) for one in device.changes.tags)
        made.plan_tools(list(zip(device.changes.times, tags, strict=True)))
    return made


def _mechanism(trocar: Trocar, device: SimulatedDevice) -> _haptic.Mechanism:
    """Masses, friction, losses and ends of a simulated device."""
    given, made = device.mechanism, _haptic.Mechanism()
    made.mass, made.centre = given.mass, given.centre
    made.across, made.axial, made.cradle = given.across, given.axial, given.cradle
    made.viscous, made.coulomb = given.damping, given.friction
    made.efficiency, made.gravity = device.efficiency, port_gravity(trocar)
    if given.roller_force is not None:
        made.roller_force = given.roller_force
    made.encoder_on_motor = given.encoder == "motor"
    made.low = (-given.tilt, -given.tilt, -1e300, 0.0)
    made.high = (given.tilt, given.tilt, 1e300, given.depth)
    return made


def hand_of(hand: Hand, seed: int, *, since: float = 0.0) -> _haptic.Hand:
    """The hand of a simulated device, with its path from a time `since` [s] on.

    Raises:
        ParameterError: the file of its path cannot be read, or is none.
    """
    rows = (
        read_path(hand.path)
        if hand.path is not None
        else np.column_stack([hand.times, np.array(hand.points)])
    )
    made = _haptic.Hand(list(rows[:, 0] - since), rows[:, 1:4], [0.0] * len(rows))
    made.smooth = hand.path is None  # a recorded path is followed as it is
    made.mass, made.stiffness, made.damping = hand.mass, hand.stiffness, hand.damping
    made.tremor, made.seed = hand.tremor, seed
    if hand.lets_go is not None:
        made.lets_go = max(0.0, hand.lets_go - since)
    made.check()
    return made


def read_path(path: Path) -> Array:
    """The rows (n, 4) of a recorded path: time [s] and place of the tip in the port's axes [m].

    Raises:
        ParameterError: it cannot be read, is not a table of four numbers, or its times do not grow.
    """
    accepted = "lines 't, x, y, z' of numbers are accepted, their times growing"
    try:
        rows = np.loadtxt(path, delimiter=",", comments="#", ndmin=2, dtype=np.float64)
    except (OSError, ValueError) as error:
        said = " ".join(str(error).split())
        raise ParameterError(f"the path {path} cannot be read ({said}); {accepted}") from None
    if rows.shape[1:] != (4,) or not np.isfinite(rows).all() or (np.diff(rows[:, 0]) <= 0).any():
        raise ParameterError(f"the path {path} has lines that do not fit; {accepted}")
    return rows
