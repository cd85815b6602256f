"""Meshes of bodies from which cells were removed."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.arrays import real_array
from tissu.errors import ParameterError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from tissu.mesh import Mesh


def removed_cells(counts: Mapping[str, int], body: str, cells: ArrayLike) -> NDArray[np.int32]:
    """The numbers of cells to take out of a body, each once, increasing.

    Args:
        counts: body -> number of its cells.
        body: its name.
        cells: to take out.

    Raises:
        ParameterError: they are not whole numbers, no body has that name, or no cell would be
            left.
    """
    given = np.atleast_1d(real_array(cells, "cells"))
    if given.size and not np.issubdtype(given.dtype, np.integer):
        raise ParameterError(f"found cells of type {given.dtype}; whole numbers are accepted")
    if given.ndim != 1:
        raise ParameterError(
            f"found cells of shape {given.shape}; numbers of cells in one row (n,) are accepted"
        )
    if body not in list(counts):  # of a list, which cannot be a key, too
        raise ParameterError(f"no body is named {body!r}; there are {', '.join(counts)}")
    beyond = given[(given < 0) | (given > np.iinfo(np.int32).max)]
    if beyond.size:
        raise ParameterError(
            f"found cell {beyond.flat[0]} of body '{body}'; the numbers of cells that were not "
            "removed are accepted (remaining_cells)"
        )
    numbers = np.unique(given).astype(np.int32)
    if len(numbers) >= counts[body]:
        raise ParameterError(f"that would leave no cell of body '{body}'; keep at least one")
    return numbers


def keep_cells(mesh: Mesh, cells: NDArray[np.int32]) -> Mesh:
    """A mesh with some of its volume cells only, by their increasing numbers; all nodes stay."""
    keep = np.zeros(mesh.cell_count, dtype=bool)
    keep[cells] = True
    number = np.cumsum(keep, dtype=np.int32) - 1
    blocks, first = [], 0
    for block in mesh.body_blocks:
        rows = keep[first : first + len(block.nodes)]
        blocks.append(dataclasses.replace(block, nodes=block.nodes[rows]))
        first += len(block.nodes)
    regions = {name: number[of[keep[of]]] for name, of in mesh.regions.items()}
    return dataclasses.replace(mesh, cells=tuple(blocks), regions=regions, border_regions={})
