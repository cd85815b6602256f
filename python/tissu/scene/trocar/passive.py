"""How stiff the coupling of a device may be: the passive bound of each axis.

A spring K that is held for a tick T gives out energy unless the device dissipates it. With viscous
damping b, Coulomb friction f_c, counts of size Delta and a delay t_d of the loop

    K <= b / (T/2 + t_d)        Colgate and Schenkel 1997 (t_d = 0), linear limit with a delay
    K <= 2 f_c / Delta          Abbott and Okamura 2005: friction hides the step of a count

Both have to hold; automatic gains take 0.8 of the smaller one.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

MARGIN = 0.8
"""Share of the bound that automatic gains take."""


class Bound(NamedTuple):
    """The largest passive stiffness of an axis, and what bounds it."""

    stiffness: float
    why: str


def passive_bound(
    damping: float, friction: float, count: float, period: float, delay: float
) -> Bound:
    """The bound of one axis, in N m/rad or N/m.

    Args:
        damping: b, viscous [N m s/rad or N s/m].
        friction: f_c, Coulomb [N m or N].
        count: Delta, position of one count [rad or m].
        period: T, of the ticks [s].
        delay: t_d, from reading to the torque on the joint [s].
    """
    by_damping = damping / (0.5 * period + delay)
    by_friction = 2.0 * friction / count
    if by_damping <= by_friction:
        return Bound(by_damping, "damping over half a tick and the delay (Colgate, Schenkel 1997)")
    return Bound(by_friction, "twice the friction over a count (Abbott, Okamura 2005)")


def passive_bounds(
    damping: Sequence[float],
    friction: Sequence[float],
    counts: Sequence[float],
    period: float,
    delay: float,
) -> list[Bound]:
    """The bound of each axis."""
    rows = zip(damping, friction, counts, strict=True)
    return [passive_bound(b, f, count, period, delay) for b, f, count in rows]
