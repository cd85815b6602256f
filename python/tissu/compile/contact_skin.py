"""The surface that `surface_of` gives a body: a mesh whose vertices ride on the body's cells."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.contact_surface import ContactSurface, Riders
from tissu.compile.mesh_surface import surface_of_mesh
from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.mesh.places import Places, nearest_places

if TYPE_CHECKING:
    from tissu.compile.prepared import Findings
    from tissu.mesh import Mesh
    from tissu.scene.problem import Path

_LEAST = -0.5
"""weight of a node below which a vertex is too far outside its cell: beyond half a cell"""
_NONE = 1e-12
"""size of a weight that is round-off"""


def skin_surface(
    name: str, source: object, mesh: Mesh, findings: Findings, *, lever: float = 0.0
) -> ContactSurface | None:
    """The surface of a body that is a mesh of its own, and the nodes that carry it.

    A vertex outside all cells rides on the nearest one, extrapolated.

    Args:
        name: of the body.
        source: a mesh, or what is read as one.
        mesh: of the body.
        findings: take the problems.
        lever: share of the way from a node to the vertex that turns with the node; 0: nodes have no
            rotation.

    Returns:
        None, and a problem, where there is none.
    """
    place: Path = ("contact", "surface_of", name)
    if not mesh.volume_blocks:
        text = f"found '{name}', which has no volume cells to carry a surface; leave it out: "
        findings.problem(place, f"{text}sheets and lines meet others themselves")
        return None
    surface = surface_of_mesh(source, place, findings)
    if surface is None:
        return None
    try:
        found = nearest_places(surface.vertices, mesh)
    except ParameterError as error:
        findings.problem(place, str(error))
        return None
    if _is_outside(place, name, found, findings):
        return None
    used = np.abs(found.weights) > _NONE
    begin = np.concatenate([[0], np.cumsum(used.sum(axis=1))]).astype(np.int32)
    weights = np.where(used, found.weights, 0.0)
    weights /= weights.sum(axis=1, keepdims=True)
    nodes = found.nodes[used].astype(np.int32)
    riders = Riders(begin, nodes, weights[used])
    if lever > 0.0:
        places = np.repeat(surface.vertices, np.diff(begin), axis=0)
        riders = riders._replace(arms=np.ascontiguousarray(lever * (places - mesh.points[nodes])))
    return surface._replace(riders=riders)


def _is_outside(place: Path, name: str, found: Places, findings: Findings) -> bool:
    """Whether vertices lie so far outside the body that no cell carries them."""
    least = found.weights.min(axis=1)
    far = int((least < _LEAST).sum())
    if far:
        text = f"found {counted(far, 'point')} of {len(least)} farther outside the cells of "
        text += f"'{name}' than half a cell; a surface in the body, or near its boundary, is "
        findings.problem(place, f"{text}accepted: look at its place and its unit")
    return far > 0
