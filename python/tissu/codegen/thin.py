"""The four questions for pieces of fewer than three dimensions: sheets (m = 2) and lines (m = 1).

In: an energy in the traces of E, or of eps. Out: Programs with F of 3 x m, in axes whose first m
lie in the piece. The same formula serves every m: tr(E) is taken over m dimensions, and lambda is
that of a piece of m dimensions (see the laying of constants).
"""

from __future__ import annotations

from functools import cache
from typing import Any

import sympy as sp

from tissu.codegen import vocabulary as words
from tissu.codegen.kinematics import dF as all_dF
from tissu.codegen.program import Program
from tissu.codegen.vocabulary import Expr, tr_E, tr_E2, tr_eps, tr_eps2

_OF_E, _OF_EPS = (tr_E, tr_E2), (tr_eps, tr_eps2)
_WORDS = {str(s) for s in (*_OF_E, *_OF_EPS)}


def traces(W: Expr, constants: set[str]) -> tuple[Expr, Expr] | None:
    """The two traces that W is written in, or None when it needs three dimensions."""
    read = {str(s) for s in W.free_symbols} - constants
    for pair in (_OF_E, _OF_EPS):
        if read <= {str(s) for s in pair}:
            return pair
    return None


class _Thin:
    """F, the strain and the weights of the strain in the stress, as assignments."""

    def __init__(self, W: Expr, pair: tuple[Expr, Expr], m: int) -> None:
        self.m, self.W, self.pair = m, W, pair
        self.large = pair == _OF_E
        self.program = Program()
        self.F = words.F.components[:, :m]
        self.dF = all_dF[:, :m]
        self.e = self._strain()
        self.program.lets += [(pair[0], self.e.trace()), (pair[1], sum(x**2 for x in self.e))]
        first = self.program.share({"W_1": sp.diff(W, pair[0]), "W_2": sp.diff(W, pair[1])})
        self.p, self.q = first["W_1"], 2 * first["W_2"]

    def _strain(self) -> Expr:
        m, F, let = self.m, self.F, self.program.let
        if not self.large:
            off = {(i, j): let(f"e{i}{j}", (F[i, j] + F[j, i]) / 2) for i, j in _pairs(m)}
        else:
            off = {(i, j): let(f"e{i}{j}", F[:, i].dot(F[:, j]) / 2) for i, j in _pairs(m)}
        on = {
            i: let(f"e{i}{i}", (F[:, i].dot(F[:, i]) - 1) / 2 if self.large else F[i, i] - 1)
            for i in range(m)
        }
        return _symmetric(m, on, off)

    def S(self) -> Expr:
        """W_1 I + 2 W_2 e."""
        return self.named("S", self.p * sp.eye(self.m) + self.q * self.e)

    def dS(self) -> Expr:
        """Its change for dF."""
        m, let, pair = self.m, self.program.let, self.pair
        if self.large:
            D = self.F.T * self.dF
            D = sp.Matrix(m, m, lambda i, j: let(f"D{i}{j}", D[i, j]))
            de = (D + D.T) / 2
        else:
            de = sp.Matrix(m, m, lambda i, j: (self.dF[i, j] + self.dF[j, i]) / 2)
        de = self.named("de", de)
        along = [let("along_1", de.trace()), let("along_2", 2 * _dot(self.e, de))]
        slopes = [
            sum(sp.diff(self.W, t, u) * d for u, d in zip(pair, along, strict=True)) for t in pair
        ]
        dp, dq = (let(f"dW_{i}", slope) for i, slope in enumerate(slopes, start=1))
        return self.named("T", dp * sp.eye(m) + 2 * dq * self.e + self.q * de)

    def named(self, name: str, entry: Expr) -> Expr:
        """Names for the entries of a symmetric matrix."""
        let, m = self.program.let, self.m
        on = {i: let(f"{name}{i}{i}", entry[i, i]) for i in range(m)}
        off = {(i, j): let(f"{name}{i}{j}", entry[i, j]) for i, j in _pairs(m)}
        return _symmetric(m, on, off)

    def in_space(self, S: Expr) -> Expr:
        """A stress in the piece as a P of 3 x m, for small strain."""
        return sp.Matrix(3, self.m, lambda i, j: S[i, j] if i < self.m else 0)


def _pairs(m: int) -> list[tuple[int, int]]:
    return [(i, j) for i in range(m) for j in range(i + 1, m)]


def _symmetric(m: int, on: dict[int, Expr], off: dict[tuple[int, int], Expr]) -> Any:
    return sp.Matrix(m, m, lambda i, j: on[i] if i == j else off[min(i, j), max(i, j)])


def _dot(A: Expr, B: Expr) -> Expr:
    return sum(x * y for x, y in zip(A, B, strict=True))


def _finished(program: Program, outputs: dict[str, Expr]) -> Program:
    program.outputs = outputs
    return program.pruned()


def _energy(made: _Thin) -> Program:
    shared = made.program.share({"W": made.W})
    return _finished(made.program, {"W": shared["W"]})


def _entries(name: str, P: Expr) -> dict[str, Expr]:
    return {f"{name}({i}, {j})": P[i, j] for i in range(P.rows) for j in range(P.cols)}


def _stress(made: _Thin) -> Program:
    P = made.F * made.S() if made.large else made.in_space(made.S())
    return _finished(made.program, _entries("P", P))


def _stress_change(made: _Thin) -> Program:
    if made.large:
        S = made.S()
        dP = made.dF * S + made.F * made.dS()
    else:
        dP = made.in_space(made.dS())
    return _finished(made.program, _entries("dP", dP))


def _tangent(made: _Thin) -> Program:
    """A_iJkL: for each F_kL the change of P along it, for one entry after the other."""
    m, F, W, pair = made.m, made.F, made.W, made.pair
    S, e = made.S(), made.e
    second = made.program.share(
        {f"W_{i}{j}": sp.diff(W, pair[i - 1], pair[j - 1]) for i, j in ((1, 1), (1, 2), (2, 2))}
    )
    w11, w12, w22 = (second[f"W_{k}"] for k in ("11", "12", "22"))
    let = made.program.let
    B = F if made.large else sp.Matrix(3, m, lambda i, j: int(i == j))  # d tr e / dF
    G = (F if made.large else B) * e
    G = sp.Matrix(3, m, lambda i, j: let(f"G{i}{j}", G[i, j]))  # d tr e^2 / dF, halved
    half = let("half_q", made.q / 2)
    outputs: dict[str, Expr] = {}
    entries = [(i, J) for i in range(3) for J in range(m)]
    if made.large:
        FF = made.F * made.F.T
        b = {(i, k): let(f"b{i}{k}", half * FF[i, k]) for i in range(3) for k in range(i, 3)}
    for row, (i, J) in enumerate(entries):
        for k, L in entries[row:]:
            entry = (
                w11 * B[i, J] * B[k, L]
                + 2 * w12 * (B[i, J] * G[k, L] + G[i, J] * B[k, L])
                + 4 * w22 * G[i, J] * G[k, L]
            )
            if made.large:
                entry += (S[J, L] if i == k else 0) + half * F[i, L] * F[k, J]
                entry += b[min(i, k), max(i, k)] if J == L else 0
            elif max(i, k) < m:
                entry += half * (int(i == k and J == L) + int(i == L and k == J))
            outputs[f"A({i}, {J}, {k}, {L})"] = sp.sympify(entry)
    return _finished(made.program, outputs)


_QUESTIONS = {
    "energy": _energy,
    "stress": _stress,
    "stress_change": _stress_change,
    "tangent": _tangent,
}


@cache
def programs(W: Expr, constants: frozenset[str], m: int) -> dict[str, Program]:
    """The four programs for m dimensions; none when the energy needs three."""
    pair = traces(W, set(constants))
    if pair is None:
        return {}
    return {name: make(_Thin(W, pair, m)) for name, make in _QUESTIONS.items()}
