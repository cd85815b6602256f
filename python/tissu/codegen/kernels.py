"""The four questions a law answers, as lists of assignments. In: an energy W. Out: Programs.

Each builds P = F (p_F I + p_FC C) + p_K K + p_N (F a) (x) a + p_I I + p_H H and its derivatives
(see derive.py) entry by entry, without expanding anything.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import sympy as sp

from tissu.codegen import derive
from tissu.codegen.derive import TENSORS, Weights
from tissu.codegen.kinematics import (
    F,
    Kinematics,
    cofactor_change,
    dF,
    matrix,
    symmetric,
)
from tissu.codegen.program import Program
from tissu.codegen.rank_one import add_rank_one
from tissu.codegen.vocabulary import II_C, Expr, Ibar2, a, tr_C2, tr_E, tr_E2

ENTRIES = [(i, j) for i in range(3) for j in range(3)]


class Builder:
    """A Program under construction with the law's weights as names in it.

    Attributes:
        program: the assignments so far.
        state: the invariants and tensors of F.
        p: weight of each tensor in the stress.
        M: weight of each pair of tensors in the tangent.
    """

    def __init__(self, weights: Weights, *, second: bool) -> None:
        self.program = Program()
        self.state = Kinematics(self.program, with_C="FC" in weights.p)
        named: dict[str, Expr] = {f"p_{b}": e for b, e in weights.p.items()}
        pairs = [(b, c) for b in TENSORS for c in TENSORS if (b, c) in weights.M]
        upper = [(b, c) for b, c in pairs if TENSORS.index(b) <= TENSORS.index(c)]
        if second:
            named |= {f"m_{b}_{c}": weights.M[b, c] for b, c in upper}
        self.state.require(list(named.values()))
        shared = self.program.share(named)
        self.p: dict[str, Expr] = {b: shared[f"p_{b}"] for b in weights.p}
        self.M: dict[tuple[str, str], Expr] = {}
        for b, c in upper if second else ():
            self.M[b, c] = self.M[c, b] = shared[f"m_{b}_{c}"]

    def symmetric(self, name: str, entry: Expr) -> Expr:
        """Names for the six entries of a symmetric matrix."""
        return matrix(
            lambda i, j: self.program.let(f"{name}{min(i, j)}{max(i, j)}", entry[symmetric(i, j)])
        )

    def S(self) -> Expr:
        """p_F I + p_FC C: a matrix of names, or a multiple of I."""
        p_F = self.p.get("F", sp.Integer(0))
        if "FC" not in self.p:
            return p_F * sp.eye(3)
        return self.symmetric("S", p_F * sp.eye(3) + self.p["FC"] * self.state.C())

    def tensor(self, name: str) -> Expr:
        """The entries of one of the tensors."""
        if name == "F":
            return F
        if name == "I":
            return sp.eye(3)
        if name == "FC":
            C = self.state.C()
            return matrix(lambda i, j: self.program.let(f"FC{i}{j}", (F * C)[i, j]))
        if name == "N":
            f = self.state.f()
            return matrix(lambda i, j: self.program.let(f"N{i}{j}", f[i] * a[j]))
        return self.state.K() if name == "K" else self.state.H()

    def finished(self, outputs: Mapping[str, Expr]) -> Program:
        """The Program with its outputs."""
        self.program.outputs = dict(outputs)
        return self.program.pruned()


@cache
def energy(W: Expr) -> Program:
    """The energy W."""
    if derive.has_components(W):
        return _direct({"W": derive.in_components(W)})
    program = Program()
    Kinematics(program, with_C=bool(W.free_symbols & set(_C_WORDS))).require([W])
    program.outputs = {"W": program.share({"W": W})["W"]}
    return program.pruned()


_C_WORDS = (II_C, Ibar2, tr_C2, tr_E, tr_E2)


@cache
def stress(W: Expr) -> Program:
    """The stress P = dW/dF."""
    if derive.has_components(W):
        W = derive.in_components(W)
        return _direct({f"P({i}, {j})": sp.diff(W, F[i, j]) for i, j in ENTRIES})
    made = Builder(derive.weights(W), second=False)
    P = F * made.S()
    if "N" in made.p:
        f = [made.program.let(f"g{i}", made.p["N"] * f_i) for i, f_i in enumerate(made.state.f())]
        P += matrix(lambda i, j: f[i] * a[j])
    for name in ("K", "I", "H"):
        if name in made.p:
            P += made.p[name] * made.tensor(name)
    return made.finished({f"P({i}, {j})": P[i, j] for i, j in ENTRIES})


@cache
def stress_change(W: Expr) -> Program:
    """The change of stress dP/dF : dF."""
    if derive.has_components(W):
        W = derive.in_components(W)
        P = {(i, j): sp.diff(W, F[i, j]) for i, j in ENTRIES}
        along = {at: sum(sp.diff(P[at], F[kl]) * dF[kl] for kl in ENTRIES) for at in ENTRIES}
        return _direct({f"dP({i}, {j})": along[i, j] for i, j in ENTRIES})
    made = Builder(derive.weights(W), second=True)
    dP = dF * made.S()
    if "FC" in made.p:  # named before D and T are, so that fewer numbers are alive at a time
        first = dP
        dP = matrix(lambda i, j: made.program.let(f"Q{i}{j}", first[i, j]))
    slope = _weight_changes(made)
    dP += F * _second_stress_change(made, slope)
    if "N" in made.p:
        f, p_N = made.state.f(), made.p["N"]
        df = _df(made)
        g = [made.program.let(f"dg{i}", p_N * df[i] + slope["N"] * f[i]) for i in range(3)]
        dP += matrix(lambda i, j: g[i] * a[j])
    if "K" in made.p:
        dK = matrix(lambda i, j: made.program.let(f"dK{i}{j}", cofactor_change(i, j)))
        dP += made.p["K"] * dK + slope["K"] * made.tensor("K")
    if "I" in made.p:
        dP += slope["I"] * sp.eye(3)
    if "H" in made.p:
        dH = matrix(lambda i, j: made.program.let(f"dH{min(i, j)}{max(i, j)}", dF[i, j] + dF[j, i]))
        dP += made.p["H"] * dH + slope["H"] * made.tensor("H")
    return made.finished({f"dP({i}, {j})": dP[i, j] for i, j in ENTRIES})


def _df(made: Builder) -> list[Expr]:
    rows = [sum(dF[i, j] * a[j] for j in range(3)) for i in range(3)]
    return [made.program.let(f"df{i}", row) for i, row in enumerate(rows)]


def _D(made: Builder) -> Expr:
    """F^T dF."""
    D = F.T * dF
    return matrix(lambda i, j: made.program.let(f"D{i}{j}", D[i, j]))


def _weight_changes(made: Builder) -> dict[str, Expr]:
    """The change of each weight, sum_c M_bc (B_c : dF)."""
    along: dict[str, Expr] = {}
    for name in sorted({c for _, c in made.M}):
        if name == "FC":
            C, D = made.state.C(), _D(made)
            full = sum(
                C[i, j] * (D[i, j] if i == j else D[i, j] + D[j, i]) for i, j in ENTRIES if i <= j
            )
        elif name == "F" and "FC" in made.p:
            full = _D(made).trace()
        elif name == "N":
            full = sum(x * y for x, y in zip(made.state.f(), _df(made), strict=True))
        else:
            tensor = made.tensor(name)
            full = sum(tensor[i, j] * dF[i, j] for i, j in ENTRIES)
        along[name] = made.program.let(f"along_{name}", full)
    changes = {}
    for b in TENSORS:
        total = sum(m * along[c] for (row, c), m in made.M.items() if row == b)
        changes[b] = made.program.let(f"dp_{b}", total)
    return changes


def _second_stress_change(made: Builder, slope: Mapping[str, Expr]) -> Expr:
    """dp_F I + dp_FC C + p_FC (D + D^T)."""
    if "FC" not in made.p:
        return slope["F"] * sp.eye(3)
    D, C = _D(made), made.state.C()
    twice = made.program.let("twice_p_FC", 2 * made.p["FC"])
    change = matrix(
        lambda i, j: (
            twice * D[i, i]
            if i == j
            else made.p["FC"] * made.program.let(f"D{min(i, j)}{max(i, j)}s", D[i, j] + D[j, i])
        )
    )
    return made.symmetric("T", slope["F"] * sp.eye(3) + slope["FC"] * C + change)


@cache
def tangent(W: Expr) -> Program:
    """The upper triangle of dP/dF; of the ways to sum the rank-one terms, the cheaper."""
    if derive.has_components(W):
        W = derive.in_components(W)
        entries = [F[i, j] for i, j in ENTRIES]
        second = {(r, c): sp.diff(W, entries[r], entries[c]) for r in range(9) for c in range(r, 9)}
        return _direct({_entry(r, c): e for (r, c), e in second.items()})
    weights = derive.weights(W)
    made = [_tangent(weights, by_row=by_row) for by_row in (False, True)]
    return min(made, key=lambda program: program.count().cost)


def _entry(row: int, column: int) -> str:
    i, J, k, L = row // 3, row % 3, column // 3, column % 3
    return f"A({i}, {J}, {k}, {L})"


def _tangent(weights: Weights, *, by_row: bool) -> Program:
    made = Builder(weights, second=True)
    terms = add_rank_one(made, by_row=by_row)
    T = made.S()
    if "N" in made.p:
        pa = [made.program.let(f"pa{i}", made.p["N"] * a[i]) for i in range(3)]
        T = made.symmetric("T", T + matrix(lambda i, j: pa[i] * a[j]))
    bF = B = None
    if "FC" in made.p:
        bF = matrix(lambda i, j: made.program.let(f"bF{i}{j}", made.p["FC"] * F[i, j]))
        B = made.symmetric("B", bF * F.T)
    kF = matrix(lambda i, j: made.program.let(f"kF{i}{j}", made.p.get("K", 0) * F[i, j]))
    outputs = {}
    for row in range(9):
        for column in range(row, 9):
            (i, J), (k, L) = divmod(row, 3), divmod(column, 3)
            entry = terms[row, column] + (T[J, L] if i == k else 0)
            if B is not None and bF is not None:
                entry += B[i, k] if J == L else 0
                entry += bF[i, L] * F[k, J] if i != k and J != L else 0
            if i != k and J != L:  # d2J = eps_ikm eps_JLN F_mN
                m, N = 3 - i - k, 3 - J - L
                sign = _sign(i, k) * _sign(J, L)
                entry += sign * kF[m, N]
            if "H" in made.p:
                entry += made.p["H"] * (int(i == k and J == L) + int(i == L and k == J))
            outputs[_entry(row, column)] = entry
    return made.finished(outputs)


def _sign(i: int, k: int) -> int:
    """eps_ikm of the third index m."""
    return 1 if (k - i) % 3 == 1 else -1


def _direct(outputs: Mapping[str, Expr]) -> Program:
    """An energy in components of F, as it stands."""
    program = Program()
    named = {f"entry{number}": e for number, e in enumerate(outputs.values())}
    shared = program.share(named, rewrite=False)
    program.outputs = dict(zip(outputs, shared.values(), strict=True))
    return program.pruned()
