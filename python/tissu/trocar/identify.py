"""Damping and friction of a device, found by driving each axis to and fro.

Of each axis in turn, with a torque tau that swings, over windows of ticks:

    I (v_1 - v_0) + b (q_1 - q_0) + f_c sum sgn(v) T + c T = sum tau T

is solved for inertia I, viscous damping b, Coulomb friction f_c and a constant torque c (a weight)
by least squares. Nothing may hold the device.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from tissu import _haptic
from tissu.errors import TissuError
from tissu.trocar.kinematics import AXES, NAMES, Array
from tissu.trocar.states import Flag, Status

if TYPE_CHECKING:
    from tissu.scene.trocar.trocar import Trocar

SHARES = (0.01, 0.01, 0.05, 0.4)
"""Of the torque limit of each axis: how strong it is driven."""
_RATE = 2.0
"""Swings a second [Hz]."""
_SECONDS = 3.0
"""For each axis."""
_HALF = 10
"""Ticks on either side of which a speed is the mean."""
_WINDOW = 25
"""Ticks of an equation."""


@dataclass(frozen=True, slots=True)
class Axis:
    """What was found of an axis.

    Attributes:
        name: pitch, roll, rotation or depth.
        inertia: [kg m^2 or kg].
        damping: viscous [N m s/rad or N s/m].
        friction: Coulomb's [N m or N].
        rest: what the equation leaves, of the torque that drives (root of mean squares) [1].
    """

    name: str
    inertia: float
    damping: float
    friction: float
    rest: float


def identify(trocar: Trocar, device: _haptic.Device, *, realtime: bool) -> list[Axis]:
    """Drive each axis, and find its friction.

    Args:
        trocar: the part of the scene.
        device: open, homed, and held by nothing.
        realtime: whether to wait for the device's samples; a simulated one gives one when asked.

    Raises:
        TissuError: the device gives no samples, is not homed, or an axis comes near its end.
    """
    found = []
    for axis in range(AXES):
        limit = trocar.limits.torques()[axis]
        times, q, tau = _swing(trocar, device, axis, SHARES[axis] * limit, realtime)
        found.append(fitted(NAMES[axis], times, q, tau))
    _haptic.write(device, [0.0] * 5, enable=False)
    return found


def _swing(
    trocar: Trocar, device: _haptic.Device, axis: int, strength: float, realtime: bool
) -> tuple[Array, Array, Array]:
    """Times, positions and torques of an axis that is driven to and fro."""
    rows = []
    begun, now = None, 0.0
    while now < _SECONDS:
        sample = _next(device, realtime)
        begun = sample["time_ns"] if begun is None else begun
        now = 1e-9 * (sample["time_ns"] - begun)
        q = sample["counts"][axis] * trocar.device.counts[axis]
        _refuse_ends(trocar, axis, q, device)
        torque = [0.0] * 5
        torque[axis] = strength * float(np.cos(2.0 * np.pi * _RATE * now))
        _haptic.write(device, torque, sequence=sample["sequence"])
        rows.append((now, q, torque[axis]))
    times, places, torques = np.transpose(rows)
    return times, places, torques


def _next(device: _haptic.Device, realtime: bool) -> dict[str, Any]:
    """The next sample; lost ones are passed over."""
    for _ in range(1000):
        status, sample = _haptic.read(device)
        if status == Status.ok:
            if not sample["flags"] & Flag.homed:
                raise TissuError("the device does not know its zero; home it first")
            return sample
        if status == Status.gone:
            break
        if realtime:
            time.sleep(0.5e-3)
    raise TissuError("the device gives no samples; check it, and begin again")


def _refuse_ends(trocar: Trocar, axis: int, q: float, device: _haptic.Device) -> None:
    limits = trocar.limits
    near = axis < 2 and abs(q) > 0.9 * limits.tilt
    near = near or (axis == 3 and not limits.least_depth < q < 0.95 * limits.depth)
    if near:
        _haptic.write(device, [0.0] * 5, enable=False)
        text = f"the {NAMES[axis]} came near its end, at {q:.4g}; put the tool in the middle of its"
        raise TissuError(f"{text} way, and begin again")


def fitted(name: str, times: Array, q: Array, tau: Array) -> Axis:
    """The axis whose motion q (n,) under torques tau (n,) was seen at times (n,) [s].

    A torque acts from its sample to the next one.
    """
    inner = slice(_HALF, -_HALF)
    speed = (q[2 * _HALF :] - q[: -2 * _HALF]) / (times[2 * _HALF :] - times[: -2 * _HALF])
    times, q, tau = times[inner], q[inner], tau[inner]
    step = np.diff(times, append=times[-1])

    def sums(rate: Array) -> Array:
        """A rate (n,), summed over the time up to each sample."""
        return np.concatenate([[0.0], np.cumsum(rate * step)[:-1]])

    def over(values: Array) -> Array:
        """How far values (n,) go in each window."""
        return np.asarray(values[_WINDOW:] - values[:-_WINDOW])

    columns = [over(speed), over(q), over(sums(np.sign(speed))), over(times)]
    wanted = over(sums(tau))
    # Near where it turns round, friction is neither of both.
    slow = np.abs(speed) < 0.1 * np.abs(speed).max(initial=0.0)
    moving = over(sums(slow.astype(float))) == 0.0
    A = np.column_stack(columns)[moving]
    (inertia, damping, friction, _), *_ = np.linalg.lstsq(A, wanted[moving], rcond=None)
    rest = A @ np.linalg.lstsq(A, wanted[moving], rcond=None)[0] - wanted[moving]
    size = max(float(np.sqrt(np.mean(wanted[moving] ** 2))), 1e-300)
    left = float(np.sqrt(np.mean(rest**2))) / size
    return Axis(name, float(inertia), float(damping), float(friction), left)
