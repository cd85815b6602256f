"""A scene's linear solver as the core's, and which one `auto` stands for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from tissu.counted import counted
from tissu.scene.solver import Auto, Cholesky, ConjugateGradient
from tissu.scene.step import Static

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.scene.solver import Solver

# Where one overtakes another, in unknowns: from docs/solvers.md, on one core.
DIRECT_STATIC = 60_000
"""below it, a factor costs less than the iterations of a static system"""
DIRECT_STEP = 1_500
"""below it, a factor costs less than the iterations of a step with inertia"""


@dataclass(frozen=True, slots=True)
class Choice:
    """What `auto` stands for, and why in a sentence."""

    solver: ConjugateGradient | Cholesky
    why: str


def choice_for(auto: Auto, *, unknowns: int, static: bool, editing: bool) -> Choice:
    """The solver for a scene.

    Args:
        auto: the solver of the scene.
        unknowns: numbers that a step solves for.
        static: without inertia, so that the system is far from diagonal.
        editing: cells are removed while it runs, which makes a factor worthless.
    """
    size = counted(unknowns, "unknown")
    kind = "without inertia" if static else "with inertia"
    limit = DIRECT_STATIC if static else DIRECT_STEP
    if unknowns <= limit and not (editing and not static):
        why = f"cholesky, since at most {limit:,} unknowns {kind} are solved fastest by a factor"
        return Choice(Cholesky(), f"{why} ({size})")
    if static:
        why = "conjugate_gradient with incomplete_cholesky, since without inertia it takes the "
        why += f"fewest operations above {limit:,} unknowns"
        solver = ConjugateGradient(
            tolerance=auto.tolerance, iterations=10_000, preconditioner="incomplete_cholesky"
        )
        return Choice(solver, f"{why} ({size})")
    why = "conjugate_gradient with block_jacobi, since inertia keeps its iterations few"
    if editing and unknowns <= limit:
        why += " and editing would make a factor worthless"
    solver = ConjugateGradient(tolerance=auto.tolerance, iterations=10_000)
    return Choice(solver, f"{why} ({size})")


def choice_of(prepared: Prepared) -> Choice | None:
    """What the scene's solver `auto` stands for; None where the scene names another."""
    scene = prepared.scene
    auto = getattr(scene.step, "solver", None)
    if not isinstance(auto, Auto):
        return None
    nodes = sum(body.mesh.node_count for body in prepared.bodies.values())
    static = isinstance(scene.step, Static)
    return choice_for(auto, unknowns=3 * nodes, static=static, editing=scene.editing)


def chosen_solver(prepared: Prepared) -> ConjugateGradient | Cholesky | None:
    """The scene's solver, chosen where it is `auto`; None for steps that solve no system."""
    choice = choice_of(prepared)
    if choice is not None:
        return choice.solver
    solver: ConjugateGradient | Cholesky | None = getattr(prepared.scene.step, "solver", None)
    return solver


def solver_of(solver: Solver) -> Any:
    """The core's linear solver.

    Raises:
        TypeError: `auto`, which `choice_for` has to replace first.
    """
    from tissu import _core

    if isinstance(solver, ConjugateGradient):
        return _core.ConjugateGradient(
            tolerance=solver.tolerance,
            iterations=solver.iterations,
            preconditioner=solver.preconditioner,
            precision=solver.precision,
            matrix=solver.matrix,
        )
    if isinstance(solver, Auto):
        raise TypeError("`auto` stands for a solver that choice_for chooses")
    return _core.Cholesky()
