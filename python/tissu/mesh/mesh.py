"""A mesh: nodes, blocks of like cells, named regions, and where it all came from."""

from __future__ import annotations

import dataclasses
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.arrays import real_array
from tissu.counted import counted
from tissu.errors import MeshError
from tissu.mesh import surface as surfaces
from tissu.mesh import thin as thins
from tissu.mesh.cell import CellBlock, Floats, Ints, dimension, handled_types, thin_types

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from tissu.mesh.quality import QualityReport
    from tissu.mesh.regions import Selects
    from tissu.mesh.surface import Surface


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Mesh:
    """Nodes and cells; never changed once made.

    Cells are numbered across `body_blocks`, first block first: volume cells, then sheets, then
    lines where the mesh simulates them.

    Attributes:
        points: rest positions (n, 3) float64 [m], read-only.
        cells: all blocks, faces and lines included; pairs of a type and its nodes, or a mapping
            from one to the other as in meshio, are converted to blocks.
        thin: which cells below three dimensions are simulated: 2 for surfaces, 1 for lines; the
            others only mark borders.
        regions: name -> numbers int32 of cells, increasing; a cell may be in several.
        border_regions: the same of all surface cells and then all line cells, simulated or not.
        source: file it was read from, None when it was made.
        unit: unit of length of the file.
        scale: factor on all lengths, on top of the unit.
        notes: changes that the reader made, in words.
        as_listed: whether cells are numbered across `cells` as they stand, whatever their kind, as
            in the mesh of a body that was cut.

    Raises:
        MeshError: a position that is not finite, an invalid cell, or a number that no node or cell
            has.
    """

    points: Floats
    cells: tuple[CellBlock, ...]
    thin: tuple[int, ...] = ()
    regions: Mapping[str, Ints] = field(default_factory=dict)
    border_regions: Mapping[str, Ints] = field(default_factory=dict)
    source: str | None = None
    unit: str = "m"
    scale: float = 1.0
    notes: tuple[str, ...] = ()
    as_listed: bool = False

    def __post_init__(self) -> None:
        given_points = real_array(self.points, "points", error=MeshError)
        points = np.array(given_points, dtype=np.float64, order="C")
        if points.ndim != 2 or points.shape[1] != 3:
            raise MeshError(f"found points of shape {points.shape}; an array (n, 3) is accepted")
        points.flags.writeable = False
        object.__setattr__(self, "points", points)
        blocks = self.cells.items() if isinstance(self.cells, Mapping) else self.cells
        object.__setattr__(self, "cells", tuple(_block(block) for block in blocks))
        self._require_finite()
        self._require_nodes()
        of_borders = sum(len(block) for block in self.border_blocks)
        for name, count in (("regions", self.cell_count), ("border_regions", of_borders)):
            given = getattr(self, name).items()
            regions = {str(region): _region(region, cells, count) for region, cells in given}
            object.__setattr__(self, name, MappingProxyType(regions))

    def __reduce__(self) -> tuple[object, ...]:
        """Pickled and copied by what it is made of: a view of a mapping cannot be."""
        given = {part.name: getattr(self, part.name) for part in dataclasses.fields(self)}
        for name in ("regions", "border_regions"):
            given[name] = dict(given[name])
        return partial(Mesh, **given), ()

    @property
    def volume_blocks(self) -> tuple[CellBlock, ...]:
        """The blocks that can be simulated: linear and quadratic volume cells."""
        return tuple(block for block in self.cells if block.type in handled_types() and len(block))

    @property
    def border_blocks(self) -> tuple[CellBlock, ...]:
        """The surface cells and then the line cells, simulated or not."""
        found = [b for b in self.cells if b.type in thin_types() and len(b)]
        return tuple(b for m in (2, 1) for b in found if dimension(b.type) == m)

    @property
    def thin_blocks(self) -> tuple[CellBlock, ...]:
        """The surface cells and then the line cells, where they are simulated."""
        return tuple(b for b in self.border_blocks if dimension(b.type) in self.thin)

    @property
    def body_blocks(self) -> tuple[CellBlock, ...]:
        """All blocks that are simulated: volume cells, then surfaces, then lines.

        Where the mesh is `as_listed`, in the order of `cells`.
        """
        if self.as_listed:
            simulated = {id(block) for block in self.volume_blocks + self.thin_blocks}
            return tuple(block for block in self.cells if id(block) in simulated)
        return self.volume_blocks + self.thin_blocks

    @property
    def unhandled(self) -> tuple[str, ...]:
        """Types of volume cells in the mesh that cannot be simulated yet, so a scene refuses it."""
        types = (block.type for block in self.cells if len(block))
        return tuple(t for t in types if dimension(t) == 3 and t not in handled_types())

    @property
    def node_count(self) -> int:
        """Number of nodes."""
        return len(self.points)

    @property
    def cell_count(self) -> int:
        """Number of cells that are simulated."""
        return sum(len(block) for block in self.body_blocks)

    @property
    def bounds(self) -> Floats:
        """Smallest and largest coordinates (2, 3) [m]."""
        return np.array([self.points.min(axis=0), self.points.max(axis=0)])

    @property
    def unused_nodes(self) -> Ints:
        """Numbers of the nodes that no simulated cell uses (without such cells: no cell at all)."""
        used = np.zeros(self.node_count, dtype=bool)
        for block in self.body_blocks or self.cells:
            used[block.nodes] = True
        return np.flatnonzero(~used).astype(np.int32)

    def native_blocks(self) -> list[tuple[str, Ints]]:
        """The volume blocks as the compiled core takes them."""
        return [(block.type, block.nodes) for block in self.volume_blocks]

    def cell_volumes(self) -> Floats:
        """Volume of each volume cell [m3]; negative when it is inside out."""
        return _core.cell_volumes(positions=self.points, blocks=self.native_blocks())

    def volume(self) -> float:
        """Sum of the volumes of the cells [m3]; 0 for a mesh that is only a surface."""
        return float(self.cell_volumes().sum())

    def surface(self) -> Surface:
        """The outer surface of the volume and the faces of sheets that are not on it.

        For a mesh without simulated cells, its own faces.
        """
        return surfaces.boundary(self)

    def surface_mesh(self) -> Mesh:
        """The outer surface as a mesh of its own, with the nodes on it only."""
        blocks = self.surface().faces
        alone = dataclasses.replace(
            self, cells=blocks, thin=(), regions={}, border_regions={}, notes=()
        )
        return alone.without_unused_nodes()

    def parts(self) -> Ints:
        """Part number of each simulated cell; cells that share a node are in one part."""
        if self.thin_blocks:
            return thins.parts(self)
        return _core.connected_parts(positions=self.points, blocks=self.native_blocks())

    def quality(self) -> QualityReport:
        """Size and shape of the cells, and what is wrong with them; print it for a table."""
        from tissu.mesh.quality import report

        return report(self)

    def with_region(self, name: str, where: Selects | ArrayLike) -> Mesh:
        """The same mesh with one more region, or with another one of this name.

        Other regions keep their cells, even those that are in the new one. In a map of laws, the
        key `rest` means the cells of no region of the map.

        Args:
            name: of the region.
            where: a selection such as `Sphere(center, radius)`, which means the cells whose centres
                lie in it, or numbers (k,) of cells, or one bool for each cell (e,).

        Raises:
            MeshError: the selection has no cell, or a number that no cell has.
        """
        from tissu.mesh.regions import with_region

        return with_region(self, name, where)

    def without_unused_nodes(self) -> Mesh:
        """The same mesh without the nodes that no simulated cell uses.

        Faces and lines on such nodes go too.
        """
        unused = self.unused_nodes
        if not len(unused):
            return self
        keep = np.ones(self.node_count, dtype=bool)
        keep[unused] = False
        number = np.cumsum(keep, dtype=np.int32) - 1
        rows = [block.nodes[keep[block.nodes].all(axis=1)] for block in self.cells]
        blocks = [CellBlock(b.type, number[r]) for b, r in zip(self.cells, rows, strict=True)]
        borders = [np.array(keep[b.nodes].all(axis=1), dtype=bool) for b in self.border_blocks]
        return dataclasses.replace(
            self,
            points=self.points[keep],
            cells=tuple(block for block in blocks if len(block)),
            border_regions=thins.kept(self.border_regions, borders),
            notes=(*self.notes, f"{counted(len(unused), 'node')} dropped: no cell uses them"),
        )

    def __repr__(self) -> str:
        """Counts and origin."""
        cells = ", ".join(f"{len(block)} {block.type}" for block in self.cells) or "no cells"
        nodes = counted(self.node_count, "node")
        origin = f", from {self.source}" if self.source else ""
        return f"Mesh({nodes}, {cells}{origin})"

    def _require_finite(self) -> None:
        wrong = np.flatnonzero(~np.isfinite(self.points).all(axis=1))
        if len(wrong):
            raise MeshError(
                f"found {len(wrong)} of {self.node_count} nodes whose position is not finite "
                f"(first: {first_five(wrong)}); finite numbers are accepted: repair the mesh"
            )

    def _require_nodes(self) -> None:
        for block in self.cells:
            outside = ((block.nodes < 0) | (block.nodes >= self.node_count)).any(axis=1)
            if outside.any():
                cell = int(np.flatnonzero(outside)[0])
                raise MeshError(
                    f"{block.type} {cell} has the nodes {block.nodes[cell].tolist()}; "
                    f"numbers from 0 to {self.node_count - 1} are accepted"
                )


def _block(given: object) -> CellBlock:
    """A block, or a pair of a type and its nodes that makes one."""
    if isinstance(given, CellBlock):
        return given
    if isinstance(given, tuple | list) and len(given) == 2 and isinstance(given[0], str):
        return CellBlock(*given)
    raise MeshError(
        f"found {reprlib.repr(given)} among the cells; blocks of cells are accepted: "
        'CellBlock("tetra", nodes), or a pair ("tetra", nodes)'
    )


def _region(name: str, cells: Ints, count: int) -> Ints:
    """The numbers of a region's cells, of `count` there are, increasing and read-only."""
    given = real_array(cells, f"cells of region '{name}'", error=MeshError)
    numbers = np.unique(np.asarray(given, dtype=np.int32)).astype(np.int32)
    if len(numbers) and not 0 <= numbers[0] <= numbers[-1] < count:
        raise MeshError(
            f"region '{name}' has cells from {numbers[0]} to {numbers[-1]}; "
            f"numbers from 0 to {count - 1} are accepted"
        )
    numbers.flags.writeable = False
    return numbers


def first_five(numbers: Ints | np.ndarray[tuple[int], np.dtype[np.int64]]) -> str:
    """The first five numbers, in words."""
    text = ", ".join(str(int(number)) for number in numbers[:5])
    return f"{text}, ..." if len(numbers) > 5 else text
