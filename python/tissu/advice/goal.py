"""What is asked for: the largest error, and the number of updates a second."""

from __future__ import annotations

import math
from dataclasses import dataclass

from tissu import units
from tissu.errors import ParameterError


@dataclass(frozen=True, slots=True)
class Goal:
    """The error and the rate that a setting has to meet.

    Attributes:
        error: largest mean error accepted: a share of the reference's largest displacement, or a
            length [m].
        is_length: whether it is a length.
        rate: updates a second; each brings the scene 1/rate seconds further, in no more time.
        dynamic: whether time is stepped; each update of a static scene is one solve.
    """

    error: float
    is_length: bool
    rate: float
    dynamic: bool = True

    def per_update(self, ms_per_step: float, dt: float) -> float:
        """Wall time of an update [ms] from that of a step and the step's length [s]."""
        steps = max(1.0, 1.0 / (self.rate * dt)) if self.dynamic else 1.0
        return ms_per_step * steps

    def rate_of(self, ms_per_step: float, dt: float) -> float:
        """Updates a second that a setting reaches; steps longer than an update limit them."""
        reached = 1e3 / max(self.per_update(ms_per_step, dt), 1e-9)
        return min(reached, 1.0 / dt) if self.dynamic and dt * self.rate > 1.0 else reached

    def share_of(self, error: float, largest: float) -> float:
        """An error [m] over the one accepted, of a scene that moves by `largest` [m]."""
        allowed = self.error if self.is_length else self.error * largest
        return error / allowed if allowed > 0.0 else math.inf if error > 0.0 else 0.0

    def error_words(self) -> str:
        """The error that is asked for, as it is written."""
        return length_words(self.error) if self.is_length else f"{100 * self.error:.3g} %"


def goal(error: units.Number, rate: units.Number, *, dynamic: bool) -> Goal:
    """Read the two demands.

    Raises:
        ParameterError: not a positive error (a share, a percentage or a length) or rate.
    """
    value, is_length = _error(error)
    if not value > 0.0:
        raise ParameterError(
            f"error: found {error}; more than 0 is accepted, such as '1%', 0.01 or '0.5 mm'"
        )
    try:
        updates = units.RATE(rate)
    except ParameterError as problem:
        raise ParameterError(f"rate: {problem}") from None
    if not updates > 0.0:
        raise ParameterError(f"rate: found {rate}; more than 0 updates a second are accepted")
    return Goal(value, is_length, updates, dynamic)


def budget_seconds(budget: units.Number) -> float:
    """The wall time that may be spent [s].

    Raises:
        ParameterError: not a positive time.
    """
    try:
        seconds = units.TIME(budget)
    except ParameterError as problem:
        raise ParameterError(f"budget: {problem}") from None
    if not seconds > 0.0:
        raise ParameterError(f"budget: found {budget}; a time of more than 0 s is accepted")
    return seconds


def _error(value: units.Number) -> tuple[float, bool]:
    """A share, or a length [m] and that it is one."""
    if isinstance(value, str) and value.strip().strip("0123456789.eE+-% "):
        try:
            return units.LENGTH(value), True
        except ParameterError as problem:
            raise ParameterError(f"error: {problem}; or a share such as '1%'") from None
    try:
        return units.NUMBER(value), False
    except ParameterError as problem:
        raise ParameterError(f"error: {problem}, such as '1%', 0.01 or '0.5 mm'") from None


def length_words(metres: float) -> str:
    """A length with a unit that suits it."""
    for unit, factor in (("m", 1.0), ("mm", 1e3)):
        if abs(metres) * factor >= 0.9995 or metres == 0.0:
            return f"{metres * factor:.3g} {unit}"
    return f"{1e6 * metres:.3g} µm"
