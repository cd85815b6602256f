"""What a quadrature rule does to an element, found out by computing it: nothing here is claimed."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

from tissu.codegen import quadrature
from tissu.codegen.elements import Element
from tissu.codegen.quadrature import Rule
from tissu.codegen.reference_cells import AXES

Array = NDArray[np.float64]

_ROUND_OFF = 1e-11
"""Relative; sums of at most a few hundred terms, condition numbers below a thousand."""


def tabulated_gradients(element: Element, rule: Rule) -> Array:
    """dN_a/dxi at the points of a rule.

    Args:
        element: the element.
        rule: points inside its reference cell.

    Returns:
        (points, nodes, m).
    """
    function = _gradient_function(element)
    return np.array([function(*point) for point in rule.points], dtype=np.float64)


def zero_energy_modes(element: Element, rule: Rule) -> int:
    """Displacements without energy beyond rigid ones, on the reference cell under Hooke's law.

    Args:
        element: the element, in a space of its own dimension.
        rule: the quadrature.

    Returns:
        Their number: the rank deficiency of the stiffness, less 1, 3 or 6.
    """
    strains = _strains(element, rule)
    B = strains.reshape(-1, strains.shape[-1])
    rank = int(np.linalg.matrix_rank(B, tol=1e-9 * float(np.linalg.norm(B, 2))))
    m = element.dimension
    return B.shape[1] - rank - m * (m + 1) // 2


def exact_for(element: Element, rule: Rule) -> str:
    """The richest law whose energy the rule integrates exactly on an affine cell.

    Any affine cell will do, as the change of coordinates is linear: it is the reference cell here,
    and the law one with every quadratic (Hooke) or quartic (StVK) term that a law can have.

    Args:
        element: the element.
        rule: the quadrature.

    Returns:
        "stvk", "hooke" or "" for neither.
    """
    exact = _fine_rule(element)
    random = np.random.default_rng(7)
    passed = ""
    for law, power in (("hooke", 1), ("stvk", 2)):
        for _ in range(3):
            u = random.standard_normal((len(element.nodes), element.dimension))
            mixed = random.standard_normal((2, element.dimension, element.dimension))
            found, expected = (_energy(element, r, u, mixed, power) for r in (rule, exact))
            if not np.isclose(found, expected, rtol=_ROUND_OFF, atol=0.0):
                return passed
        passed = law
    return passed


def _energy(element: Element, rule: Rule, u: Array, mixed: Array, power: int) -> float:
    """Integral of (G : A)^(2 power) + (G : B)^(2 power), G = sum_a u_a (x) dN_a/dxi."""
    G = np.einsum("ai,gaj->gij", u, tabulated_gradients(element, rule))
    density = (np.einsum("gij,kij->gk", G, mixed) ** (2 * power)).sum(axis=1)
    return float(np.array(rule.weights) @ density)


def _strains(element: Element, rule: Rule) -> Array:
    """Sqrt(w) sym(grad u) for each unit displacement: (points, m m, nodes m)."""
    dN = tabulated_gradients(element, rule)
    points, nodes, m = dN.shape
    strain = np.zeros((points, m, m, nodes, m))
    for i in range(m):
        strain[:, i, :, :, i] += 0.5 * dN.transpose(0, 2, 1)
        strain[:, :, i, :, i] += 0.5 * dN.transpose(0, 2, 1)
    roots = np.sqrt(np.array(rule.weights))
    weighted: Array = roots[:, None, None] * strain.reshape(points, m * m, nodes * m)
    return weighted


@cache
def _fine_rule(element: Element) -> Rule:
    """Exact for degree eight in every direction: conical products on simplices and wedges too."""
    if element.cell in ("line", "quad", "hexahedron"):
        return quadrature.tensor(5, element.dimension)
    if element.cell == "pyramid":
        return quadrature.pyramid(5, 4)
    line = _unit(0)
    points: list[tuple[float, ...]]
    if element.cell == "wedge":
        points = [
            ((1 - t) * s, t, 2 * z - 1, wt * ws * 2 * wz)
            for t, wt in _unit(1)
            for s, ws in line
            for z, wz in line
        ]
    elif element.cell == "triangle":
        points = [((1 - t) * s, t, wt * ws) for t, wt in _unit(1) for s, ws in line]
    else:
        points = [
            ((1 - r) * (1 - t) * s, (1 - r) * t, r, wr * wt * ws)
            for r, wr in _unit(2)
            for t, wt in _unit(1)
            for s, ws in line
        ]
    return Rule("fine", tuple(p[:-1] for p in points), tuple(p[-1] for p in points), 8)


def _unit(alpha: int) -> list[tuple[float, float]]:
    """Five points on (0, 1) for the weight (1 - t)^alpha."""
    roots, weights = quadrature.gauss(5, alpha)
    return [
        (float((1 + t) / 2), float(w) / 2 ** (alpha + 1))
        for t, w in zip(roots, weights, strict=True)
    ]


@cache
def _gradient_function(element: Element) -> Callable[..., Any]:
    axes = AXES[: element.dimension]
    rows = [list(row) for row in element.gradients]
    function: Callable[..., Any] = sympy.lambdify(axes, rows, "math")
    return function
