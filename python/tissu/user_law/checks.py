"""What is refused besides codegen.checks: wrong units, a rest that nothing or too much holds.

In: a Law with numbers to try it with. Out: nothing, or a LawError with the reason.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import sympy as sp

from tissu.codegen import kernels
from tissu.codegen.checks import Point, check_law
from tissu.codegen.definition import Law
from tissu.codegen.program import cube_root, square_root
from tissu.codegen.vocabulary import Expr, Parameter, a
from tissu.errors import LawError

UNITS = ("Pa", "1")
_TRIES = 12  # sets of numbers, where the user gave none
_SCALES = (0.4, 2.5, 6.0, 0.15, 1.3, 30.0)  # of pure numbers
_TOLERANCE = 1e-9  # of the stiffness; see codegen.checks


def check_units(law: Law) -> None:
    """Refuses an energy that is not in Pa: with pressures twice as large it must be twice as large.

    Raises:
        LawError: a unit that no elastic law has, or an energy of another dimension.
    """
    for p in law.parameters:
        if p.unit not in UNITS:
            raise LawError(
                f"{law.name}: the parameter {p.name} is in '{p.unit}'; accepted are 'Pa' and '1' "
                "(a pure number): an energy density is in Pa."
            )
    pressures = {sp.Symbol(p.name, real=True) for p in law.parameters if p.unit == "Pa"}
    factor, table = sp.Symbol("factor", positive=True), {}
    for name, expression in law.constants.items():
        symbol = sp.Symbol(name, real=True)
        table[symbol] = expression.xreplace({**{p: factor * p for p in pressures}})
    scaled = law.energy.xreplace(table)
    plain = law.energy.xreplace({k: e.xreplace({factor: sp.Integer(1)}) for k, e in table.items()})
    generator, worst = np.random.default_rng(5), 0.0
    for _ in range(3):
        values = {s: sp.Float(generator.uniform(1.05, 1.3)) for s in plain.free_symbols}
        once, twice = sp.N(plain.subs(values)), sp.N(scaled.subs({**values, factor: 2}))
        if once.is_finite and twice.is_finite and once.is_real and twice.is_real:
            worst = max(worst, abs(float(twice - 2 * once)) / (abs(float(once)) + 1e-300))
    if worst > _TOLERANCE:
        units = ", ".join(f"{p.name} in {p.unit}" for p in law.parameters)
        raise LawError(
            f"{law.name}: the energy is not in Pa with {units}: twice the pressures do not give "
            "twice the energy."
        )


def checked(law: Law, *, given: bool) -> Law:
    """The law with numbers it was tried with and its limit at small strain.

    given: the parameters' typical values are the user's; else several are tried.

    Raises:
        LawError: what is wrong with the law.
    """
    check_units(law)
    stated = law.small_strain
    law = replace(law, small_strain=_small_strain(law))
    first: LawError | None = None
    for tried in [law] if given else _with_numbers(law):
        try:
            check_law(replace(tried, small_strain=stated or tried.small_strain))
            _check_stiffness(tried)
            return tried
        except LawError as error:
            first = first or error
        except (ValueError, ArithmeticError):
            continue
    raise first or LawError(
        f"{law.name}: the energy or its derivatives are not finite numbers near rest; give the "
        "parameters as tissu.formula.Parameter with a typical value where they are."
    )


def _with_numbers(law: Law) -> list[Law]:
    """The same law with several sets of typical values."""
    generator, laws = np.random.default_rng(3), []
    for number in range(_TRIES):
        made: list[Parameter] = []
        for place, p in enumerate(law.parameters):
            scale = 1000.0 if p.unit == "Pa" else _SCALES[(number + place) % len(_SCALES)]
            made.append(replace(p, typical=float(scale * generator.uniform(0.7, 1.4))))
        laws.append(replace(law, parameters=tuple(made)))
    return laws


def _check_stiffness(law: Law) -> None:
    """Refuses a law that a small strain makes softer than nothing, at rest."""
    if law.addition:
        return
    A = Point(law).tangent(np.eye(3))
    # Unit strains: three along the axes, three shears.
    basis = [np.outer(e, e) for e in np.eye(3)]
    basis += [
        (np.outer(np.eye(3)[i], np.eye(3)[j]) + np.outer(np.eye(3)[j], np.eye(3)[i])) / np.sqrt(2)
        for i, j in ((1, 2), (0, 2), (0, 1))
    ]
    strains = np.array(basis).reshape(6, 9)
    lowest = float(np.linalg.eigvalsh(strains @ A @ strains.T)[0])
    if lowest > _TOLERANCE * abs(A).max():
        return
    numbers = ", ".join(f"{p.name} = {p.typical:.4g} {p.unit}" for p in law.parameters)
    words = numbers.replace(" 1,", ",").removesuffix(" 1")
    if law.small_strain is not None:
        lam, mu = A[0, 4], A[1, 1]
        found = f"the shear modulus at rest is {mu:.4g} Pa, the bulk modulus {lam + 2 * mu / 3:.4g}"
        raise LawError(f"{law.name}: with {words} {found} Pa; both must be above 0.")
    raise LawError(
        f"{law.name}: with {words} a small strain has the stiffness {lowest:.4g} Pa; "
        "it must be above 0."
    )


def _small_strain(law: Law) -> tuple[Expr, Expr] | None:
    """Lamé's lambda and mu at rest in the constants; None where rest is not isotropic."""
    if law.energy.free_symbols & set(a):
        return None
    program = kernels.tangent(law.energy)
    known: dict[Expr, Expr] = {
        sp.Symbol(f"F{i}{j}", real=True): sp.Integer(int(i == j))
        for i in range(3)
        for j in range(3)
    }
    for symbol, expression in program.lets:
        known[symbol] = _value(expression, known)
    entries = {target: _value(e, known) for target, e in program.outputs.items()}
    A = {
        (3 * i + J, 3 * k + L): entries[f"A({i}, {J}, {k}, {L})"]
        for i, J, k, L in (_indices(r, c) for r in range(9) for c in range(r, 9))
    }
    lam, mu = A[0, 4], A[1, 1]
    for (row, column), entry in A.items():
        i, J, k, L = _indices(row, column)
        hooke = lam * int(i == J and k == L) + mu * (
            int(i == k and J == L) + int(i == L and k == J)
        )
        if sp.simplify(entry - hooke) != 0:
            return None
    return lam, mu


def _indices(row: int, column: int) -> tuple[int, int, int, int]:
    return row // 3, row % 3, column // 3, column % 3


def _value(expression: Expr, known: dict[Expr, Expr]) -> Expr:
    found = expression.xreplace(known)
    found = found.replace(cube_root, lambda x: sp.cbrt(x)).replace(
        square_root, lambda x: sp.sqrt(x)
    )
    return found if found.is_Atom else sp.simplify(found)
