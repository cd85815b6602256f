"""What the report says of a blade whose walls are nearer to each other than a cell."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

import tissu as ts
from tissu.cli.touches import cut_lines
from tissu.output.summary import cut_record

WALLS = [(0.057, 0.1), (0.057, 0.031), (0.063, 0.031), (0.063, 0.1)]
"""A U in the x y plane, 6 mm wide, which is open at the end of the bar's width; cells of 1 cm."""


def u_shape(walls: Sequence[tuple[float, float]]) -> ts.Triangles:
    points = [(x, y, z) for x, y in walls for z in (-0.01, 0.05)]
    triangles = []
    for a in (0, 2, 4):
        triangles += [(a, a + 2, a + 3), (a, a + 3, a + 1)]
    return ts.Triangles(points, triangles)


def cut_out(
    method: str, walls: Sequence[tuple[float, float]]
) -> tuple[ts.Simulation, ts.CutReport]:
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.12, 0.08, 0.04), cells=(12, 8, 4), cell="tetra"),
        law=ts.StableNeoHooke(young=2e4, poisson=0.3),
        density=1000.0,
    )
    simulation = ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=ts.ImplicitEuler(0.01),
        editing=ts.Editing(room=5.0, method=method),
    ).compile()
    return simulation, simulation.cut("bar", u_shape(walls))


@pytest.mark.parametrize("method", ["virtual", "subdivide"])
def test_the_inside_of_a_u_comes_out(method: str) -> None:
    _, report = cut_out(method, WALLS)
    volumes = sorted(piece.volume for piece in report.pieces)
    # Where cells are divided, a crossing moves by up to a fifth of an edge.
    assert volumes[-2] == pytest.approx(
        0.006 * 0.049 * 0.04, rel=0.1 if method == "virtual" else 0.3
    )


def test_the_report_names_walls_that_are_too_near_to_each_other() -> None:
    narrow = [(0.06 + (0.0007 if x > 0.06 else -0.0007), y) for x, y in WALLS]
    simulation, report = cut_out("subdivide", narrow)
    assert report.bridges > 0
    said = f"walls of the blade may have left bridges in {report.bridges} cells"
    assert f"; {said}" in str(report)
    assert sum("more than once" in why for _, why in report.unresolved) == report.bridges
    (line,) = cut_lines(simulation, [cut_record(0.0, report)])
    assert said.replace("the blade", "a blade") in line
