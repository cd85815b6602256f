"""Connective tissue: its integration points, and those of bodies made of frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.layer import Draw, Layer
from tissu.live_view.marks import Marks

if TYPE_CHECKING:
    from tissu.simulation import Simulation


def with_points(simulation: Simulation) -> list[str]:
    """Names of the tissue and of the bodies that are made of frames."""
    bodies = simulation.scene.bodies.items()
    framed = [
        name
        for name, body in bodies
        if any(model.type == "frames" for model in body.models().values())
    ]
    return [*simulation.tissue, *framed]


def _begin(simulation: Simulation) -> Draw:
    names = with_points(simulation)

    def draw() -> list[Marks]:
        places = [simulation.points(name) for name in names]
        return [Marks((180, 120, 60), points=np.concatenate(places))] if places else []

    return draw


TISSUE = Layer(
    name="points of tissue and frames",
    on=True,
    offered=lambda simulation: bool(with_points(simulation)),
    begin=_begin,
)
