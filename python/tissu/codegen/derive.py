"""Derivatives of an energy by the chain rule. In: an energy. Out: its Weights.

With invariants q_k(F), W = W(q), and d q_k/dF = sum_b g_kb B_b over a few tensors B_b:

    P = sum_b p_b B_b,                       p_b = sum_k W_k g_kb
    dP/dF = sum_b p_b dB_b/dF + sum_bc M_bc B_b (x) B_c,   M_bc = sum_kl W_kl g_kb g_lc

The tensors: F; FC = F C; K = dJ/dF, the cofactors; N = (F a) (x) a; I; H = F + F^T - 2 I.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TypeVar

import sympy as sp

from tissu.codegen.vocabulary import (
    I4,
    I_C,
    II_C,
    J_23,
    C,
    E,
    Expr,
    F,
    Ibar1,
    Ibar2,
    Ibar4,
    J,
    J_inv,
    a,
    eps,
    positive,
    step,
    tr_C2,
    tr_E,
    tr_E2,
    tr_eps,
    tr_eps2,
)

# d q/dF in the tensors; d tr(C^2)/dF = 4 F C, d tr(E^2)/dF = 2 F E = F C - F.
GRADIENTS: dict[Expr, dict[str, int]] = {
    I_C: {"F": 2},
    tr_C2: {"FC": 4},
    tr_E: {"F": 1},
    tr_E2: {"FC": 1, "F": -1},
    J: {"K": 1},
    I4: {"N": 2},
    tr_eps: {"I": 1},
    tr_eps2: {"H": 1},
}
# Symbols that are functions of the q_k, and their derivatives.
CHAIN: dict[Expr, dict[Expr, Expr]] = {
    J_inv: {J: -(J_inv**2)},
    J_23: {J: -sp.Rational(2, 3) * J_23 * J_inv},
    II_C: {I_C: I_C, tr_C2: -sp.Rational(1, 2)},
    Ibar1: {I_C: J_23, J: -sp.Rational(2, 3) * Ibar1 * J_inv},
    Ibar2: {
        I_C: J_23**2 * I_C,
        tr_C2: -(J_23**2) / 2,
        J: -sp.Rational(4, 3) * Ibar2 * J_inv,
    },
    Ibar4: {I4: J_23, J: -sp.Rational(2, 3) * Ibar4 * J_inv},
}
Key = TypeVar("Key")
TENSORS = ("F", "FC", "K", "N", "I", "H")


@dataclass(frozen=True)
class Weights:
    """The energy with the weights of its derivatives.

    Attributes:
        energy: W.
        p: of each tensor in the stress, zeros left out.
        M: of each pair of tensors in the tangent, symmetric, zeros left out.
    """

    energy: Expr
    p: Mapping[str, Expr]
    M: Mapping[tuple[str, str], Expr]

    @property
    def linear(self) -> bool:
        """One tangent for every F."""
        invariants = {*GRADIENTS, *CHAIN}
        constant = all(not e.free_symbols & invariants for e in self.M.values())
        return constant and set(self.p) <= {"I", "H"}


def tidy(expression: Expr) -> Expr:
    """1/J as one symbol; step(x)^n = step(x), positive(x)^n step(x) = positive(x)^n."""

    def absorbed(product: Expr) -> Expr:
        kept = {f.base.args[0] if f.is_Pow else f.args[0] for f in product.args if _is_positive(f)}
        return sp.Mul(*(f for f in product.args if not (isinstance(f, step) and f.args[0] in kept)))

    expression = expression.replace(
        lambda e: e.is_Pow and isinstance(e.base, step) and e.exp.is_positive, lambda e: e.base
    )
    expression = expression.replace(lambda e: e.is_Mul, absorbed)
    return expression.replace(
        lambda e: e.is_Pow and e.base == J and e.exp.is_negative, lambda e: J_inv**-e.exp
    )


def _is_positive(factor: Expr) -> bool:
    return isinstance(factor, positive) or (factor.is_Pow and isinstance(factor.base, positive))


def derivative(expression: Expr, q: Expr) -> Expr:
    """d/dq through every symbol that depends on q."""
    total = sp.diff(expression, q)
    for symbol, partial in CHAIN.items():
        if q in partial and expression.has(symbol):
            total += sp.diff(expression, symbol) * partial[q]
    return tidy(total)


@cache
def weights(energy: Expr) -> Weights:
    """p_b and M_bc of an energy written in invariants."""
    first = {q: derivative(energy, q) for q in GRADIENTS}
    p: dict[str, Expr] = {}
    M: dict[tuple[str, str], Expr] = {}
    for q, W_q in first.items():
        if W_q == 0:
            continue
        for tensor, g in GRADIENTS[q].items():
            p[tensor] = p.get(tensor, 0) + g * W_q
        for r in GRADIENTS:
            W_qr = derivative(W_q, r)
            for tensor, g in GRADIENTS[q].items():
                for other, h in GRADIENTS[r].items() if W_qr != 0 else ():
                    M[tensor, other] = M.get((tensor, other), 0) + g * h * W_qr
    return Weights(energy, _nonzero(p), _nonzero(M))


def _nonzero(table: dict[Key, Expr]) -> dict[Key, Expr]:
    return {key: sum_ for key, e in table.items() if (sum_ := sp.sympify(e)) != 0}


def has_components(energy: Expr) -> bool:
    """True of an energy that names components of F: it is differentiated as it stands."""
    return bool(energy.free_symbols & set(F.components))


def in_components(energy: Expr) -> Expr:
    """The energy in the components of F alone."""
    volume = F.components.det()
    squares, fibre = (C.components * C.components).trace(), (F.components * a)
    I = C.components.trace()  # noqa: E741 - the invariant's letter
    shear = volume ** sp.Rational(-2, 3)
    second = (I**2 - squares) / 2
    stretch = fibre.dot(fibre)
    return energy.subs(
        {
            I_C: I,
            II_C: second,
            tr_C2: squares,
            J: volume,
            Ibar1: shear * I,
            Ibar2: shear**2 * second,
            I4: stretch,
            Ibar4: shear * stretch,
            tr_E: E.components.trace(),
            tr_E2: (E.components * E.components).trace(),
            tr_eps: eps.components.trace(),
            tr_eps2: (eps.components * eps.components).trace(),
        }
    )
