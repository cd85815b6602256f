"""One row for each setting that was tried: its error, its time, and whether they are enough."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tissu import pareto
from tissu.advice.measure import Floats, mean_distance
from tissu.advice.setting import scene_words

if TYPE_CHECKING:
    from tissu.advice.goal import Goal
    from tissu.advice.laboratory import Tried
    from tissu.advice.reference import Reference
    from tissu.front import Scene


@dataclass(frozen=True, slots=True)
class Row:
    """One setting.

    Attributes:
        mesh: cells of the bodies: "8x2x2 hexahedron20", or their number.
        model: what computes the forces.
        step: method, time step and Newton's method.
        solver: linear solver and its tolerance.
        outcome: "finished", "stopped", "refused", or "not run".
        cells: of all bodies.
        unknowns: numbers that a step solves for.
        steps: how many were taken.
        unconverged: steps that did not converge.
        distance: from the reference, mean over watched points and times [m].
        error: the distance and, where it is known, the reference's own error beside it: at most so
            far is the setting from the truth [m]; absent where nothing is known of it.
        error_percent: the same in percent of the reference's largest displacement.
        ms_per_step: median wall time of a step.
        ms_per_update: of the steps of an update.
        rate: updates a second that it reaches.
        megabytes: models, matrix and linear solver.
        meets_error: whether the error is at most the one asked for.
        meets_rate: whether the rate is at least the one asked for.
        why: of an outcome that is not "finished".
        is_reference: whether the others are measured against it.
        error_excess: the error over the one asked for.
        rate_excess: the rate asked for over the one reached.
        scene: that was run.
    """

    mesh: str
    model: str
    step: str
    solver: str
    outcome: str
    cells: int | None = None
    unknowns: int | None = None
    steps: int | None = None
    unconverged: int | None = None
    distance: float | None = None
    error: float | None = None
    error_percent: float | None = None
    ms_per_step: float | None = None
    ms_per_update: float | None = None
    rate: float | None = None
    megabytes: float | None = None
    meets_error: bool = False
    meets_rate: bool = False
    why: str = ""
    is_reference: bool = False
    error_excess: float = field(default=math.inf, repr=False)
    rate_excess: float = field(default=math.inf, repr=False)
    scene: Scene | None = field(default=None, repr=False, compare=False)

    @property
    def missed(self) -> float:
        """By how much it misses what is asked, as a logarithm; 0: it meets both."""
        if not (math.isfinite(self.error_excess) and math.isfinite(self.rate_excess)):
            return math.inf
        return math.log(max(self.error_excess, 1.0)) + math.log(max(self.rate_excess, 1.0))

    @property
    def name(self) -> str:
        """The setting in words."""
        solver = f", {self.solver}" if self.solver != "-" else ""
        return f"{self.mesh}, {self.model}, {self.step}{solver}"


def row_of(tried: Tried, reference: Reference, goal: Goal) -> Row:
    """The row of a setting that was tried."""
    scene, measured = tried.scene, tried.measured
    words = scene_words(scene)
    if measured is None:
        return Row(*words, "refused" if tried.refused else "not run", why=tried.why, scene=scene)
    is_reference = tried is reference.tried
    distance = _distance(tried, reference.moved)
    judged = reference.judges(tried.setting)
    error = reference.error if is_reference else _plus(distance, reference.error)
    error = error if judged or is_reference else None
    largest = largest_move(reference.moved)
    excess = math.inf if error is None else goal.share_of(error, largest)
    timed = measured.steps > 0
    rate = goal.rate_of(measured.ms_per_step, measured.dt) if timed else None
    return Row(
        *words,
        outcome="stopped" if measured.stopped else "finished",
        cells=measured.cells,
        unknowns=measured.unknowns,
        steps=measured.steps,
        unconverged=measured.unconverged,
        distance=distance,
        error=error,
        error_percent=100.0 * error / largest if error is not None and largest > 0.0 else None,
        ms_per_step=measured.ms_per_step if timed else None,
        ms_per_update=goal.per_update(measured.ms_per_step, measured.dt) if timed else None,
        rate=rate,
        megabytes=measured.megabytes,
        meets_error=excess <= 1.0,
        meets_rate=rate is not None and rate >= goal.rate,
        why=tried.why,
        is_reference=is_reference,
        error_excess=excess,
        rate_excess=goal.rate / rate if rate else math.inf,
        scene=scene,
    )


def largest_move(moved: Floats) -> float:
    """The largest displacement over points and times [m]."""
    return math.sqrt(float((moved**2).sum(axis=-1).max(initial=0.0)))


def _distance(tried: Tried, reference: Floats) -> float | None:
    measured = tried.measured
    if measured is None or measured.stopped or len(measured.moved) != len(reference):
        return None
    return mean_distance(measured.moved, reference)


def _plus(distance: float | None, own: float | None) -> float | None:
    return None if distance is None else distance + (own or 0.0)


def front(rows: Sequence[Row]) -> list[Row]:
    """The rows than which none is both faster and more accurate (Pareto), fastest first."""
    known = [row for row in rows if row.error is not None and row.ms_per_update is not None]
    return pareto.front(known, lambda row: row.ms_per_update or 0.0, lambda row: row.error or 0.0)
