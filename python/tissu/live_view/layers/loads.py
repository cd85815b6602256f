"""Loads: arrows to the nodes on which they act, against the surface where they press."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.live_view.layers.layer import Draw, Layer
from tissu.live_view.marks import Marks, arrows_at, extent, few

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.simulation import Simulation

_MOST = 40
_LENGTH = 0.12  # of the longest arrow, as a share of the body
_COLOUR = (200, 90, 30)


def _begin(simulation: Simulation) -> Draw:
    meshes = {**simulation.meshes, **simulation.tissue}
    chosen = []
    for number, load in enumerate(simulation.scene.loads):
        mesh = meshes[load.body]
        nodes = load.on.nodes(mesh)
        size = _LENGTH * extent([mesh.points])
        chosen.append((load, simulation.load(number), mesh, nodes[few(nodes, _MOST)], size))

    def draw() -> list[Marks]:
        found = []
        for load, live, mesh, nodes, size in chosen:
            places = simulation.positions[load.body]
            value = live.factor * np.asarray(getattr(live, load.quantity), dtype=float)
            along = value if value.ndim else -value * _normals(mesh, places)[nodes]
            found.append(Marks(_COLOUR, arrows=arrows_at(places[nodes], along, longest=size)))
        return found

    return draw


def _normals(mesh: Mesh, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Outward unit normals (n, 3) of the surface at its nodes."""
    triangles = mesh.surface().triangles
    a, b, c = (places[triangles[:, k]] for k in range(3))
    across, normals = np.cross(b - a, c - a), np.zeros_like(places)
    for k in range(3):
        np.add.at(normals, triangles[:, k], across)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None])


LOADS = Layer(
    name="loads",
    on=True,
    offered=lambda simulation: bool(simulation.scene.loads),
    begin=_begin,
)
