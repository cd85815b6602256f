"""A scene's step as the core's integrator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tissu.scene.energy_momentum import EnergyMomentum
from tissu.scene.step import (
    BDF2,
    RK2,
    RK4,
    BDF2FixedPoint,
    ExplicitEuler,
    ImplicitEuler,
    ImplicitMidpoint,
    Newmark,
    Static,
    SymplecticEuler,
)

if TYPE_CHECKING:
    from tissu.scene.step import Implicit, Step


def integrator_of(step: Step) -> Any:
    """The core's integrator for a step."""
    from tissu import _core

    if isinstance(step, Static):
        return _core.Static(
            newton_iterations=step.newton.iterations,
            newton_tolerance=step.newton.tolerance,
            load_steps=step.load_steps,
            total_iterations=step.total_iterations or 0,
            arc_length=step.arc_length,
        )
    if isinstance(step, EnergyMomentum):
        return _core.EnergyMomentum(
            newton_iterations=step.iterations, newton_tolerance=step.tolerance
        )
    if isinstance(step, BDF2FixedPoint):
        return _core.Bdf2FixedPoint(
            iterations=step.iterations, tolerance=step.tolerance, anderson=step.anderson
        )
    if isinstance(step, (ImplicitEuler, ImplicitMidpoint, BDF2, Newmark)):
        return _implicit(step)
    if isinstance(step, ExplicitEuler):
        return _core.ExplicitEuler()
    if isinstance(step, SymplecticEuler):
        return _core.SymplecticEuler()
    orders = {RK2: 2, RK4: 4}
    return _core.RungeKutta(order=orders[type(step)])


def _implicit(step: Implicit) -> Any:
    from tissu import _core

    newton: dict[str, Any] = {"newton_iterations": 1, "indefinite": step.indefinite}
    if step.newton is not None:
        newton["newton_iterations"] = step.newton.iterations
        newton["newton_tolerance"] = step.newton.tolerance
    if isinstance(step, Newmark):
        return _core.Newmark(beta=step.beta, gamma=step.gamma, **newton)
    classes: dict[type[Any], Any] = {
        ImplicitEuler: _core.ImplicitEuler,
        ImplicitMidpoint: _core.ImplicitMidpoint,
        BDF2: _core.Bdf2,
    }
    return classes[type(step)](**newton)
