"""What the ticks of a trocar are set to: from the parts of a scene to the numbers of a tick."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from tissu import _haptic
from tissu.scene.trocar.device import SimulatedDevice
from tissu.scene.trocar.trocar import Coupling

if TYPE_CHECKING:
    from tissu.scene.trocar.trocar import Trocar
    from tissu.trocar.kinematics import Array

ANY_TOOL: int = _haptic.ANY_TOOL
"""Tag of the settings with which every tool is taken."""
FIELDS = tuple(
    name for name, value in vars(_haptic.Settings).items() if isinstance(value, property)
)
_HOMING = (0.2, 0.2, 0.0, 2.0)
"""Torques that drive a simulated device to its end stops [N m, N m, N m, N]."""
_ENOUGH = 1.0 + 1e-9


def settings_of(trocar: Trocar) -> _haptic.Settings:
    """Gains, limits and device of a trocar; off, and without a tool."""
    made = _haptic.Settings()
    made.period = 1.0 / trocar.rate
    made.count_size = trocar.device.counts
    made.stiffness = trocar.stiffness()
    if isinstance(trocar.coupling, Coupling):
        made.damping = trocar.coupling.damping
    _give_friction(made, trocar)
    limits = trocar.limits
    made.torque_limit = limits.torques()
    made.force_limit, made.speed_limit = limits.force, limits.speed
    made.joint_low = (-limits.tilt, -limits.tilt, -1e300, limits.least_depth)
    made.joint_high = (limits.tilt, limits.tilt, 1e300, limits.depth)
    made.tag = 0 if trocar.tools else ANY_TOOL
    if isinstance(trocar.device, SimulatedDevice):  # which may lose its zero, too
        ends = trocar.device.mechanism
        made.homing_torque = _HOMING
        made.end_low = (-ends.tilt, -ends.tilt, -1e300, 0.0)
        made.end_high = (ends.tilt, ends.tilt, 1e300, ends.depth)
    _give_compensation(made, trocar)
    return made


def port_gravity(trocar: Trocar) -> Array:
    """Gravity in the port's axes (3,) [m/s^2]; zero where the device is balanced."""
    return np.asarray(trocar.port.frame().T @ np.array(trocar.gravity or (0.0, 0.0, 0.0)))


def _give_compensation(made: _haptic.Settings, trocar: Trocar) -> None:
    """Efficiency of the motors, and the friction and weight that they carry."""
    given, known = trocar.compensation, trocar.device.dissipation()
    made.efficiency = trocar.device.efficiency
    made.compensation = given.friction
    if known is not None:
        made.compensated = known[1]
    made.tool_mass, made.tool_centre = given.mass, given.centre
    made.gravity = port_gravity(trocar)


def _give_friction(made: _haptic.Settings, trocar: Trocar) -> None:
    """What the device dissipates; where it is not known, nothing is credited to the tank.

    Friction then stands for the least that makes the given stiffness passive: that is the word of
    the scene.
    """
    known = trocar.device.dissipation()
    if known is not None:
        made.viscous, made.coulomb = known
        return
    stiffness = np.array(trocar.stiffness())
    made.viscous = stiffness * (0.5 * made.period + trocar.device.loop_delay()) * _ENOUGH
    made.coulomb = 0.5 * stiffness * made.count_size * _ENOUGH
    made.tank_credit = 0.0


def fields_of(settings: _haptic.Settings) -> dict[str, Any]:
    """All numbers of settings by their names, as the law takes them."""
    return {name: getattr(settings, name) for name in FIELDS}


def settings_from(fields: dict[str, Any]) -> _haptic.Settings:
    """Settings with these numbers."""
    made = _haptic.Settings()
    for name, value in fields.items():
        setattr(made, name, value)
    return made
