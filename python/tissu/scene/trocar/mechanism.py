"""The mechanism of a simulated device: its masses, friction, ends and rollers."""

from __future__ import annotations

import math
from typing import Literal

from tissu import units
from tissu.reading import Maybe
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.trocar.axes import Cradle, OneForce, OneInertia, OwnDamping, OwnFriction

__all__ = ["TrocarMechanism"]


class TrocarMechanism(Part):
    """Masses, friction and ends of a simulated device, to be replaced by those of a real one."""

    mass: units.Mass = field(default=0.12, gt=0.0)
    """mass of the tool [kg]"""
    centre: units.Length = field(default=0.15)
    """distance of its center of mass above the tip [m]"""
    across: OneInertia = field(default=1.5e-3, gt=0.0)
    """inertia of the tool about an axis across it, through its center of mass [kg m^2]"""
    axial: OneInertia = field(default=2e-6, ge=0.0)
    """inertia of the tool about its own axis [kg m^2]"""
    cradle: Cradle = field(default=(2e-3, 2e-3, 5e-6, 0.05))
    """what else moves with pitch, roll, rotation [kg m^2] and depth [kg], rotors included"""
    damping: OwnDamping = field(default=(0.03, 0.03, 1e-3, 1.0))
    """viscous damping of pitch, roll, rotation [N m s/rad] and depth [N s/m]"""
    friction: OwnFriction = field(default=(6e-3, 6e-3, 1e-3, 0.3))
    """Coulomb friction of pitch, roll, rotation [N m] and depth [N]"""
    roller_force: Maybe[OneForce] = field(default=None, gt=0.0)
    """largest force that the rollers of the depth transmit [N]; beyond it they slip; absent: any"""
    encoder: Literal["tool", "motor"] = "tool"
    """what the encoder of the depth measures: the tool, or the motor, which does not see slip"""
    tilt: units.Angle = field(default=math.radians(50.0), gt=0.0, le=math.radians(80.0))
    """mechanical ends of pitch and roll [rad]"""
    depth: units.Length = field(default=0.31, gt=0.0)
    """mechanical end of the depth [m]"""
