"""Contacts: arrows of the forces that press on bodies, to the places at which they act."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.layer import Draw, Layer
from tissu.live_view.marks import Marks, arrows_at, extent

if TYPE_CHECKING:
    from tissu.simulation import Simulation

_MOST = 200
"""Arrows; of more contacts those with the largest forces are shown."""
_LENGTH = 0.1
"""Of the longest arrow, as a share of the extent of the bodies."""
_COLOUR = (190, 40, 60)


def _begin(simulation: Simulation) -> Draw:
    size = _LENGTH * extent([mesh.points for mesh in simulation.meshes.values()])

    def draw() -> list[Marks]:
        found = simulation.contacts()
        forces = np.linalg.norm(found.forces, axis=1)
        pressing = np.flatnonzero(forces > 0.0)
        shown = pressing[np.argsort(-forces[pressing], kind="stable")[:_MOST]]
        obstacle = np.array([name in simulation.scene.obstacles for name in found.surfaces])
        on_body = np.where(obstacle[found.pairs[shown, 0]], -1.0, 1.0)
        along = on_body[:, None] * found.forces[shown]
        arrows = arrows_at(found.points[shown], along, longest=size)
        return [Marks(_COLOUR, arrows=arrows)]

    return draw


CONTACTS = Layer(
    name="contacts",
    on=True,
    offered=lambda simulation: bool(simulation.touching),
    begin=_begin,
)
