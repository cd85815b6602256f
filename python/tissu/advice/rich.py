"""The first rich run of a scene: its own number of cells, of second order where it can be."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from tissu.advice.setting import Setting, is_explicit
from tissu.scene.model import LOCKING
from tissu.scene.solver import Auto
from tissu.scene.step import (
    BDF2,
    BDF2FixedPoint,
    EnergyMomentum,
    Implicit,
    ImplicitEuler,
    Newton,
    Static,
    SymplecticEuler,
)

if TYPE_CHECKING:
    from tissu.advice.laboratory import Laboratory, Tried
    from tissu.scene.step import Step

_DIVISORS = {4: 0.2, 2: 0.4, 1: 0.7}
"""Of the scene's time step -> share of the time for the reference that its first run may take."""

_MORE = 0.3  # of that time beside, for cells of the scene's own order
_SAME_AS_FEM = ("mass_tensor", "mass_link", "mean_dilatation")  # in the limit of small cells
_TOLERANCE = 1e-6


def rich_step(step: Step, divisor: int) -> Step:
    """A step that leaves less error: shorter, of second order where it is implicit Euler's.

    Where the scene's own steps are linearised once, these are too: what that costs grows with the
    step and is part of its error.
    """
    solver = Auto(tolerance=_TOLERANCE)
    if isinstance(step, Static):
        iterations = max(30, step.newton.iterations)
        return step.replace(newton=Newton(iterations=iterations, tolerance=1e-8), solver=solver)
    if isinstance(step, BDF2FixedPoint):
        return BDF2(dt=step.dt / divisor, solver=solver)
    if isinstance(step, ImplicitEuler):
        return BDF2(dt=step.dt / divisor, newton=step.newton, solver=solver)
    if isinstance(step, (Implicit, EnergyMomentum)):
        return step.replace(dt=step.dt / divisor, solver=solver)
    return step.replace(dt="auto")


def first_rich(
    lab: Laboratory, own: Setting, family: str, left: Callable[..., float]
) -> Tried | None:
    """The scene's own number of cells, of second order where it can be, with a rich step."""
    for order in (2, own.order) if own.order == 1 else (own.order,):
        for model in _models(lab, order):
            rich = Setting(own.scale, order, model, own.step, family)
            found = _richest_step(lab, rich, own, left)
            if found is not None:
                return found
    return None


def _richest_step(
    lab: Laboratory, setting: Setting, own: Setting, left: Callable[..., float]
) -> Tried | None:
    """A quarter of the step or the stable explicit one, whichever is cheaper; else longer ones."""
    more = _MORE if setting.order == own.order else 0.0
    divided = hasattr(own.step, "dt") and not is_explicit(own)
    runs: list[Tried] = []
    for divisor, share in (_DIVISORS if divided else {1: 0.7}).items():
        steps = [rich_step(own.step, divisor)] + [SymplecticEuler()] * divided
        for step in steps[_hopeless(runs, divisor, left(share + more)) :]:
            found = lab.run(replace(setting, step=step), allowance=left(share + more))
            if found is not None and found.refused:
                return None
            runs += [found] if found is not None else []
        finished = [run for run in runs if run.finished and run.measured is not None]
        if finished:
            return min(finished, key=_seconds)
    return None


def _hopeless(runs: list[Tried], divisor: int, allowance: float) -> bool:
    """Whether a run with a quarter of the step was so slow that one with fewer is too."""
    if not runs or runs[0].measured is None:
        return False
    return runs[0].measured.foreseen * divisor / 4.0 > 1.5 * allowance


def _seconds(tried: Tried) -> float:
    return tried.measured.seconds if tried.measured is not None else math.inf


def _models(lab: Laboratory, order: int) -> Sequence[str]:
    """Models to take, the best first: what the scene's own tends to for small cells; itself.

    Cells of first order that lock look converged long before they are; mean dilatation cures them.
    """
    bodies = lab.scene.bodies.values()
    own = {model.type for body in bodies for model in body.models().values()}
    if not own <= {"fem", *_SAME_AS_FEM}:
        return ("",)
    models = ["" if own == {"fem"} else "fem", ""]
    locks = any(law.poisson_at_rest() >= LOCKING for b in bodies for law in b.laws().values())
    if order == 1 and locks:
        models.insert(0, "" if own == {"mean_dilatation"} else "mean_dilatation")
    return tuple(dict.fromkeys(models))
