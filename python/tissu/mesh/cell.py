"""Cells: their names, and blocks of like ones."""

from __future__ import annotations

import reprlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.arrays import real_array
from tissu.errors import MeshError

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_DIMENSIONS = {
    "vertex": 0,
    "line": 1,
    "curve": 1,
    "triangle": 2,
    "quad": 2,
    "polygon": 2,
    "tetra": 3,
    "hexahedron": 3,
    "wedge": 3,
    "pyramid": 3,
    "polyhedron": 3,
}
_CORNERS = {"line": 2, "triangle": 3, "quad": 4}


class CellType(NamedTuple):
    """What is fixed by the type of a cell.

    Attributes:
        name: as in meshio.
        nodes: number of nodes; corners first, then middles of edges, of faces, of the cell.
        dimension: 3 for a volume.
        order: 1 for straight edges, 2 for a node in the middle of each.
        corners: number of corners.
    """

    name: str
    nodes: int
    dimension: int
    order: int
    corners: int


@cache
def cell_table() -> dict[str, CellType]:
    """The cell types of the compiled core by their names."""
    return {row[0]: CellType(*row) for row in _core.cell_types()}


@cache
def handled_types() -> tuple[str, ...]:
    """Names of the volume cell types that can be simulated."""
    return tuple(row.name for row in cell_table().values() if row.dimension == 3)


@cache
def thin_types() -> dict[str, CellType]:
    """The types of surface and line cells that can be simulated, by their names."""
    rows = (row for row in _core.elements() if row[2] < 3)
    # A surface has as many corners as straight edges: 3 of triangle*, 4 of quad*; a line has 2.
    return {row[0]: CellType(*row, corners=_CORNERS[row[0].rstrip("0123456789")]) for row in rows}


def linear_type(name: str) -> str:
    """The handled type with the same corners and straight edges."""
    corners = cell_table()[name].corners
    return next(r.name for r in cell_table().values() if r.order == 1 and r.corners == corners)


def dimension(cell_type: str) -> int:
    """0 for a point, 1 for a line, 2 for a face, 3 for a volume, by the name that meshio gives.

    Raises:
        MeshError: a name of no known family.
    """
    name = cell_type.lower().removeprefix("vtk_lagrange_")
    for family, value in _DIMENSIONS.items():
        if name.startswith(family):
            return value
    raise MeshError(
        f"cells of type '{cell_type}' are not known; accepted: {', '.join(_DIMENSIONS)}"
    )


@dataclass(frozen=True, slots=True, eq=False)
class CellBlock:
    """Cells of one type.

    Attributes:
        type: name as in meshio: "tetra", "hexahedron", "triangle", ...
        nodes: node numbers (e, k) int32, read-only, in VTK order.
    """

    type: str
    nodes: Ints

    def __post_init__(self) -> None:
        dimension(self.type)
        given = real_array(self.nodes, "node numbers", error=MeshError)
        with np.errstate(invalid="ignore"):
            whole = given.size == 0 or bool(np.all(given == np.floor(given)))
        if not whole or (given.size and np.abs(given).max() > np.iinfo(np.int32).max):
            raise MeshError(
                f"found node numbers {reprlib.repr(given.ravel().tolist())} for the cells of type "
                f"'{self.type}'; whole numbers up to 2147483647 are accepted"
            )
        nodes = np.array(given, dtype=np.int32, order="C")
        if nodes.ndim != 2:
            raise MeshError(
                f"found node numbers of shape {nodes.shape} for the cells of type '{self.type}'; "
                "an array (cells, nodes per cell) is accepted"
            )
        known = cell_table().get(self.type) or thin_types().get(self.type)
        if known and nodes.shape[1] != known.nodes:
            raise MeshError(f"found {nodes.shape[1]} nodes per {self.type}; it has {known.nodes}")
        nodes.flags.writeable = False
        object.__setattr__(self, "nodes", nodes)

    def __len__(self) -> int:
        """Number of cells."""
        return len(self.nodes)

    def __repr__(self) -> str:
        """Type and number of cells."""
        return f"CellBlock({len(self)} {self.type})"


def corners(blocks: tuple[CellBlock, ...], family: str, count: int) -> Iterator[Ints]:
    """The first `count` nodes of the cells of a family, so that quadratic faces are faces too."""
    for block in blocks:
        if block.type.startswith(family):
            yield block.nodes[:, :count]
