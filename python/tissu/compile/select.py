"""Which nodes and faces of a mesh a selection means."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.prepared import Floats, Ints
from tissu.errors import ParameterError
from tissu.mesh.cell import CellBlock
from tissu.mesh.whole_faces import whole_faces
from tissu.scene.problem import nearest, one_of_words
from tissu.scene.selection import Box, Nodes, Plane, Region, Sphere

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.selection import Selection

_SLACK = (
    1e-9  # share of the body's diagonal that counts as on the border, for round-off in coordinates
)


def selected_nodes(on: Selection, mesh: Mesh) -> Ints:
    """Numbers (k,) of the selected nodes, increasing.

    Raises:
        ParameterError: a region that the mesh lacks, or node numbers beyond the mesh.
    """
    if isinstance(on, Nodes):
        return _by_number(on, mesh)
    if isinstance(on, Region):
        return region_nodes(on.name, mesh)
    if isinstance(on, (Box, Sphere, Plane)):
        return np.flatnonzero(_inside(on, mesh.points, diagonal(mesh))).astype(np.int32)
    return np.unique(mesh.surface().triangles).astype(np.int32)


def selected_cells(on: Selection, mesh: Mesh) -> Ints:
    """Numbers (k,) of the cells that a selection means, across the simulated blocks.

    Raises:
        ParameterError: a region that the mesh lacks, or node numbers beyond the mesh.
    """
    if isinstance(on, Region):
        return region_cells(on.name, mesh)
    chosen = np.zeros(mesh.node_count, dtype=bool)
    by_centre = isinstance(on, (Box, Sphere, Plane))
    if not by_centre:
        chosen[selected_nodes(on, mesh)] = True
    found = [np.zeros(0, dtype=bool)]
    for block in mesh.body_blocks:
        if by_centre:
            assert isinstance(on, (Box, Sphere, Plane))
            found.append(_inside(on, mesh.points[block.nodes].mean(axis=1), diagonal(mesh)))
        else:
            found.append(np.asarray(chosen[block.nodes].all(axis=1)))
    return np.flatnonzero(np.concatenate(found)).astype(np.int32)


def selected_faces(nodes: Ints, mesh: Mesh) -> tuple[CellBlock, ...]:
    """Whole faces of the surface, outward, whose nodes are all among `nodes`."""
    chosen = np.zeros(mesh.node_count, dtype=bool)
    chosen[nodes] = True
    kept = ((b.type, b.nodes[chosen[b.nodes].all(axis=1)]) for b in whole_faces(mesh))
    return tuple(CellBlock(kind, faces) for kind, faces in kept if len(faces))


def region_nodes(name: str, mesh: Mesh) -> Ints:
    """Nodes of the cells of a region.

    Raises:
        ParameterError: the mesh has no region of this name.
    """
    cells = region_cells(name, mesh)
    nodes, first = [], 0
    for block in mesh.body_blocks:
        inside = cells[(cells >= first) & (cells < first + len(block.nodes))] - first
        nodes.append(np.asarray(block.nodes)[inside].ravel())
        first += len(block.nodes)
    return np.unique(np.concatenate(nodes)).astype(np.int32)


def region_cells(name: str, mesh: Mesh) -> Ints:
    """Numbers of the cells of a region, across the volume blocks.

    Raises:
        ParameterError: the mesh has no region of this name.
    """
    if name in mesh.regions:
        return np.asarray(mesh.regions[name])
    if not mesh.regions:
        raise ParameterError(f"found region '{name}', but the mesh names no regions")
    raise ParameterError(
        f"the mesh has no region '{name}'{nearest(name, mesh.regions)} "
        f"Regions: {one_of_words(mesh.regions)}"
    )


def diagonal(mesh: Mesh) -> float:
    """Length of the diagonal of the mesh's bounds [m]."""
    return float(np.linalg.norm(mesh.bounds[1] - mesh.bounds[0]))


def _by_number(on: Nodes, mesh: Mesh) -> Ints:
    ids = np.unique(np.asarray(on.ids, dtype=np.int64))
    beyond = ids[ids >= mesh.node_count]
    if beyond.size:
        raise ParameterError(
            f"found node {beyond[0]}; the mesh has the nodes 0 to {mesh.node_count - 1}"
        )
    return ids.astype(np.int32)


def _inside(
    on: Box | Sphere | Plane, points: Floats, size: float
) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    slack = _SLACK * size
    if isinstance(on, Sphere):
        return np.asarray(np.linalg.norm(points - on.center, axis=1) <= on.radius + slack)
    if isinstance(on, Plane):
        normal = np.asarray(on.normal) / np.linalg.norm(on.normal)
        tolerance = 1e-6 * size if on.tolerance is None else on.tolerance + slack
        return np.asarray(np.abs((points - on.point) @ normal) <= tolerance)
    low = np.array([-np.inf if x is None else x for x in on.min])
    high = np.array([np.inf if x is None else x for x in on.max])
    return np.asarray(((points >= low - slack) & (points <= high + slack)).all(axis=1))
