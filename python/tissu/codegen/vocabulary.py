"""The words an energy may be written in.

F is the deformation gradient, C = F^T F, E = (C - I)/2, eps = sym(F) - I, J = det F. The invariants
are symbols: an energy written in them is differentiated by the chain rule and never expanded.

    tr(E), tr(E * E), tr(C), tr(C * C), tr(eps), tr(eps * eps)    traces
    I_C = tr C,  II_C = (I_C^2 - tr C^2)/2,  J                     invariants
    Ibar1 = J^(-2/3) I_C,  Ibar2 = J^(-4/3) II_C                  of the part without volume change
    I4 = a . C a,  Ibar4 = J^(-2/3) I4                            squared stretch along the fibre a
    ln, exp, sqrt, positive(x) = max(x, 0)
    F[i, j], C[i, j], E[i, j]                                     components, for anything else
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp

Expr = Any  # a SymPy expression; SymPy carries no types

I_C, II_C, J = sp.symbols("I_C II_C J", real=True)
Ibar1, Ibar2, Ibar4, I4 = sp.symbols("Ibar1 Ibar2 Ibar4 I4", real=True)
a = sp.Matrix(sp.symbols("a0 a1 a2", real=True))  # unit direction of the fibre at rest
tr_C2, tr_E, tr_E2, tr_eps, tr_eps2 = sp.symbols("tr_C2 tr_E tr_E2 tr_eps tr_eps2", real=True)
J_inv, J_23 = sp.symbols("J_inv J_23", real=True)  # 1/J and J^(-2/3): made by the derivatives

ln, exp, sqrt, Rational = sp.log, sp.exp, sp.sqrt, sp.Rational


class step(sp.Function):  # type: ignore[misc]  # noqa: N801 - a function in a formula
    """1 where x > 0, else 0."""

    nargs = 1

    @classmethod
    def eval(cls, x: Expr) -> Expr:
        """Its value for a number."""
        return sp.Integer(1 if x > 0 else 0) if x.is_Number else None

    def fdiff(self, argindex: int = 1) -> Expr:
        """Zero: the jump is met only where it is multiplied by zero."""
        return sp.Integer(0)


class positive(sp.Function):  # type: ignore[misc]  # noqa: N801 - a function in a formula
    """The positive part, max(x, 0)."""

    nargs = 1

    @classmethod
    def eval(cls, x: Expr) -> Expr:
        """Its value for a number."""
        return sp.Max(x, 0) if x.is_Number else None

    def fdiff(self, argindex: int = 1) -> Expr:
        """1 where x > 0."""
        return step(self.args[0])


class Tensor:
    """A second-order tensor of F: components by [i, j], products by *."""

    def __init__(self, name: str, components: Expr) -> None:
        self.name = name
        self.components = components

    def __getitem__(self, index: tuple[int, int]) -> Expr:
        return self.components[index]

    def __mul__(self, other: Tensor) -> Tensor:
        return Tensor(f"{self.name} {other.name}", self.components * other.components)


F = Tensor("F", sp.Matrix(3, 3, sp.symbols("F:3:3", real=True)))
C = Tensor("C", F.components.T * F.components)
E = Tensor("E", (C.components - sp.eye(3)) / 2)
eps = Tensor("eps", (F.components + F.components.T) / 2 - sp.eye(3))

_TRACES = {
    "C": I_C,
    "C C": tr_C2,
    "E": tr_E,
    "E E": tr_E2,
    "eps": tr_eps,
    "eps eps": tr_eps2,
}


def tr(tensor: Tensor) -> Expr:
    """The trace: an invariant where it has a name, else written out in F."""
    return _TRACES.get(tensor.name, tensor.components.trace())


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A number that the user of a law gives.

    Attributes:
        name: as in a scene.
        unit: SI, "1" for none.
        meaning: a few words.
        above: excluded lower bound, if any.
        below: excluded upper bound, if any.
        at_least: included lower bound, if any.
        typical: a value of soft tissue, used by the tests.
        default: in a scene; None: it must be given.
        example: how a scene may write it.
        hint: what to take instead of a value beyond its bounds.
    """

    name: str
    unit: str
    meaning: str
    typical: float
    above: float | None = None
    below: float | None = None
    at_least: float | None = None
    default: float | None = None
    example: str = ""
    hint: str = ""

    def accepted(self) -> str:
        """The range in words."""
        bounds = (
            ("above", self.above),
            ("at least", self.at_least),
            ("below", self.below),
        )
        words = [f"{word} {bound:g}" for word, bound in bounds if bound is not None]
        return " and ".join(words) or "any finite number"


@dataclass(frozen=True)
class Requirement:
    """What several parameters must meet together: expression > 0.

    Attributes:
        expression: in the parameters.
        field: what a message names.
        accepted: the condition in words.
    """

    expression: Expr
    field: str
    accepted: str


def symbols_of(names: Iterable[Parameter | str]) -> Any:
    """One symbol for each parameter or constant, in their order; not a tuple when there is one."""
    made = [sp.Symbol(n.name if isinstance(n, Parameter) else n, real=True) for n in names]
    return made[0] if len(made) == 1 else tuple(made)


YOUNG = Parameter(
    name="young",
    unit="Pa",
    meaning="Young's modulus at small strain",
    typical=3000.0,
    above=0.0,
    example="4 kPa",
)
POISSON = Parameter(
    name="poisson",
    unit="1",
    meaning="Poisson's ratio at small strain",
    typical=0.4,
    above=-1.0,
    below=0.5,
    hint="take 0.45 to 0.49 for tissue that hardly changes volume",
)
KAPPA = Parameter(name="kappa", unit="Pa", meaning="bulk modulus", typical=20000.0, above=0.0)

_young, _poisson = symbols_of((YOUNG, POISSON))
LAME = {
    "lambda": _young * _poisson / ((1 + _poisson) * (1 - 2 * _poisson)),
    "mu": _young / (2 * (1 + _poisson)),
}
