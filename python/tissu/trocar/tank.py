"""What a haptic port may give out: a tank of energy that pays, and an observer that trips.

The energy that a port has given out is exact under sample and hold, without a velocity:
W_out(k) = sum_j tau_{j-1} . (q_j - q_{j-1}). The readable statement of the C++ tank.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tissu.trocar.kinematics import AXES, Array

_FLOOR = 0.125
"""Share of the coupling's stiffness that the observer leaves at least."""
_ROUND_OFF = 1e-9
"""J: a tank that has paid all it had is empty, and has no debt."""
_RECOVERY = 0.1
"""By which it recovers in a second."""


@dataclass(slots=True)
class Tank:
    """Energy that may be given out.

    Attributes:
        cap: the most that it holds [J].
        credit: share of the device's own dissipation that fills it.
        gate: false: every model is adopted whole, whatever it costs.
        energy: E_t [J]; below 0 the observer trips.
        given_out: W_out since the start [J].
        stiffness: share of K_c that the observer leaves.
        debt: E_t at the last trip [J].
    """

    energy: float = 1e-3
    cap: float = 5e-3
    credit: float = 0.8
    gate: bool = True
    given_out: float = 0.0
    stiffness: float = 1.0
    debt: float = 0.0

    def settle(self, work: float, stored: float, dissipated: float) -> None:
        """One tick: work on the joints, more energy in springs, the device's dissipation [J]."""
        self.given_out += work
        self.energy = min(self.cap, self.energy - (work + stored) + self.credit * dissipated)

    def pay(self, more: float) -> float:
        """The share of energy that a new model stores more which the tank can pay."""
        share = 1.0
        if more > 0.0 and self.gate:
            share = float(np.clip(self.energy / more, 0.0, 1.0))
        self.energy = min(self.cap, self.energy - share * more)
        return share

    def observe(self, period: float) -> None:
        """Halves the stiffness at a debt deeper than at the last trip; else it recovers."""
        if not self.gate:
            return
        if self.energy < self.debt - _ROUND_OFF:
            self.stiffness, self.debt = max(_FLOOR, 0.5 * self.stiffness), self.energy
        elif self.energy >= -_ROUND_OFF:
            self.stiffness = min(1.0, self.stiffness * (1.0 + _RECOVERY * period))
            self.debt = 0.0

    def damping(self, viscous: Array, speed: Array, slow: Array, period: float) -> Array:
        """Torques (4,) of dampers that pay a debt, of joints that move by two counts a tick."""
        moving = np.abs(speed) > slow
        power = float(np.sum(viscous * speed**2 * moving))
        if not self.gate or self.energy >= 0.0 or power <= 0.0:
            return np.zeros(AXES)
        share = min(1.0, -self.energy / (period * power))
        return np.asarray(-share * viscous * speed * moving)
