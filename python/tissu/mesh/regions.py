"""Regions of a mesh: cells under a name, from a shape or from their numbers."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import ArrayLike

from tissu.counted import counted
from tissu.errors import MeshError
from tissu.mesh.cell import Ints

if TYPE_CHECKING:
    from tissu.mesh.mesh import Mesh


class Selects(Protocol):
    """What means some cells of a mesh: a box, a sphere, ..."""

    def cells(self, mesh: Mesh) -> Ints:
        """Numbers of the cells across the simulated blocks of the mesh."""


def with_region(mesh: Mesh, name: str, where: Selects | ArrayLike) -> Mesh:
    """See `Mesh.with_region`."""
    regions, borders = dict(mesh.regions), dict(mesh.border_regions)
    regions.pop(name, None)
    borders.pop(name, None)
    if hasattr(where, "cells"):
        none = np.empty(0, dtype=np.int32)
        known = {**dict.fromkeys(mesh.border_regions, none), **mesh.regions}
        regions[name] = where.cells(dataclasses.replace(mesh, regions=known))
        # Faces and lines that may be simulated later, where a body has a thickness or a section.
        known = {**dict.fromkeys(mesh.regions, none), **mesh.border_regions}
        thin = dataclasses.replace(mesh, cells=mesh.border_blocks, thin=(2, 1), regions=known)
        if thin.cell_count:
            borders[name] = where.cells(thin)
    else:
        regions[name] = _numbers(mesh, name, np.asarray(where))
    if not len(regions[name]) and not len(borders.get(name, ())):
        raise MeshError(
            f"region '{name}': found no cell; a cell belongs to a shape when its centre, the mean "
            "of its nodes, lies in it: take a larger shape, or refine the mesh"
        )
    # What is in the file does not have the region: the mesh is one of its own.
    return dataclasses.replace(mesh, regions=regions, border_regions=borders, source=None)


def _numbers(mesh: Mesh, name: str, given: np.ndarray[tuple[int], np.dtype[np.int64]]) -> Ints:
    if given.dtype == np.bool_ and given.shape == (mesh.cell_count,):
        return np.flatnonzero(given).astype(np.int32)
    if given.dtype.kind not in "iu" or given.ndim != 1:
        raise MeshError(
            f"region '{name}': found an array of {given.dtype} of shape {given.shape}; a shape, "
            f"numbers of cells (k,), or a bool for each of {counted(mesh.cell_count, 'cell')} are "
            "accepted"
        )
    beyond = given[(given < 0) | (given >= mesh.cell_count)]
    if len(beyond):
        raise MeshError(
            f"region '{name}': found cell {beyond[0]}; numbers from 0 to {mesh.cell_count - 1} are "
            "accepted"
        )
    return np.unique(given).astype(np.int32)
