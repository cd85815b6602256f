"""Displacements at given points of a body, whatever mesh it was computed on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.mesh.shapes import Shape, shape_of

if TYPE_CHECKING:
    from tissu.mesh import Mesh

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SLACK = 1e-6  # of the extent: a point no farther than this from a cell is in it
_AT_ONCE = 4096  # points that are looked for together


@dataclass(frozen=True, slots=True)
class Places:
    """Where points stand in a mesh.

    Attributes:
        nodes: (k, m) numbers of the nodes that carry each point.
        weights: (k, m) value of the shape function of each at the point.
    """

    nodes: Ints
    weights: Floats

    def values(self, of_nodes: Floats) -> Floats:
        """What a field (n, 3) of the nodes is at the points (k, 3)."""
        return np.asarray(np.einsum("km,kmc->kc", self.weights, of_nodes[self.nodes]))


@dataclass(frozen=True, slots=True)
class Holder:
    """A cell in which a point lies.

    Attributes:
        cell: number of the cell in its mesh.
        nodes: (k,) its nodes, corners first.
        weights: (k,) value of the shape function of each at the point.
        local: (m,) local coordinates of the point.
        corners: (c, m) local coordinates of the corners.
        beyond: how far outside the point is; not above 0 inside.
    """

    cell: int
    nodes: Ints
    weights: Floats
    local: Floats
    corners: Floats
    beyond: float


def holders(point: Floats, mesh: Mesh) -> list[Holder]:
    """Every cell in which a point (3,) [m] lies, that first which `places` finds."""
    found: list[Holder] = []
    slack, start = _SLACK * float(np.ptp(mesh.points, axis=0).max()), 0
    for block in mesh.body_blocks:
        shape, nodes = _as_shape(block.type, block.nodes)
        corners = mesh.points[nodes[:, : len(shape.corners)]]
        low, high = corners.min(axis=1) - slack, corners.max(axis=1) + slack
        cell = np.flatnonzero(((point >= low) & (point <= high)).all(axis=1))
        local, apart = shape.local(np.repeat(point[None], len(cell), axis=0), corners[cell])
        beyond = np.where(apart <= slack, shape.beyond(local), np.inf)
        weights = shape.values(local, _own(shape, mesh.points, nodes))
        for i in np.flatnonzero(beyond <= _SLACK):
            own = nodes[cell[i]]
            number = start + int(cell[i]) % len(block)
            at = (own, weights[i], local[i], shape.corners)
            found.append(Holder(number, *at, float(beyond[i])))
        start += len(block)
    return sorted(found, key=lambda holder: holder.beyond)


def places(points: Floats, mesh: Mesh) -> Places:
    """Find the cell of each point (k, 3) [m] and the shape functions of its nodes there.

    Exact for cells whose edges are straight at rest; pyramids are taken as two tetrahedra with
    their corners.

    Raises:
        ParameterError: a point is in no cell.
    """
    blocks = [_as_shape(block.type, block.nodes) for block in mesh.body_blocks]
    width = max(nodes.shape[1] for _, nodes in blocks)
    found = Places(np.zeros((len(points), width), dtype=np.int64), np.zeros((len(points), width)))
    outside = np.full(len(points), np.inf)
    slack = _SLACK * float(np.ptp(mesh.points, axis=0).max())
    for shape, nodes in blocks:
        _improve(found, outside, shape, nodes, points, mesh.points, slack)
    lost = int((outside > _SLACK).sum())
    if lost:
        raise ParameterError(
            f"{counted(lost, 'point')} of {len(points)} of the scene's mesh in no cell of another "
            "resolution of it; the same domain is accepted"
        )
    return found


def nearest_places(points: Floats, mesh: Mesh) -> Places:
    """The volume cell that holds each point (k, 3) [m], or the nearest one, and its weights there.

    Outside all cells the shape functions go on beyond the cell whose local coordinates the point
    leaves least, of those nearby.

    Raises:
        ParameterError: a point is farther from all cells than the length of the longest.
    """
    blocks = [_as_shape(block.type, block.nodes) for block in mesh.volume_blocks]
    width = max(nodes.shape[1] for _, nodes in blocks)
    found = Places(np.zeros((len(points), width), dtype=np.int64), np.zeros((len(points), width)))
    beyond = np.full(len(points), np.inf)
    slack = _SLACK * float(np.ptp(mesh.points, axis=0).max())
    longest = max(float(np.ptp(mesh.points[nodes], axis=1).max()) for _, nodes in blocks)
    for reach in (slack, longest / 8.0, longest / 4.0, longest / 2.0, longest):
        lost = np.flatnonzero(beyond == np.inf) if reach > slack else np.arange(len(points))
        for start in range(0, len(lost), _AT_ONCE):
            some = lost[start : start + _AT_ONCE]
            part, least = Places(found.nodes[some], found.weights[some]), beyond[some]
            for shape, nodes in blocks:
                _improve(part, least, shape, nodes, points[some], mesh.points, slack, reach)
            found.nodes[some], found.weights[some], beyond[some] = part.nodes, part.weights, least
    far = int((beyond == np.inf).sum())
    if far:
        raise ParameterError(
            f"found {counted(far, 'point')} of {len(points)} farther from all cells than "
            f"{longest:.3g} m, the length of the longest; points in the mesh, or near it, are "
            "accepted: look at their place and their unit"
        )
    return found


def _as_shape(cell_type: str, nodes: NDArray[np.int32]) -> tuple[Shape, Ints]:
    if cell_type.startswith("pyramid"):
        halves = np.concatenate([nodes[:, [0, 1, 2, 4]], nodes[:, [0, 2, 3, 4]]])
        return shape_of("tetra"), halves.astype(np.int64)
    return shape_of(cell_type), nodes.astype(np.int64)


def _improve(
    found: Places,
    outside: Floats,
    shape: Shape,
    nodes: Ints,
    points: Floats,
    rest: Floats,
    slack: float,
    reach: float | None = None,
) -> None:
    """Put points into cells of one block where they are farther inside than so far.

    A cell is tried if a point is at most `reach` from its box; the default is `slack`.
    """
    corners = rest[nodes[:, : len(shape.corners)]]
    point, cell = _near(points, corners, slack if reach is None else reach)
    if not len(point):
        return
    local, apart = shape.local(points[point], corners[cell])
    beyond = np.where(apart <= slack, shape.beyond(local), np.inf)
    order = np.lexsort((beyond, point))
    first = order[np.unique(point[order], return_index=True)[1]]
    first = first[beyond[first] < outside[point[first]]]
    at, of = point[first], nodes[cell[first]]
    own = _own(shape, rest, nodes)
    found.nodes[at] = 0
    found.weights[at] = 0.0
    found.nodes[at, : nodes.shape[1]] = of
    found.weights[at, : nodes.shape[1]] = shape.values(local[first], own)
    outside[at] = beyond[first]


def _own(shape: Shape, rest: Floats, nodes: Ints) -> Floats:
    """Local coordinates (k, m) of the nodes of cells (e, k), found in the first of them."""
    first = rest[nodes[0]]
    corners = np.repeat(first[None, : len(shape.corners)], nodes.shape[1], axis=0)
    return shape.local(first, corners)[0]


def _near(points: Floats, corners: Floats, slack: float) -> tuple[Ints, Ints]:
    """Pairs of points and cells (e, k, 3) whose boxes hold them, by way of a grid of boxes."""
    low, high = corners.min(axis=1) - slack, corners.max(axis=1) + slack
    start, stop = low.min(axis=0), high.max(axis=0)
    size = np.maximum(np.median(high - low, axis=0), (stop - start) / 64.0)
    counts = np.maximum(np.ceil((stop - start) / size).astype(np.int64), 1)

    def column(places: Floats) -> Ints:
        return np.asarray(np.clip(((places - start) / size).astype(np.int64), 0, counts - 1))

    first, last = column(low), column(high)
    spread = last - first + 1
    total = spread.prod(axis=1)
    cell = np.repeat(np.arange(len(corners)), total)
    rank = np.arange(total.sum()) - np.repeat(total.cumsum() - total, total)
    z = rank % spread[cell, 2]
    y = rank // spread[cell, 2] % spread[cell, 1]
    x = rank // (spread[cell, 2] * spread[cell, 1])
    column_of = np.ravel_multi_index((first[cell] + np.stack([x, y, z], axis=1)).T, counts)
    order = np.argsort(column_of, kind="stable")
    column_of, cell = column_of[order], cell[order]
    wanted = np.ravel_multi_index(column(points).T, counts)
    begin: Ints = np.asarray(np.searchsorted(column_of, wanted, side="left"))
    many: Ints = np.asarray(np.searchsorted(column_of, wanted, side="right")) - begin
    point = np.repeat(np.arange(len(points)), many)
    near = cell[np.arange(many.sum()) - np.repeat(many.cumsum() - many, many) + begin[point]]
    inside = ((points[point] >= low[near]) & (points[point] <= high[near])).all(axis=1)
    return point[inside], near[inside]
