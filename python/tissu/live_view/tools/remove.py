"""Remove: cells around the place under the pointer are taken out of the body."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tissu.counted import counted
from tissu.cutting.material import centres_of
from tissu.live_view.marks import extent
from tissu.live_view.pointer import met
from tissu.live_view.tools.tool import Number, Tool

if TYPE_CHECKING:
    from tissu.live_view.pointer import Pointer
    from tissu.simulation import Simulation

_RADIUS = 0.04
"""At first, as a share of the extent of the scene."""


class Remove(Tool):
    """Removes the cells whose material has its centre near the pointer, in every simulation."""

    name = "remove cells"
    hint = "Press on a body, or draw over it: cells whose centre is within the radius are removed."

    edits = True

    def __init__(self, simulations: Sequence[Simulation]) -> None:
        """Choose a radius that suits the scene."""
        super().__init__(simulations)
        size = extent([mesh.points for mesh in simulations[0].meshes.values()])
        self._removed = 0
        self.numbers = [Number("radius", "mm", float(f"{1e3 * _RADIUS * size:.2g}"), 0.0)]

    @classmethod
    def offered(cls, simulation: Simulation) -> bool:
        """Where cells may be removed."""
        return simulation.scene.editing is not None

    def press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Remove the cells around the place; at least the one that is nearest."""
        touched = simulations[pointer.lane]
        surface = touched.surface(pointer.body)
        place = met(pointer.eye, pointer.there, surface.points[surface.triangles])
        if place is None:
            return
        centres, numbers = centres_of(touched.material(pointer.body))
        apart = np.linalg.norm(centres - place, axis=1)
        cells = numbers[apart <= 1e-3 * self.numbers[0].value]
        if not len(cells):
            cells = numbers[[int(apart.argmin())]]
        for simulation in simulations:
            left = simulation.remaining_cells(pointer.body)
            simulation.remove_cells(body=pointer.body, cells=np.intersect1d(cells, left))
        self._removed += len(cells)

    def move(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Draw on: the pointer removes what it passes."""
        self.press(simulations, pointer)

    def forget(self) -> None:
        """They are there again."""
        self._removed = 0

    def say(self, simulations: Sequence[Simulation]) -> str:
        """How many cells it has removed."""
        return f"{counted(self._removed, 'cell')} removed" if self._removed else ""

    def click(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Remove at one place."""
        self.press(simulations, pointer)
