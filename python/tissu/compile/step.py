"""A scene's step as the core's integrator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tissu.scene.step import Static

if TYPE_CHECKING:
    from tissu.scene.step import Step


def integrator_of(step: Step) -> Any:
    """The core's integrator for a step."""
    from tissu import _core

    newton = step.newton
    if isinstance(step, Static):
        return _core.Static(
            newton_iterations=step.newton.iterations,
            newton_tolerance=step.newton.tolerance,
            load_steps=step.load_steps,
        )
    if newton is None:
        return _core.ImplicitEuler(newton_iterations=1)
    return _core.ImplicitEuler(
        newton_iterations=newton.iterations, newton_tolerance=newton.tolerance
    )
