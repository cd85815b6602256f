"""What a person wants to know of a mesh before running it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.mesh.cell import Floats, Ints
from tissu.mesh.surface import area, edge_faults, enclosed_volume

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh

_FLAT = 1e-12  # determinant over cubed diagonal of a cell's box, below which the cell is flat


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class QualityReport:
    """Counts, sizes, shapes and faults of a mesh.

    For a mesh without volume cells the cells are its triangles: `sizes` are areas, `shapes`
    4 sqrt(3) A / (sum of squared edges), and `volume` is what they enclose (nan when open,
    negative when they are wound inwards).

    Attributes:
        name: file, or "mesh".
        solid: whether there are volume cells.
        node_count: number of nodes.
        cells: cell type -> number of cells, faces and lines too.
        bounds: smallest and largest coordinates (2, 3) [m].
        volume: [m3].
        area: of the outer surface [m2].
        triangles: number of triangles of the outer surface, quads split.
        open_edges: edges of the surface that one triangle has; 0 when it is closed.
        clashing_edges: edges of the surface whose triangles are wound against each other.
        overfull_faces: faces that more than two cells share; cells there overlap.
        nonconforming_faces: places where cells touch without sharing a face: a quad against two
            triangles, quads cut along different diagonals, middles of edges on one side only.
        nonconforming_cells: numbers of the cells there.
        parts: number of parts that share no node.
        sizes: volume of each cell [m3].
        shapes: quality of each cell: 1 ideal, 0 flat, negative inside out. Tetrahedra:
            6 sqrt(2) V / l_rms^3; others: scaled Jacobian; all by their corners.
        inverted: numbers of the cells that are inside out, if only at one quadrature point.
        zero_volume: numbers of the cells that are flat.
        unused_nodes: numbers of the nodes that no volume cell uses.
        regions: name -> number of cells.
        unhandled: types of volume cells that cannot be simulated.
        notes: what the reader did.
    """

    name: str
    solid: bool
    node_count: int
    cells: dict[str, int]
    bounds: Floats
    volume: float
    area: float
    triangles: int
    open_edges: int
    clashing_edges: int
    parts: int
    sizes: Floats = field(repr=False)
    shapes: Floats = field(repr=False)
    overfull_faces: int
    nonconforming_faces: int
    nonconforming_cells: Ints
    inverted: Ints
    zero_volume: Ints
    unused_nodes: Ints
    regions: dict[str, int]
    unhandled: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def closed(self) -> bool:
        """Whether the surface has no border."""
        return self.triangles > 0 and self.open_edges == 0

    @property
    def min_quality(self) -> float:
        """Shape of the worst cell; nan without cells."""
        return float(self.shapes.min()) if len(self.shapes) else float("nan")

    @property
    def median_quality(self) -> float:
        """Median shape of the cells; nan without cells."""
        return float(np.median(self.shapes)) if len(self.shapes) else float("nan")

    @property
    def worst(self) -> Ints:
        """Numbers of the five worst-shaped cells, worst first."""
        return np.argsort(self.shapes, kind="stable")[:5].astype(np.int32)

    @property
    def size_ratio(self) -> float:
        """Smallest cell over largest cell; nan without cells."""
        if not len(self.sizes) or self.sizes.max() == 0.0:
            return float("nan")
        return float(self.sizes.min() / self.sizes.max())

    def __str__(self) -> str:
        """A table of it all."""
        from tissu.mesh.table import table

        return table(self)


def report(mesh: Mesh) -> QualityReport:
    """Measure a mesh."""
    surface = mesh.surface()
    open_edges, clashing_edges = edge_faults(surface.triangles)
    faces = area(mesh.points, surface.triangles)
    if mesh.volume_blocks:
        volume, sizes, shapes = mesh.volume(), mesh.cell_volumes(), _shapes(mesh)
        parts = int(mesh.parts().max()) + 1
    else:
        closed = len(faces) > 0 and open_edges == 0
        volume = enclosed_volume(mesh.points, surface.triangles) if closed else float("nan")
        sizes, shapes = faces, _triangle_shapes(mesh.points, surface.triangles, faces)
        parts = triangle_parts(surface.triangles)
    inverted, zero_volume = _faults(mesh)
    native = mesh.native_blocks()
    torn, torn_cells = _core.nonconforming_faces(positions=mesh.points, blocks=native)
    return QualityReport(
        name=mesh.source or "mesh",
        solid=bool(mesh.volume_blocks),
        node_count=mesh.node_count,
        cells=_counts(mesh),
        bounds=mesh.bounds,
        volume=volume,
        area=float(faces.sum()),
        triangles=len(faces),
        open_edges=open_edges,
        clashing_edges=clashing_edges,
        overfull_faces=_core.overfull_face_count(positions=mesh.points, blocks=native),
        nonconforming_faces=torn,
        nonconforming_cells=torn_cells,
        parts=parts,
        sizes=sizes,
        shapes=shapes,
        inverted=inverted,
        zero_volume=zero_volume,
        unused_nodes=mesh.unused_nodes,
        regions={name: len(cells) for name, cells in mesh.regions.items()},
        unhandled=mesh.unhandled,
        notes=mesh.notes,
    )


def _counts(mesh: Mesh) -> dict[str, int]:
    counts: dict[str, int] = {}
    for block in mesh.cells:
        counts[block.type] = counts.get(block.type, 0) + len(block)
    return counts


def _shapes(mesh: Mesh) -> Floats:
    return _core.shape_qualities(positions=mesh.points, blocks=mesh.native_blocks())


def _faults(mesh: Mesh) -> tuple[Ints, Ints]:
    """Numbers of the volume cells that are inside out, and of those that are flat."""
    if not mesh.volume_blocks:
        return np.empty(0, np.int32), np.empty(0, np.int32)
    jacobian = _core.jacobian_ranges(positions=mesh.points, blocks=mesh.native_blocks())
    diagonal = np.concatenate(
        [np.linalg.norm(np.ptp(mesh.points[b.nodes], axis=1), axis=1) for b in mesh.volume_blocks]
    )
    flat = np.abs(jacobian).max(axis=1) <= _FLAT * diagonal**3
    inverted = (jacobian[:, 0] <= 0.0) & ~flat
    return np.flatnonzero(inverted).astype(np.int32), np.flatnonzero(flat).astype(np.int32)


def _triangle_shapes(points: Floats, triangles: Ints, areas: Floats) -> Floats:
    corners = points[triangles]
    squares = ((corners - np.roll(corners, 1, axis=1)) ** 2).sum(axis=(1, 2))
    shape = np.zeros(len(triangles))
    np.divide(4.0 * np.sqrt(3.0) * areas, squares, out=shape, where=squares > 0.0)
    return shape


def triangle_parts(triangles: Ints) -> int:
    """Number of parts of a surface that share no node: labels spread until they rest."""
    label = np.arange(triangles.max(initial=-1) + 1)
    while True:
        smallest = label[triangles].min(axis=1)
        before = label.copy()
        np.minimum.at(label, triangles, smallest[:, None])
        label = label[label]
        if np.array_equal(before, label):
            return len(np.unique(label[triangles]))
