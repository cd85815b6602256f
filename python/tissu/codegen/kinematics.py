"""The invariants and tensors of F as assignments.

In: a Program. Out: names in it, made when first asked for.
"""

from __future__ import annotations

import sympy as sp

from tissu.codegen import vocabulary as words
from tissu.codegen.program import Program, cube_root
from tissu.codegen.vocabulary import Expr, a

F = words.F.components
dF = sp.Matrix(3, 3, sp.symbols("dF:3:3", real=True))
PAIRS = ((0, 1), (0, 2), (1, 2))


def symmetric(i: int, j: int) -> tuple[int, int]:
    """The entry of the upper triangle."""
    return (i, j) if i <= j else (j, i)


def cofactor(A: Expr, i: int, j: int) -> Expr:
    """Of one entry, with its sign."""
    i1, i2, j1, j2 = (i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3
    return A[i1, j1] * A[i2, j2] - A[i1, j2] * A[i2, j1]


def cofactor_change(i: int, j: int) -> Expr:
    """Its derivative along dF."""
    i1, i2, j1, j2 = (i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3
    return (
        dF[i1, j1] * F[i2, j2]
        + F[i1, j1] * dF[i2, j2]
        - dF[i1, j2] * F[i2, j1]
        - F[i1, j2] * dF[i2, j1]
    )


def matrix(entry: object) -> Expr:
    """3 x 3 from a function of (i, j)."""
    return sp.Matrix(3, 3, entry)


class Kinematics:
    """What laws read of F.

    Attributes:
        program: where the assignments go.
        with_C: C is at hand anyway, so traces come from it.
    """

    def __init__(self, program: Program, *, with_C: bool) -> None:
        self.program = program
        self.with_C = with_C

    def C(self) -> Expr:
        """F^T F."""
        for j in range(3):
            for k in range(j, 3):
                self.program.let(f"C{j}{k}", sum(F[i, j] * F[i, k] for i in range(3)))
        return matrix(lambda j, k: sp.Symbol("C{}{}".format(*symmetric(j, k)), real=True))

    def K(self) -> Expr:
        """The cofactors of F, dJ/dF."""
        return matrix(lambda i, j: self.program.let(f"K{i}{j}", cofactor(F, i, j)))

    def J(self) -> Expr:
        """The determinant of F."""
        K = self.K()
        return self.program.let("J", sum(F[0, j] * K[0, j] for j in range(3)))

    def f(self) -> Expr:
        """F a."""
        rows = [sum(F[i, j] * a[j] for j in range(3)) for i in range(3)]
        return [self.program.let(f"f{i}", row) for i, row in enumerate(rows)]

    def I_C(self) -> Expr:
        """Tr C."""
        if self.with_C:
            return self.program.let("I_C", self.C().trace())
        return self.program.let("I_C", sum(x**2 for x in F))

    def tr_C2(self) -> Expr:
        """Tr C^2."""
        C = self.C()
        off = self.program.let("off_diagonal", sum(C[i, j] ** 2 for i, j in PAIRS))
        return self.program.let("tr_C2", sum(C[i, i] ** 2 for i in range(3)) + 2 * off)

    def II_C(self) -> Expr:
        """The second invariant."""
        twice = self.program.let("twice_II_C", self.I_C() ** 2 - self.tr_C2())
        return self.program.let("II_C", twice / 2)

    def tr_E(self) -> Expr:
        """Tr E."""
        return self.program.let("tr_E", self.program.let("tr_2E", self.C().trace() - 3) / 2)

    def tr_E2(self) -> Expr:
        """Tr E^2, from C - I so that no digits are lost near rest."""
        C = self.C()
        e = [self.program.let(f"e{i}", C[i, i] - 1) for i in range(3)]
        on = self.program.let("on_diagonal", sum(x**2 for x in e))
        off = self.program.let("off_diagonal", sum(C[i, j] ** 2 for i, j in PAIRS))
        return self.program.let("tr_E2", on / 4 + off / 2)

    def J_23(self) -> Expr:
        """J^(-2/3)."""
        root = self.program.let("root", 1 / cube_root(self.J()))
        return self.program.let("J_23", root**2)

    def J_inv(self) -> Expr:
        """1/J, from the cube root where that is at hand."""
        if any(str(symbol) == "root" for symbol, _ in self.program.lets):
            return self.program.let("J_inv", sp.Symbol("root", real=True) * self.J_23())
        return self.program.let("J_inv", 1 / self.J())

    def Ibar1(self) -> Expr:
        """J^(-2/3) tr C."""
        return self.program.let("Ibar1", self.J_23() * self.I_C())

    def Ibar2(self) -> Expr:
        """J^(-4/3) II_C."""
        return self.program.let("Ibar2", self.J_23() ** 2 * self.II_C())

    def I4(self) -> Expr:
        """The squared stretch along the fibre."""
        return self.program.let("I4", sum(x**2 for x in self.f()))

    def Ibar4(self) -> Expr:
        """J^(-2/3) I4."""
        return self.program.let("Ibar4", self.J_23() * self.I4())

    def tr_eps(self) -> Expr:
        """The trace of eps."""
        return self.program.let("tr_eps", F.trace() - 3)

    def H(self) -> Expr:
        """2 eps."""
        return matrix(
            lambda i, j: (
                2 * (F[i, i] - 1)
                if i == j
                else self.program.let("H{}{}".format(*symmetric(i, j)), F[i, j] + F[j, i])
            )
        )

    def tr_eps2(self) -> Expr:
        """The trace of eps^2."""
        H = self.H()
        e = [self.program.let(f"e{i}", F[i, i] - 1) for i in range(3)]
        off = self.program.let("off_diagonal", sum(H[i, j] ** 2 for i, j in PAIRS))
        return self.program.let("tr_eps2", sum(x**2 for x in e) + off / 2)

    def require(self, expressions: list[Expr]) -> None:
        """Makes every invariant that the expressions read; the cube root before 1/J."""
        read = set().union(*(sp.sympify(e).free_symbols for e in expressions), set())
        names = sorted(map(str, read & INVARIANTS), key=lambda n: (n == "J_inv", n))
        for name in names:
            getattr(self, name)()


INVARIANTS = {
    words.I_C,
    words.II_C,
    words.J,
    words.Ibar1,
    words.Ibar2,
    words.Ibar4,
    words.I4,
    words.J_inv,
    words.J_23,
    words.tr_C2,
    words.tr_E,
    words.tr_E2,
    words.tr_eps,
    words.tr_eps2,
}
