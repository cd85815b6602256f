"""Forces of a body's nodes, shared among the points of its material so that they add up.

A node that is a point of the material keeps its force. A copy of a node may lie outside the
material that it moves: it has no point, and its force goes to the points that it carries, in
proportion to their weights for it, or, if it carries none, in equal parts to the points of its
cells. A couple on the points of the cells around these makes up for the lever,
f_i = w_i F + theta x (x_i - c) with I theta = (x_node - sum w_i x_i) x F, where I is the inertia of
unit masses at the points about their centre c.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tissu.cutting.material import Material
    from tissu.mesh import Mesh

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_FLAT = 1e-9
"""of the largest moment of inertia: less is that of points on a line, about the line"""


def spread(
    material: Material, mesh: Mesh, cells: Ints, forces: Floats, now: Floats | None
) -> Floats:
    """See `Material.spread`."""
    result = np.zeros((len(material.points), 3))
    own = np.flatnonzero(material.numbers >= 0)
    result[own] = forces[material.numbers[own]]
    without = np.any(forces != 0.0, axis=1)
    without[material.numbers[own]] = False
    if not without.any():
        return result
    points_of = _points_of_cells(material)
    for node, around in _cells_of_nodes(mesh, cells, without).items():
        places = [points_of[cell] for cell in around if cell in points_of]
        if not places:
            continue
        near = np.unique(np.concatenate(places))
        shares = np.where(material.nodes[near] == node, material.weights[near], 0.0).sum(axis=1)
        if not shares.any():
            shares = np.ones(len(near))
        shares /= shares.sum()
        result[near] += shares[:, None] * forces[node]
        if now is not None:
            lever = now[node] - shares @ material.points[near]
            result[near] += _couple(material.points[near], np.cross(lever, forces[node]))
    return result


def _couple(points: Floats, moment: Floats) -> Floats:
    """The least forces (k, 3) on points that have a moment, and no sum."""
    off = points - points.mean(axis=0)
    spread_out = off.T @ off
    inertia = np.trace(spread_out) * np.eye(3) - spread_out
    turn = np.linalg.pinv(inertia, rcond=_FLAT, hermitian=True) @ moment
    return np.asarray(np.cross(turn, off))


def _points_of_cells(material: Material) -> dict[int, Ints]:
    """The points of the material of each cell of the body."""
    first, of_cell, points = 0, [], []
    for block in material.mesh.body_blocks:
        count, width = block.nodes.shape
        of_cell.append(np.repeat(material.cell[first : first + count], width))
        points.append(np.asarray(block.nodes).ravel())
        first += count
    return _grouped(np.concatenate(of_cell), np.concatenate(points))


def _cells_of_nodes(mesh: Mesh, cells: Ints, wanted: NDArray[np.bool_]) -> dict[int, Ints]:
    """The numbers of the cells at each wanted node."""
    first, nodes, at = 0, [], []
    for block in mesh.body_blocks:
        count, width = block.nodes.shape
        of_block = np.asarray(block.nodes).ravel()
        there = wanted[of_block]
        nodes.append(of_block[there])
        at.append(np.repeat(cells[first : first + count], width)[there])
        first += count
    return _grouped(np.concatenate(nodes), np.concatenate(at))


def _grouped(keys: Ints, values: Ints) -> dict[int, Ints]:
    """The values of each key, each once."""
    pairs = np.unique(np.stack([keys, values], axis=1), axis=0)
    found, begin = np.unique(pairs[:, 0], return_index=True)
    lists = np.split(pairs[:, 1].astype(np.int32), begin)[1:]
    return {int(key): list_ for key, list_ in zip(found, lists, strict=True)}
