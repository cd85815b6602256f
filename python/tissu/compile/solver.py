"""What `plan()` and `check` say of the solver `auto` before it has met a matrix."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.scene.solver import Auto
from tissu.scene.step import Static

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared


def said_of(prepared: Prepared) -> list[str]:
    """A note on the solver of a scene, where it is `auto`."""
    step = prepared.scene.step
    solver = getattr(step, "solver", None)
    if not isinstance(solver, Auto):
        return []
    few = "few solves" if isinstance(step, Static) else "many solves"
    return [
        f"step.solver: auto begins with what the first matrix makes cheapest, for {few} with one "
        "preparation, and changes where counted work says so; plan() and profile() say to what"
    ]
