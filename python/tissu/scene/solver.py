"""How the linear systems of a step are solved."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from tissu import units
from tissu.scene.part import Part, one_of

_Tolerance = Annotated[units.Pure, Field(gt=0.0, lt=1.0)]
_Count = Annotated[int, Field(ge=1)]


class ConjugateGradient(Part):
    """Conjugate gradient with block-Jacobi preconditioner."""

    type: Literal["conjugate_gradient"] = "conjugate_gradient"
    tolerance: _Tolerance = 1e-6
    """residual relative to the right-hand side at which it stops"""
    iterations: _Count = 1000
    """largest number of iterations in a solve"""

    if TYPE_CHECKING:

        def __init__(self, *, tolerance: units.Number = ..., iterations: int = ...) -> None: ...


class Cholesky(Part):
    """Sparse Cholesky factorisation (CHOLMOD)."""

    type: Literal["cholesky"] = "cholesky"


Solver = ConjugateGradient | Cholesky
OneSolver = Annotated[Solver, one_of(ConjugateGradient, Cholesky)]
