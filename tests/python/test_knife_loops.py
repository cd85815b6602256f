"""A knife that goes round and crosses its own incision, in many small steps."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import tissu as ts

CELLS = 8
H = 0.01
"""[m]: the length of a cell"""


def loop(x: float, y: float, width: float, *, stride: float) -> tuple[list[float], list[float]]:
    """What three bends of a way leave of a sheet, and what they should leave [cells].

    The knife enters from below, goes up, to the right, down, and to the left across its first leg,
    and leaves the sheet. All lengths are those of cells.
    """
    sheet = ts.Body(
        mesh=ts.bar_mesh(size=(CELLS * H, CELLS * H, 0), cells=(CELLS, CELLS, 0), cell="quad"),
        law=ts.StVK(young=1e6, poisson=0.3),
        density=1000.0,
        thickness=1e-3,
    )
    corners = [(x, -2.0), (x, y + width), (x + width, y + width), (x + width, y), (-2.0, y)]
    way = [np.array(corners[0])]
    for begin, end in itertools.pairwise(corners):
        count = int(np.ceil(np.linalg.norm(np.subtract(end, begin)) / stride))
        way += [np.array(begin) + np.subtract(end, begin) * k / count for k in range(1, count + 1)]
    edge = [(0, 0, -0.05), (0, 0, 0.05)]
    knife = ts.Knife(edge, cuts=["sheet"], position=(*(H * way[0]), 0))
    simulation = ts.Scene(
        bodies={"sheet": sheet},
        step=ts.ImplicitEuler("1 ms"),
        editing=True,
        instruments={"knife": knife},
    ).compile()
    for place in way[1:]:
        simulation.instruments["knife"].move((*(H * place), 0))
        simulation.step()
    found = sorted(piece.volume / (H * H * 1e-3) for piece in simulation.pieces("sheet"))
    inside, corner = width * width, x * y
    return found, sorted([corner, inside, CELLS**2 - inside - corner])


@pytest.mark.parametrize("stride", [0.25, 0.5, 1.0])
@pytest.mark.parametrize(
    "place", [(2.907, 2.566, 2.716), (2.2, 3.3, 3.1), (3.42, 2.71, 2.33), (1.7, 2.3, 4.1)]
)
def test_a_loop_that_crosses_itself_leaves_three_pieces(
    place: tuple[float, float, float], stride: float
) -> None:
    """The inside, the corner below the crossing, and the rest.

    To the cells at the five bends and ends: at each a straight chord may cut off half a cell. Half
    of such loops left the inside joined while each vertex near an older wall was taken for a part
    of it at the front of the incision alone. In some places a crumb comes off besides (the Limits).
    """
    found, expected = loop(*place, stride=stride)
    assert len(found) == 3
    assert found == pytest.approx(expected, abs=1.0)
    assert sum(found) == pytest.approx(CELLS**2)
