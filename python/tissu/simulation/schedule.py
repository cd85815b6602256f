"""Which steps a run takes: whole ones, and a shorter last one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from tissu.errors import ParameterError

MOST_STEPS = 1_000_000_000


class Stepped(Protocol):
    """What is stepped."""

    @property
    def time(self) -> float:
        """Where it stands [s]."""

    @property
    def dt(self) -> float:
        """The step that it would take now [s]."""


def steps_of(span: float, dt: float, *, taken: int = 0) -> Iterator[float]:
    """The steps [s] that make up a span of time [s], without the first ones that were taken."""
    if not span <= dt * MOST_STEPS:
        raise ParameterError(
            f"found steps of {dt:g} s for {span:g} s, which is more than {MOST_STEPS:.0e} steps; "
            "take larger steps, or a shorter run"
        )
    # A remainder of more than a millionth of a step is a step of its own.
    whole = int(span / dt * (1.0 + 1e-12) + 1e-6)
    for _ in range(taken, whole):
        yield dt
    rest = span - whole * dt
    if rest > 1e-6 * dt and taken <= whole:
        yield rest


def steps_until(end: float, dt: float, *, time: float, taken: int) -> Iterator[float]:
    """The steps [s] that a run from time zero to `end` [s] would take from `time` on.

    Args:
        end: of the run [s].
        dt: of its whole steps [s].
        time: where it stands [s].
        taken: steps until then.
    """
    if abs(time - taken * dt) > 1e-3 * dt:  # not all of them were whole
        return steps_of(max(end - time, 0.0), dt)
    return steps_of(end, dt, taken=taken)


def stable_steps(moved: Stepped, end: float) -> Iterator[float]:
    """Steps [s] as long as they may be at present; the last two share what is left until `end`."""
    while True:
        dt, left = moved.dt, end - moved.time
        if left <= 1e-6 * dt:
            return
        yield left if left <= dt else 0.5 * left if left < 2.0 * dt else dt
