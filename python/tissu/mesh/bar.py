"""A bar: a box filled with a regular grid of like cells."""

from __future__ import annotations

import math
from collections.abc import Sequence
from operator import index
from typing import Literal, get_args

import numpy as np

from tissu import _core
from tissu.errors import ParameterError
from tissu.mesh.cell import (
    CellBlock,
    Floats,
    Ints,
    cell_table,
    handled_types,
    linear_type,
    thin_types,
)
from tissu.mesh.cut import into_pyramids, into_wedges
from tissu.mesh.flat_bar import flat_bar_mesh
from tissu.mesh.mesh import Mesh
from tissu.mesh.quadratic import into_quadratic
from tissu.mesh.room import require_room

Split = Literal["six", "five", "six_mirrored"]


def bar_mesh(
    *,
    size: Sequence[float],
    cells: Sequence[int],
    cell: str = "tetra",
    split: Split = "six",
    origin: Sequence[float] = (0.0, 0.0, 0.0),
) -> Mesh:
    """A box, plate or line of cells of one type; nodes are numbered x fastest, then y, then z.

    The tips of pyramids come after the corners of the grid, the middles of edges after both.

    Args:
        size: lengths along x, y, z [m].
        cells: numbers of grid cells along x, y, z.
        cell: type as meshio names it: a grid cell is one "hexahedron", 2 of "wedge", 6 of
            "pyramid" or as `split` says "tetra"; "tetra10", "hexahedron20", "hexahedron27",
            "wedge15", "pyramid13" are those with middle nodes; flat ones: see `flat_bar_mesh`.
        split: how a grid cell is cut into tetrahedra: "six" around one diagonal, all alike;
            "five", in two mirror images like a chessboard; "six_mirrored", each grid cell the
            mirror image of its neighbours.
        origin: smallest corner [m].

    Raises:
        ParameterError: a length or a number that is not positive, an unknown cell or split, or a
            split of cells that are not tetrahedra.
    """
    if cell in thin_types():
        _require_no_split(cell, split)
        return flat_bar_mesh(size=size, cells=cells, cell=cell, origin=origin)
    if cell not in handled_types():
        accepted = ", ".join((*handled_types(), *thin_types()))
        raise ParameterError(f"found cell '{cell}'; {accepted} are accepted")
    if split not in get_args(Split):
        raise ParameterError(f"found split '{split}'; {', '.join(get_args(Split))} are accepted")
    base = linear_type(cell)
    if base != "tetra":
        _require_no_split(cell, split)
    cut = split if base == "tetra" else "none"
    points, nodes = grid(size=size, cells=cells, origin=origin, split=cut)
    if base == "wedge":
        ((_, nodes),) = into_wedges(nodes, triangles_along_x=False)
    elif base == "pyramid":
        points, tips = with_centres(points, nodes)
        ((_, nodes),) = into_pyramids(nodes, tips)
    mesh = Mesh(points=points, cells=(CellBlock(base, nodes),))
    if cell_table()[cell].order == 1:
        return mesh
    return into_quadratic(mesh, centres=cell == "hexahedron27")


def _require_no_split(cell: str, split: str) -> None:
    if split != "six":
        raise ParameterError(
            f"found split '{split}' of cells of type {cell}; only tetra and tetra10 are split: "
            "leave split out"
        )


def grid(
    *, size: Sequence[float], cells: Sequence[int], origin: Sequence[float], split: str = "none"
) -> tuple[Floats, Ints]:
    """Nodes (n, 3) [m] of a box and its grid cells (e, 8), or its tetrahedra (e, 4) by `split`.

    Raises:
        ParameterError: a length or a number that is not positive.
    """
    lengths, corner = _three(size, "size"), _three(origin, "origin")
    if min(lengths) <= 0.0:
        raise ParameterError(f"found size {lengths}; three positive lengths [m] are accepted")
    points, ((_, nodes),) = _core.box_mesh(
        origin=corner, size=lengths, cells=counts(cells), split=getattr(_core.Split, split)
    )
    return points, nodes


def with_centres(points: Floats, corners: Ints) -> tuple[Floats, Ints]:
    """Points with the middle of each grid cell (e, 8) behind them, and its number (e,)."""
    numbers = np.arange(len(points), len(points) + len(corners), dtype=np.int32)
    return np.vstack([points, points[corners].mean(axis=1)]), numbers


def _three(values: Sequence[float], name: str) -> tuple[float, float, float]:
    try:
        x, y, z = (float(value) for value in values)
    except (TypeError, ValueError):
        raise ParameterError(f"found {name} {values!r}; three numbers [m] are accepted") from None
    if not all(math.isfinite(value) for value in (x, y, z)):
        raise ParameterError(f"found {name} {values!r}; three finite numbers [m] are accepted")
    return x, y, z


def counts(cells: Sequence[int]) -> tuple[int, int, int]:
    """Three positive whole numbers.

    Raises:
        ParameterError: they are not.
    """
    try:
        x, y, z = (index(count) for count in cells)
    except (TypeError, ValueError):
        raise ParameterError(f"found cells {cells!r}; three whole numbers are accepted") from None
    if min(x, y, z) < 1 or max(x, y, z) > np.iinfo(np.int32).max:
        raise ParameterError(f"found cells {(x, y, z)}; three numbers from 1 on are accepted")
    require_room((x, y, z))
    return x, y, z
