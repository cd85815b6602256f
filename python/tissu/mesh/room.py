"""Whether a made mesh fits in the memory of this machine, asked before it is made."""

from __future__ import annotations

import os

from tissu.errors import ParameterError

_COPIES = 6  # of points and cells that are alive at once while a bar is cut and its faces are found
_CELLS_OF_SIX = 6 * 4 * 4  # bytes of the tetrahedra of a grid cell, the most that one is cut into


def memory_bytes() -> int:
    """The memory of this machine."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def require_room(cells: tuple[int, int, int]) -> None:
    """Refuses a bar of more grid cells than the memory of this machine holds.

    Raises:
        ParameterError: it does not fit, or its nodes cannot be numbered.
    """
    boxes = max(cells[0], 1) * max(cells[1], 1) * max(cells[2], 1)
    nodes = (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1)
    if nodes > 2**28:  # eight times as many with the middles of edges, faces and cells
        raise ParameterError(
            f"found {boxes:.3g} grid cells, whose nodes do not fit 32-bit numbers; take fewer cells"
        )
    needed, there = _COPIES * (24 * nodes + _CELLS_OF_SIX * boxes), memory_bytes()
    if needed > there:
        raise ParameterError(
            f"found {boxes:.3g} grid cells, which take about {needed / 1e9:.3g} GB; this machine "
            f"has {there / 1e9:.3g} GB: take fewer cells"
        )
