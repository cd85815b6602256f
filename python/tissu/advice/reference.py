"""The richest run of the scene that the budget affords, and what its own error is."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from tissu.advice.laboratory import Laboratory, Tried
from tissu.advice.measure import Floats
from tissu.advice.richardson import Estimate, estimate
from tissu.advice.setting import Setting, is_explicit
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
    from tissu.scene.step import Step

_DIVISORS = {4: 0.2, 2: 0.4, 1: 0.7}
"""Of the scene's time step -> share of the time for the reference that its first run may take."""

_MORE = 0.3  # of that time beside, for cells of the scene's own order
_SAME_AS_FEM = ("mass_tensor", "mass_link", "mean_dilatation")  # in the limit of small cells
_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True)
class Reference:
    """What the errors of other settings are measured against.

    Attributes:
        tried: the run.
        space: what runs with larger cells say of it; None: not known.
        time: what runs with longer steps say of it; None: not known.
        dynamic: whether time is stepped.
        own: the scene's own setting.
        meshes_change: whether there are other meshes of the scene at all.
    """

    tried: Tried
    space: Estimate | None
    time: Estimate | None
    dynamic: bool
    own: Setting
    meshes_change: bool

    @property
    def richer(self) -> bool:
        """Whether it is richer than the scene's own setting."""
        return self.tried.setting.key() != self.own.key()

    @property
    def finer(self) -> bool:
        """Whether its cells are more, or of higher order, than the scene's own."""
        return _cells(self.tried.setting) != _cells(self.own)

    def judges(self, setting: Setting) -> bool:
        """Whether it tells the error of a setting, as far as it is known.

        Not of one that has the same cells, or the same steps, of which the error is not known: both
        are off alike.
        """
        rich = self.tried.setting
        same_cells = self.finer and _cells(setting) == _cells(rich)
        same_steps = _steps(self.own) != _steps(rich) and _steps(setting) == _steps(rich)
        return not (same_cells and self.space is None) and not (
            self.dynamic and same_steps and self.time is None
        )

    @property
    def moved(self) -> Floats:
        """(t, p, 3) its displacements [m]."""
        assert self.tried.measured is not None
        return self.tried.measured.moved

    @property
    def error(self) -> float | None:
        """Its own error, mean over points and times [m]; None: not known."""
        if (self.meshes_change and self.space is None) or (self.dynamic and self.time is None):
            return None
        return sum(found.error for found in (self.space, self.time) if found is not None)


def find_reference(lab: Laboratory, own: Tried, *, share: float) -> Reference:
    """Climb to ever richer settings while they take no longer than a share of the budget.

    First cells of second order and a quarter of the time step or, where that is cheaper, stable
    explicit steps (a half of the step, or the whole, where neither is affordable); then ever more
    cells; then cheaper runs that show its order.

    Args:
        lab: where they run.
        own: the scene's own setting, which has run.
        share: of what is left of the budget.
    """
    begin = time.perf_counter()
    whole = share * lab.left
    setting, changes = own.setting, lab.resolutions.can_change
    dynamic = not isinstance(setting.step, Static)

    def left(part: float = 1.0) -> float:
        return part * whole - (time.perf_counter() - begin)

    best = _first(lab, setting, left)
    if best is None:
        return Reference(own, None, None, dynamic, setting, changes)
    levels = {Fraction(1): best}
    _climb(lab, best.setting, levels, left)
    _descend(lab, best.setting, levels, left)
    scales = [scale for scale in sorted(levels) if lab.resolutions.exact(scale)]
    space = estimate([float(1 / s) for s in scales], [_moved(levels[s]) for s in scales])
    best = levels[max(levels)]
    if max(levels) not in scales[-1:]:
        space = None
    steps = _time_sequence(lab, levels[min(levels)], best, left)
    return Reference(best, space, steps, dynamic, setting, changes)


def _cells(setting: Setting) -> tuple[Fraction, int]:
    return setting.scale, setting.order


def _steps(setting: Setting) -> tuple[str, object]:
    return setting.step.type, getattr(setting.step, "dt", None)


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


def _first(lab: Laboratory, own: Setting, left: Callable[..., float]) -> Tried | None:
    """The scene's own number of cells, of second order where it can be, with a rich step."""
    for order in (2, own.order) if own.order == 1 else (own.order,):
        for model in dict.fromkeys((_model(lab), "")):
            found = _richest_step(lab, Setting(own.scale, order, model, own.step), own, left)
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


def _model(lab: Laboratory) -> str:
    """The model that the scene's own one tends to for small cells; empty: itself."""
    models = [model.type for body in lab.scene.bodies.values() for model in body.models().values()]
    return "fem" if all(model in _SAME_AS_FEM for model in models) else ""


def _climb(
    lab: Laboratory, first: Setting, levels: dict[Fraction, Tried], left: Callable[..., float]
) -> None:
    """Add runs with more cells, as long as they are affordable."""
    for scale in (Fraction(2), Fraction(3), Fraction(4)):
        found = _at(lab, first, scale, left)
        if found is None and lab.resolutions.bodies(scale, first.order) is None:
            continue
        if found is None:
            break
        levels[scale] = found
    if max(levels) == 1:
        found = _at(lab, first, Fraction(3, 2), left)
        if found is not None:
            levels[Fraction(3, 2)] = found


def _descend(
    lab: Laboratory, first: Setting, levels: dict[Fraction, Tried], left: Callable[..., float]
) -> None:
    """Add runs with fewer cells until there are three, whose cells are all larger alike."""
    for part in (Fraction(2, 3), Fraction(1, 2), Fraction(1, 3), Fraction(1, 4)):
        if len(levels) < 3 and lab.resolutions.exact(part):
            found = _at(lab, first, part, left)
            if found is not None:
                levels[part] = found


def _at(
    lab: Laboratory, first: Setting, scale: Fraction, left: Callable[..., float]
) -> Tried | None:
    found = lab.run(Setting(scale, first.order, first.model, first.step), allowance=left())
    return found if found is not None and found.finished else None


def _time_sequence(
    lab: Laboratory, tried: Tried, best: Tried, left: Callable[..., float]
) -> Estimate | None:
    """What other steps say of the reference's, on the fewest cells.

    Of implicit methods four and two times the length; of explicit ones, whose step is the stable
    one, a half and a quarter, taken to the step that the reference has with its cells.
    """
    assert tried.measured is not None and best.measured is not None
    step: Any = tried.setting.step
    if isinstance(step, Static):
        return None
    explicit = is_explicit(tried.setting)
    dt = tried.measured.dt if explicit else step.dt
    runs = []
    for factor in (0.5, 0.25) if explicit else (4, 2):
        other = replace(tried.setting, step=step.replace(dt=factor * dt))
        found = lab.run(other, allowance=left())
        if found is None or not found.finished:
            return None
        runs.append(_moved(found))
    if not explicit:
        return estimate([4.0, 2.0, 1.0], [*runs, _moved(tried)])
    finest = estimate([4.0, 2.0, 1.0], [_moved(tried), *runs])
    if finest is None:
        return None
    longer = 4.0 * best.measured.dt / dt
    return Estimate(finest.order, finest.error * longer**finest.order)


def _moved(tried: Tried) -> Floats:
    assert tried.measured is not None
    return tried.measured.moved
