"""Options of the core for cuts that move nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from tissu.simulation import grab as kept
from tissu.simulation.still import still_nodes

if TYPE_CHECKING:
    from tissu.simulation.simulation import Simulation


def snapping(simulation: Simulation, body: str) -> dict[str, Any]:
    """Whether a cut moves nodes of a body, and which of them do not."""
    editing = simulation.scene.editing
    if editing is None or not editing.snaps(body):
        return {"snap": False, "depth": False, "still": np.zeros(0, dtype=np.int32)}
    first, count = simulation._core.body_range(body)
    grabs = kept.records(simulation._core) if simulation.scene.grabbing else {}
    rows = [grab.nodes for grab in grabs.values()]
    still = still_nodes(simulation._meshes[body], rows, first, count)
    return {"snap": True, "depth": editing.depth, "still": still}
