"""A scene's linear solver as the core's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tissu.scene.solver import ConjugateGradient

if TYPE_CHECKING:
    from tissu.scene.solver import Solver


def solver_of(solver: Solver) -> Any:
    """The core's linear solver."""
    from tissu import _core

    if isinstance(solver, ConjugateGradient):
        return _core.ConjugateGradient(tolerance=solver.tolerance, iterations=solver.iterations)
    return _core.Cholesky()
