"""Flat bars: a rectangle in z = const cut into surface cells, or a straight line of line cells."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tissu.errors import ParameterError
from tissu.mesh.cell import CellBlock, Floats, thin_types
from tissu.mesh.mesh import Mesh
from tissu.mesh.room import require_room

# Nodes of the cells of one grid cell, by their places in it in halves of its edges.
_CELLS: dict[str, tuple[tuple[tuple[int, int], ...], ...]] = {
    "line": (((0, 0), (2, 0)),),
    "line3": (((0, 0), (2, 0), (1, 0)),),
    "triangle": (((0, 0), (2, 0), (2, 2)), ((0, 0), (2, 2), (0, 2))),
    "triangle6": (
        ((0, 0), (2, 0), (2, 2), (1, 0), (2, 1), (1, 1)),
        ((0, 0), (2, 2), (0, 2), (1, 1), (1, 2), (0, 1)),
    ),
    "quad": (((0, 0), (2, 0), (2, 2), (0, 2)),),
}
_MIDDLES = ((1, 0), (2, 1), (1, 2), (0, 1))
_CELLS["quad8"] = ((*_CELLS["quad"][0], *_MIDDLES),)
_CELLS["quad9"] = ((*_CELLS["quad8"][0], (1, 1)),)


def flat_bar_mesh(
    *,
    size: Sequence[float],
    cells: Sequence[int],
    cell: str,
    origin: Sequence[float] = (0.0, 0.0, 0.0),
) -> Mesh:
    """A rectangle of triangles or quads, or a line along x; nodes are numbered x fastest, then y.

    Args:
        size: lengths along x, y, z [m]; 0 along z, for lines along y too.
        cells: numbers of grid cells along x, y, z; 0 where the length is.
        cell: "quad", "quad8", "quad9", "triangle" or "triangle6" (two to a grid cell), "line",
            "line3".
        origin: smallest corner [m].

    Raises:
        ParameterError: lengths and numbers that are not of such a bar, or another cell type.
    """
    if cell not in _CELLS:
        raise ParameterError(f"found cell '{cell}'; {', '.join(_CELLS)} are accepted")
    dimension = thin_types()[cell].dimension
    lengths, counts = [float(x) for x in size], [int(n) for n in cells]
    for name, numbers in (("size", lengths), ("cells", counts)):
        if len(numbers) != 3 or min(numbers[:dimension]) <= 0 or any(numbers[dimension:]):
            raise ParameterError(
                f"found {name} {tuple(numbers)} for cells of type {cell}; {dimension} positive "
                f"and {3 - dimension} of 0 behind are accepted"
            )
    nx, ny = counts[:2]
    require_room((nx, ny, 0))
    points, width = _lattice(lengths, nx, ny, origin), 2 * nx + 1
    rows, columns = np.mgrid[: max(ny, 1), :nx].reshape(2, -1)
    first = 2 * rows * width + 2 * columns
    blocks = np.stack(
        [np.stack([first + y * width + x for x, y in nodes], axis=1) for nodes in _CELLS[cell]],
        axis=1,
    ).reshape(len(first) * len(_CELLS[cell]), -1)
    return _used(points, blocks, cell)


def _lattice(lengths: Sequence[float], nx: int, ny: int, origin: Sequence[float]) -> Floats:
    """Corners and middles of the edges and faces of the grid cells, x fastest."""
    x, y = np.linspace(0.0, lengths[0], 2 * nx + 1), np.linspace(0.0, lengths[1], 2 * ny + 1)
    across, along = np.meshgrid(y, x, indexing="ij")
    flat = np.stack([along, across, np.zeros_like(along)], axis=-1).reshape(-1, 3)
    return np.asarray(flat + np.asarray(origin, dtype=np.float64))


def _used(
    points: Floats, nodes: np.ndarray[tuple[int, ...], np.dtype[np.int64]], cell: str
) -> Mesh:
    used, number = np.unique(nodes, return_inverse=True)
    numbered = number.reshape(nodes.shape).astype(np.int32)
    return Mesh(points=points[used], cells=(CellBlock(cell, numbered),))
