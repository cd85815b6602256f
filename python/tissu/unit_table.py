"""Units that texts may have: a table, a grammar, and exact factors. Nothing is evaluated.

    unit   = factor { ("*" | "/") factor }
    factor = ( name | "1" | "(" unit ")" ) [ "^" whole number | whole number ]

A name is one of the table, or one that takes SI prefixes with one in front: "kPa", "micrometer".
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

_LONGEST = 64  # characters of a unit
_LARGEST = 12  # exponent

Powers = tuple[int, int, int, int]
"""Exponents of metre, kilogram, second and radian."""


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: its factor to SI and the exponents of the base units."""

    factor: Fraction
    powers: Powers

    def __mul__(self, other: Unit) -> Unit:
        m, kg, s, rad = (a + b for a, b in zip(self.powers, other.powers, strict=True))
        return Unit(self.factor * other.factor, (m, kg, s, rad))

    def __pow__(self, exponent: int) -> Unit:
        m, kg, s, rad = (exponent * a for a in self.powers)
        return Unit(self.factor**exponent, (m, kg, s, rad))


class UnknownUnitError(ValueError):
    """A text that the grammar or the table does not have."""


_ONE = Unit(Fraction(1), (0, 0, 0, 0))
_LENGTH, _MASS, _TIME, _ANGLE = (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)
_VOLUME, _FORCE, _PRESSURE = (3, 0, 0, 0), (1, 1, -2, 0), (-1, 1, -2, 0)
_ENERGY, _POWER, _RATE, _VISCOSITY = (2, 1, -2, 0), (2, 1, -3, 0), (0, 0, -1, 0), (-1, 1, -1, 0)

_PREFIXES = {
    "T": 12, "G": 9, "M": 6, "k": 3, "h": 2, "da": 1, "d": -1, "c": -2, "m": -3, "u": -6, "n": -9,
    "p": -12, "f": -15,
}  # fmt: skip
_LONG_PREFIXES = {
    "tera": 12, "giga": 9, "mega": 6, "kilo": 3, "hecto": 2, "deca": 1, "deci": -1, "centi": -2,
    "milli": -3, "micro": -6, "nano": -9, "pico": -12, "femto": -15,
}  # fmt: skip

# symbol, names, factor to SI, exponents; these take prefixes
_PREFIXED = (
    ("m", "meter metre", "1", _LENGTH),
    ("g", "gram", "0.001", _MASS),
    ("s", "second", "1", _TIME),
    ("N", "newton", "1", _FORCE),
    ("Pa", "pascal", "1", _PRESSURE),
    ("bar", "bar", "100000", _PRESSURE),
    ("J", "joule", "1", _ENERGY),
    ("W", "watt", "1", _POWER),
    ("Hz", "hertz", "1", _RATE),
    ("l", "liter litre", "0.001", _VOLUME),
    ("L", "", "0.001", _VOLUME),
    ("P", "poise", "0.1", _VISCOSITY),
    ("dyn", "dyne", "0.00001", _FORCE),
    ("rad", "radian", "1", _ANGLE),
)
# names, factor to SI, exponents; these take none
_PLAIN = (
    ("min minute", "60", _TIME),
    ("h hr hour", "3600", _TIME),
    ("day", "86400", _TIME),
    ("week", "604800", _TIME),
    ("in inch inches", "0.0254", _LENGTH),
    ("ft foot feet", "0.3048", _LENGTH),
    ("yd yard", "0.9144", _LENGTH),
    ("mi mile", "1609.344", _LENGTH),
    ("furlong", "201.168", _LENGTH),
    ("thou", "0.0000254", _LENGTH),
    ("micron", "1e-6", _LENGTH),
    ("angstrom Å", "1e-10", _LENGTH),
    ("t tonne", "1000", _MASS),
    ("lb pound", "0.45359237", _MASS),
    ("oz ounce", "0.028349523125", _MASS),
    ("kgf", "9.80665", _FORCE),
    ("gf", "0.00980665", _FORCE),
    ("lbf", "4.4482216152605", _FORCE),
    ("psi", "6894.757293168361", _PRESSURE),
    ("atm atmosphere", "101325", _PRESSURE),
    ("mmHg", "133.322387415", _PRESSURE),
    ("torr", "133.32236842105263", _PRESSURE),
    ("cmH2O", "98.0665", _PRESSURE),
    ("mmH2O", "9.80665", _PRESSURE),
    ("cc", "1e-6", _VOLUME),
    ("percent %", "0.01", (0, 0, 0, 0)),
)
_AMBIGUOUS = ("hbar",)  # means something else
_TURN = Fraction(2 * math.pi)
_ANGLES = (
    ("deg degree °", _TURN / 360, _ANGLE),
    ("rev revolution turn", _TURN, _ANGLE),
    ("rpm", _TURN / 60, (0, 0, -1, 1)),
)

_TOKEN = re.compile(r"[cm]mH2O|[^\W\d_]+|[°%]|\d+|\^-?\d+|[*/()]")


def _table() -> dict[str, Unit]:
    units: dict[str, Unit] = {}
    for symbol, names, factor, powers in _PREFIXED:
        one = Unit(Fraction(factor), powers)
        for prefix, exponent in ({"": 0} | _PREFIXES).items():
            units.setdefault(prefix + symbol, Unit(one.factor * Fraction(10) ** exponent, powers))
        for name in names.split():
            for prefix, exponent in ({"": 0} | _LONG_PREFIXES).items():
                unit = Unit(one.factor * Fraction(10) ** exponent, powers)
                units |= {prefix + name: unit, f"{prefix}{name}s": unit}
    plain = [(names, Fraction(factor), powers) for names, factor, powers in _PLAIN]
    for words, size, powers in (*plain, *_ANGLES):
        for name in words.split():
            units[name] = Unit(size, powers)
            if len(name) > 3:
                units.setdefault(f"{name}s", units[name])
    for name in _AMBIGUOUS:
        units.pop(name, None)
    return units


_UNITS: Mapping[str, Unit] = _table()


def read_unit(text: str) -> Unit:
    """The unit that a text names, with * between two and ^ before exponents.

    Raises:
        UnknownUnitError: a name that is not in the table, or what the grammar does not have.
    """
    if len(text) > _LONGEST:
        raise UnknownUnitError
    tokens = _TOKEN.findall(text)
    if "".join(tokens) != text or not tokens:
        raise UnknownUnitError
    unit, rest = _product(tokens)
    if rest:
        raise UnknownUnitError
    return unit


def _product(tokens: list[str]) -> tuple[Unit, list[str]]:
    unit, rest = _factor(tokens)
    while rest and rest[0] in ("*", "/"):
        sign = 1 if rest[0] == "*" else -1
        other, rest = _factor(rest[1:])
        unit = unit * other**sign
    return unit, rest


def _factor(tokens: list[str]) -> tuple[Unit, list[str]]:
    if not tokens:
        raise UnknownUnitError
    first, rest = tokens[0], tokens[1:]
    if first == "(":
        unit, rest = _product(rest)
        if not rest or rest[0] != ")":
            raise UnknownUnitError
        rest = rest[1:]
    elif first == "1":
        unit = _ONE
    elif first in _UNITS:
        unit = _UNITS[first]
    else:
        raise UnknownUnitError
    if rest and (rest[0][0] == "^" or rest[0].isdecimal()):
        exponent = int(rest[0].lstrip("^")) if len(rest[0]) <= 4 else _LARGEST + 1
        if abs(exponent) > _LARGEST or first == "1":
            raise UnknownUnitError
        unit, rest = unit**exponent, rest[1:]
    return unit, rest


def words_of(powers: Powers) -> str:
    """The exponents in words: "m^5", "kg m/s^2" as "kg m s^-2"."""
    order = ((powers[1], "kg"), (powers[0], "m"), (powers[2], "s"), (powers[3], "rad"))
    words = [name if n == 1 else f"{name}^{n}" for n, name in order if n]
    return " ".join(words) or "1"
