"""The words of an energy for `tissu.law`: from tissu.formula import I_C, J, ln.

F is the deformation gradient, C = F^T F, E = (C - I)/2, eps = sym(F) - I, J = det F.

    tr(E), tr(E * E), tr(C), tr(C * C), tr(eps), tr(eps * eps)    traces
    I_C = tr C,  II_C = (I_C^2 - tr C^2)/2,  J                     invariants
    Ibar1 = J^(-2/3) I_C,  Ibar2 = J^(-4/3) II_C                  of the part without volume change
    I4 = a . C a,  Ibar4 = J^(-2/3) I4                            squared stretch along the fibre a
    ln, exp, sqrt, positive(x) = max(x, 0), Rational              functions, exact fractions
    F[i, j], C[i, j], E[i, j]                                     components, for anything else
    Parameter, Requirement, symbols_of, YOUNG, POISSON, LAME, KAPPA   parameters

SymPy is imported when a word is first asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tissu.errors import LawError

if TYPE_CHECKING:
    from tissu.codegen.vocabulary import (
        I4,
        I_C,
        II_C,
        KAPPA,
        LAME,
        POISSON,
        YOUNG,
        C,
        E,
        F,
        Ibar1,
        Ibar2,
        Ibar4,
        J,
        Parameter,
        Rational,
        Requirement,
        a,
        eps,
        exp,
        ln,
        positive,
        sqrt,
        symbols_of,
        tr,
    )

__all__ = [
    "I4",
    "II_C",
    "I_C",
    "KAPPA",
    "LAME",
    "POISSON",
    "YOUNG",
    "C",
    "E",
    "F",
    "Ibar1",
    "Ibar2",
    "Ibar4",
    "J",
    "Parameter",
    "Rational",
    "Requirement",
    "a",
    "eps",
    "exp",
    "ln",
    "positive",
    "sqrt",
    "symbols_of",
    "tr",
]


def __getattr__(name: str) -> Any:
    """A word of the vocabulary."""
    if name not in __all__:
        raise AttributeError(f"module 'tissu.formula' has no word '{name}'")
    try:
        from tissu.codegen import vocabulary
    except ImportError:
        raise LawError(
            "SymPy, which formulae are written in, is not installed; run pip install 'tissu[laws]'."
        ) from None
    value = getattr(vocabulary, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
