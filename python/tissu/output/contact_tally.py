"""What the contacts of a run came to: forces by name, the least gap, and what was held back."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tissu.simulation import Simulation, StepReport


class ContactTally:
    """Looks at the contacts of a simulation after each step; of one without contacts, never."""

    def __init__(self, simulation: Simulation) -> None:
        """Begin to look."""
        self._simulation = simulation
        self._names = simulation.touching
        self._largest = dict.fromkeys(self._names, 0.0)
        self._forces = {name: np.zeros(3) for name in self._names}
        self._least = math.inf
        self._most = 0
        self._held = 0
        if self._names:
            simulation.on_step(self._add)

    def record(self) -> dict[str, Any] | None:
        """As the summary has it, in SI; None of a scene without contacts.

        `forces`: of each body and obstacle the `force` of the latest step, and the size of the
        `largest` one [N]; `most`: contacts that pressed at once; `least_gap`: distance of the
        nearest pair that pressed, as a share of that at which the surfaces rest, None where
        nothing did; `steps_held_back`: in which ways were cut so that nothing passes through
        anything.
        """
        if not self._names:
            return None
        forces: dict[str, dict[str, float | NDArray[np.float64]]] = {
            name: {"force": self._forces[name], "largest": self._largest[name]}
            for name in self._names
        }
        return {
            "forces": forces,
            "most": self._most,
            "least_gap": self._least,
            "steps_held_back": self._held,
        }

    def _add(self, report: StepReport) -> None:
        self._least = min(self._least, report.least_gap)
        self._most = max(self._most, report.contacts)
        self._held += report.held_back > 0
        for name in self._names:
            force = self._simulation.force_on(name).force
            self._forces[name] = force
            self._largest[name] = max(self._largest[name], float(np.linalg.norm(force)))
