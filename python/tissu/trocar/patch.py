"""Forces of a few contacts on a spring: Coulomb's law for each, all at once.

    g = b + A lambda        0 <= lambda_n  _|_  g_n >= 0,   |lambda_t| <= mu lambda_n

Rows stand in blocks: a cone has three (normal and two tangents), a push one, and a bounded row has
|lambda| <= bound. This is the readable statement; the C++ solver finds the same forces another way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tissu.trocar.kinematics import Array

_STEEPEST = 0.05
"""Least share of its own compliance that a slipping contact gives way by."""
_ROUND_OFF = 1e-15
"""rad"""


@dataclass(frozen=True, slots=True)
class Block:
    """A block of rows.

    Attributes:
        kind: a cone, a push or a bounded row.
        row: the first.
        bound: mu of a cone, the largest |lambda| [N] of a bounded row.
    """

    kind: Literal["cone", "push", "bounded"]
    row: int
    bound: float = 0.0

    @property
    def rows(self) -> slice:
        """Its rows."""
        return slice(self.row, self.row + (3 if self.kind == "cone" else 1))


@dataclass(slots=True)
class Patch:
    """Contacts that act on each other.

    Attributes:
        b: (n,) gaps without forces [m].
        A: (n, n) symmetric, positive semi-definite, with a positive diagonal [m/N].
        blocks: what the rows are.
    """

    b: Array
    A: Array
    blocks: list[Block]

    def gaps(self, forces: Array) -> Array:
        """The gaps g (n,) [m]."""
        return self.b + self.A @ forces

    def stored(self, forces: Array) -> float:
        """1/2 lambda^T A lambda [J]."""
        return float(0.5 * forces @ self.A @ forces)

    def solve(self, start: Array, *, sweeps: int, tolerance: float) -> tuple[Array, int]:
        """The forces (n,) [N], and how many sweeps they took: block Gauss–Seidel from a start."""
        forces = np.array(start, dtype=float)
        for sweep in range(1, sweeps + 1):
            before = forces.copy()
            for block in self.blocks:
                self._solve_block(block, forces)
            change = np.abs(forces - before).max(initial=0.0)
            if change <= tolerance * np.abs(forces).max(initial=0.0):
                return forces, sweep
        return forces, sweeps

    def _solve_block(self, block: Block, forces: Array) -> None:
        at = block.rows
        own = self.A[at, at]
        rest = (self.b + self.A @ forces)[at] - own @ forces[at]
        if block.kind == "cone":
            forces[at] = cone_force(own, rest, block.bound, forces[at])
            return
        wanted = -rest / own[0, 0]
        low = 0.0 if block.kind == "push" else -block.bound
        high = np.inf if block.kind == "push" else block.bound
        forces[at] = np.clip(wanted, low, high)


def cone_force(A: Array, rest: Array, mu: float, start: Array) -> Array:
    """Force (3,) of one contact with g = rest + A lambda: open, stuck, or slipping against it."""
    if rest[0] >= 0.0:
        return np.zeros(3)
    if mu == 0.0:
        return np.array([-rest[0] / A[0, 0], 0.0, 0.0])
    stuck = np.asarray(-np.linalg.solve(A, rest), dtype=np.float64)
    if stuck[0] > 0.0 and np.hypot(stuck[1], stuck[2]) <= mu * stuck[0]:
        return stuck
    along = start[1:] if np.any(start[1:]) else stuck[1:]
    return _slipping(A, rest, mu, float(np.arctan2(along[1], along[0])))


def _slipping(A: Array, rest: Array, mu: float, angle: float) -> Array:
    """The force whose slip is against it: a root of the slip across the force, over its angle."""

    def force(at: float) -> Array:
        e = np.array([np.cos(at), np.sin(at)])
        stiff = max(A[0, 0] + mu * (A[0, 1:] @ e), _STEEPEST * A[0, 0])
        normal = -rest[0] / stiff
        return np.array([normal, *(mu * normal * e)])

    def slip(at: float) -> tuple[float, float]:
        """Slip across the force, and along it: negative where friction takes energy."""
        g = (rest + A @ force(at))[1:]
        c, s = np.cos(at), np.sin(at)
        return float(g[1] * c - g[0] * s), float(g[0] * c + g[1] * s)

    def across(at: float) -> float:
        return slip(at)[0]

    near = _root_near(across, angle)
    if near is None or slip(near)[1] > 0.0:
        near = next((at for at in _roots(across, angle) if slip(at)[1] <= 0.0), angle)
    return force(near)


def _root_near(function: Callable[[float], float], start: float) -> float | None:
    """A root by secants from a start; None where they do not find one."""
    last, at = start, start + 1e-4
    value, before = function(at), function(last)
    for _ in range(30):
        if value == before:
            return at if abs(at - last) < _ROUND_OFF else None
        last, at = at, at - value * (at - last) / (value - before)
        before, value = value, function(at)
        if abs(at - last) <= _ROUND_OFF:
            return at
    return None


def _roots(function: Callable[[float], float], angle: float) -> list[float]:
    """Roots over a turn, the nearest to an angle first."""
    from scipy.optimize import brentq

    turns = angle + np.linspace(-np.pi, np.pi, 49)
    values = [function(at) for at in turns]
    found = []
    for low, high, f_low, f_high in zip(turns, turns[1:], values, values[1:], strict=False):
        if f_low == 0.0:
            found.append(float(low))
        elif f_low * f_high < 0.0:
            found.append(float(brentq(function, low, high, xtol=_ROUND_OFF, rtol=_ROUND_OFF)))
    return sorted(found, key=lambda at: abs(at - angle))
