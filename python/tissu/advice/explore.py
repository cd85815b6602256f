"""Coordinate by coordinate from the scene's own setting to a cheaper or more accurate one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from tissu.advice.choices import PARTS, Choices
from tissu.advice.rows import Row, row_of
from tissu.advice.setting import is_explicit
from tissu.scene.step import Static

if TYPE_CHECKING:
    from tissu.advice.goal import Goal
    from tissu.advice.laboratory import Laboratory, Tried
    from tissu.advice.reference import Reference

_SHARE_OF_RUN = 1.0 / 3.0  # of what is left of the budget that one run may take
_CLEARLY = 0.95  # of the cost, or of what is missed, for a setting to count as better
_PASSES = 6


def explore(lab: Laboratory, own: Tried, reference: Reference, choices: Choices) -> None:
    """Try the parts of a setting one after the other, going on from the best so far.

    From the scene's own setting; then from the best that has run, the runs for the reference among
    them; then with methods of the other kind, explicit or implicit, since what is best for one kind
    is seldom best for the other.
    """
    kind, static = is_explicit(own.setting), isinstance(own.setting.step, Static)
    of_own_kind = replace(choices, explicit=kind)
    _descend(lab, own, reference, replace(of_own_kind, until=0.6 * lab.left))
    again = replace(of_own_kind, until=0.0 if static else 0.5 * lab.left)
    _descend(lab, _best(lab, own, reference, of_own_kind), reference, again)
    if static:
        return
    other = replace(choices, explicit=not kind, until=0.0)
    for setting in other.of("step", own.setting):
        begun = lab.run(setting, allowance=_SHARE_OF_RUN * lab.left)
        if begun is not None and begun.finished:
            _descend(lab, begun, reference, other)
            return


def _descend(lab: Laboratory, start: Tried, reference: Reference, choices: Choices) -> None:
    """From a setting to the best one that single changes lead to.

    A pass over all parts is followed by another while it has found something better and there is
    time.
    """
    best, value = start, _value(row_of(start, reference, choices.goal))
    for _ in range(_PASSES):
        before = best
        for part in PARTS:
            for setting in choices.of(part, best.setting):
                if lab.left <= choices.until:
                    return
                other = lab.run(
                    setting,
                    allowance=_SHARE_OF_RUN * lab.left,
                    too_slow=_slower_than(value, choices.goal),
                )
                if other is None:
                    continue
                found = _value(row_of(other, reference, choices.goal))
                if _better(found, value):
                    best, value = other, found
        if best is before:
            return


def _slower_than(value: tuple[float, float], goal: Goal) -> Callable[[float, float], bool]:
    """Whether steps are clearly slower than those of a setting that meets the goal.

    Where none is known, than four times what the rate allows, and than twice the best so far.
    """
    missed, cost = value
    most = 1.5 * cost if missed == 0.0 else max(2.0 * cost, 4e3 / goal.rate)
    return lambda ms_per_step, dt: goal.per_update(ms_per_step, dt) > most


def _best(lab: Laboratory, own: Tried, reference: Reference, choices: Choices) -> Tried:
    """The best setting so far, but for the reference's."""
    best, value = own, _value(row_of(own, reference, choices.goal))
    for tried in lab.tried.values():
        if tried is not reference.tried and choices.allows(tried.setting):
            found = _value(row_of(tried, reference, choices.goal))
            if _better(found, value):
                best, value = tried, found
    return best


def _value(row: Row) -> tuple[float, float]:
    """What is missed, then the cost: less is better."""
    return row.missed, math.inf if row.ms_per_update is None else row.ms_per_update


def _better(one: tuple[float, float], other: tuple[float, float]) -> bool:
    if not math.isfinite(other[0]):
        return math.isfinite(one[0])
    if one[0] < other[0] + math.log(_CLEARLY) or (one[0] == 0.0 < other[0]):
        return True
    return one[0] <= other[0] and one[1] < _CLEARLY * other[1]
