"""The surface of a body as contact sees it: triangles, lines, half thicknesses; and its edges."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tissu.compile.prepared import Floats, Ints
from tissu.mesh import thin
from tissu.mesh.flat_edges import flat_edges
from tissu.scene.section import area_of

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.body import Body

_SAME = 1e-9
"""share by which the diagonals of a quad may differ and count as equal: round-off in coordinates"""


class Riders(NamedTuple):
    """The nodes of a body that carry the vertices of a surface.

    Attributes:
        begin: first of each vertex in the lists (n + 1,).
        nodes: of the body (k,); from its number of nodes on: of `others`.
        weights: of these (k,), which sum to one for each vertex.
        arms: from the nodes that are frames to the vertex at rest (k, 3) [m], zero of others;
            empty: none is a frame.
        others: nodes of other bodies, by the name of the body and the number there.
    """

    begin: Ints
    nodes: Ints
    weights: Floats
    arms: Floats = np.empty((0, 3))
    others: tuple[tuple[str, int], ...] = ()

    def in_core(self) -> tuple[Ints, Ints, Ints, Floats, Floats, list[tuple[str, int]]]:
        """Numbers of the vertices as the core has them, ascending, and the lists in that order."""
        count = len(self.begin) - 1
        last = np.repeat(self.begin[1:][::-1], np.diff(self.begin)[::-1])
        lengths = np.diff(self.begin)[::-1]
        begin = np.concatenate([[0], np.cumsum(lengths)]).astype(np.int32)
        order = last - np.repeat(lengths, lengths) + np.arange(len(last))
        order = order - np.repeat(begin[:-1], lengths)
        vertices = numbered(np.arange(count, dtype=np.int32))[::-1]
        arms = self.arms[order] if len(self.arms) else self.arms
        lists = (begin, self.nodes[order], self.weights[order], arms.ravel())
        return np.ascontiguousarray(vertices), *lists, list(self.others)

    def carried_by(self, nodes: Ints) -> Ints:
        """The vertices whose nodes are all among these."""
        there = np.isin(self.nodes, nodes)
        return np.flatnonzero(np.logical_and.reduceat(there, self.begin[:-1])).astype(np.int32)

    def values(self, of_nodes: Floats) -> Floats:
        """Values (n, ...) at the vertices of values at the nodes."""
        weights = self.weights.reshape(-1, *(1,) * (of_nodes.ndim - 1))
        return np.asarray(np.add.reduceat(weights * of_nodes[self.nodes], self.begin[:-1]))


class ContactSurface(NamedTuple):
    """What of a body or obstacle meets others.

    Attributes:
        vertices: (n, 3) where they are at rest [m].
        triangles: (t, 3) vertices, anticlockwise seen from outside.
        edges: (k, 2) vertices of edges that belong to no triangle.
        points: (p,) vertices that belong to no edge.
        radius: (n,) half the thickness at each vertex [m]; empty: none.
        closed: whether the triangles enclose a volume, or the edges an area, on their left seen
            from +z.
        riders: nodes of the body that carry the vertices; None: each vertex is the node of its
            number.
    """

    vertices: Floats
    triangles: Ints
    edges: Ints
    points: Ints
    radius: Floats
    closed: bool
    riders: Riders | None = None

    @property
    def nodes(self) -> Ints:
        """Numbers of all vertices on it, increasing."""
        parts = (self.triangles.ravel(), self.edges.ravel(), self.points)
        return np.unique(np.concatenate(parts)).astype(np.int32)

    def as_mesh(self) -> Mesh:
        """Its triangles as a mesh at rest."""
        from tissu.mesh import CellBlock, Mesh

        return Mesh(points=self.vertices, cells=(CellBlock("triangle", self.triangles),))

    @property
    def mean_edge(self) -> float:
        """Mean length of its edges at rest, each once [m]; 0 without edges."""
        edges = np.concatenate([edges_of(self.triangles), self.edges])
        if not len(edges):
            return 0.0
        ends = self.vertices[np.unique(np.sort(edges, axis=1), axis=0)]
        return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())

    @property
    def longest(self) -> float:
        """Longest side of the box around it at rest, with its thickness [m]."""
        sides = np.ptp(self.vertices[self.nodes], axis=0)
        return float(sides.max() + 2.0 * self.radius.max(initial=0.0))


def numbered(vertices: Ints) -> Ints:
    """Vertices that nodes carry, as the core numbers them: below zero, which no node is."""
    return np.asarray(-1 - vertices, dtype=np.int32)


def edges_of(triangles: Ints) -> Ints:
    """The three edges of each triangle (3 t, 2)."""
    return np.asarray(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))


def body_surface(mesh: Mesh, body: Body) -> ContactSurface:
    """The boundary of the volume cells, the sheets and the lines of a body, by its nodes.

    Sheets on the boundary take its place; what lies inside the volume meets nothing. A flat body
    has its rim.
    """
    if body.plane is not None:
        return _rim(mesh)
    whole, quads, loose = _faces(mesh)
    triangles = np.concatenate([whole, halves_of(mesh.points, quads)]).astype(np.int32)
    volume = np.zeros(mesh.node_count, dtype=bool)
    for block in mesh.volume_blocks:
        volume[block.nodes] = True
    pieces = thin.line_pieces(mesh)[0]
    pieces = pieces[~volume[pieces].all(axis=1)]
    return ContactSurface(
        vertices=mesh.points,
        triangles=triangles,
        edges=_without(pieces, edges_of(triangles)),
        points=np.empty(0, dtype=np.int32),
        radius=_radius(mesh, body, (whole, quads), pieces),
        closed=not loose and len(triangles) > 0,
    )


def _rim(mesh: Mesh) -> ContactSurface:
    """The edges that one sheet alone has, which lies on the left of them seen from +z."""
    ends = [np.asarray(block.nodes) for block in flat_edges(mesh)]
    halves = [
        nodes if nodes.shape[1] == 2 else nodes[:, [0, 2, 2, 1]].reshape(-1, 2) for nodes in ends
    ]
    return ContactSurface(
        vertices=mesh.points,
        triangles=np.empty((0, 3), dtype=np.int32),
        edges=np.concatenate([np.empty((0, 2), np.int32), *halves]).astype(np.int32),
        points=np.empty(0, dtype=np.int32),
        radius=np.empty(0),
        closed=True,
    )


def _faces(mesh: Mesh) -> tuple[Ints, Ints, bool]:
    """Triangles and quads on the boundary and beside it, and whether there are any beside it."""
    outer, count = mesh.surface(), sum(len(block) for block in mesh.volume_blocks)
    three = len(outer.triangles) - 2 * len(outer.quads)
    kept, loose = [], False
    for faces, cells in (
        (outer.triangles[:three], outer.cells[:three]),
        (outer.quads, outer.cells[three::2]),
    ):
        sheets = np.flatnonzero(cells >= count)
        inside = _in_a_volume_cell(mesh, faces[sheets])
        kept.append(np.delete(faces, sheets[inside], axis=0))
        loose = loose or not inside.all()
    return kept[0], kept[1], loose


def halves_of(points: Floats, quads: Ints) -> Ints:
    """Quads (q, 4) cut along their shorter diagonal (2 q, 3), each in its own sense.

    Of equal diagonals it is the one of the lowest node.
    """
    if not len(quads):
        return np.empty((0, 3), dtype=np.int32)
    corners = points[quads]
    first = np.linalg.norm(corners[:, 2] - corners[:, 0], axis=1)
    second = np.linalg.norm(corners[:, 3] - corners[:, 1], axis=1)
    equal = np.abs(first - second) <= _SAME * (first + second)
    lowest = np.argmin(quads, axis=1) % 2 == 0
    along = np.where(equal, lowest, first < second)
    one, other = quads[:, [0, 1, 2, 0, 2, 3]], quads[:, [0, 1, 3, 1, 2, 3]]
    return np.where(along[:, None], one, other).reshape(-1, 3).astype(np.int32)


def _in_a_volume_cell(mesh: Mesh, faces: Ints) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which faces (f, k) have all their nodes in one volume cell."""
    if not len(faces) or not mesh.volume_blocks:
        return np.zeros(len(faces), dtype=bool)
    from scipy.sparse import coo_matrix

    first, rows, columns = 0, [], []
    for block in mesh.volume_blocks:
        cells = np.arange(first, first + len(block))
        rows.append(np.asarray(block.nodes).ravel())
        columns.append(np.repeat(cells, block.nodes.shape[1]))
        first += len(block)
    row, column = np.concatenate(rows), np.concatenate(columns)
    at = coo_matrix((np.ones(len(row), np.int32), (row, column)), shape=(mesh.node_count, first))
    touching = at.tocsr()
    shared = touching[faces[:, 0]]
    for corner in range(1, faces.shape[1]):
        shared = shared.multiply(touching[faces[:, corner]])
    return np.asarray(shared.sum(axis=1)).ravel() > 0


def _radius(mesh: Mesh, body: Body, faces: tuple[Ints, Ints], pieces: Ints) -> Floats:
    """Half the thickness at each node; of a line the radius of a circle of its section's area."""
    radius = np.zeros(mesh.node_count)
    if body.thickness is not None:
        sheets = thin.faces(mesh)
        for there, of_sheets in zip(faces, (sheets[0], sheets[2]), strict=True):
            known = {tuple(face) for face in np.sort(there, axis=1).tolist()}
            met = [tuple(face) in known for face in np.sort(of_sheets, axis=1).tolist()]
            radius[of_sheets[np.array(met, dtype=bool)]] = body.thickness / 2.0
    if body.section is not None and len(pieces):
        round_one = math.sqrt(area_of(body.section) / math.pi)
        radius[pieces] = np.maximum(radius[pieces], round_one)
    return radius if radius.any() else np.empty(0)


def _without(edges: Ints, others: Ints) -> Ints:
    """The edges (k, 2) that are not among the others, each once."""
    known = {tuple(edge) for edge in np.sort(others, axis=1).tolist()}
    kept: dict[tuple[int, ...], None] = {}
    for edge in np.sort(edges, axis=1).tolist():
        if tuple(edge) not in known:
            kept[tuple(edge)] = None
    return np.array(list(kept), dtype=np.int32).reshape(-1, 2)
