"""What cells keep, measured in the core on a mesh of each element: `tissu info --constants`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from tissu.mesh import Mesh

PAPER = {"triangle": 6, "tetra": 11, "pyramid": 71, "wedge": 77, "hexahedron": 40}
"""Constants per element of Faure (thesis, 2014), who counts hexahedra as boxes."""
_GRID = {3: (6, 6, 6), 2: (20, 20, 0), 1: (400, 0, 0)}
_BENT = 0.05  # of the length of a grid cell: how far nodes are moved to make cells general


@dataclass(frozen=True, slots=True)
class Storage:
    """What a block of cells of one element and one law holds.

    Attributes:
        cells: how many there are.
        reals: numbers kept per cell of its rest shape and, where cells differ, its law.
        bytes: of all of it, places of nodes and of matrix blocks included.
    """

    cells: int
    reals: int
    bytes: int

    @property
    def per_cell(self) -> float:
        """Bytes per cell."""
        return self.bytes / self.cells


@dataclass(frozen=True, slots=True)
class Row:
    """What an element keeps with one law.

    Attributes:
        element: its name.
        nodes: its number of nodes.
        dimension: of its reference cell.
        law: the law's name.
        law_constants: numbers that the law needs of a cell whose parameters are its own.
        affine: of cells whose Jacobian is constant; surfaces in one plane of z.
        general: of cells of any shape; surfaces and lines bent in space.
        own: of affine cells with parameters of their own.
    """

    element: str
    nodes: int
    dimension: int
    law: str
    law_constants: int
    affine: Storage
    general: Storage
    own: Storage


def rows() -> Iterator[Row]:
    """Every element with every law that its cells may be made of."""
    from tissu import _core
    from tissu.mesh import bar_mesh

    for element, nodes, dimension, _ in _core.elements():
        counts = _GRID[dimension]
        mesh = bar_mesh(size=[float(n) for n in counts], cells=counts, cell=element)
        bent = _bent(mesh)
        for law, typical, constants, addition, dimensions in _core.laws():
            if addition or dimension not in dimensions:
                continue
            yield Row(
                element,
                nodes,
                dimension,
                law,
                constants,
                _measured(mesh.points, mesh, law, typical, own=False),
                _measured(bent, mesh, law, typical, own=False),
                _measured(mesh.points, mesh, law, typical, own=True),
            )


def _bent(mesh: Mesh) -> Any:
    return mesh.points + np.random.default_rng(1).uniform(-_BENT, _BENT, mesh.points.shape)


def _measured(
    points: Any, mesh: Mesh, law: str, typical: dict[str, float], *, own: bool
) -> Storage:
    """A world of one body, and what its elastic blocks say of themselves."""
    from tissu import _core

    (block,) = mesh.cells
    count = len(block) if own else 1
    builder = _core.WorldBuilder(threads=1, editable=False, grabbing=False, consistent_weight=False)
    builder.add_body(name="body", positions=points, frames=False)
    builder.add_elastic(
        body="body",
        cell_type=block.type,
        cells=block.nodes,
        cell_numbers=np.arange(len(block), dtype=np.int32),
        law=law,
        parameters={name: np.full(count, value) for name, value in typical.items()},
        density=np.array([1000.0]),
        quadrature="full",
        reinforcements=[],
        loaded=None,
        cross_section=np.array([1.0]),
        section=("round", [0.0] * 5, [0.0] * 3),
        plane=_core.Plane.stress,
        model=_core.FEM(),
    )
    found = builder.build().elastic_blocks
    return Storage(
        cells=sum(cells for *_, cells, _, _ in found),
        reals=max(reals for *_, reals in found),
        bytes=sum(size for *_, size, _ in found),
    )


def constants_text() -> str:
    """The table; laws with the same numbers share a line."""
    head = ("element", "affine", "general", "own", "paper", "bytes", "bytes", "laws")
    below = ("", "", "", "parameters", "", "affine", "general", "")
    same: dict[tuple[str, ...], list[str]] = {}
    for row in rows():
        cells = (
            row.element,
            *(str(s.reals) for s in (row.affine, row.general, row.own)),
            str(PAPER.get(row.element, "")),
            *(f"{s.per_cell:.0f}" for s in (row.affine, row.general)),
        )
        same.setdefault(cells, []).append(row.law)
    lines = [head, below, *((*cells, ", ".join(laws)) for cells, laws in same.items())]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head) - 1)]
    text = [
        "Numbers kept per cell; of a law that all cells share the constants are kept once.",
        "affine: one Jacobian a cell, surfaces in a plane of z; general: any shape, surfaces and",
        "lines bent in space; own parameters: affine, each cell its own. paper: Faure 2014,",
        "hexahedra as boxes. bytes: measured, places of nodes and of matrix blocks included.",
        "",
    ]
    for line in lines:
        numbers = "  ".join(f"{line[i]:>{widths[i]}}" for i in range(1, len(widths)))
        text.append(f"{line[0]:<{widths[0]}}  {numbers}  {line[-1]}".rstrip())
    return "\n".join(text)
