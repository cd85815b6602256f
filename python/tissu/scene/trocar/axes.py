"""Numbers of the four axes of a trocar: pitch, roll, own rotation, depth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from pydantic import BeforeValidator

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Number, Read, listed, written

AXIS_NAMES = ("pitch", "roll", "rotation", "depth")


def _per_turn(name: str, unit: str, example: str) -> units.Dimension:
    """A quantity of an axis that turns; the radian may be left out."""
    short = unit.replace("/rad", "").replace("*rad", "")
    return units.Dimension(name, unit, example, {unit: 1.0, short: 1.0})


TURN_DAMPING = _per_turn("damping of a turn", "N*m*s/rad", "0.03 N m s/rad")
TURN_STIFFNESS = _per_turn("stiffness of a turn", "N*m/rad", "48 N m/rad")
INERTIA = units.Dimension("inertia", "kg*m^2", "2e-3 kg m^2", {"kg*m^2": 1.0, "g*m^2": 1e-3})
DAMPING = units.Dimension("damping", "N*s/m", "1 N s/m", {"N*s/m": 1.0, "kg/s": 1.0})


@dataclass(frozen=True, slots=True)
class PerAxis:
    """Reads four numbers: of the axes that turn in one dimension, of the depth in another."""

    turn: units.Dimension
    slide: units.Dimension
    least: float = 0.0
    """each is at least this"""
    above: bool = False
    """or above it"""
    most: float = math.inf
    """and at most this"""
    absent: bool = False
    """whether none at all is accepted too"""

    def __call__(self, value: object) -> tuple[float, ...] | None:
        """Four values in SI.

        Raises:
            ParameterError: not four numbers, one of another dimension, or one that is too small.
        """
        value = listed(value)
        if value is None and self.absent:
            return None
        if not isinstance(value, (list, tuple)) or len(value) != 4:
            text = "four numbers are accepted, of pitch, roll, rotation and depth"
            raise ParameterError(f"found {written(value)}; {text}: {self._example()}")
        kinds = (self.turn, self.turn, self.turn, self.slide)
        return tuple(self._one(*each) for each in zip(AXIS_NAMES, kinds, value, strict=True))

    def _one(self, name: str, kind: units.Dimension, value: object) -> float:
        try:
            number = kind(value)
        except ParameterError as error:
            raise ParameterError(f"{name}: {error}") from None
        if number < self.least or (self.above and number == self.least):
            bound = "above" if self.above else "of at least"
            text = f"found {number:g} {kind.unit.replace('*', ' ')}".rstrip()
            raise ParameterError(f"{name}: {text}; one {bound} {self.least:g} is accepted")
        if number > self.most:
            text = f"found {number:g} {kind.unit.replace('*', ' ')}".rstrip()
            raise ParameterError(f"{name}: {text}; one of at most {self.most:g} is accepted")
        return number

    def _example(self) -> str:
        return "[" + ", ".join([*3 * [self.turn.example], self.slide.example]) + "]"


_Four = Read[tuple[float, float, float, float], Sequence[Number]]
Counts = Annotated[_Four, BeforeValidator(PerAxis(units.ANGLE, units.LENGTH, above=True))]
_MaybeFour = Read[tuple[float, float, float, float] | None, Sequence[Number] | None]
MaybeDamping = Annotated[_MaybeFour, BeforeValidator(PerAxis(TURN_DAMPING, DAMPING, absent=True))]
MaybeFriction = Annotated[
    _MaybeFour, BeforeValidator(PerAxis(units.MOMENT, units.FORCE, absent=True))
]
Damping = Annotated[_Four, BeforeValidator(PerAxis(TURN_DAMPING, DAMPING))]
OwnDamping = Annotated[_Four, BeforeValidator(PerAxis(TURN_DAMPING, DAMPING, above=True))]
OwnFriction = Annotated[_Four, BeforeValidator(PerAxis(units.MOMENT, units.FORCE, above=True))]
Cradle = Annotated[_Four, BeforeValidator(PerAxis(INERTIA, units.MASS))]
Efficiency = Annotated[
    _Four, BeforeValidator(PerAxis(units.NUMBER, units.NUMBER, least=1e-2, most=1.0))
]
Stiffness = Annotated[_Four, BeforeValidator(PerAxis(TURN_STIFFNESS, units.STIFFNESS, above=True))]
OneForce = Annotated[Read[float, Number], BeforeValidator(units.FORCE)]
OneMoment = Annotated[Read[float, Number], BeforeValidator(units.MOMENT)]
OneSpeed = Annotated[Read[float, Number], BeforeValidator(units.VELOCITY)]
OneInertia = Annotated[Read[float, Number], BeforeValidator(INERTIA)]
OneStiffness = Annotated[Read[float, Number], BeforeValidator(units.STIFFNESS)]
OneDamping = Annotated[Read[float, Number], BeforeValidator(DAMPING)]
