"""Grabs: a line from the point to where it is pulled, and the force in newtons."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.layers.layer import Layer
from tissu.live_view.marks import Marks

if TYPE_CHECKING:
    from tissu.simulation import Simulation

_COLOUR = (20, 110, 200)


def _marks(simulation: Simulation) -> list[Marks]:
    found = []
    for grab in simulation.grabs:
        here, there = grab.position, grab.target
        force = float(np.linalg.norm(grab.force))
        found.append(
            Marks(
                _COLOUR,
                points=np.stack([here, there]),
                lines=np.stack([here, there])[None],
                labels=((there, force_text(force)),),
            )
        )
    return found


def force_text(force: float) -> str:
    """A force [N] in a unit that suits it."""
    return f"{force:.3g} N" if force >= 0.1 else f"{1e3 * force:.3g} mN"


GRABS = Layer(
    name="grabs",
    on=True,
    offered=lambda simulation: simulation.scene.grabbing,
    begin=lambda simulation: lambda: _marks(simulation),
)
