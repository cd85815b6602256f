"""The table of elements: shape functions by their properties, rules by what they integrate."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

sympy = pytest.importorskip("sympy")

from tissu.codegen import quadrature  # noqa: E402
from tissu.codegen.element_properties import exact_for, zero_energy_modes  # noqa: E402
from tissu.codegen.element_text import expression  # noqa: E402
from tissu.codegen.elements import Element, element_texts, elements  # noqa: E402
from tissu.codegen.reference_cells import AXES  # noqa: E402

ROOT = Path(__file__).parents[2]
GENERATED = ROOT / "cpp/include/tissu/element/generated"
every_element = pytest.mark.parametrize("element", elements(), ids=lambda e: e.name)


def interpolation_error(element: Element, powers: tuple[int, ...]) -> Any:
    def monomial(point: Any) -> Any:
        return sympy.prod([c**k for c, k in zip(point, powers, strict=False)])

    shapes = zip(element.shapes, element.nodes, strict=True)
    error = sum(N * monomial(X) for N, X in shapes) - monomial(AXES)
    return sympy.cancel(error) if element.rational else sympy.expand(error)


def test_names_and_node_counts_are_those_of_meshio() -> None:
    counts = pytest.importorskip("meshio")._common.num_nodes_per_cell
    assert len({e.name for e in elements()}) == len({e.struct for e in elements()}) == 16
    for element in elements():
        assert len(element.nodes) == len(element.shapes) == counts[element.name]


@every_element
def test_shape_functions_are_one_at_their_node_only(element: Element) -> None:
    # At a pyramid's apex the quotients have no value, only the limit along the axis.
    axes = AXES[: element.dimension]
    for b, node in enumerate(element.nodes):
        at = dict(zip(axes, node, strict=True))
        for a, N in enumerate(element.shapes):
            along_axis = [(s, c) for s, c in at.items() if s != axes[-1]]
            assert sympy.cancel(N.subs(along_axis)).subs(axes[-1], at[axes[-1]]) == int(a == b)


@every_element
def test_polynomials_of_the_order_are_held_exactly(element: Element) -> None:
    m = element.dimension
    for powers in np.ndindex(*[element.order + 1] * m):
        if sum(powers) <= element.order:
            assert interpolation_error(element, powers) == 0, powers


@every_element
def test_cubic_polynomials_are_not_held(element: Element) -> None:
    assert interpolation_error(element, (element.order + 1, 0, 0)[: element.dimension]) != 0


@every_element
def test_printed_expressions_are_the_formulae(element: Element) -> None:
    numbers = random.Random(4)
    point = {s: Fraction(numbers.randint(1, 9), 40) for s in AXES}
    names: dict[str, Any] = {str(s): c for s, c in point.items()}
    names["w"] = 1 / (1 - names["z"])
    exact = {s: sympy.Rational(c.numerator, c.denominator) for s, c in point.items()}
    for formula in [*element.shapes, *(d for row in element.gradients for d in row)]:
        printed = eval(expression(formula), {}, names)
        assert float(printed) == pytest.approx(float(formula.subs(exact)), rel=1e-14, abs=1e-15)


def test_expressions_are_printed_readably() -> None:
    x, y, z = AXES
    assert expression(sympy.Integer(0)) == "0"
    assert expression((x - 1) * (y + 1) / 4) == "-0.25 * (1 - x) * (1 + y)"
    assert expression(-(x**2)) == "-x * x"
    assert expression(1 - x - y) == "1 - x - y"
    assert expression(x * y / (1 - z) ** 2) == "x * y * w * w"
    assert expression((1 - z + x) * (1 - z) / (1 - z)) == "1 + x - z"


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5])
def test_gauss_is_that_of_numpy(count: int) -> None:
    points, weights = np.polynomial.legendre.leggauss(count)
    found = quadrature.tensor(count, 1)
    np.testing.assert_allclose([p[0] for p in found.points], points, atol=1e-15)
    np.testing.assert_allclose(found.weights, weights, rtol=1e-14)


def test_symmetric_rules_have_their_closed_forms() -> None:
    corner = (5 - 5**0.5) / 20
    found = sorted({c for p in quadrature.simplex(3, 2).points for c in p})
    assert found == pytest.approx([corner, 1 - 3 * corner], rel=1e-15)
    assert sorted({c for p in quadrature.simplex(2, 2).points for c in p}) == [1 / 6, 2 / 3]


@every_element
def test_rules_do_what_their_names_say(element: Element) -> None:
    assert exact_for(element, element.full) in ("hooke", "stvk")
    unaffordable = {"hexahedron20", "hexahedron27", "wedge15", "pyramid13"}
    assert (exact_for(element, element.over) == "stvk") == (element.name not in unaffordable)
    assert zero_energy_modes(element, element.full) == 0
    assert zero_energy_modes(element, element.over) == 0
    assert len(element.reduced.points) <= len(element.full.points) <= len(element.over.points)


def test_reduced_rules_count_their_zero_energy_modes() -> None:
    # The textbooks' counts, of one element alone.
    known = {"quad": 2, "quad8": 1, "quad9": 3, "hexahedron": 12, "hexahedron20": 6, "tetra": 0}
    found = {e.name: zero_energy_modes(e, e.reduced) for e in elements() if e.name in known}
    assert found == known


def test_files_are_what_the_table_makes() -> None:
    texts = element_texts()
    assert {str(p.relative_to(ROOT)) for p in GENERATED.glob("*.h")} == set(texts)
    differ = [path for path, text in texts.items() if (ROOT / path).read_text("utf-8") != text]
    assert not differ, f"{differ}: run python -m tissu.codegen --update"
