"""Quantities: numbers in SI, texts with units, and what is refused."""

import math
import subprocess
import sys

import numpy as np
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
    registry = units._registry()
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
    assert units.PRESSURE(4 * units._registry().kilopascal) == pytest.approx(4000.0)


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
