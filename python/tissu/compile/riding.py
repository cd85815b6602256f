"""Nodes without a rotation that carry tissue: it rides on a cell that they belong to.

A frame at a node j of a cell moves with the cell: p - x_j = F l, F = sum_b x_b (x) grad N_b, the
cell's mean.
So a point that listens to j with the weight w listens to the nodes b of the cell with
w_b = w (delta_jb + l . grad N_b), dw_b/dX = (delta_jb + l . grad N_b) dw/dX + w grad N_b, and the
forces go back the same way (bosman2014, figure 10, for bodies of any resolution).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.compile.prepared import Floats, Ints, Weights
from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.mesh import Mesh

_MOST = 64  # nodes and frames that a point may listen to


def carried(
    prepared: Prepared,
    weights: Weights,
    own: int,
    shared: list[tuple[str, int]],
    points: Floats,
) -> tuple[Weights, list[tuple[str, int]]]:
    """The weights with nodes that have no rotation replaced by the nodes of their cells."""
    used = [shared[n - own] for n in np.unique(weights.frames) if n >= own]
    riding = {name for name, _ in used if not prepared.scene.bodies[name].has_rotations}
    if not riding:
        return weights, shared
    cells = {name: _cells_at_nodes(prepared.bodies[name].mesh) for name in riding}
    numbers = {node: own + i for i, node in enumerate(shared)}
    rows: list[dict[int, tuple[float, Floats]]] = []
    for p, point in enumerate(points):
        row: dict[int, tuple[float, Floats]] = {}
        for a, frame in enumerate(weights.frames[p]):
            w, dw = float(weights.weights[p, a]), weights.gradients[p, a]
            name, node = ("", 0) if frame < own else shared[frame - own]
            if name not in riding:
                _add(row, int(frame), w, dw)
                continue
            mesh = prepared.bodies[name].mesh
            nodes, slopes = cells[name][node]
            levers = (nodes == node) + slopes @ (point - mesh.points[node])
            for b, lever, slope in zip(nodes, levers, slopes, strict=True):
                number = numbers.setdefault((name, int(b)), own + len(numbers))
                _add(row, number, w * float(lever), lever * dw + w * slope)
        rows.append(row)
    return _packed(rows), sorted(numbers, key=lambda node: numbers[node])


def _add(row: dict[int, tuple[float, Floats]], number: int, w: float, dw: Floats) -> None:
    before = row.get(number, (0.0, np.zeros(3)))
    row[number] = (before[0] + w, before[1] + dw)


def _packed(rows: list[dict[int, tuple[float, Floats]]]) -> Weights:
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
