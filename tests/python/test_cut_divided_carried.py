"""What new nodes and cells take over where cuts divide cells: supports, memory, the stable step."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts
from divided import (
    EXACT,
    HELD,
    SIZE,
    SLANTED,
    bar,
    scene,
)

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
RELAXING = ts.Prony(branches=[ts.PronyBranch(weight=0.5, time=0.05)])


def test_nodes_between_held_nodes_are_held() -> None:
    """A cut along the bar through its held end, and nothing else, divides edges of that end."""
    simulation = scene(bar((4, 2, 2))).compile()
    report = simulation.cut("bar", ts.Plane(point=(0, 0.02, 0), normal=(0, 1, 0)))
    assert [piece.held for piece in report.pieces] == [True, True]
    rest = simulation.meshes["bar"].points
    at_end = np.abs(rest[:, 0]) < 1e-12
    assert at_end.sum() > 9
    for _ in range(10):
        simulation.step()
    still = np.abs(simulation.displacements("bar")[at_end]).max()
    assert still == 0.0
    nodes, weights = simulation.made_of("bar")
    assert weights.sum(axis=1) == pytest.approx(1.0, abs=ROUND_OFF)
    first = simulation._rest["bar"].points
    made = (weights[:, :, None] * np.where(nodes[:, :, None] < 0, 0.0, first[nodes])).sum(axis=1)
    np.testing.assert_allclose(made, rest, rtol=0, atol=ROUND_OFF)
    assert ((simulation.born("bar") < 0) == (weights[:, 1] > 0)).all()


@pytest.mark.parametrize("follows", [True, False])
@pytest.mark.parametrize("solid", [True, False])
def test_a_pressure_stays_on_divided_faces(solid: bool, follows: bool) -> None:
    """500 Pa on 0.1 x 0.05 m, before and after each of three cuts that divide its faces."""
    if solid:
        mesh = ts.bar_mesh(size=(0.1, 0.05, 0.05), cells=(4, 2, 2), cell="tetra")
        body, on = {}, ts.Plane((0, 0, 0.05), (0, 0, 1))
    else:
        mesh = ts.bar_mesh(size=(0.1, 0.05, 0), cells=(4, 2, 0), cell="triangle")
        law = ts.StVK(young=5e4, poisson=0.3)
        body, on = {"thickness": 1e-3, "law": law}, ts.Box()
    pressed = ts.Pressure("bar", on=on, pressure=500.0, follows=follows)
    simulation = scene(bar(mesh=mesh, **body), fixed=[], gravity=None, loads=[pressed]).compile()
    forces = simulation.forces()[simulation.rows("bar")].sum(axis=0)
    assert np.abs(forces) == pytest.approx([0.0, 0.0, 2.5], abs=1e-12)
    for blade in (
        ts.Plane((0.06, 0, 0), (1.0, 0.2, 0.0)),
        ts.Plane((0.05, 0.02, 0), (0.3, 1.0, 0.0)),
        ts.Plane((0.02, 0, 0), (1.0, -0.4, 0.1)),
    ):
        assert simulation.cut("bar", blade).cells_cut > 0
        after = simulation.forces()[simulation.rows("bar")].sum(axis=0)
        assert after == pytest.approx(forces, abs=1e-12)


def test_a_cut_along_the_pull_changes_nothing() -> None:
    """A relaxing bar under uniaxial tension has no traction on planes along it.

    A density near zero leaves no waves. The children remember what their parents did: else the
    stress would relax anew there.
    """
    ends = [
        ts.Fixed("bar", on=HELD, axes="x"),
        ts.Fixed("bar", on=ts.Plane((0, 0, 0), (0, 1, 0)), axes="y"),
        ts.Fixed("bar", on=ts.Plane((0, 0, 0), (0, 0, 1)), axes="z"),
    ]
    pulled = ts.Prescribed(
        "bar",
        on=ts.Plane((SIZE[0], 0, 0), (1, 0, 0)),
        displacements=[(0, 0, 0), (0.02, 0, 0)],
        times=[0, 0.02],
        axes="x",
    )
    law = ts.StVK(young=5e4, poisson=0.3)
    body = bar((8, 3, 3), viscosity=RELAXING, law=law, density=1e-7)
    runs = []
    for blade in (None, ts.Disc((0.2, 0.047, 0.05), (0, 1, 0.1), 0.09)):
        simulation = scene(
            body, fixed=ends, prescribed=[pulled], gravity=None, step=EXACT
        ).compile()
        for number in range(12):
            if blade is not None and number == 6:
                assert simulation.cut("bar", blade).cells_new > 50
            simulation.step()
        runs.append(simulation)
    whole, parted = runs
    first = whole.meshes["bar"].node_count
    found = parted.positions["bar"][:first]
    np.testing.assert_allclose(found, whole.positions["bar"], rtol=0, atol=1e-7 * SIZE[0])
    stress = [run.field("cauchy_stress", "cells", "bar")[:, 0, 0] for run in runs]
    assert np.ptp(stress[0]) < 1e-4 * stress[0].mean()
    np.testing.assert_allclose(stress[1], stress[0].mean(), rtol=1e-4)


def test_an_explicit_step_is_measured_again() -> None:
    step = ts.SymplecticEuler(dt="auto")
    simulation = scene(bar((4, 2, 2)), step=step).compile()
    before = simulation.stable_step
    report = simulation.cut("bar", SLANTED)
    assert report.stable_step == simulation.stable_step
    assert 0.0 < simulation.stable_step < before
    for _ in range(20):
        simulation.step()
    assert np.isfinite(simulation.positions["bar"]).all()
