"""A knife that goes round and crosses its own incision, in many small steps."""

from __future__ import annotations

import numpy as np
import pytest

from knife_ways import CELLS, pieces_of, way_of


def loop(x: float, y: float, width: float, *, stride: float) -> tuple[list[float], list[float]]:
    """What three bends of a way leave of a sheet, and what they should leave [cells].

    The knife enters from below, goes up, to the right, down, and to the left across its first leg,
    and leaves the sheet. All lengths are those of cells.
    """
    corners = [(x, -2.0), (x, y + width), (x + width, y + width), (x + width, y), (-2.0, y)]
    inside, corner = width * width, x * y
    expected = sorted([corner, inside, CELLS**2 - inside - corner])
    return pieces_of(way_of(np.array(corners), stride)), expected


PLACES = [(2.907, 2.566, 2.716), (2.2, 3.3, 3.1), (3.42, 2.71, 2.33), (1.7, 2.3, 4.1)]
NEAR_NODES = [(2.280, 3.186, 2.866), (1.654, 1.584, 4.464), (2.244, 2.275, 3.830)]
"""The way turns a twentieth of a cell beside a node; crumbs came off in 1 % of such ways."""


@pytest.mark.parametrize("stride", [0.25, 0.5, 1.0])
@pytest.mark.parametrize("place", PLACES + NEAR_NODES)
def test_a_loop_that_crosses_itself_leaves_three_pieces(
    place: tuple[float, float, float], stride: float
) -> None:
    """The inside, the corner below the crossing, and the rest.

    To the cells at the five bends and ends: at each a straight chord may cut off half a cell. Half
    of such loops left the inside joined while each vertex near an older wall was taken for a part
    of it at the front of the incision alone.
    """
    found, expected = loop(*place, stride=stride)
    assert len(found) == 3
    assert found == pytest.approx(expected, abs=1.2)
    assert sum(found) == pytest.approx(CELLS**2)
