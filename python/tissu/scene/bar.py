"""A bar of cells: a box, a flat plate or a straight line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import BeforeValidator, Field

from tissu import units
from tissu.reading import Read, listed
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.selection import NamedSelections
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from tissu.mesh import Mesh

__all__ = ["BarMesh"]

_Count = Annotated[int, Field(ge=0)]
_Counts = Read[tuple[_Count, _Count, _Count], Sequence[int]]
_LENGTHS = {
    1: "a positive length along x, 0 along y and z",
    2: "positive lengths along x and y and 0 along z",
    3: "three positive lengths",
}
_COUNTS = {
    1: "a number from 1 on along x and 0 along y and z",
    2: "numbers from 1 on along x and y and 0 along z",
    3: "three numbers from 1 on",
}
BarCell = Literal[
    "tetra",
    "tetra10",
    "hexahedron",
    "hexahedron20",
    "hexahedron27",
    "wedge",
    "wedge15",
    "pyramid",
    "pyramid13",
    "triangle",
    "triangle6",
    "quad",
    "quad8",
    "quad9",
    "line",
    "line3",
]


class BarMesh(Part):
    """A box, plate or line of cells of one type, or a box in segments of one cell type each."""

    type: Literal["bar"] = "bar"
    size: units.Position
    """lengths along x, y, z [m]; z is 0 for triangles and quads, y and z for lines"""
    cells: Annotated[_Counts, BeforeValidator(listed)]
    """numbers of boxes along x, y, z; 0 where the length is 0"""
    cell: BarCell = "tetra"
    """cell type"""
    segments: str | None = None
    """cell types along x with a label each, "wedge6:stvk, hex8:stvk, tet4:hooke", instead of
    `cell`; they are the regions "1 wedge stvk", "2 hexahedron stvk", "3 tetra hooke" """
    split: Literal["six", "five", "six_mirrored"] = "six"
    """how a box is cut into tetrahedra; of `tetra` and `tetra10` only"""
    origin: units.Position = field(default=(0.0, 0.0, 0.0))
    """smallest corner [m]"""
    regions: NamedSelections = field(default_factory=dict)
    """regions by name, of the cells whose centres lie in a shape: {tumour: {type: sphere, ...}}"""

    @rule("cell", "split")
    def _splits_tetrahedra(self) -> Iterator[Problem]:
        if self.split != "six" and not self.cell.startswith("tetra"):
            text = f"found split {self.split} of cells of type {self.cell}"
            yield Problem((), f"{text}; only tetra and tetra10 are split: leave split out")

    @rule("segments")
    def _segments_stand_alone(self) -> Iterator[Problem]:
        extra = [name for name in ("cell", "split") if name in self.model_fields_set]
        if self.segments is not None and extra:
            text = f"found segments and {' and '.join(extra)}; segments alone are accepted"
            yield Problem((), text)

    @rule("size")
    def _lengths(self) -> Iterator[Problem]:
        dimension = bar_dimension(self.cell)
        if not _fills(self.size, dimension):
            found = f"found {self.size} for cells of type {self.cell}"
            yield Problem(("size",), f"{found}; {_LENGTHS[dimension]} are accepted")

    @rule("cells")
    def _counts(self) -> Iterator[Problem]:
        dimension = bar_dimension(self.cell)
        if not _fills(self.cells, dimension):
            found = f"found {self.cells} for cells of type {self.cell}"
            yield Problem(("cells",), f"{found}; {_COUNTS[dimension]} are accepted")

    def mesh(self) -> Mesh:
        """The mesh.

        Raises:
            TissuError: cells or segments that do not fit together.
        """
        from tissu.mesh import bar_mesh, mixed_bar_mesh
        from tissu.mesh.segment import parse_segments

        size, cells, origin = self.size, self.cells, self.origin
        if self.segments is not None:
            segments = parse_segments(self.segments)
            return mixed_bar_mesh(size=size, cells=cells, segments=segments, origin=origin)
        return bar_mesh(size=size, cells=cells, cell=self.cell, split=self.split, origin=origin)


def bar_dimension(cell: str) -> int:
    """1 for lines, 2 for triangles and quads, 3 for volumes."""
    families = (("line", 1), ("triangle", 2), ("quad", 2))
    return next((m for family, m in families if cell.startswith(family)), 3)


def _fills(numbers: tuple[float, ...], dimension: int) -> bool:
    """Whether the first ones are positive and the others 0."""
    first, others = numbers[:dimension], numbers[dimension:]
    return min(first) > 0 and not any(others)
