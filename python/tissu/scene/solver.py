"""How the linear systems of a step are solved."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from tissu import units
from tissu.scene.field import field
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from tissu import _core

__all__ = ["Auto", "ConjugateGradient", "Cholesky"]

_Tolerance = Annotated[units.Pure, Field(gt=0.0, lt=1.0)]
_Count = Annotated[int, Field(ge=1)]
Preconditioner = Literal[
    "jacobi", "block_jacobi", "incomplete_cholesky", "stale_cholesky", "multigrid"
]
Precision = Literal["double", "single"]
Matrix = Literal["assembled", "free"]


class Solver(Part):
    """What all solvers share."""

    if TYPE_CHECKING:
        type: str

    def linear_solver(self, *, equilibrium: bool = False) -> _core.LinearSolver:
        """The core's solver of the same name, with the fields that are its own.

        Args:
            equilibrium: its step has no inertia.
        """
        from tissu import _core

        fields = {name: getattr(self, name) for name in type(self).model_fields if name != "type"}
        made: _core.LinearSolver = getattr(_core, type(self).__name__)(
            **fields, **self._of_step(equilibrium=equilibrium)
        )
        return made

    def _of_step(self, *, equilibrium: bool) -> dict[str, bool]:
        """What its step gives it to know."""
        return {}

    def words(self, _solves: str) -> str:
        """What a plan says of it; `_solves`: "few solves" or "many solves" of a run."""
        return f"step.solver is {self.type}"


class Auto(Solver):
    """The cheapest solver by counted work; the choice may change while a scene runs.

    Block-Jacobi, incomplete Cholesky, multigrid, a stale factor or a new one. It may change while
    the scene runs; `plan()` and `profile()` say to which, and by which counts.
    """

    type: Literal["auto"] = "auto"
    tolerance: _Tolerance = field(default=1e-5)
    """residual relative to the right-hand side at which iterations stop; its effect on the answer
    is measured in docs/measured/solvers.md"""

    def _of_step(self, *, equilibrium: bool) -> dict[str, bool]:
        return {"equilibrium": equilibrium}

    def words(self, solves: str) -> str:
        """What it begins with, and that it may change."""
        return (
            "step.solver is auto: it begins with what the first matrix makes cheapest for "
            f"{solves}, and changes where counted work says so"
        )


class ConjugateGradient(Solver):
    """Preconditioned conjugate gradient."""

    type: Literal["conjugate_gradient"] = "conjugate_gradient"
    tolerance: _Tolerance = field(default=1e-6)
    """residual relative to the right-hand side at which it stops"""
    iterations: _Count = 1000
    """largest number of iterations in a solve"""
    preconditioner: Preconditioner = "block_jacobi"
    """the diagonal, its 3x3 blocks, a factor without fill, the factor of an earlier matrix, or a
    multigrid of rigid aggregates"""
    precision: Precision = "double"
    """precision of the preconditioner, and of the iterations except with `multigrid`; the solution
    has the tolerance of double precision in any case"""
    matrix: Matrix = "assembled"
    """free: products of the forces themselves, without a matrix; with jacobi and block_jacobi"""

    def words(self, _solves: str) -> str:
        """The method and its preconditioner."""
        return (
            f"step.solver is conjugate_gradient with {self.preconditioner}, to {self.tolerance:g}"
        )

    @rule("matrix")
    def _free_is_simple(self) -> Iterator[Problem]:
        if self.matrix != "free":
            return
        if self.preconditioner not in ("jacobi", "block_jacobi"):
            text = f"found {self.preconditioner} with matrix free; it is made of a matrix: "
            yield Problem(("preconditioner",), text + "jacobi and block_jacobi are accepted")
        if self.precision == "single":
            text = "found single with matrix free; the products of forces are double: "
            yield Problem(("precision",), text + "double is accepted")


class Cholesky(Solver):
    """Sparse Cholesky factorisation (CHOLMOD); its symbolic part is kept with the mesh."""

    type: Literal["cholesky"] = "cholesky"


SOLVERS: tuple[type[Solver], ...] = (ConjugateGradient, Cholesky, Auto)


def _by_type(value: Any) -> Any:
    """A solver with its own settings may be named alone: `solver: auto`."""
    return {"type": value} if isinstance(value, str) else value


OneSolver = Annotated[Solver, one_of(*SOLVERS), BeforeValidator(_by_type)]
