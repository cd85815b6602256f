"""Damping, friction and efficiency of a device, found by driving each axis to and fro.

Of each axis in turn, with a torque tau that swings at several rates and strengths, over windows of
ticks:

    I (v_1 - v_0) + b (q_1 - q_0) + f_c sum sgn(v) T + c T = eta sum+ tau T + 1/eta sum- tau T

with sum+ over the ticks in which the motor drives (tau v > 0) and sum- over those in which it
brakes. Divided by eta, this is linear in I / eta, b / eta, f_c / eta, c / eta and 1 / eta^2, and is
solved by least squares for inertia I, viscous damping b, Coulomb friction f_c, a constant torque c
(a weight) and the efficiency eta. Only braking separates eta from the others: an axis whose inertia
is small against its damping does not brake long enough, and its eta may stay unknown. Nothing may
hold the device.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from tissu import _haptic
from tissu.errors import ParameterError, TissuError
from tissu.trocar.kinematics import AXES, NAMES, Array
from tissu.trocar.states import Flag, Status

if TYPE_CHECKING:
    from tissu.scene.trocar.trocar import Trocar

SHARES = (0.02, 0.02, 0.2, 0.4)
"""Of the torque limit of each axis: how strong it is driven."""
_RATE = 2.0
"""Least number of swings a second [Hz]."""
_RATES = (1.0, 1.0, 5.0, 1.0)
"""times that for each axis: the own rotation has little inertia, which shows in fast swings alone
"""
_PARTS = ((1.0, 1.0), (1.0, 0.6), (2.0, 1.0), (2.0, 0.6))
"""Rate and strength of the parts of a drive, of the largest."""
_SECONDS = 1.5
"""For each part."""
_LAGS = np.arange(0.0, 6.1e-3, 2.5e-4)
"""s from a command to its torque that are tried"""
_LEAST_BRAKING = 1e-3
"""of the torque that drives: below it, the efficiency is not known"""
_DOUBT = 0.06
"""Standard error of the efficiency, of noise alone, from which it counts as not known."""
_LARGEST_ERROR = 0.1
"""The same with the spread between slow and fast swings."""
_LARGE = 0.25
"""Spread of a value, as a share of it, from which it counts as not found."""


@dataclass(frozen=True, slots=True)
class Axis:
    """What was found of an axis.

    Attributes:
        name: pitch, roll, rotation or depth.
        inertia: [kg m^2 or kg].
        damping: viscous [N m s/rad or N s/m].
        friction: Coulomb's [N m or N].
        efficiency: of the transmission; None: the drive does not show it, and inertia, damping and
            friction are those that the motor feels, which are divided by it.
        error: of the efficiency: noise, and how far slow and fast swings differ; infinite: not
            known.
        rest: what the equation leaves, of the torque that drives (root of mean squares) [1].
        spread: how far inertia, damping and friction of slow and fast swings differ.
    """

    name: str
    inertia: float
    damping: float
    friction: float
    efficiency: float | None
    error: float
    rest: float
    spread: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def found(self) -> tuple[bool, bool, bool]:
        """Whether inertia, damping and friction are above 0 and known within a share of them."""
        values = (self.inertia, self.damping, self.friction)
        rows = zip(values, self.spread, strict=True)
        inertia, damping, friction = (
            value > 0.0 and spread <= _LARGE * value for value, spread in rows
        )
        return inertia, damping, friction


def identify(trocar: Trocar, device: _haptic.Device, *, realtime: bool) -> list[Axis]:
    """Drive each axis, and find its friction.

    Args:
        trocar: the part of the scene.
        device: open, homed, and held by nothing.
        realtime: whether to wait for the device's samples; a simulated one gives one when asked.

    Raises:
        ParameterError: gravity pulls at the tool.
        TissuError: the device gives no samples, is not homed, or an axis comes near its end.
    """
    if any(trocar.gravity or ()):
        text = "found `gravity` of the trocar; identification accepts a balanced tool: leave "
        raise ParameterError(f"{text}`gravity` out for it")
    found = []
    for axis in range(AXES):
        limit = trocar.limits.torques()[axis]
        times, q, tau = _swing(trocar, device, axis, SHARES[axis] * limit, realtime)
        rate = _RATE * _RATES[axis] * max(part[0] for part in _PARTS)
        found.append(compared(NAMES[axis], times, q, tau, rate=rate))
    _haptic.write(device, [0.0] * 5, enable=False)
    return found


def _swing(
    trocar: Trocar, device: _haptic.Device, axis: int, strength: float, realtime: bool
) -> tuple[Array, Array, Array]:
    """Times, positions and torques of an axis that is driven to and fro."""
    rows = []
    begun, now = None, 0.0
    while now < _SECONDS * len(_PARTS):
        sample = _next(device, realtime)
        begun = sample["time_ns"] if begun is None else begun
        now = 1e-9 * (sample["time_ns"] - begun)
        q = sample["counts"][axis] * trocar.device.counts[axis]
        _refuse_ends(trocar, axis, q, device)
        torque = [0.0] * 5
        part = min(int(now / _SECONDS), len(_PARTS) - 1)
        rate, share = _PARTS[part]
        phase = 2.0 * np.pi * _RATE * _RATES[axis] * rate * (now - part * _SECONDS)
        torque[axis] = share * strength * float(np.cos(phase))
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


def compared(name: str, times: Array, q: Array, tau: Array, *, rate: float) -> Axis:
    """What the slow swings show, with how far the fast ones differ from it as its spread.

    Near where an axis turns round, the sense of its motion is least certain, and fast swings spend
    more of their braking there. A torque acts from its sample to the next one, and a while later:
    the time that leaves least.

    Args:
        name: of the axis.
        times: of the samples [s].
        q: positions [rad or m].
        tau: torques of the motor [N m or N].
        rate: largest number of swings a second [Hz].
    """
    lag = _best_lag(name, times, q, tau, rate)
    early = times < 2.0 * _SECONDS
    slow = _fitted(name, times[early], q[early], tau[early], rate, lag)
    fast = _fitted(name, times[~early], q[~early], tau[~early], rate, lag)
    if slow.efficiency is None or fast.efficiency is None:
        slow, fast = _of_the_motor(slow), _of_the_motor(fast)
    else:
        error = float(np.hypot(slow.error, slow.efficiency - fast.efficiency))
        known = error <= _LARGEST_ERROR
        slow = replace(slow, error=error) if known else _of_the_motor(slow)
        fast = fast if known else _of_the_motor(fast)
    inertia, damping = abs(slow.inertia - fast.inertia), abs(slow.damping - fast.damping)
    return replace(slow, spread=(inertia, damping, abs(slow.friction - fast.friction)))


def _of_the_motor(axis: Axis) -> Axis:
    """As the motor feels it: the efficiency is not known."""
    eta = axis.efficiency or 1.0
    return replace(
        axis,
        inertia=axis.inertia / eta,
        damping=axis.damping / eta,
        friction=axis.friction / eta,
        efficiency=None,
        error=float("inf"),
    )


def _best_lag(name: str, times: Array, q: Array, tau: Array, rate: float) -> float:
    """The time from a command to its torque that leaves least [s]."""
    return float(min(_LAGS, key=lambda lag: _fitted(name, times, q, tau, rate, lag).rest))


def _fitted(name: str, times: Array, q: Array, tau: Array, rate: float, lag: float) -> Axis:
    """The same for torques that arrive so much later [s]."""
    tick = float(np.median(np.diff(times)))
    half = max(2, round(0.04 / (rate * tick)))
    window = max(4, round(0.1 / (rate * tick)))
    inner = slice(half, -half)
    speed = (q[2 * half :] - q[: -2 * half]) / (times[2 * half :] - times[: -2 * half])
    before, times, q = times, times[inner], q[inner]
    tau = np.interp(times - lag, before, tau)
    step = np.diff(times, append=times[-1])

    def sums(rate: Array) -> Array:
        """A rate (n,), summed over the time up to each sample."""
        return np.concatenate([[0.0], np.cumsum(rate * step)[:-1]])

    def over(values: Array) -> Array:
        """How far values (n,) go in each window."""
        return np.asarray(values[window:] - values[:-window])

    drives = tau * speed > 0.0
    columns = [over(speed), over(q), over(sums(np.sign(speed))), over(times)]
    wanted, braked = over(sums(np.where(drives, tau, 0.0))), over(sums(np.where(drives, 0.0, tau)))
    # Near where it turns round, friction is neither of both.
    slow = np.abs(speed) < 0.1 * np.abs(speed).max(initial=0.0)
    moving = over(sums(slow.astype(float))) == 0.0
    A = np.column_stack([*columns, -braked])[moving]
    x, rest, spread = _least_squares(A, wanted[moving])
    size = max(float(np.sqrt(np.mean((wanted + braked)[moving] ** 2))), 1e-300)
    # Windows overlap: so many of them tell as much as one.
    loss, doubt = float(x[4]), float(spread[4]) * np.sqrt(window)
    eta = float(min(1.0, max(loss, 1.0) ** -0.5))
    error = float(0.5 * eta**3 * doubt)
    brakes = np.linalg.norm(braked[moving]) > _LEAST_BRAKING * np.linalg.norm(wanted[moving])
    known = bool(brakes) and error <= _DOUBT
    if not known:
        x, rest, _ = _least_squares(np.column_stack(columns)[moving], (wanted + braked)[moving])
    scale = eta if known else 1.0
    inertia, damping, friction = (scale * float(value) for value in x[:3])
    left = float(np.sqrt(np.mean(rest**2))) / size
    error = error if known else float("inf")
    return Axis(name, inertia, damping, friction, eta if known else None, error, left)


def _least_squares(A: Array, b: Array) -> tuple[Array, Array, Array]:
    """The x of least |A x - b|, what it leaves, and the standard error of each number."""
    size = np.maximum(np.linalg.norm(A, axis=0), 1e-300)
    U, s, V = np.linalg.svd(A / size, full_matrices=False)
    inverse = np.where(s > 1e-12 * s[0], 1.0 / np.maximum(s, 1e-300), 0.0)
    x = (V.T * inverse) @ (U.T @ b) / size
    rest = A @ x - b
    noise = float(rest @ rest) / max(1, len(b) - len(s))
    return x, rest, np.sqrt(noise * ((V.T * inverse) ** 2).sum(axis=1)) / size
