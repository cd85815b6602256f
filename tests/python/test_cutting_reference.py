"""Cut bodies against closed forms: a bar under its weight, and a double cantilever."""

from __future__ import annotations

import math

import numpy as np
import pytest

import tissu as ts

YOUNG = 1e6
EXACT = ts.Static(newton=ts.Newton(iterations=20, tolerance=1e-10))


def hanging_bar(cells: int, cut_at: float) -> tuple[float, float]:
    """Errors of the left part's displacements under weight along x, over its largest.

    Returns:
        At the nodes, and at the face that the blade made.
    """
    mesh = ts.bar_mesh(size=(1.0, 0.1, 0.1), cells=(cells, 1, 1), cell="hexahedron")
    made = ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=ts.Hooke(young=YOUNG, poisson=0.0), density=1e3)},
        fixed=[ts.Fixed("bar", on=ts.Plane((end, 0, 0), (1, 0, 0))) for end in (0, 1)],
        gravity=(1.0, 0, 0),
        step=EXACT,
        editing=True,
    )
    simulation = made.compile()
    report = simulation.cut("bar", ts.Plane((cut_at, 0, 0), (1, 0, 0)))
    assert [piece.held for piece in report.pieces] == [True, True]
    assert simulation.step().converged
    rest = mesh.points[:, 0]
    left = np.flatnonzero(rest < cut_at)
    exact = 1e3 / YOUNG * (cut_at * rest[left] - 0.5 * rest[left] ** 2)
    found = simulation.displacements("bar")[left, 0]
    end = 0.5e3 / YOUNG * cut_at**2  # below that of the right part, at (1 - cut_at)^2
    surface = simulation.surface("bar")
    lip = surface.carried(simulation.displacements("bar"))[surface.triangles[surface.cut], 0].min()
    return float(np.abs(found - exact).max() / end), float(abs(lip - end) / end)


def test_a_bar_that_is_cut_off_the_faces_converges() -> None:
    """Exact at the nodes, since the weight of a part is that of its material; h^2 at the face.

    The blade lies at two thirds of a cell in both meshes.
    """
    (_, coarse), (nodes, fine) = hanging_bar(8, 1 / 3), hanging_bar(32, 1 / 3)
    assert nodes < 1e-9
    assert coarse < 0.05
    assert 0.5 * math.log2(coarse / fine) >= 1.7


def test_a_bar_that_is_cut_on_faces_is_exact() -> None:
    """Linear elements are exact at their nodes under a weight that is constant."""
    assert max(hanging_bar(8, 0.375)) < 1e-9


HEIGHT, WIDTH, LENGTH, FORCE = 0.01, 0.005, 0.17, 0.01


def opening(crack: float) -> float:
    """Distance by which the ends of the two arms of a double cantilever open [m].

    Cells of 27 nodes' order, two over each arm; the arms are drawn apart at their ends.
    """
    mesh = ts.bar_mesh(size=(LENGTH, WIDTH, 2 * HEIGHT), cells=(34, 1, 4), cell="hexahedron20")
    tiny = 1e-6
    upper = ts.Box(min=(None, None, HEIGHT + tiny), max=(tiny, None, None))
    lower = ts.Box(max=(tiny, None, HEIGHT - tiny))
    made = ts.Scene(
        bodies={"beam": ts.Body(mesh=mesh, law=ts.Hooke(young=YOUNG, poisson=0.3), density=1e3)},
        fixed=[ts.Fixed("beam", on=ts.Plane((LENGTH, 0, 0), (1, 0, 0)))],
        loads=[
            ts.NodalLoad("beam", on=upper, force=(0, 0, FORCE)),
            ts.NodalLoad("beam", on=lower, force=(0, 0, -FORCE)),
        ],
        step=EXACT,
        editing=True,
    )
    simulation = made.compile()
    x, y, z = (-1.0, crack + tiny), (-1.0, 1.0), HEIGHT  # a whole number of cells
    corners = [(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]
    report = simulation.cut("beam", ts.Triangles(corners, [(0, 1, 2), (0, 2, 3)]))
    assert report.area == pytest.approx(crack * WIDTH, rel=1e-9)
    assert simulation.step().converged
    ends = [on.nodes(mesh) for on in (upper, lower)]
    up, down = (simulation.displacements("beam")[nodes, 2].mean() for nodes in ends)
    return float(up - down)


def test_a_double_cantilever_opens_as_williams_says() -> None:
    """Williams (1989): beams of length a + chi h, for what turns at the front; a / h = 10.

    Energy release rate from two lengths: G = P / (2 b) d(opening)/da.
    """
    shear = YOUNG / 2.6
    gamma = 1.18 * YOUNG / shear
    chi = math.sqrt(YOUNG / (11 * shear) * (3 - 2 * (gamma / (1 + gamma)) ** 2))
    assert chi == pytest.approx(0.663, abs=5e-4)
    short, long = (opening(crack) for crack in (0.095, 0.105))
    for crack, found in ((0.095, short), (0.105, long)):
        arm = crack + chi * HEIGHT
        assert found == pytest.approx(8 * FORCE * arm**3 / (YOUNG * WIDTH * HEIGHT**3), rel=0.02)
    released = FORCE / (2 * WIDTH) * (long - short) / 0.01
    arm = 0.1 + chi * HEIGHT
    expected = 12 * FORCE**2 * arm**2 / (YOUNG * WIDTH**2 * HEIGHT**3)
    assert released == pytest.approx(expected, rel=0.03)
