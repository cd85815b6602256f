"""Tears: material that opens where it is pulled too much."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from tissu import units
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.part import Part

__all__ = ["Tear"]


class Tear(Part):
    """A body tears where the local mean of its largest principal stress exceeds its strength."""

    body: str = field(kw_only=False)
    """name of a body of the scene"""
    strength: units.Pressure = field(gt=0.0)
    """largest principal Cauchy stress that it withstands [Pa]"""
    length: units.Length = field(gt=0.0)
    """the stress is a mean over the cells within this distance [m], and a tear opens 1.5 times as
    far; take it longer than the edge of a cell, and the same for every mesh"""
    per_step: Annotated[int, Field(ge=1, le=1000)] = 8
    """largest number of places that tear at the end of one step; the most overstressed first"""

    def effect(self, path: str) -> Effect:
        """The effect that it switches on."""
        mean = f"{self.strength:g} Pa, averaged over {self.length:g} m"
        why = f"{path} opens {self.body} above {mean}"
        return Effect(f"tear of {self.body}", why)
