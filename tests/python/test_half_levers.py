"""Volumes of frames with half levers: bending in static steps, rotations of the material."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

import tissu as ts

SIZE = (16.0, 1.0, 1.0)
SOFT = ts.StVK(young=40e3, poisson=0.3)
STEP = ts.Static(newton=ts.Newton(iterations=60, tolerance=1e-8), solver=ts.Cholesky())
# Gravity [m/s2] at which the soft bar of bosman2014 sinks by about 2 % and 30 % of its length.
SMALL, LARGE = 0.42, 6.5


def _bar(cells: tuple[int, int, int], cell: str, model: ts.FEM | ts.Frames) -> ts.Body:
    mesh = ts.BarMesh(size=SIZE, cells=cells, cell=cell)
    return ts.Body(mesh=mesh, model=model, law=SOFT, density=5 / 16)


def _hung(body: ts.Body, gravity: float) -> tuple[ts.Simulation, ts.StepReport]:
    simulation = ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, -gravity, 0),
        step=STEP,
    ).compile()
    report = simulation.step()
    assert report.converged
    return simulation, report


def _end(simulation: ts.Simulation) -> Any:
    return np.isclose(simulation.meshes["bar"].points[:, 0], SIZE[0])


def _sag(simulation: ts.Simulation) -> float:
    return -float(simulation.displacements("bar")[_end(simulation), 1].mean())


@cache
def _reference(gravity: float) -> float:
    """The sag of quadratic hexahedra; twice as many are 0.2 % softer."""
    return _sag(_hung(_bar((24, 2, 2), "hexahedron20", ts.FEM()), gravity)[0])


def _turns(simulation: ts.Simulation) -> tuple[float, float]:
    """Mean angle about z [rad] of the frames of the end, and that of the edges between them."""
    end = _end(simulation)
    frames = simulation.rotations("bar")[end]
    points, now = simulation.meshes["bar"].points, simulation.positions["bar"]
    top, bottom = end & (points[:, 1] == 1.0), end & (points[:, 1] == 0.0)
    edge = (now[top] - now[bottom]).mean(axis=0)
    angle = float(np.arctan2(-frames[:, 1, 0], frames[:, 0, 0]).mean())
    return angle, math.atan2(edge[0], edge[1])


@pytest.mark.parametrize(("gravity", "share"), [(SMALL, 0.02), (LARGE, 0.3)])
def test_a_bar_bends_statically_to_the_solution_of_quadratic_cells(
    gravity: float, share: float
) -> None:
    """One static step from rest: the error goes as the square of the size of the cells.

    Trilinear cells are 1 / (4 n^2) stiff along the bar and lack the curvature across it, so that
    one layer of cells is 10 % stiff and two are 3.5 %; measured.
    """
    wanted = _reference(gravity)
    assert wanted == pytest.approx(share * SIZE[0], rel=0.05)
    errors = []
    for cells in ((10, 1, 1), (20, 2, 2)):
        simulation, report = _hung(_bar(cells, "hexahedron", ts.Frames(lever="half")), gravity)
        errors.append(1.0 - _sag(simulation) / wanted)
        # Newton's iteration ends by itself, in no more than the quadratic cells take, about.
        assert report.newton_iterations <= 15
    assert 0.0 < errors[0] < 0.12
    assert 0.0 < errors[1] < 0.4 * errors[0]


@pytest.mark.parametrize("cell", ["tetra", "wedge"])
def test_other_cells_bend_statically_too(cell: str) -> None:
    """They are stiff as linear cells are, less than these, and near the solution from below."""
    wanted = _reference(SMALL)
    sags = [
        _sag(_hung(_bar(cells, cell, ts.Frames(lever="half")), SMALL)[0])
        for cells in ((10, 1, 1), (20, 2, 2))
    ]
    assert 0.3 * wanted < sags[0] < sags[1] < wanted
    assert wanted - sags[1] < 0.5 * (wanted - sags[0])


@pytest.mark.parametrize("gravity", [SMALL, LARGE])
def test_rotations_are_those_of_the_material(gravity: float) -> None:
    """Frames with half levers turn as the edges of their cells do, with whole ones by half."""
    cells = (20, 2, 2)
    half = _turns(_hung(_bar(cells, "hexahedron", ts.Frames(lever="half")), gravity)[0])
    assert half[0] == pytest.approx(half[1], rel=0.02)
    if gravity == SMALL:
        whole = _turns(_hung(_bar(cells, "hexahedron", ts.Frames()), gravity)[0])
        assert whole[0] == pytest.approx(0.5 * whole[1], rel=0.02)


def test_a_moment_on_the_end_bends_to_an_arc() -> None:
    """M L^2 / (2 E I) at the tip and M L / (E I) of turn; no Poisson's ratio, small turns."""
    mesh = ts.BarMesh(size=(10, 1, 1), cells=(20, 2, 2), cell="hexahedron")
    body = ts.Body(mesh=mesh, model=ts.Frames(lever="half"), density=1.0,
                   law=ts.StVK(young=1e5, poisson=0.0))  # fmt: skip
    end = ts.Plane((10, 0, 0), (1, 0, 0))
    moment = 10.0
    simulation = ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        loads=[ts.Moment("bar", on=end, moment=(0, 0, moment))],
        step=STEP,
    ).compile()
    assert simulation.step().converged
    at_end = np.isclose(simulation.meshes["bar"].points[:, 0], 10.0)
    stiffness = 1e5 / 12
    sag = float(simulation.displacements("bar")[at_end, 1].mean())
    # Two cells across are stiff by 1 / (2 m^2) of the moment that linear strain leaves between
    # their points, which half levers carry: measured 1 %.
    assert sag == pytest.approx(moment * 100 / (2 * stiffness), rel=0.03)


@pytest.mark.parametrize("model", [ts.Frames(), ts.Frames(lever="whole")])
def test_whole_levers_of_a_volume_take_no_moment(model: ts.Frames) -> None:
    """Its rotations move nearly no point: the answer would be wrong, and converged all the same."""
    end = ts.Plane((SIZE[0], 0, 0), (1, 0, 0))
    scene = ts.Scene(
        bodies={"bar": _bar((4, 1, 1), "hexahedron", model)},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        loads=[ts.Moment("bar", on=end, moment=(0, 0, 1))],
        step=STEP,
    )
    with pytest.raises(ts.SceneError, match=r"whole levers.*lever: half"):
        scene.compile()


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "wedge", "pyramid"])
def test_only_rigid_motions_are_free(cell: str) -> None:
    """Six motions of a block without stiffness: no rotation that moves no point is among them."""
    mesh = ts.BarMesh(size=(1.6, 1, 1), cells=(1, 1, 1), cell=cell)
    body = ts.Body(mesh=mesh, model=ts.Frames(lever="half"), law=SOFT, density=1.0)
    simulation = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(dt=1.0)).compile()
    stiffness = simulation.stiffness().toarray()
    values = np.linalg.eigvalsh((stiffness + stiffness.T) / 2)
    assert np.abs(values[:6]).max() < 1e-12 * values[-1]
    assert values[6] > 1e-4 * values[-1]


def test_momentum_of_a_thrown_bar_is_kept() -> None:
    body = _bar((4, 1, 1), "hexahedron", ts.Frames(lever="half"))
    start = ts.Start(velocity=(0.1, 0, -0.2), spin=(0, 0.3, 0.1))
    step = ts.ImplicitMidpoint(dt=0.05, newton=ts.Newton(iterations=20, tolerance=1e-12))
    simulation = ts.Scene(bodies={"bar": body.replace(start=start)}, step=step).compile()
    masses = np.asarray(simulation.mass_matrix().diagonal())[: simulation.positions["bar"].size]
    before = masses @ simulation.velocities["bar"].ravel()
    for _ in range(20):
        assert simulation.step().converged
    after = masses @ simulation.velocities["bar"].ravel()
    assert after == pytest.approx(before, rel=1e-10)


def test_cells_that_bend_by_themselves_are_refused() -> None:
    body = _bar((2, 1, 1), "hexahedron20", ts.Frames(lever="half"))
    (problem,) = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(dt=0.1)).check().problems
    assert problem.startswith("bodies.bar.model: ")
    assert "hexahedron20, which bend by themselves; tetra, " in problem
    assert "take lever: whole" in problem
