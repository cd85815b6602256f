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
from tissu.advice.rich import first_rich
from tissu.advice.richardson import Estimate, estimate
from tissu.advice.setting import Setting, is_explicit
from tissu.scene.step import (
    Static,
)

if TYPE_CHECKING:
    pass


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
        """Whether its cells are more than the scene's own, of higher order or another family."""
        return _cells(self.tried.setting) != _cells(self.own)

    def judges(self, setting: Setting) -> bool:
        """Whether it gives the error of a setting, as far as it is known.

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


def find_reference(
    lab: Laboratory,
    own: Tried,
    *,
    share: float,
    enough: Callable[[Reference], bool] = lambda reference: True,
) -> Reference:
    """The richest run of the scene's own cells; where it is not enough, of richer ones as well.

    Args:
        lab: where they run.
        own: the scene's own setting, which has run.
        share: of what is left of the budget, for each family of cells.
        enough: whether a reference is good enough to leave out richer families of cells.

    Returns:
        The one whose own error is the smallest; where none is known, the first of higher order.
    """
    found = []
    for family in ("", *lab.resolutions.families):
        found.append(_of_family(lab, own, family, share))
        if enough(found[-1]):
            break
    return min(found, key=_doubtful)


def _doubtful(reference: Reference) -> tuple[float, int]:
    error = math.inf if reference.error is None else reference.error
    return error, -reference.tried.setting.order


def _of_family(lab: Laboratory, own: Tried, family: str, share: float) -> Reference:
    """Climb to ever richer settings while they take no longer than a share of the budget.

    First cells of second order and a quarter of the time step or, where that is cheaper, stable
    explicit steps (a half of the step, or the whole, where neither is affordable); then ever more
    cells; then cheaper runs that show its order.
    """
    begin = time.perf_counter()
    whole = share * lab.left
    setting, changes = own.setting, lab.resolutions.can_change
    dynamic = not isinstance(setting.step, Static)

    def left(part: float = 1.0) -> float:
        return part * whole - (time.perf_counter() - begin)

    best = first_rich(lab, setting, family, left)
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


def _cells(setting: Setting) -> tuple[Fraction, int, str]:
    return setting.scale, setting.order, setting.family


def _steps(setting: Setting) -> tuple[str, object]:
    return setting.step.type, getattr(setting.step, "dt", None)


def _climb(
    lab: Laboratory, first: Setting, levels: dict[Fraction, Tried], left: Callable[..., float]
) -> None:
    """Add runs with more cells, as long as they are affordable."""
    for scale in (Fraction(2), Fraction(3), Fraction(4)):
        found = _at(lab, first, scale, left)
        if found is None and lab.resolutions.bodies(scale, first.order, first.family) is None:
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
    found = lab.run(replace(first, scale=scale), allowance=left())
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
