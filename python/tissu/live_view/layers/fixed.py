"""Nodes that are held, and nodes that are led."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.layer import Draw, Layer
from tissu.live_view.marks import Colour, Marks

if TYPE_CHECKING:
    from tissu.scene.support import Support
    from tissu.simulation import Simulation


def _begin(simulation: Simulation, supports: Sequence[Support], colour: Colour) -> Draw:
    meshes = {**simulation.meshes, **simulation.tissue}
    held = [(support.body, support.on.nodes(meshes[support.body])) for support in supports]

    def draw() -> list[Marks]:
        places = [simulation.positions[body][nodes] for body, nodes in held]
        return [Marks(colour, points=np.concatenate(places))] if places else []

    return draw


FIXED = Layer(
    name="fixed nodes",
    on=True,
    offered=lambda simulation: bool(simulation.scene.fixed),
    begin=lambda simulation: _begin(simulation, simulation.scene.fixed, (60, 70, 90)),
)
LED = Layer(
    name="led nodes",
    on=True,
    offered=lambda simulation: bool(simulation.scene.prescribed),
    begin=lambda simulation: _begin(simulation, simulation.scene.prescribed, (120, 60, 160)),
)
