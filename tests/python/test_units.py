"""Quantities: numbers in SI, texts with units, and what is refused."""

import math
import subprocess
import sys

import numpy as np
import pint
import pytest

from tissu import units
from tissu.errors import ParameterError


@pytest.mark.parametrize(
    ("dimension", "written", "value"),
    [
        (units.PRESSURE, 4000, 4000.0),
        (units.PRESSURE, "4 kPa", 4000.0),
        (units.PRESSURE, "4kPa", 4000.0),
        (units.PRESSURE, "1e-3 MPa", 1000.0),
        (units.PRESSURE, "2 bar", 2e5),
        (units.PRESSURE, np.float32(0.5), 0.5),
        (units.TIME, "10 ms", 0.01),
        (units.TIME, "1e-6", 1e-6),
        (units.DENSITY, "1.05 g/cm^3", 1050.0),
        (units.DENSITY, "1.05 g/cm³", 1050.0),
        (units.DENSITY, "1.05 g/cm**3", 1050.0),
        (units.ANGLE, "90 deg", math.pi / 2),
        (units.RATE, "0.1 1/s", 0.1),
        (units.ACCELERATION, "-9.81 m/s^2", -9.81),
        (units.FORCE, ".5 kN", 500.0),
        (units.NUMBER, "45 %", 0.45),
        (units.LENGTH, "1 inch", 0.0254),
        (units.AREA, "2 mm²", 2e-6),
    ],
)
def test_reads_numbers_and_units(dimension, written, value):
    assert dimension(written) == pytest.approx(value, rel=1e-12)


def test_table_agrees_with_pint():
    registry = pint.UnitRegistry()
    shorthand = {"kg/m3": "kg/m^3", "g/cm3": "g/cm^3", "m/s2": "m/s^2", "/s": "1/s", "%": "percent"}
    shorthand |= {"m2": "m^2", "cm2": "cm^2", "mm2": "mm^2"}
    for dimension in units.DIMENSIONS:
        for unit, factor in dimension.units.items():
            quantity = registry.parse_expression(shorthand.get(unit, unit))
            si = quantity.to(dimension.unit or "dimensionless")
            assert factor == pytest.approx(si.magnitude, rel=1e-14), unit


@pytest.mark.parametrize(
    ("dimension", "written", "message"),
    [
        (
            units.PRESSURE,
            "4 mm",
            "'4 mm', which is a length; a pressure is accepted: a number in Pa",
        ),
        (units.PRESSURE, "4 furlong", "which is a length"),
        (units.PRESSURE, "4 m^5", "which is of dimension"),
        (units.PRESSURE, "4 kPaa", "unit 'kPaa' is not known"),
        (units.PRESSURE, "kPa", "does not begin with a number"),
        (units.PRESSURE, None, "found nothing"),
        (units.PRESSURE, True, "found True"),
        (units.PRESSURE, [1], r"found \[1\]"),
        (units.ACCELERATION, math.nan, "not finite"),
        (units.ACCELERATION, "-inf", "not finite"),
        (units.ACCELERATION, "1 N", "an acceleration is accepted"),
        (units.NUMBER, "0.4 Pa", "which is a pressure; a number is accepted"),
    ],
)
def test_says_what_is_wrong_and_what_is_accepted(dimension, written, message):
    with pytest.raises(ParameterError, match=message):
        dimension(written)


def test_reads_a_pint_quantity():
    assert units.PRESSURE(4 * pint.UnitRegistry().kilopascal) == pytest.approx(4000.0)


def test_vectors():
    assert units.Triple(units.LENGTH)([0, "1 cm", np.float64(2)]) == (0.0, 0.01, 2.0)
    assert units.Triple(units.LENGTH)(np.arange(3)) == (0.0, 1.0, 2.0)
    assert units.Triple(units.LENGTH, open=True)([None, 1, None]) == (None, 1.0, None)
    with pytest.raises(ParameterError, match="component y: found '1 s', which is a time"):
        units.Triple(units.LENGTH)([0, "1 s", 0])
    with pytest.raises(ParameterError, match="three components"):
        units.Triple(units.LENGTH)([0, 1])
    with pytest.raises(ParameterError, match="component x: found nothing"):
        units.Triple(units.LENGTH)([None, 0, 0])


def test_common_units_never_import_pint():
    code = (
        "import sys; from tissu import units; units.PRESSURE('4 kPa'); units.DENSITY('1 g/cm^3');"
        "units.LENGTH(3); sys.exit('pint' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    "written",
    [
        "1 10**2 s",  # arithmetic is no unit
        "1 2 s",
        "1 s + 1 s",
        "1 s^99",
        "1 s^10^10^10",
        "1 10**10**10 s",
        "1 (s",
        "1 s)",
        "1 /",
        "1 __import__('os')",
        "1 kks",
        "1 " + "(" * 60 + "s",
        "1" + " " * 100_000 + "x y",
        "1 " + "s*" * 100_000 + "s",
        "9" * 100_000,
        10**400,
        -(10**5000),
    ],
    ids=lambda value: str(value)[:20] if isinstance(value, str) else "digits",
)
def test_a_unit_is_a_name_of_a_table_and_nothing_is_computed(written):
    with pytest.raises(ParameterError, match="a time is accepted") as refused:
        units.TIME(written)
    assert len(str(refused.value)) < 300
    assert "\n" not in str(refused.value)


def test_a_long_text_is_refused_by_its_length():
    """Before it is read: no quantity is longer than 200 characters."""
    with pytest.raises(ParameterError, match="found a text of 100000 characters"):
        units.TIME("9" * 100_000)


AMBIGUOUS = {"hbar"}
"""Prefix and unit that together mean something else."""


def test_every_unit_of_the_grammar_agrees_with_pint():
    from tissu.unit_table import _PLAIN, _PREFIXED, _PREFIXES, read_unit

    registry = pint.UnitRegistry()
    names = [p + symbol for symbol, *_ in _PREFIXED for p in ("", *_PREFIXES)]
    names += [name for row in _PREFIXED for name in row[1].split()]
    names += [name for words, *_ in _PLAIN for name in words.split()]
    names += [
        "deg",
        "degree",
        "revolution",
        "turn",
        "rpm",
        "kg/(m*s^2)",
        "N*s/m^4",
        "mm2",
        "lbf/in^2",
    ]
    for name in names:
        if name in AMBIGUOUS:
            with pytest.raises(ValueError):
                read_unit(name)
            continue
        if name in {"furlong", "%"}:  # pint's furlong is of the survey foot, 2 ppm longer
            continue
        found = read_unit(name)
        quantity = registry.parse_expression(name.replace("mm2", "mm^2"))
        si = quantity.to_base_units()
        # The conventional millimetre of water and torr have ten digits.
        assert float(found.factor) == pytest.approx(si.magnitude, rel=1e-9, abs=0.0), name
        powers = {"meter": 0, "kilogram": 1, "second": 2}
        wanted = [0, 0, 0]
        for base, power in si.unit_items():
            if base in powers:
                wanted[powers[base]] = int(power)
        assert list(found.powers[:3]) == wanted, name


@pytest.mark.parametrize(
    ("dimension", "written", "value"),
    [
        (units.PRESSURE, "16 cmH2O", 16 * 98.0665),
        (units.PRESSURE, "1 kgf/cm^2", 98066.5),
        (units.VISCOSITY, "1 cP", 1e-3),
        (units.DENSITY, "1 kg/(m m m)", 1.0),
        (units.SPIN, "1 turn/min", 2 * math.pi / 60),
        (units.LENGTH, "3 micrometers", 3e-6),
        (units.MOMENT, "2 N mm", 2e-3),
        (units.ACCELERATION, "1 km/h/s", 1 / 3.6),
    ],
)
def test_the_grammar_reads_what_the_short_table_lacks(dimension, written, value):
    assert dimension(written) == pytest.approx(value, rel=1e-14)


def test_cycles_are_no_radians():
    with pytest.raises(ParameterError, match="which is a rate; an angular velocity is accepted"):
        units.SPIN("2 kHz")
