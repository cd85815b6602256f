"""Quadrature rules on the reference cells, computed to forty digits and rounded once.

Cells: line (-1, 1) and its powers; triangle and tetrahedron with corners at the origin and the unit
points; wedge: that triangle times (-1, 1); pyramid: base (-1, 1)^2 at z = 0, apex (0, 0, 1).
All weights are positive, all points lie inside. The first coordinate runs fastest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import permutations, product
from math import factorial, prod
from typing import Any

import mpmath
import sympy

Point = tuple[float, ...]

DIGITS = 40
"""Digits every point and weight is computed to."""

_ORBITS: dict[tuple[int, int], Sequence[tuple[tuple[int, ...], tuple[float, ...]]]] = {
    (2, 1): [((3,), ())],
    (2, 2): [((2, 1), (0.17,))],
    (2, 4): [((2, 1), (0.09,)), ((2, 1), (0.45,))],
    (2, 6): [((2, 1), (0.06,)), ((2, 1), (0.25,)), ((1, 1, 1), (0.05, 0.31))],
    (3, 1): [((4,), ())],
    (3, 2): [((3, 1), (0.14,))],
    (3, 5): [((3, 1), (0.09,)), ((3, 1), (0.31,)), ((2, 2), (0.05,))],
}
"""(dimension, degree) -> symmetric orbits of a simplex rule: how often each barycentric coordinate
occurs, and where Newton starts for all of them but the last, which makes their sum one."""


@dataclass(frozen=True)
class Rule:
    """Points and weights of a quadrature rule.

    Attributes:
        name: what it is, in words.
        points: reference coordinates.
        weights: positive, their sum is the measure of the reference cell.
        degree: every polynomial of this total degree is integrated exactly.
    """

    name: str
    points: tuple[Point, ...]
    weights: tuple[float, ...]
    degree: int


@cache
def gauss(count: int, alpha: int = 0) -> tuple[list[Any], list[Any]]:
    """Gauss-Jacobi points and weights on (-1, 1) for the weight (1 - t)^alpha (0: Gauss-Legendre).

    The points are the roots of the Jacobi polynomial P_n^(alpha, 0); the weights make the first
    `count` moments exact. Polynomials to degree 2 count - 1 are integrated exactly.

    Args:
        count: number of points.
        alpha: exponent of the weight.
    """
    t = sympy.Symbol("t")
    with mpmath.workdps(DIGITS + 10):
        polynomial = sympy.Poly(sympy.jacobi(count, alpha, 0, t), t)
        roots = sorted(mpmath.polyroots([mpmath.mpf(c.p) / c.q for c in polynomial.all_coeffs()]))
        moments = [sympy.integrate(t**k * (1 - t) ** alpha, (t, -1, 1)) for k in range(count)]
        powers = mpmath.matrix(count, count)
        for k, (i, root) in product(range(count), enumerate(roots)):
            powers[k, i] = root**k
        right = mpmath.matrix([mpmath.mpf(m.p) / m.q for m in moments])
        return roots, list(mpmath.lu_solve(powers, right))


def tensor(count: int, dimension: int) -> Rule:
    """Gauss-Legendre products on (-1, 1)^dimension: degree 2 count - 1 in each direction.

    The weights are products of the rounded weights of the line, one factor after the other.

    Args:
        count: points in each direction.
        dimension: 1, 2 or 3.
    """
    roots, weights = gauss(count)
    line = [(float(t), float(w)) for t, w in zip(roots, weights, strict=True)]
    points, products = [], []
    for picked in product(line, repeat=dimension):
        picked = picked[::-1]
        points.append(tuple(t for t, _ in picked))
        products.append(prod(w for _, w in picked))
    name = "Gauss-Legendre, " + " x ".join([str(count)] * dimension)
    return Rule(name, tuple(points), tuple(products), 2 * count - 1)


def simplex(dimension: int, degree: int) -> Rule:
    """Fully symmetric rule on the triangle or the tetrahedron.

    Args:
        dimension: 2 or 3.
        degree: total degree that is exact; (2; 1, 2, 4, 6) and (3; 1, 2, 5) exist.
    """
    points, weights = _simplex(dimension, degree)
    rounded = tuple(tuple(float(c) for c in p[1:]) for p in points)
    name = f"Symmetric, {len(points)} point{'s' * (len(points) > 1)}"
    return Rule(name, rounded, tuple(float(w) for w in weights), degree)


def wedge(degree: int, count: int) -> Rule:
    """Symmetric rule of the triangle times Gauss-Legendre along z.

    Args:
        degree: of the triangle's rule.
        count: points along z.
    """
    roots, weights = gauss(count)
    corner, area = _simplex(2, degree)
    points, products = [], []
    for (t, w), (p, a) in product(zip(roots, weights, strict=True), zip(corner, area, strict=True)):
        points.append((float(p[1]), float(p[2]), float(t)))
        products.append(float(w * a))
    name = f"Symmetric triangle of {len(corner)} points x Gauss-Legendre of {count}"
    return Rule(name, tuple(points), tuple(products), min(degree, 2 * count - 1))


def pyramid(base: int, height: int) -> Rule:
    """Conical product: x = (1 - z) a, y = (1 - z) b, dx dy dz = (1 - z)^2 da db dz.

    Gauss-Legendre in a and b, Gauss-Jacobi in z for the weight (1 - z)^2, so that functions which
    are polynomials in a, b and z are integrated exactly and no point is at the apex.

    Args:
        base: points along a and along b.
        height: points along z.
    """
    line = list(zip(*gauss(base), strict=True))
    axis = list(zip(*gauss(height, 2), strict=True))
    points, products = [], []
    for (t, wz), (b, wb), (a, wa) in product(axis, line, line):
        z = (1 + t) / 2
        points.append((float((1 - z) * a), float((1 - z) * b), float(z)))
        products.append(float(wa * wb * wz / 8))
    name = f"Conical product, {base} x {base} x {height}"
    return Rule(name, tuple(points), tuple(products), min(2 * base, 2 * height) - 1)


@cache
def _simplex(dimension: int, degree: int) -> tuple[list[tuple[Any, ...]], list[Any]]:
    """Barycentric points and weights of a symmetric rule, by Newton on its moments."""
    orbits = _ORBITS[dimension, degree]
    exponents = _invariants(dimension, degree)

    def unpack(unknowns: Sequence[Any]) -> list[list[tuple[Any, ...]]]:
        left = list(unknowns)
        return [_orbit(times, [left.pop(0) for _ in times[:-1]]) for times, _ in orbits]

    def moments(points: list[tuple[Any, ...]]) -> list[Any]:
        return [
            mpmath.fsum(prod(c**k for c, k in zip(p, e, strict=False)) for p in points)
            for e in exponents
        ]

    def residual(*unknowns: Any) -> list[Any]:
        sums = [moments(points) for points in unpack(unknowns[len(orbits) :])]
        return [
            mpmath.fsum(w * s[k] for w, s in zip(unknowns, sums, strict=False)) - exact[k]
            for k in range(len(exact))
        ]

    with mpmath.workdps(DIGITS + 10):
        exact = [
            mpmath.mpf(prod(map(factorial, e))) / factorial(sum(e) + dimension) for e in exponents
        ]
        start = [mpmath.mpf(value) for _, values in orbits for value in values]
        table = mpmath.matrix([moments(points) for points in unpack(start)]).T
        unknowns = list(mpmath.lu_solve(table, mpmath.matrix(exact))) + start
        if len(unknowns) != len(exact):
            raise ValueError(f"{len(unknowns)} unknowns for {len(exact)} moments")
        solution = mpmath.findroot(residual, unknowns, tol=mpmath.mpf(10) ** (-2 * DIGITS))
        weights = list(solution)[: len(orbits)]
        places = unpack(list(solution)[len(orbits) :])
    points = [p for orbit in places for p in orbit]
    return points, [w for w, orbit in zip(weights, places, strict=True) for _ in orbit]


def _orbit(times: Sequence[int], values: list[Any]) -> list[tuple[Any, ...]]:
    """All permutations of barycentric coordinates of which the last makes the sum one."""
    used = mpmath.fsum(k * v for k, v in zip(times, values, strict=False))
    every = [*values, (1 - used) / times[-1]]
    order = [i for i, k in enumerate(times) for _ in range(k)]
    return [tuple(every[i] for i in p) for p in sorted(set(permutations(order)))]


def _invariants(dimension: int, degree: int) -> list[tuple[int, ...]]:
    """Exponents of monomials whose moments a symmetric rule of a degree has to meet.

    Symmetric polynomials of the barycentric coordinates, whose sum is one, are polynomials of the
    elementary symmetric ones of order 2 ... dimension + 1: as many moments as products of these.
    """
    parts = range(dimension + 1, 1, -1)
    counts = product(*[range(degree // p + 1) for p in parts])
    found = [sum(((p,) * k for p, k in zip(parts, c, strict=True)), ()) for c in counts]
    return sorted((e for e in found if sum(e) <= degree), key=lambda e: (sum(e), e))
