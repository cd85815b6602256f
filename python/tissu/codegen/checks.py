"""What is refused at definition: a loaded rest, a law that sees rotations, a wrong limit.

In: a Law. Out: nothing, or a LawError with the reason. Numerical: with the typical parameters, on
the very assignments that are printed as C++.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tissu.codegen import kernels
from tissu.codegen.definition import Law
from tissu.codegen.program import Program
from tissu.errors import LawError

Matrix = NDArray[np.float64]
TOLERANCE = 1e-9  # of the stiffness: round-off is 1e-15, a forgotten term is of order one


class Point:
    """A law with its typical parameters at one material point."""

    def __init__(self, law: Law) -> None:
        self.constants = law.constant_values({p.name: p.typical for p in law.parameters})
        self.programs: dict[str, Program] = {
            "energy": kernels.energy(law.energy),
            "stress": kernels.stress(law.energy),
            "stress_change": kernels.stress_change(law.energy),
            "tangent": kernels.tangent(law.energy),
        }

    def values(self, question: str, F: Matrix, dF: Matrix | None = None) -> list[float]:
        """The outputs of one question."""
        numbers = {f"F{i}{j}": float(F[i, j]) for i in range(3) for j in range(3)}
        if dF is not None:
            numbers |= {f"dF{i}{j}": float(dF[i, j]) for i in range(3) for j in range(3)}
        return list(self.programs[question].evaluate(numbers | self.constants).values())

    def energy(self, F: Matrix) -> float:
        """The energy W."""
        return self.values("energy", F)[0]

    def stress(self, F: Matrix) -> Matrix:
        """The stress P, (3, 3)."""
        return np.reshape(self.values("stress", F), (3, 3))

    def stress_change(self, F: Matrix, dF: Matrix) -> Matrix:
        """Its change along dF, (3, 3)."""
        return np.reshape(self.values("stress_change", F, dF), (3, 3))

    def tangent(self, F: Matrix) -> Matrix:
        """The tangent dP/dF, (9, 9), row 3 i + J."""
        full = np.zeros((9, 9))
        full[np.triu_indices(9)] = self.values("tangent", F)
        return full + np.triu(full, 1).T


def random_rotation(generator: np.random.Generator) -> Matrix:
    """A rotation, any direction and angle."""
    Q, R = np.linalg.qr(generator.normal(size=(3, 3)))
    Q = Q * np.sign(np.diag(R))
    return np.asarray(Q * np.linalg.det(Q))


def check_law(law: Law) -> None:
    """Refuses a law that is not one.

    Raises:
        LawError: energy or stress at rest, dependence on rotation, or another limit of small strain
            than the file states.
    """
    point = Point(law)
    # Stretched a little along each axis in turn: a fibre is slack in some directions.
    states = [np.eye(3) + 0.05 * np.diag(axis) for axis in np.eye(3)]
    scale = max(abs(point.tangent(F)).max() for F in states)
    if not 0.0 < scale < np.inf:
        raise LawError(f"{law.name}: the tangent near rest is {scale:g} Pa; nothing resists there.")
    _check_rest(law, point, scale)
    _check_rotation(law, point, scale)
    _check_small_strain(law, point, scale)


def _check_rest(law: Law, point: Point, scale: float) -> None:
    W = point.energy(np.eye(3))
    if not abs(W) <= TOLERANCE * scale:
        raise LawError(f"{law.name}: the energy at rest is {W:.6g} J/m3; subtract it.")
    P = point.stress(np.eye(3))
    if not abs(P).max() <= TOLERANCE * scale:
        worst = P.flat[int(np.argmax(np.nan_to_num(abs(P), nan=np.inf)))]
        raise LawError(
            f"{law.name}: the stress at rest is {worst:.6g} Pa; it must vanish at F = I."
        )


def _check_rotation(law: Law, point: Point, scale: float) -> None:
    generator = np.random.default_rng(1)
    worst = 0.0
    for _ in range(5):
        F = np.eye(3) + generator.uniform(-0.2, 0.2, (3, 3))
        Q = random_rotation(generator)
        worst = max(worst, abs(point.energy(Q @ F) - point.energy(F)) / scale)
    if law.frame_invariant and not worst <= TOLERANCE:
        raise LawError(
            f"{law.name}: the energy changes when the body turns, by {worst:.2g} of the "
            "stiffness; write it in C, E or their invariants, or declare it as not frame-invariant."
        )
    if not law.frame_invariant and worst <= TOLERANCE:
        raise LawError(f"{law.name}: it is frame-invariant; do not declare the opposite.")


def _check_small_strain(law: Law, point: Point, scale: float) -> None:
    if law.small_strain is None:
        return
    import sympy as sp

    table = {sp.Symbol(name, real=True): value for name, value in point.constants.items()}
    lam, mu = (float(sp.sympify(e).subs(table)) for e in law.small_strain)
    d = np.eye(3)
    hooke = lam * np.einsum("iJ,kL->iJkL", d, d)
    hooke += mu * (np.einsum("ik,JL->iJkL", d, d) + np.einsum("iL,Jk->iJkL", d, d))
    found = point.tangent(np.eye(3))
    if abs(found - hooke.reshape(9, 9)).max() > TOLERANCE * scale:
        real_mu, real_lam = found[1, 1], found[0, 4]
        raise LawError(
            f"{law.name}: SMALL_STRAIN gives lambda = {lam:.6g}, mu = {mu:.6g}, but the tangent at "
            f"rest has {real_lam:.6g}, {real_mu:.6g}; state those."
        )
