"""Cells: their names, and blocks of like ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from tissu import _core
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


@cache
def handled_types() -> tuple[str, ...]:
    """Names of the volume cell types that can be simulated."""
    return tuple(name for name, _, dimension in _core.cell_types() if dimension == 3)


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
        nodes = np.array(self.nodes, dtype=np.int32, order="C")
        if nodes.ndim != 2:
            raise MeshError(
                f"found node numbers of shape {nodes.shape} for the cells of type '{self.type}'; "
                "an array (cells, nodes per cell) is accepted"
            )
        for name, width, _ in _core.cell_types():
            if name == self.type and nodes.shape[1] != width:
                raise MeshError(f"found {nodes.shape[1]} nodes per {name}; it has {width}")
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
