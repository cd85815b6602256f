"""What is seen of a body: its surface, or its lines, by the nodes that are on them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.material import carried
from tissu.mesh.thin import line_pieces

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.simulation import Simulation

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """The surface of a body, and its lines.

    Attributes:
        nodes: numbers (k,) of the body's nodes that are seen; of a body that was cut, or whose
            surface is a mesh of its own, those (k, m) that carry the points that are, -1: none.
        triangles: (t, 3) places in `nodes`.
        cells: (t,) number of the cell of each triangle in the body's mesh.
        edges: (e, 2) places in `nodes`: sides of faces, without the diagonals of quads.
        lines: (l, 2) places in `nodes`, of line cells.
        line_cells: (l,) number of the cell of each line.
    """

    nodes: Ints
    triangles: Ints
    cells: Ints
    edges: Ints
    lines: Ints
    line_cells: Ints
    weights: Floats | None = None
    """(k, m) of the nodes, which are (k, m) then: the points ride on them"""
    cut: NDArray[np.bool_] | None = None
    """(t,) whether a cut opened the triangle, of such a body"""
    numbers: NDArray[np.int32] | None = None
    """(k,) of the points, as contacts have them, of a body that was cut"""

    def at(self, values: Floats) -> Floats:
        """Values (k, ...) at what is seen of values (n, ...) at the nodes of the body."""
        if self.weights is None:
            return np.asarray(values[self.nodes])
        return carried(self.nodes.astype(np.int32), self.weights, values)


@lru_cache(maxsize=16)  # a mesh never changes
def seen(mesh: Mesh) -> Seen:
    """What is seen of a mesh; of nodes that no cell joins, the nodes."""
    surface = mesh.surface()
    ends, of_lines = line_pieces(mesh)
    triangles, lines = surface.triangles.astype(np.int64), np.asarray(ends, dtype=np.int64)
    sides = [
        np.asarray(face.nodes, dtype=np.int64)[:, [k, (k + 1) % face.nodes.shape[1]]]
        for face in surface.faces
        for k in range(face.nodes.shape[1])
    ]
    edges = np.unique(np.sort(np.concatenate([np.empty((0, 2), np.int64), *sides]), axis=1), axis=0)
    parts = [triangles.ravel(), lines.ravel()]
    nodes = np.unique(np.concatenate(parts))
    if not len(nodes):
        nodes = np.arange(mesh.node_count, dtype=np.int64)
    place = np.zeros(mesh.node_count, dtype=np.int64)
    place[nodes] = np.arange(len(nodes))
    return Seen(
        nodes=nodes,
        triangles=place[triangles].reshape(-1, 3),
        cells=np.asarray(surface.cells, dtype=np.int64),
        edges=place[edges].reshape(-1, 2),
        lines=place[lines].reshape(-1, 2),
        line_cells=np.asarray(of_lines, dtype=np.int64),
    )


_KEPT = 16
_cut: dict[int, tuple[Mesh, Seen]] = {}
"""What is seen of bodies that were cut, by their meshes, which every cut makes anew; and of bodies
whose surface is a mesh of its own.
"""


def seen_of(simulation: Simulation, body: str) -> Seen:
    """What is seen of a body of a simulation, its cut faces too."""
    mesh = simulation.meshes[body]
    is_own = body in simulation.own_surfaces
    if not (is_own or simulation.is_cut(body)):
        return seen(mesh)
    known = _cut.get(id(mesh))
    if known is None or known[0] is not mesh:
        while len(_cut) >= _KEPT:
            _cut.pop(next(iter(_cut)))
        made = _seen_of_own(simulation, body) if is_own else _seen_of_cut(simulation, body)
        known = (mesh, made)
        _cut[id(mesh)] = known
    return known[1]


def places_of(simulation: Simulation, body: str, seen: Seen) -> Floats:
    """Where the points (k, 3) are that are seen of a body [m].

    Points that frames carry turn with these, so that weights of positions alone do not give them.
    """
    if _turns(simulation, body):
        return np.asarray(simulation.contact_surface(body).points)
    return seen.at(simulation.positions[body])


def gone_of(simulation: Simulation, body: str, seen: Seen) -> Floats:
    """How far the points (k,) that are seen of a body are from where they are at rest [m]."""
    if _turns(simulation, body):
        surface = simulation.contact_surface(body)
        return np.asarray(np.linalg.norm(surface.points - surface.rest, axis=1))
    rest = {**simulation.meshes, **simulation.tissue}[body].points
    return np.asarray(np.linalg.norm(seen.at(simulation.positions[body] - rest), axis=1))


def _turns(simulation: Simulation, body: str) -> bool:
    bodies = simulation.scene.bodies
    return body in simulation.own_surfaces and body in bodies and bodies[body].has_rotations


def _seen_of_own(simulation: Simulation, body: str) -> Seen:
    """The mesh with which a body meets others; a triangle has the fields of the nearest cell."""
    from scipy.spatial import cKDTree

    surface, mesh = simulation.contact_surface(body), simulation.meshes[body]
    triangles = surface.triangles.astype(np.int64)
    middles = [mesh.points[block.nodes].mean(axis=1) for block in mesh.body_blocks]
    cells = cKDTree(np.concatenate(middles)).query(surface.rest[triangles].mean(axis=1))[1]
    sides = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    return Seen(
        nodes=surface.nodes.astype(np.int64),
        triangles=triangles,
        cells=np.asarray(cells, dtype=np.int64),
        edges=np.unique(sides, axis=0),
        lines=np.empty((0, 2), dtype=np.int64),
        line_cells=np.empty(0, dtype=np.int64),
        weights=surface.weights,
    )


def _seen_of_cut(simulation: Simulation, body: str) -> Seen:
    """The surface of the material; edges lie between triangles of different cells."""
    surface = simulation.surface(body)
    triangles = surface.triangles.astype(np.int64)
    cells = np.searchsorted(simulation.remaining_cells(body), surface.cell)
    sides = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    kind = np.tile(2 * cells + surface.cut, 3)
    order = np.lexsort((kind, sides[:, 1], sides[:, 0]))
    sides, kind = sides[order], kind[order]
    inner = np.zeros(len(sides), dtype=bool)
    same = (sides[1:] == sides[:-1]).all(axis=1) & (kind[1:] == kind[:-1])
    inner[1:] |= same
    inner[:-1] |= same
    return Seen(
        nodes=surface.nodes.astype(np.int64),
        triangles=triangles,
        cells=cells.astype(np.int64),
        edges=np.unique(sides[~inner], axis=0),
        lines=surface.lines.astype(np.int64),
        line_cells=np.searchsorted(simulation.remaining_cells(body), surface.line_cell),
        weights=surface.weights,
        cut=surface.cut,
        numbers=surface.numbers,
    )
