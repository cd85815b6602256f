"""Instruments: the edge of each knife, and the axis of each ablator, where they are now."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.layer import Layer
from tissu.live_view.marks import Marks

if TYPE_CHECKING:
    from tissu.simulation import Simulation

COLOUR = (40, 40, 40)


def _shown(simulation: Simulation) -> list[str]:
    """All but those of trocars, which the view of trocars draws while they are in it."""
    trocars = simulation.scene.trocars.values()
    taken = {name for trocar in trocars for name in trocar.tools.values()}
    return [name for name in simulation.scene.instruments if name not in taken]


def _marks(simulation: Simulation) -> list[Marks]:
    found = []
    for name in _shown(simulation):
        edge = simulation.instruments[name].edge
        lines = np.stack([edge[:-1], edge[1:]], axis=1)
        found.append(Marks(COLOUR, points=edge, lines=lines))
    return found


INSTRUMENTS = Layer(
    name="instruments",
    on=True,
    offered=lambda simulation: bool(_shown(simulation)),
    begin=lambda simulation: lambda: _marks(simulation),
)
