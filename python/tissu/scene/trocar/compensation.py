"""What the motors of a trocar add so that the hand does not feel it: friction, and the weight."""

from __future__ import annotations

from tissu import units
from tissu.scene.field import field
from tissu.scene.part import Part

__all__ = ["TrocarCompensation"]

MOST_FRICTION = 0.8
"""share of the friction: more may be active"""


class TrocarCompensation(Part):
    """Friction and weight that the motors carry, so that the hand does not feel them."""

    friction: units.Pure = field(default=0.0, ge=0.0, le=MOST_FRICTION)
    """share of the Coulomb friction of the device that the motors overcome, at most 80 %"""
    mass: units.Mass = field(default=0.0, ge=0.0)
    """mass of the tool whose weight the motors carry [kg]"""
    centre: units.Length = field(default=0.15)
    """distance of its center of mass above the tip [m]"""
