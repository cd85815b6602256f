"""From what the joints of a trocar should feel to what its motors are told.

No torque is above a limit of its axis, nor the force at the tip above its own: one factor keeps the
direction. No axis changes by more than a share of its limit in a tick. A motor that drives the hand
loses to its transmission, one that the hand drives gains:

    motor = (tau + share f_c sigma(q.)) / eta^s,   s = +1 where it drives, -1 where it brakes

The thesis (5.8, 5.9) divides always: the hand that drives then feels tau / eta^2.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tissu.trocar import kinematics
from tissu.trocar.kinematics import AXES, Array
from tissu.trocar.velocity import WINDOW

Settings = Mapping[str, Any]
_LEAST_DEPTH = 0.02
"""m, nearer to the pivot than which a torque has no force at the tip to speak of."""


def felt(s: Settings, q: Array, before: Array, wanted: Array) -> Array:
    """Torques (4,) within all limits, from those of the tick before towards those wanted."""
    tau = saturated(s, q, wanted)
    change, most = np.abs(tau - before), s["slew"] * s["torque_limit"]
    above = change > most
    factor = np.min(most[above] / change[above], initial=1.0)
    return np.asarray(tau if factor == 1.0 else before + factor * (tau - before))


def command(s: Settings, q: Array, tau: Array, speed: Array) -> tuple[Array, Array]:
    """Torques (4,) of the motors, and what of them counts as work on the hand."""
    moving = np.clip(speed * s["period"] * (WINDOW - 1) / (2.0 * s["count_size"]), -1.0, 1.0)
    compensation = s["compensation"] * s["compensated"] * moving
    carried = tau + _weight(s, q) + compensation
    sign = np.where(carried < 0.0, -moving, moving)  # +1: the motor drives the hand
    up, down = 1.0 / s["efficiency"] - 1.0, 1.0 - s["efficiency"]
    factor = 1.0 + sign * np.where(sign >= 0.0, up, down)
    limit = s["torque_limit"]
    return np.clip(factor * carried, -limit, limit), tau + compensation


def saturated(s: Settings, q: Array, tau: Array) -> Array:
    """Tau times one factor, so that no axis and not the tip is above its limit."""
    sizes = np.append(np.abs(tau), tip_force(q, tau))
    limits = np.append(s["torque_limit"], s["force_limit"])
    above = sizes > limits
    return np.asarray(np.min(limits[above] / sizes[above], initial=1.0) * tau)


def tip_force(q: Array, tau: Array) -> float:
    """The size of the force at the tip that torques of pitch, roll and depth stand for [N]."""
    if q[3] < _LEAST_DEPTH or max(abs(q[0]), abs(q[1])) >= 0.5 * np.pi:
        return 0.0
    J = kinematics.jacobian(q, kinematics.position(q))[:, [0, 1, 3]]
    return float(np.linalg.norm(np.linalg.solve(J.T, np.asarray(tau)[[0, 1, 3]])))


def _weight(s: Settings, q: Array) -> Array:
    """What carries the tool's weight (4,)."""
    if s["tool_mass"] == 0.0:
        return np.zeros(AXES)
    centre = kinematics.position(q, (0.0, 0.0, -s["tool_centre"]))
    return -kinematics.torques(q, centre, s["tool_mass"] * np.asarray(s["gravity"]))
