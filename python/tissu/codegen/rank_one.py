"""sum_bc M_bc B_b (x) B_c, the part of a tangent that couples everything with everything.

In: a Builder with names for M. Out: the 45 entries. Where p_FC is there, the entries with i = k or
J = L take its term p_FC F_iL F_kJ = p_FC F_iJ F_kL along.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import sympy as sp

from tissu.codegen.derive import TENSORS
from tissu.codegen.kinematics import matrix
from tissu.codegen.vocabulary import Expr

if TYPE_CHECKING:
    from tissu.codegen.kernels import Builder

Table = dict[tuple[int, int], Expr]
UPPER = [(row, column) for row in range(9) for column in range(row, 9)]


def _flat(A: Expr) -> list[Expr]:
    return list(A)


def _scaled(made: Builder, name: str, weights: dict[str, Expr]) -> list[Expr]:
    """Names for sum_c weights_c B_c."""
    total = sp.zeros(3, 3)
    for tensor, weight in weights.items():
        total += weight * made.tensor(tensor)
    return _flat(matrix(lambda i, j: made.program.let(f"{name}{i}{j}", total[i, j])))


def add_rank_one(made: Builder, *, by_row: bool) -> Table:
    """The entries of the upper triangle.

    by_row: sum_b B_b (x) (sum_c M_bc B_c). Else each tensor but F is paired with everything left:
    K (x) Q + Q (x) K, Q = sum_c M_Kc B_c + M_KK K / 2, which leaves F (x) F alone with the term of
    p_FC.
    """
    table: Table = dict.fromkeys(UPPER, sp.Integer(0))
    merged = not by_row or set(made.M) <= {("F", "F")}
    left = [b for b in reversed(TENSORS) if any(row == b for row, _ in made.M)]
    if "FC" in made.p and "F" not in left:
        left.append("F")
    for b in list(left):
        row = {c: m for (r, c), m in made.M.items() if r == b and (by_row or c in left)}
        if by_row or b == "F" or set(row) <= {b}:
            _outer(made, table, b, row, merged=merged)
        elif row:
            _paired(made, table, b, row)
        if not by_row:
            left.remove(b)
    if "FC" in made.p and not merged:
        _swapped(made, table)
    return table


def _outer(made: Builder, table: Table, b: str, row: dict[str, Expr], *, merged: bool) -> None:
    """B_b (x) sum_c M_bc B_c; for F with the term of p_FC where that has the same product."""
    B, R = _flat(made.tensor(b)), _scaled(made, f"r_{b}_", row)
    both = R
    if b == "F" and merged and "FC" in made.p:
        total = made.program.let("m_F_F_p_FC", row.get("F", 0) + made.p["FC"])
        both = _scaled(made, "rb_F_", {"F": total})
    for r, c in UPPER:
        same = r // 3 == c // 3 or r % 3 == c % 3
        table[r, c] += (both if same else R)[r] * B[c]


def _paired(made: Builder, table: Table, b: str, row: dict[str, Expr]) -> None:
    half = {c: made.program.let(f"half_m_{b}_{b}", m / 2) if c == b else m for c, m in row.items()}
    B, Q = _flat(made.tensor(b)), _scaled(made, f"q_{b}_", half)
    for r, c in UPPER:
        table[r, c] += 2 * B[r] * Q[r] if r == c else B[r] * Q[c] + Q[r] * B[c]


def _swapped(made: Builder, table: Table) -> None:
    """p_FC F_iL F_kJ of the entries with i = k or J = L."""
    F, bF = _flat(made.tensor("F")), _scaled(made, "bF", {"F": made.p["FC"]})
    for r, c in UPPER:
        if r // 3 == c // 3 or r % 3 == c % 3:
            table[r, c] += bF[r] * F[c]
