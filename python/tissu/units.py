"""Physical quantities: a plain number is SI, a text carries its unit ("4 kPa", "1.05 g/cm^3").

Units are those of a table and a small grammar (`tissu.unit_table`); no text is evaluated. The
annotated types at the end are the field types of the scene.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Annotated

import numpy as np
from pydantic import AfterValidator, BeforeValidator

from tissu.errors import ParameterError
from tissu.reading import Number as Number
from tissu.reading import Read, VectorLike, listed, written
from tissu.unit_table import UnknownUnitError, read_unit, words_of

_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)", re.DOTALL)
_LONGEST = 200  # characters of a quantity
_APART = re.compile(r"(?<=\w) +(?=[^\W\d])")


@dataclass(frozen=True, slots=True)
class Dimension:
    """One kind of quantity; called with a number or a text, it answers the value in SI.

    Attributes:
        name: what it is called in messages ("a pressure").
        unit: SI unit that a plain number has; empty for a pure number.
        example: a text that is accepted.
        units: factor to SI of those looked up first; the others are read by the grammar.
    """

    name: str
    unit: str
    example: str
    units: dict[str, float] = field(hash=False)

    def __call__(self, value: object) -> float:
        """Value in SI.

        Raises:
            ParameterError: not a number nor a text with a unit of this dimension, or not finite.
        """
        number = self._read(value)
        if not math.isfinite(number):
            raise ParameterError(f"found {written(value)}, which is not finite; {self.accepted}")
        return number

    @property
    def accepted(self) -> str:
        """What is accepted, in words."""
        if not self.unit:
            return "a number is accepted"
        written = f"a number in {self.unit}, or text such as '{self.example}'"
        return f"{_a(self.name)} is accepted: {written}"

    def _read(self, value: object) -> float:
        if isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool):
            try:
                return float(value)
            except OverflowError:  # a whole number with hundreds of digits
                return math.inf
        if isinstance(value, str):
            return self._read_text(value)
        if hasattr(value, "dimensionality") and hasattr(value, "to"):  # a pint quantity
            return self._read_text(f"{value:~}")
        found = "nothing" if value is None else written(value)
        raise ParameterError(f"found {found}; {self.accepted}")

    def _read_text(self, text: str) -> float:
        text = text.strip()
        if text.lower().lstrip("+-.") in {"nan", "inf", "infinity"}:
            return math.nan
        match = _NUMBER.fullmatch(text) if len(text) <= _LONGEST else None
        if match is None:
            raise ParameterError(
                f"found {_quoted(text)}, which does not begin with a number; {self.accepted}"
                if len(text) <= _LONGEST
                else f"found a text of {len(text)} characters; {self.accepted}"
            )
        number, unit = float(match[1]), _normal(match[2])
        if not unit:
            return number
        factor = self.units.get(unit)
        return number * (self._factor(text, unit) if factor is None else factor)

    def _factor(self, text: str, unit: str) -> float:
        """Factor of a unit that the short table lacks, by the grammar."""
        for other in DIMENSIONS:
            if other is not self and unit in other.units:
                raise ParameterError(f"found '{text}', which is {_a(other.name)}; {self.accepted}")
        try:
            found = read_unit(unit)
        except UnknownUnitError:
            raise ParameterError(
                f"found {_quoted(text)}, whose unit {_quoted(unit)} is not known; {self.accepted}"
            ) from None
        if found.powers != self._powers:
            kinds = (other for other in DIMENSIONS if other._powers == found.powers)
            kind = next(
                (_a(other.name) for other in kinds), f"of dimension {words_of(found.powers)}"
            )
            raise ParameterError(f"found '{text}', which is {kind}; {self.accepted}")
        return float(found.factor)

    @property
    def _powers(self) -> tuple[int, int, int, int]:
        return read_unit(_normal(self.unit) or "1").powers


def _quoted(text: str) -> str:
    """A text in a message, cut when it is long."""
    return f"'{text}'" if len(text) <= 60 else f"'{text[:57]}...'"


def _normal(unit: str) -> str:
    """One spelling for each unit: no spaces, * between two units, ^ for powers."""
    unit = _APART.sub("*", unit)
    for old, new in (
        ("**", "^"),
        ("²", "^2"),
        ("³", "^3"),
        ("·", "*"),
        ("µ", "u"),
        ("μ", "u"),
        (" ", ""),
    ):
        unit = unit.replace(old, new)
    return unit


def _a(noun: str) -> str:
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


LENGTH = Dimension("length", "m", "5 mm", {"m": 1.0, "dm": 0.1, "cm": 1e-2, "mm": 1e-3, "um": 1e-6})
AREA = Dimension(
    "area", "m^2", "2 mm^2",
    {"m^2": 1.0, "m2": 1.0, "cm^2": 1e-4, "cm2": 1e-4, "mm^2": 1e-6, "mm2": 1e-6, "um^2": 1e-12},
)  # fmt: skip
AREA_MOMENT = Dimension(
    "second moment of area", "m^4", "80 mm^4",
    {"m^4": 1.0, "cm^4": 1e-8, "mm^4": 1e-12},
)  # fmt: skip
TIME = Dimension("time", "s", "10 ms", {"s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0})
MASS = Dimension("mass", "kg", "1.5 kg", {"kg": 1.0, "g": 1e-3, "mg": 1e-6})
PRESSURE = Dimension(
    "pressure", "Pa", "4 kPa",
    {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/m^2": 1.0, "N/mm^2": 1e6},
)  # fmt: skip
DENSITY = Dimension(
    "density", "kg/m^3", "1.05 g/cm^3",
    {"kg/m^3": 1.0, "kg/m3": 1.0, "g/cm^3": 1e3, "g/cm3": 1e3, "g/ml": 1e3, "kg/l": 1e3},
)  # fmt: skip
FORCE = Dimension("force", "N", "20 mN", {"N": 1.0, "mN": 1e-3, "kN": 1e3})
STIFFNESS = Dimension(
    "stiffness", "N/m", "50 N/m", {"N/m": 1.0, "N/mm": 1e3, "mN/mm": 1.0, "kN/m": 1e3}
)
STIFFNESS_PER_AREA = Dimension(
    "stiffness per area", "Pa/m", "5 kPa/mm",
    {"Pa/m": 1.0, "kPa/m": 1e3, "kPa/mm": 1e6, "MPa/m": 1e6, "N/m^3": 1.0},
)  # fmt: skip
MOMENT = Dimension("moment", "N m", "2 N mm", {"N m": 1.0, "N mm": 1e-3, "kN m": 1e3})
ACCELERATION = Dimension(
    "acceleration", "m/s^2", "-9.81 m/s^2", {"m/s^2": 1.0, "m/s2": 1.0, "mm/s^2": 1e-3}
)
ANGLE = Dimension(
    "angle",
    "rad",
    "90 deg",
    {"rad": 1.0, "deg": math.pi / 180, "degree": math.pi / 180, "°": math.pi / 180},
)
RATE = Dimension(
    "rate", "1/s", "0.1 1/s", {"1/s": 1.0, "/s": 1.0, "s^-1": 1.0, "1/ms": 1e3, "Hz": 1.0}
)
VISCOSITY = Dimension(
    "viscosity", "Pa*s", "40 Pa s",
    {"Pa*s": 1.0, "mPa*s": 1e-3, "kPa*s": 1e3},
)  # fmt: skip
DAMPING_PER_VOLUME = Dimension(
    "damping per volume", "N*s/m^4", "2e5 N s/m^4",
    {"N*s/m^4": 1.0, "kg/s/m^3": 1.0, "kg/m^3/s": 1.0},
)  # fmt: skip
VELOCITY = Dimension(
    "velocity", "m/s", "1.5 m/s",
    {"m/s": 1.0, "mm/s": 1e-3, "cm/s": 1e-2, "km/h": 1.0 / 3.6},
)  # fmt: skip
SPIN = Dimension(
    "angular velocity", "rad/s", "90 deg/s",
    {"rad/s": 1.0, "1/s": 1.0, "deg/s": math.pi / 180, "rpm": math.pi / 30},
)  # fmt: skip
NUMBER = Dimension("pure number", "", "0.45", {"%": 0.01})
TOUGHNESS = Dimension(
    "toughness", "J/m^2", "150 J/m^2", {"J/m^2": 1.0, "J/m2": 1.0, "N/m": 1.0, "kJ/m^2": 1e3}
)
DIMENSIONS = (
    *(LENGTH, AREA, TIME, MASS, PRESSURE, DENSITY, FORCE, ACCELERATION, ANGLE, RATE),
    *(VISCOSITY, DAMPING_PER_VOLUME, VELOCITY, SPIN, AREA_MOMENT, STIFFNESS_PER_AREA),
    NUMBER,
)


def dimension_of(unit: str) -> Dimension:
    """The dimension of a unit that a formula declares; "1" is a pure number."""
    if unit == "1":
        return NUMBER
    known = (dimension for dimension in DIMENSIONS if dimension.unit == _normal(unit))
    return next(known, Dimension("quantity", unit, f"1 {unit}", {_normal(unit): 1.0}))


def unit_of(metadata: Iterable[object]) -> str:
    """SI unit of a field with this metadata, as it is written: "Pa s"; empty for a pure number."""
    readers = (getattr(item, "func", None) for item in metadata)
    found = next((reader for reader in readers if isinstance(reader, Dimension)), NUMBER)
    return found.unit.replace("*", " ")


@dataclass(frozen=True, slots=True)
class Triple:
    """Reads three components of one dimension; with `open`, an absent component means unbounded."""

    dimension: Dimension
    open: bool = False

    def __call__(self, value: object) -> tuple[float | None, ...]:
        """Three values in SI.

        Raises:
            ParameterError: not three components, or one that is not of the dimension.
        """
        value = listed(value)
        if value is None and self.open:
            return (None, None, None)
        if not isinstance(value, (list, tuple)) or len(value) != 3:
            raise ParameterError(
                f"found {written(value)}; three components are accepted, for each "
                f"{self.dimension.accepted}"
            )
        return tuple(self._component(name, part) for name, part in zip("xyz", value, strict=True))

    def _component(self, name: str, value: object) -> float | None:
        if value is None and self.open:
            return None
        try:
            return self.dimension(value)
        except ParameterError as error:
            raise ParameterError(f"component {name}: {error}") from None


@dataclass(frozen=True, slots=True)
class _Within:
    """Refuses a number that is not strictly between two bounds."""

    low: float
    high: float
    hint: str

    def __call__(self, value: float) -> float:
        if not self.low < value < self.high:
            raise ParameterError(
                f"found {value:g}; a number between {self.low:g} and {self.high:g}, both excluded, "
                f"is accepted; {self.hint}"
            )
        return value


def within(low: float, high: float, *, hint: str) -> AfterValidator:
    """A number strictly between two bounds; the hint says what to take instead."""
    return AfterValidator(_Within(low, high, hint))


_Quantity = Read[float, Number]
_Three = Read[tuple[float, float, float], VectorLike]
_OpenThree = Read[
    tuple[float | None, float | None, float | None], Sequence[float | str | None] | None
]
Length = Annotated[_Quantity, BeforeValidator(LENGTH)]
Area = Annotated[_Quantity, BeforeValidator(AREA)]
AreaMoment = Annotated[_Quantity, BeforeValidator(AREA_MOMENT)]
Time = Annotated[_Quantity, BeforeValidator(TIME)]
Mass = Annotated[_Quantity, BeforeValidator(MASS)]
Pressure = Annotated[_Quantity, BeforeValidator(PRESSURE)]
Density = Annotated[_Quantity, BeforeValidator(DENSITY)]
StiffnessPerArea = Annotated[_Quantity, BeforeValidator(STIFFNESS_PER_AREA)]
Rate = Annotated[_Quantity, BeforeValidator(RATE)]
Viscosity = Annotated[_Quantity, BeforeValidator(VISCOSITY)]
DampingPerVolume = Annotated[_Quantity, BeforeValidator(DAMPING_PER_VOLUME)]
Toughness = Annotated[_Quantity, BeforeValidator(TOUGHNESS)]
ForceSize = Annotated[_Quantity, BeforeValidator(FORCE)]
Angle = Annotated[_Quantity, BeforeValidator(ANGLE)]
Pure = Annotated[_Quantity, BeforeValidator(NUMBER)]
Direction = Annotated[_Three, BeforeValidator(Triple(NUMBER))]
RotationVector = Annotated[_Three, BeforeValidator(Triple(ANGLE))]
Position = Annotated[_Three, BeforeValidator(Triple(LENGTH))]
OpenPosition = Annotated[_OpenThree, BeforeValidator(Triple(LENGTH, open=True))]
Acceleration = Annotated[_Three, BeforeValidator(Triple(ACCELERATION))]
Velocity = Annotated[_Three, BeforeValidator(Triple(VELOCITY))]
Spin = Annotated[_Three, BeforeValidator(Triple(SPIN))]
Force = Annotated[_Three, BeforeValidator(Triple(FORCE))]
Moment = Annotated[_Three, BeforeValidator(Triple(MOMENT))]
TractionVector = Annotated[_Three, BeforeValidator(Triple(PRESSURE))]
