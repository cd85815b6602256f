"""What the report says of a blade whose walls are nearer to each other than a cell."""

from __future__ import annotations

import pytest

import tissu as ts
from tissu.cli.touches import cut_lines
from tissu.output.summary import cut_record

WALLS = [(0.057, 0.1), (0.057, 0.031), (0.063, 0.031), (0.063, 0.1)]
"""A U in the x y plane, 6 mm wide, which is open at the end of the bar's width; cells of 1 cm."""


def u_shape() -> ts.Triangles:
    points = [(x, y, z) for x, y in WALLS for z in (-0.01, 0.05)]
    triangles = []
    for a in (0, 2, 4):
        triangles += [(a, a + 2, a + 3), (a, a + 3, a + 1)]
    return ts.Triangles(points, triangles)


@pytest.mark.parametrize("method", ["virtual", "subdivide"])
def test_the_inside_comes_out_or_the_report_names_bridges(method: str) -> None:
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
    report = simulation.cut("bar", u_shape())
    if method == "virtual":
        volumes = sorted(piece.volume for piece in report.pieces)
        assert volumes[-2] == pytest.approx(0.006 * 0.049 * 0.04, rel=0.1)
        return
    assert report.bridges > 0
    said = f"walls of the blade may have left bridges in {report.bridges} cells"
    assert f"; {said}" in str(report)
    assert sum("more than once" in why for _, why in report.unresolved) == report.bridges
    (line,) = cut_lines(simulation, [cut_record(0.0, report)])
    assert said.replace("the blade", "a blade") in line
