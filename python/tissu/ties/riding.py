"""Nodes without a rotation that carry tissue: it rides on a cell that they belong to.

A frame at a node j of a cell moves with the cell: p - x_j = F l, F = sum_b x_b (x) grad N_b, the
cell's mean.
So a point that listens to j with the weight w listens to the nodes b of the cell with
w_b = w (delta_jb + l . grad N_b), dw_b/dX = (delta_jb + l . grad N_b) dw/dX + w grad N_b, and the
forces go back the same way (bosman2014, figure 10, for bodies of any resolution).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.errors import ParameterError
from tissu.ties.weights import Floats, Ints, Weights

if TYPE_CHECKING:
    from tissu.mesh import Mesh

_MOST = 64  # nodes and frames that a point may listen to

Node = tuple[str, int]
"""A node of a body, by the name of the body and its number there."""
Row = dict[int, tuple[float, Floats]]
"""Number of a frame -> its weight at a point, and the gradient of the weight."""


class Carriers:
    """Bodies whose nodes have no rotation, with a cell for each node of their surface.

    Args:
        meshes: body -> its mesh at rest.
    """

    def __init__(self, meshes: Mapping[str, Mesh]) -> None:
        self._meshes = dict(meshes)
        self._cells: dict[str, dict[int, tuple[Ints, Floats]]] = {}

    def carry(self, body: str) -> bool:
        """Whether tissue rides on the cells of a body."""
        return body in self._meshes

    def shares(self, node: Node, point: Floats) -> tuple[Ints, Floats, Floats]:
        """Nodes (b,) of the cell at a node, their weights (b,) at a point, and grad N_b (b, 3)."""
        body, number = node
        if body not in self._cells:
            self._cells[body] = _cells_at_nodes(self._meshes[body])
        nodes, slopes = self._cells[body][number]
        lever = point - self._meshes[body].points[number]
        return nodes, (nodes == number) + slopes @ lever, slopes


def carried(
    carriers: Carriers, weights: Weights, own: int, shared: list[Node], points: Floats
) -> tuple[Weights, list[Node]]:
    """The weights with nodes that have no rotation replaced by the nodes of their cells.

    Args:
        carriers: what carries.
        weights: of the points, by numbers of `own` frames and, after those, of `shared` nodes.
        own: number of frames.
        shared: nodes of bodies.
        points: at rest (p, 3) [m].

    Returns:
        The weights, and all nodes that their numbers name.
    """
    used = [shared[n - own] for n in np.unique(weights.frames) if n >= own]
    if not any(carriers.carry(body) for body, _ in used):
        return weights, shared
    numbers = {node: own + i for i, node in enumerate(shared)}
    rows = [
        row_of(carriers, own, shared, numbers, weights, p, point) for p, point in enumerate(points)
    ]
    return _packed(rows), sorted(numbers, key=lambda node: numbers[node])


def row_of(
    carriers: Carriers,
    own: int,
    shared: list[Node],
    numbers: dict[Node, int],
    weights: Weights,
    p: int,
    point: Floats,
) -> Row:
    """How a point listens to frames and nodes; `numbers` gets those of new nodes."""
    row: Row = {}
    for a, frame in enumerate(weights.frames[p]):
        w, dw = float(weights.weights[p, a]), weights.gradients[p, a]
        node = ("", 0) if frame < own else shared[frame - own]
        if not carriers.carry(node[0]):
            _add(row, int(frame), w, dw)
            continue
        nodes, levers, slopes = carriers.shares(node, point)
        for b, lever, slope in zip(nodes, levers, slopes, strict=True):
            number = numbers.setdefault((node[0], int(b)), own + len(numbers))
            _add(row, number, w * float(lever), lever * dw + w * slope)
    return row


def _add(row: Row, number: int, w: float, dw: Floats) -> None:
    before = row.get(number, (0.0, np.zeros(3)))
    row[number] = (before[0] + w, before[1] + dw)


def _packed(rows: list[Row]) -> Weights:
    """Rows of one length, filled up with entries of no weight."""
    k = max(len(row) for row in rows)
    if k > _MOST:
        raise ParameterError(
            f"found a point that listens to {k} nodes and frames; {_MOST} at most are accepted: "
            "take fewer neighbours"
        )
    frames = np.empty((len(rows), k), dtype=np.int32)
    values, slopes = np.zeros((len(rows), k)), np.zeros((len(rows), k, 3))
    for p, row in enumerate(rows):
        order = sorted(row)
        frames[p] = order[0]
        frames[p, : len(order)] = order
        for a, number in enumerate(order):
            values[p, a], slopes[p, a] = row[number]
    return Weights(frames, values, slopes)


def _cells_at_nodes(mesh: Mesh) -> dict[int, tuple[Ints, Floats]]:
    """For each node of the surface a cell, and the mean grad N_b of its nodes (k, 3) [1/m]."""
    found: dict[int, tuple[Ints, Floats]] = {}
    wanted = set(mesh.surface().nodes.tolist())
    for block in mesh.body_blocks:
        slopes = _core.mean_gradients(
            cell_type=str(block.type),
            positions=mesh.points,
            cells=np.ascontiguousarray(block.nodes),
        )
        for cell, of_nodes in zip(block.nodes, slopes, strict=True):
            for node in wanted.intersection(cell.tolist()):
                found[node] = (cell, of_nodes)
                wanted.remove(node)
    return found
