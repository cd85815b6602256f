"""The surface of a body as contact sees it: triangles, lines, half thicknesses; and its edges."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tissu.compile.prepared import Floats, Ints
from tissu.mesh import thin
from tissu.mesh.cell import dimension
from tissu.scene.section import area_of

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.body import Body

_SAME = 1e-9
"""share by which the diagonals of a quad may differ and count as equal: round-off in coordinates"""


class ContactSurface(NamedTuple):
    """What of a body or obstacle meets others.

    Attributes:
        vertices: (n, 3) where they are at rest [m].
        triangles: (t, 3) vertices, anticlockwise seen from outside.
        edges: (k, 2) vertices of edges that belong to no triangle.
        points: (p,) vertices that belong to no edge.
        radius: (n,) half the thickness at each vertex [m]; empty: none.
        closed: whether the triangles enclose a volume.
    """

    vertices: Floats
    triangles: Ints
    edges: Ints
    points: Ints
    radius: Floats
    closed: bool

    @property
    def nodes(self) -> Ints:
        """Numbers of all vertices on it, increasing."""
        parts = (self.triangles.ravel(), self.edges.ravel(), self.points)
        return np.unique(np.concatenate(parts)).astype(np.int32)

    @property
    def mean_edge(self) -> float:
        """Mean length of its edges at rest, each once [m]; 0 without edges."""
        edges = np.concatenate([edges_of(self.triangles), self.edges])
        if not len(edges):
            return 0.0
        ends = self.vertices[np.unique(np.sort(edges, axis=1), axis=0)]
        return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())


def edges_of(triangles: Ints) -> Ints:
    """The three edges of each triangle (3 t, 2)."""
    return np.asarray(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))


def body_surface(mesh: Mesh, body: Body) -> ContactSurface:
    """The boundary of the volume cells, the sheets and the lines of a body, by its nodes.

    Sheets on the boundary take its place; what lies inside the volume meets nothing.
    """
    outer = mesh.surface()
    whole, quads = outer.triangles[: len(outer.triangles) - 2 * len(outer.quads)], outer.quads
    inside_whole, inside_quads = (_in_a_volume_cell(mesh, faces) for faces in (whole, quads))
    volume = np.zeros(mesh.node_count, dtype=bool)
    for block in mesh.volume_blocks:
        volume[block.nodes] = True
    of_sheets = sum(dimension(block.type) == 2 for block in mesh.thin_blocks) > 0
    if of_sheets and mesh.volume_blocks:
        count = sum(len(block) for block in mesh.volume_blocks)
        whole_cells = outer.cells[: len(whole)]
        quad_cells = outer.cells[len(whole) :: 2]
        whole = whole[(whole_cells < count) | ~inside_whole]
        quads = quads[(quad_cells < count) | ~inside_quads]
        loose = bool((whole_cells >= count)[~inside_whole].any())
        loose = loose or bool((quad_cells >= count)[~inside_quads].any())
    else:
        loose = of_sheets
    triangles = np.concatenate([whole, halves_of(mesh.points, quads)]).astype(np.int32)
    pieces = thin.line_pieces(mesh)[0]
    pieces = pieces[~volume[pieces].all(axis=1)] if len(pieces) else pieces
    return ContactSurface(
        vertices=mesh.points,
        triangles=triangles,
        edges=_without(pieces, edges_of(triangles)),
        points=np.empty(0, dtype=np.int32),
        radius=_radius(mesh, body, triangles, pieces),
        closed=bool(mesh.volume_blocks) and not loose,
    )


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


def _radius(mesh: Mesh, body: Body, triangles: Ints, pieces: Ints) -> Floats:
    """Half the thickness at each node; of a line the radius of a circle of its section's area."""
    radius = np.zeros(mesh.node_count)
    if body.thickness is not None:
        sheets = [b.nodes for b in mesh.thin_blocks if dimension(b.type) == 2]
        of_sheet = np.zeros(mesh.node_count, dtype=bool)
        for nodes in sheets:
            of_sheet[nodes] = True
        on = np.unique(triangles)
        radius[on[of_sheet[on]]] = body.thickness / 2.0
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
