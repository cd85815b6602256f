"""A bar of segments of different cell types whose faces match."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.mesh import cut
from tissu.mesh.bar import counts, grid, with_centres
from tissu.mesh.cell import CellBlock, Floats, Ints, cell_table
from tissu.mesh.mesh import Mesh
from tissu.mesh.quadratic import into_quadratic
from tissu.mesh.segment import Segment, segments_of


def mixed_bar_mesh(
    *,
    size: Sequence[float],
    cells: Sequence[int],
    segments: Sequence[tuple[str, str]],
    origin: Sequence[float] = (0.0, 0.0, 0.0),
) -> Mesh:
    """A box divided along x into equal segments, each cut into cells of its own type.

    Every face inside is shared by two cells: where tetrahedra meet quads, the layer of grid cells
    of their segment there holds pyramids on the quads and tetrahedra around them.

    Args:
        size: lengths along x, y, z [m].
        cells: numbers of grid cells along x, y, z; along x a multiple of the number of segments.
        segments: (cell type, label) of each; the cell type by meshio's name or as "wedge6",
            "pyramid5", "hex8", "tet4", ...; the label, a law for instance, may be empty. The region
            of the first segment is called "1 wedge label".
        origin: smallest corner [m].

    Raises:
        ParameterError: a length or a number that is not positive, an unknown cell type, types whose
            middle nodes do not match, or a number of grid cells that does not divide.
    """
    parts, number = segments_of(segments), counts(cells)
    if number[0] % len(parts):
        raise ParameterError(
            f"found {counted(number[0], 'cell')} along x for {counted(len(parts), 'segment')}; "
            f"a multiple of {len(parts)} is accepted"
        )
    points, corners = grid(size=size, cells=cells, origin=origin)
    points, tips = with_centres(points, corners)
    shape = number[::-1]
    grids = (corners.reshape(*shape, 8), tips.reshape(shape))
    width = number[0] // len(parts)
    cut_cells = [
        (part.region, name, nodes)
        for i, part in enumerate(parts)
        for name, nodes in _cells(part, *(a[:, :, i * width : (i + 1) * width] for a in grids))
    ]
    mesh = _gathered(points, cut_cells)
    if cell_table()[parts[0].cell].order == 1:
        return mesh
    return into_quadratic(mesh, centres=parts[0].cell == "hexahedron27")


def _cells(part: Segment, corners: Ints, tips: Ints) -> Iterator[tuple[str, Ints]]:
    """Cells of a segment from its grid cells (z, y, x, 8) and their centres (z, y, x)."""
    everything = corners.reshape(-1, 8)
    if part.base == "hexahedron":
        yield "hexahedron", everything
    elif part.base == "wedge":
        yield from cut.into_wedges(everything, triangles_along_x=part.lying)
    elif part.base == "pyramid":
        yield from cut.into_pyramids(everything, tips.reshape(-1))
    else:
        yield from _tetrahedra(part, corners, tips)


def _tetrahedra(part: Segment, corners: Ints, tips: Ints) -> Iterator[tuple[str, Ints]]:
    """Tetrahedra, with a layer of transition at the ends where there are quads."""
    last = corners.shape[2] - 1
    for layer in range(last + 1):
        quads = (cut.LEFT,) * (part.left and layer == 0)
        quads += (cut.RIGHT,) * (part.right and layer == last)
        of_layer = corners[:, :, layer].reshape(-1, 8)
        if quads:
            yield from cut.into_transition(of_layer, tips[:, :, layer].reshape(-1), quads)
        else:
            yield from cut.into_six(of_layer)


def _gathered(points: Floats, pieces: list[tuple[str, str, Ints]]) -> Mesh:
    """A mesh of pieces (region, cell type, nodes): like cells together, tips only where used."""
    blocks, owners = [], []
    for name in dict.fromkeys(name for _, name, _ in pieces):
        blocks.append(CellBlock(name, np.concatenate([n for _, t, n in pieces if t == name])))
        owners += [np.full(len(n), region) for region, t, n in pieces if t == name]
    owner = np.concatenate(owners)
    regions = {
        region: np.flatnonzero(owner == region).astype(np.int32)
        for region in dict.fromkeys(region for region, _, _ in pieces)
    }
    used = np.zeros(len(points), dtype=bool)
    for block in blocks:
        used[block.nodes] = True
    place = np.cumsum(used, dtype=np.int32) - 1
    kept = tuple(CellBlock(block.type, place[block.nodes]) for block in blocks)
    return Mesh(points=points[used], cells=kept, regions=regions)
