"""Which linear solver `auto` stands for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from tissu.counted import counted
from tissu.scene.solver import Auto, Cholesky, ConjugateGradient
from tissu.scene.step import Static

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.scene.solver import Solver

# Where one overtakes another, in unknowns, on one core: see docs/solvers.md.
DIRECT_STATIC = 10_000
"""up to it, the factor of a static system takes some tenths of a second, however ill-conditioned"""
PLAIN_STEP = 3_000
"""up to it, block-Jacobi solves a step with inertia before incomplete Cholesky is prepared"""
MANY_STEP = 50_000
"""beyond it, the iterations that a multigrid saves in a step with inertia pay for its cycles"""


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
        editing: cells are removed while it runs, after which a factor is ordered anew.
    """
    size = counted(unknowns, "unknown")
    if static and not editing and unknowns <= DIRECT_STATIC:
        why = f"cholesky, since up to {DIRECT_STATIC} unknowns without inertia a factor is cheap "
        return Choice(Cholesky(), f"{why}and no condition slows it down ({size})")
    solver = ConjugateGradient(tolerance=auto.tolerance, iterations=10_000)
    if not static and unknowns <= PLAIN_STEP:
        why = f"conjugate_gradient with block_jacobi, since up to {PLAIN_STEP} unknowns with "
        return Choice(solver, f"{why}inertia its few iterations need nothing prepared ({size})")
    kind = "without inertia" if static else "with inertia"
    least = DIRECT_STATIC if static else MANY_STEP
    if not editing and unknowns > least:
        why = f"conjugate_gradient with multigrid, since beyond {least} unknowns {kind} only its "
        why += f"iterations do not grow with the mesh ({size})"
        return Choice(solver.replace(preconditioner="multigrid"), why)
    why = "conjugate_gradient with incomplete_cholesky, since it takes several times fewer "
    if static and unknowns <= DIRECT_STATIC:
        why = "conjugate_gradient with incomplete_cholesky, since editing would order a factor "
        why += f"anew after each cut ({size})"
    else:
        why += f"iterations than block_jacobi {kind} ({size})"
    return Choice(solver.replace(preconditioner="incomplete_cholesky"), why)


def choice_of(prepared: Prepared) -> Choice | None:
    """What the scene's solver `auto` stands for; None where the scene names another."""
    scene = prepared.scene
    auto = getattr(scene.step, "solver", None)
    if not isinstance(auto, Auto):
        return None
    nodes = sum(
        body.mesh.node_count * (2 if prepared.has_rotations(name) else 1)
        for name, body in prepared.bodies.items()
    )
    nodes += sum(2 * tissue.mesh.node_count for tissue in prepared.tissue.values())
    static = isinstance(scene.step, Static)
    return choice_for(auto, unknowns=3 * nodes, static=static, editing=scene.editing)


def chosen_solver(prepared: Prepared) -> Solver | None:
    """The scene's solver, chosen where it is `auto`; None for steps that solve no system."""
    choice = choice_of(prepared)
    if choice is not None:
        return choice.solver
    solver: Solver | None = getattr(prepared.scene.step, "solver", None)
    return solver
