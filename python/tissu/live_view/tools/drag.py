"""Drag: a spring from the point of the surface under the pointer to the pointer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.grabs import force_text
from tissu.live_view.tools.tool import Number, Tool

if TYPE_CHECKING:
    from tissu.live_view.pointer import Pointer
    from tissu.simulation import Simulation
    from tissu.simulation.grab import Grab


class Drag(Tool):
    """Drags the same point of every simulation that is shown.

    The grabs draw themselves: they are a layer of the page.
    """

    name = "drag"
    hint = "Press on a body and pull: a spring of this stiffness follows the pointer."

    def __init__(self, simulations: Sequence[Simulation]) -> None:
        """Nothing is held."""
        super().__init__(simulations)
        first = simulations[0]
        stiffness = float(f"{first.drag_stiffness([*first.bodies, *first.tissue][0]):.2g}")
        self.numbers = [Number("stiffness", "N/m", stiffness, 1e-6)]
        self._held: dict[int, list[Grab]] = {}

    @classmethod
    def offered(cls, simulation: Simulation) -> bool:
        """Where points may be grabbed."""
        return simulation.scene.grabbing

    def press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Take hold of the point, in every simulation."""
        self.release(simulations, pointer)
        stiffness = self.numbers[0].value
        first = simulations[pointer.lane].drag(pointer.body, pointer.place, stiffness=stiffness)
        held = self._held.setdefault(pointer.client, [])
        held.append(first)
        for lane, simulation in enumerate(simulations):
            if lane != pointer.lane:
                held.append(simulation.drag_as(first))
        self.move(simulations, pointer)

    def move(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Pull to where the pointer is."""
        for grab in self._held.get(pointer.client, ()):
            if not grab.released:
                grab.target = pointer.there

    def say(self, simulations: Sequence[Simulation]) -> str:
        """The forces of the grabs of each pointer; of several simulations beside each other."""
        held = [[grab for grab in grabs if not grab.released] for grabs in self._held.values()]
        forces = [[force_text(float(np.linalg.norm(g.force))) for g in grabs] for grabs in held]
        return "; ".join(" and ".join(texts) for texts in forces if texts)

    def release(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Let go."""
        for grab in self._held.pop(pointer.client, []):
            grab.release()
