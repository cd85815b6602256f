"""What a trocar may do to the hand that holds it, and how far it goes."""

from __future__ import annotations

import math
from collections.abc import Iterator

from tissu import units
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.trocar.axes import OneForce, OneMoment, OneSpeed
from tissu.scene.unknown import rule

__all__ = ["TrocarLimits"]

_STEEPEST = math.radians(75.0)


class TrocarLimits(Part):
    """Limits of torques and speeds, and the places of the end stops."""

    force: OneForce = field(default=5.0, gt=0.0)
    """largest force along the tool [N]"""
    torque: OneMoment = field(default=6.0, gt=0.0)
    """largest torque about pitch and roll [N m]"""
    rotation: OneMoment = field(default=0.2, gt=0.0)
    """largest torque about the tool's own axis [N m]"""
    speed: OneSpeed = field(default=2.0, gt=0.0)
    """largest speed of the tip [m/s]: beyond it, the trocar gives no force until it is enabled
    again"""
    tilt: units.Angle = field(default=math.radians(45.0), gt=0.0, le=_STEEPEST)
    """largest pitch and roll [rad], up to 75 degrees; the place of the end stops"""
    least_depth: units.Length = field(default=0.02, gt=0.0)
    """smallest depth at which there is a force [m]"""
    depth: units.Length = field(default=0.3, gt=0.0)
    """largest depth [m]; the place of an end stop"""

    @rule("least_depth", "depth")
    def _has_a_way(self) -> Iterator[Problem]:
        if not self.least_depth < self.depth:
            text = f"found {self.depth:g} m, and a least depth of {self.least_depth:g} m; a depth "
            yield Problem(("depth",), f"{text}above the least one is accepted")

    def torques(self) -> tuple[float, float, float, float]:
        """Of pitch, roll, rotation [N m] and depth [N]."""
        return (self.torque, self.torque, self.rotation, self.force)
