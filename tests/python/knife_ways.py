"""Ways of a knife through a square sheet, and what they leave of it.

All lengths are those of cells.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

import tissu as ts

CELLS = 8
H = 0.01
"""[m]: the length of a cell"""

Floats = NDArray[np.float64]


def way_of(corners: Floats, stride: float) -> Floats:
    """Places (n, 2), one for each step, on the straight lines between corners (k, 2)."""
    way = [corners[0]]
    for begin, end in itertools.pairwise(corners):
        count = int(np.ceil(np.linalg.norm(end - begin) / stride))
        way += [begin + (end - begin) * k / count for k in range(1, count + 1)]
    return np.array(way)


def pieces_of(way: Floats, *, cell: str = "quad", method: str = "auto") -> list[float]:
    """Areas of the pieces of a sheet, ascending, after a knife went that way (n, 2)."""
    sheet = ts.Body(
        mesh=ts.bar_mesh(size=(CELLS * H, CELLS * H, 0), cells=(CELLS, CELLS, 0), cell=cell),
        law=ts.StVK(young=1e6, poisson=0.3),
        density=1000.0,
        thickness=1e-3,
    )
    edge = [(0, 0, -0.05), (0, 0, 0.05)]
    knife = ts.Knife(edge, cuts=["sheet"], position=(*(H * way[0]), 0))
    simulation = ts.Scene(
        bodies={"sheet": sheet},
        step=ts.ImplicitEuler("1 ms"),
        editing=ts.Editing(method=method, room="200 %"),
        instruments={"knife": knife},
    ).compile()
    for place in way[1:]:
        simulation.instruments["knife"].move((*(H * place), 0))
        simulation.step()
    return sorted(piece.volume / (H * H * 1e-3) for piece in simulation.pieces("sheet"))


def part_between(b: Floats, before: Floats, after: Floats) -> float:
    """Area of the sheet inside of a bend at b of a way with these directions."""
    side = np.sign(before[0] * after[1] - before[1] * after[0])
    part = np.array([[0, 0], [CELLS, 0], [CELLS, CELLS], [0, CELLS]], dtype=np.float64)
    for along in (before, after):
        part = _clipped(part, b, side * np.array([-along[1], along[0]]))
    x, y = part.T
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def _clipped(polygon: Floats, place: Floats, normal: Floats) -> Floats:
    """The part of a polygon (n, 2) on the side of a line to which its normal points."""
    kept: list[Floats] = []
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        of_a, of_b = (a - place) @ normal, (b - place) @ normal
        if of_a >= 0:
            kept.append(a)
        if of_a * of_b < 0:
            kept.append(a + (b - a) * of_a / (of_a - of_b))
    return np.array(kept)
