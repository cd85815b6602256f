"""Nodes that are held, and nodes that are led."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.layer import Layer
from tissu.live_view.marks import Colour, Marks

if TYPE_CHECKING:
    from tissu.scene.support import Support
    from tissu.simulation import Simulation


def _marks(simulation: Simulation, supports: Sequence[Support], colour: Colour) -> list[Marks]:
    meshes = {**simulation.meshes, **simulation.tissue}
    places = [
        simulation.positions[support.body][support.on.nodes(meshes[support.body])]
        for support in supports
    ]
    return [Marks(colour, points=np.concatenate(places))] if places else []


FIXED = Layer(
    name="fixed nodes",
    on=True,
    offered=lambda simulation: bool(simulation.scene.fixed),
    marks=lambda simulation: _marks(simulation, simulation.scene.fixed, (60, 70, 90)),
)
LED = Layer(
    name="led nodes",
    on=True,
    offered=lambda simulation: bool(simulation.scene.prescribed),
    marks=lambda simulation: _marks(simulation, simulation.scene.prescribed, (120, 60, 160)),
)
