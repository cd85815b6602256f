"""Obstacles that bodies meet: planes as squares, all others whole."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.layer import Draw, Layer
from tissu.live_view.marks import Marks

if TYPE_CHECKING:
    from tissu.simulation import Simulation

COLOUR = (168, 172, 178)
OPACITY = 0.75


def _begin(simulation: Simulation) -> Draw:
    drawn: dict[str, tuple[np.ndarray[tuple[int, int], np.dtype[np.float64]], Marks]] = {}

    def draw() -> list[Marks]:
        for name in simulation.obstacles:
            surface = simulation.obstacle_surface(name)
            known = drawn.get(name)
            if known is None or not np.array_equal(known[0], surface.points):
                corners = surface.points[surface.triangles]
                drawn[name] = surface.points, Marks(COLOUR, surface=corners, opacity=OPACITY)
        return [marks for _, marks in drawn.values()]

    return draw


OBSTACLES = Layer(
    name="obstacles",
    on=True,
    offered=lambda simulation: bool(simulation.obstacles),
    begin=_begin,
)
