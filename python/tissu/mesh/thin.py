"""Sheets and lines: surface and line cells of a mesh that are simulated, beside its volume."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.mesh.cell import CellBlock, Floats, Ints, dimension

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh

KINDS = {3: "volumes", 2: "sheets", 1: "lines"}
"""What the cells of a body are called by their dimension; a region each in a body that mixes."""

# Corners and middle nodes of a face as small triangles: anticlockwise, none with three in a row.
_PIECES = {
    "triangle": [[0, 1, 2]],
    "triangle6": [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
    "quad8": [[0, 4, 7], [4, 1, 5], [5, 2, 6], [6, 3, 7], [4, 5, 6], [4, 6, 7]],
}
_QUADS = {
    "quad": [[0, 1, 2, 3]],
    "quad9": [[0, 4, 8, 7], [4, 1, 5, 8], [8, 5, 2, 6], [7, 8, 6, 3]],
}


def with_thin(mesh: Mesh, *, sheets: bool, lines: bool) -> Mesh:
    """The same mesh with its surface cells, its line cells or both simulated.

    Their border regions are regions then, unless the mesh says itself that they are simulated.
    Where it simulates cells of several dimensions, each kind
    is a region by the name in KINDS, unless the mesh has one of this name already.
    """
    chosen = tuple(m for m, wanted in ((2, sheets), (1, lines)) if wanted)
    if chosen == mesh.thin:
        missing = {name: part for name, part in _kinds(mesh).items() if name not in mesh.regions}
        return dataclasses.replace(mesh, regions={**missing, **mesh.regions}) if missing else mesh
    solid = sum(len(block) for block in mesh.volume_blocks)
    regions = {name: cells[cells < solid] for name, cells in mesh.regions.items()}
    made = dataclasses.replace(mesh, thin=chosen, regions=regions)
    inside = [np.full(len(b), dimension(b.type) in chosen) for b in mesh.border_blocks]
    for name, cells in kept(mesh.border_regions, inside).items():
        regions[name] = np.concatenate([regions.get(name, cells[:0]), cells + solid])
    return dataclasses.replace(made, regions={**_kinds(made), **regions})


def _kinds(mesh: Mesh) -> dict[str, Ints]:
    """The cells of each kind, where there are several."""
    counts = {m: sum(len(b) for b in mesh.body_blocks if dimension(b.type) == m) for m in KINDS}
    ends = np.cumsum(list(counts.values()))
    present = {
        KINDS[m]: np.arange(end - counts[m], end, dtype=np.int32)
        for m, end in zip(KINDS, ends, strict=True)
        if counts[m]
    }
    return present if len(present) > 1 else {}


def kept(regions: Mapping[str, Ints], keep: Sequence[NDArray[np.bool_]]) -> dict[str, Ints]:
    """Regions of blocks of which some cells stay (a mask for each block), by their new numbers.

    Those that lose all their cells are dropped.
    """
    mask = np.concatenate([np.empty(0, dtype=bool), *keep])
    number = np.cumsum(mask, dtype=np.int32) - 1
    found = {name: number[cells[mask[cells]]] for name, cells in regions.items()}
    return {name: cells for name, cells in found.items() if len(cells)}


def sizes(mesh: Mesh, block: CellBlock) -> Floats:
    """Area [m2] of each cell of a block of surfaces, or length [m] of lines."""
    return _core.cell_measures(positions=mesh.points, cell_type=block.type, nodes=block.nodes)


def parts(mesh: Mesh) -> Ints:
    """Part number of each simulated cell: labels spread from node to node until they rest."""
    label = np.arange(mesh.node_count)
    blocks = [np.asarray(block.nodes) for block in mesh.body_blocks]
    while True:
        before = label.copy()
        for nodes in blocks:
            smallest = label[nodes].min(axis=1)
            np.minimum.at(label, nodes, smallest[:, None])
        label = label[label]
        if np.array_equal(before, label):
            break
    of_cell = np.concatenate([label[nodes[:, 0]] for nodes in blocks])
    return np.unique(of_cell, return_inverse=True)[1].astype(np.int32)


def faces(mesh: Mesh) -> tuple[Ints, Ints, Ints, Ints]:
    """Triangles (t, 3) and quads (q, 4) of the sheets, each with the number of its cell."""
    triangles, quads = [np.empty((0, 4), np.int32)], [np.empty((0, 5), np.int32)]
    first = sum(len(block) for block in mesh.volume_blocks)
    for block in mesh.thin_blocks:
        cell = np.arange(first, first + len(block), dtype=np.int32)[:, None]
        first += len(block)
        for pieces, found in ((_PIECES, triangles), (_QUADS, quads)):
            for corners in pieces.get(block.type, ()):
                found.append(np.hstack([block.nodes[:, corners], cell]))
    of_three, of_four = np.concatenate(triangles), np.concatenate(quads)
    return of_three[:, :3], of_three[:, 3], of_four[:, :4], of_four[:, 4]


def line_pieces(mesh: Mesh) -> tuple[Ints, Ints]:
    """Straight pieces (k, 2) of the lines, and the number (k,) of the cell of each."""
    pieces = [np.empty((0, 3), np.int32)]
    first = sum(len(block) for block in mesh.volume_blocks)
    for block in mesh.thin_blocks:
        cell = np.arange(first, first + len(block), dtype=np.int32)[:, None]
        first += len(block)
        for ends in {"line": ([0, 1],), "line3": ([0, 2], [2, 1])}.get(block.type, ()):
            pieces.append(np.hstack([block.nodes[:, ends], cell]))
    found = np.concatenate(pieces)
    return found[:, :2], found[:, 2]
