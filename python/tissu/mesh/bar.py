"""A bar: a box filled with a regular grid of like cells."""

from __future__ import annotations

import math
from collections.abc import Sequence
from operator import index
from typing import Literal, get_args

import numpy as np

from tissu import _core
from tissu.errors import ParameterError
from tissu.mesh.cell import CellBlock
from tissu.mesh.mesh import Mesh

Cell = Literal["tetra", "hexahedron"]
Split = Literal["six", "five", "six_mirrored"]


def bar_mesh(
    *,
    size: Sequence[float],
    cells: Sequence[int],
    cell: Cell = "tetra",
    split: Split = "six",
    origin: Sequence[float] = (0.0, 0.0, 0.0),
) -> Mesh:
    """A box cut into like cells; nodes are numbered x fastest, then y, then z.

    Args:
        size: lengths along x, y, z [m].
        cells: numbers of grid cells along x, y, z.
        cell: "tetra" or "hexahedron".
        split: how a grid cell is cut into tetrahedra: "six" around one diagonal, all alike;
            "five", in two mirror images like a chessboard; "six_mirrored", each grid cell the
            mirror image of its neighbours.
        origin: smallest corner [m].

    Raises:
        ParameterError: a length or a number that is not positive, or an unknown cell or split.
    """
    lengths, corner = _three(size, "size"), _three(origin, "origin")
    if min(lengths) <= 0.0:
        raise ParameterError(f"found size {lengths}; three positive lengths [m] are accepted")
    if cell not in get_args(Cell):
        raise ParameterError(f"found cell '{cell}'; {' or '.join(get_args(Cell))} is accepted")
    if split not in get_args(Split):
        raise ParameterError(f"found split '{split}'; {', '.join(get_args(Split))} are accepted")
    points, blocks = _core.box_mesh(
        origin=corner,
        size=lengths,
        cells=_counts(cells),
        split=getattr(_core.Split, "none" if cell == "hexahedron" else split),
    )
    return Mesh(points=points, cells=tuple(CellBlock(name, nodes) for name, nodes in blocks))


def _three(values: Sequence[float], name: str) -> tuple[float, float, float]:
    try:
        x, y, z = (float(value) for value in values)
    except (TypeError, ValueError):
        raise ParameterError(f"found {name} {values!r}; three numbers [m] are accepted") from None
    if not all(math.isfinite(value) for value in (x, y, z)):
        raise ParameterError(f"found {name} {values!r}; three finite numbers [m] are accepted")
    return x, y, z


def _counts(cells: Sequence[int]) -> tuple[int, int, int]:
    try:
        x, y, z = (index(count) for count in cells)
    except (TypeError, ValueError):
        raise ParameterError(f"found cells {cells!r}; three whole numbers are accepted") from None
    if min(x, y, z) < 1 or max(x, y, z) > np.iinfo(np.int32).max:
        raise ParameterError(f"found cells {(x, y, z)}; three numbers from 1 on are accepted")
    return x, y, z
