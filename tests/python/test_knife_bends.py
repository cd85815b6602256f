"""A knife that turns or trembles in many small steps leaves what lies between its walls whole."""

from __future__ import annotations

import numpy as np
import pytest

from knife_ways import CELLS, part_between, pieces_of, way_of

FAR = 10.0
"""[cells]: outside of the sheet, from each place in it"""


@pytest.mark.parametrize("seed", [4, 15, 51, 66, 82])
@pytest.mark.parametrize("method", ["virtual", "subdivide"])
def test_a_bend_parts_the_sheet_in_two(method: str, seed: int) -> None:
    """Bends of 10 to 165 degrees; 4 % of such ways left crumbs of the wall that was cut first.

    Areas to the chords in the cell of the bend and in those at both ends: a crossing within a fifth
    of an edge goes to its end where cells are divided.
    """
    random = np.random.default_rng(seed)
    turn, stride = np.radians(random.uniform(10, 165)), random.choice([0.25, 0.5, 1.0])
    bend, angle = random.uniform(2.5, 5.5, 2), random.uniform(0, 2 * np.pi)
    turn *= random.choice([-1, 1])
    before = np.array([np.cos(angle), np.sin(angle)])
    after = np.array([np.cos(angle + turn), np.sin(angle + turn)])
    way = way_of(np.array([bend - FAR * before, bend, bend + FAR * after]), stride)
    inner = part_between(bend, before, after)
    found = pieces_of(way, cell="triangle", method=method)
    within = 1.3 if method == "virtual" else 2.0
    assert found == pytest.approx(sorted([inner, CELLS**2 - inner]), abs=within)


@pytest.mark.parametrize("seed", [2, 18, 23, 40])
@pytest.mark.parametrize("method", ["virtual", "subdivide"])
def test_a_hand_that_trembles_cuts_a_straight_line(method: str, seed: int) -> None:
    """By 0.06 cells in each step: of 60 such cuts 17 left crumbs or stayed joined.

    Areas to the tremble along the way, and a chord at either end.
    """
    random = np.random.default_rng(seed)
    x, stride = random.uniform(1.5, 6.5), random.choice([0.05, 0.1, 0.25, 0.5])
    slope = random.uniform(-0.3, 0.3)
    y = np.arange(-1.5, CELLS + 1.5, stride)
    way = np.stack([x + slope * (y - CELLS / 2), y], axis=1)
    found = pieces_of(way + random.normal(0, 0.06, way.shape), cell="triangle", method=method)
    assert found == pytest.approx(sorted([CELLS * x, CELLS * (CELLS - x)]), abs=1.5)


@pytest.mark.parametrize("off", [0.0, 0.0195, 0.0231, -0.0138])
@pytest.mark.parametrize("stride", [0.1, 0.25])
@pytest.mark.parametrize("middle", [3.7, 4.2, 4.6])
def test_a_flap_along_a_line_of_nodes_comes_off(middle: float, stride: float, off: float) -> None:
    """In, along the nodes or a fiftieth of a cell beside them, and out: 8 of 200 stayed or broke.

    Areas to the chords in the cells of both bends and both ends.
    """
    depth, half, slope = CELLS / 2 + off, 1.3, 0.4
    outside = -1.5
    corners = [
        (middle - half - slope, outside),
        (middle - half, depth),
        (middle + half, depth),
        (middle + half + slope, outside),
    ]
    width = 2 * (half + slope * depth / (depth - outside))  # where it enters and leaves
    flap = 0.5 * depth * (width + 2 * half)
    found = pieces_of(way_of(np.array(corners), stride))
    assert found == pytest.approx(sorted([flap, CELLS**2 - flap]), abs=1.3)
