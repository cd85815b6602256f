"""Which unknowns carry a point of a body: a node, a place in a cell, a place on a frame."""

from __future__ import annotations

import numbers
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from tissu import units
from tissu.errors import ParameterError
from tissu.mesh.places import places
from tissu.simulation.held_place import holder_in_material

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.cutting.material import Material
    from tissu.mesh import Mesh
    from tissu.reading import VectorLike

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_POSITION = units.Triple(units.LENGTH)


@dataclass(frozen=True, slots=True)
class GrabPoint:
    """A point of a body, as a weighted mean of its nodes.

    Attributes:
        nodes: numbers (k,) of nodes and
        weights: their weights (k,), which sum to one.
        offset: (3,) from the node, in the axes of its frame [m]; None: the nodes are not frames,
            or the node itself is the point.
    """

    nodes: Ints
    weights: Floats
    offset: Floats | None = None


def grab_point(
    simulation: core.Simulation,
    *,
    body: str,
    mesh: Mesh,
    material: Material | None,
    at: int | VectorLike,
    offset: VectorLike | None,
) -> GrabPoint:
    """The point at a node, or at a place of the body at rest.

    Args:
        simulation: of the core.
        body: its name.
        mesh: of its cells.
        material: what is there of these where cuts have parted some; else None.
        at: number of the node, or the place (3,) [m].
        offset: from a node that is a frame.

    Raises:
        ParameterError: no such node, a place outside, an offset where nodes are not frames, or
            nodes that cannot move.
    """
    has_frames = simulation.frames_of(body)[0] >= 0
    if isinstance(at, numbers.Integral) and not isinstance(at, bool):
        point = _node(int(at), body, mesh, offset, has_frames=has_frames)
    else:
        place = _place_of(cast("VectorLike", at), body, offset, has_frames=has_frames)
        cells = np.sort(simulation.remaining_cells(body)) if material is not None else None
        found = point_at(place, mesh, cells, material)
        if found is None:
            x, y, z = place
            raise ParameterError(
                f"found the place ({x:g}, {y:g}, {z:g}) m, which is in no cell of '{body}' at "
                "rest; one inside it, or the number of a node, is accepted"
            )
        point = found
    require_free(simulation, body, point.nodes)
    return point


def point_at(
    place: Floats, mesh: Mesh, cells: NDArray[np.int32] | None, material: Material | None
) -> GrabPoint | None:
    """The point at a place of a body at rest (3,) [m]; None where no cell has it.

    Args:
        place: (3,) [m].
        mesh: of the cells.
        cells: their numbers, and
        material: what is there of them, where cuts have parted some; else None.
    """
    if material is not None and cells is not None:
        holder = holder_in_material(place, mesh, cells, material)
        if holder is None:
            return None
        nodes, weights = holder.nodes, holder.weights
    else:
        try:
            found = places(place[None], mesh)
        except ParameterError:
            return None
        nodes, weights = found.nodes[0], found.weights[0]
    used = np.flatnonzero(weights)
    return GrabPoint(nodes[used], weights[used])


def _node(
    node: int, body: str, mesh: Mesh, offset: VectorLike | None, *, has_frames: bool
) -> GrabPoint:
    count = mesh.node_count
    if not 0 <= node < count:
        raise ParameterError(f"found node {node} of '{body}'; 0 to {count - 1} are accepted")
    if mesh.body_blocks and not any((block.nodes == node).any() for block in mesh.body_blocks):
        raise ParameterError(
            f"found node {node} of '{body}', which has no cell (any more), so that nothing goes "
            "with it; a node with a cell is accepted"
        )
    if offset is not None and not has_frames:
        raise ParameterError(
            f"found an offset from node {node} of '{body}', whose nodes have no rotation; a place "
            "of the body at rest is accepted in place of the node"
        )
    arm = None if offset is None else np.array(_POSITION(offset), dtype=float)
    return GrabPoint(np.array([node]), np.ones(1), arm)


def _place_of(at: VectorLike, body: str, offset: VectorLike | None, *, has_frames: bool) -> Floats:
    place = np.array(_POSITION(at), dtype=float)
    if has_frames:
        raise ParameterError(
            f"found a place of '{body}', whose nodes are frames; the number of a node is accepted, "
            "with the offset of the point from it"
        )
    if offset is not None:
        raise ParameterError("found an offset from a place; from a node that is a frame it is one")
    return place


def require_free(simulation: core.Simulation, body: str, nodes: Ints) -> None:
    """Refuse a point that no pull moves, or that has no unknown.

    Raises:
        ParameterError: why.
    """
    eliminated, held = simulation.unfree_nodes(body)
    inner = nodes[np.isin(nodes, eliminated)]
    if len(inner):
        raise ParameterError(
            f"found node {inner[0]} of '{body}' inside a condensed region, which has no unknown; "
            "a point outside the region or at its rim is accepted"
        )
    if np.isin(nodes, held).all():
        raise ParameterError(
            f"found node {nodes[0]} of '{body}', which is held or led on all axes, so that no "
            "pull moves it; a point that is free to move is accepted"
        )
