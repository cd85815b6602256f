"""Frames: their axes, of connective tissue and of bodies whose nodes turn."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.layer import Layer
from tissu.live_view.marks import Marks, extent

if TYPE_CHECKING:
    from tissu.simulation import Simulation

_LENGTH = 0.02  # of an axis, as a share of the extent
_COLOURS = ((200, 60, 60), (60, 150, 60), (60, 90, 200))


def _turning(simulation: Simulation) -> list[str]:
    bodies = simulation.scene.bodies.items()
    return [*simulation.tissue, *(name for name, body in bodies if body.has_rotations)]


def _marks(simulation: Simulation) -> list[Marks]:
    names = _turning(simulation)
    places = np.concatenate([simulation.positions[name] for name in names])
    axes = np.concatenate([simulation.rotations(name) for name in names])
    arm = _LENGTH * extent([places])
    return [
        Marks(colour, lines=np.stack([places, places + arm * axes[:, :, k]], axis=1))
        for k, colour in enumerate(_COLOURS)
    ]


FRAMES = Layer(
    name="frames",
    on=False,
    offered=lambda simulation: bool(_turning(simulation)),
    begin=lambda simulation: lambda: _marks(simulation),
)
