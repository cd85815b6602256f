"""Explicit steps without damping after cuts by copies, which may hold very little material."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts


def flying() -> ts.Simulation:
    """A slab of hexahedra that is held at one end and thrown sideways."""
    return ts.Scene(
        bodies={
            "slab": ts.Body(
                mesh=ts.bar_mesh(size=(0.1, 0.06, 0.02), cells=(10, 6, 2), cell="hexahedron"),
                law=ts.StableNeoHooke(young=2e4, poisson=0.3),
                density=1000.0,
                start=ts.Start(velocity=(0, 0.1, 0)),
            )
        },
        fixed=[ts.Fixed("slab", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=ts.SymplecticEuler(),
        editing=ts.Editing(room=5.0),
    ).compile()


@pytest.mark.parametrize("seed", [0, 10])
def test_automatic_steps_stay_stable_after_a_cut(seed: int) -> None:
    """With nine tenths of the stable step the second diverges; energy may rise by a tenth."""
    simulation, random = flying(), np.random.default_rng(seed)
    energy = simulation.energy()["total"]
    assert simulation.dt == pytest.approx(0.8 * simulation.stable_step, rel=1e-12)
    highest, is_cut = energy, False
    while simulation.time < 0.5:
        simulation.step()
        highest = max(highest, simulation.energy()["total"])
        if not is_cut and simulation.time > 0.02:
            point = np.array([0.05, 0.03, 0.01]) + 0.01 * random.normal(size=3)
            simulation.cut("slab", ts.Plane(point, random.normal(size=3)))
            assert simulation.dt == pytest.approx(0.5 * simulation.stable_step, rel=1e-12)
            is_cut = True
    assert highest < 1.1 * energy


def test_a_body_that_was_not_cut_by_copies_keeps_its_step() -> None:
    simulation = flying()
    mark = simulation.mark()
    simulation.cut("slab", ts.Plane((0.05, 0, 0), (1, 0.3, 0)))
    assert simulation.dt == pytest.approx(0.5 * simulation.stable_step, rel=1e-12)
    simulation.rewind(mark)
    assert simulation.dt == pytest.approx(0.8 * simulation.stable_step, rel=1e-12)
    simulation.remove_cells(body="slab", cells=[5])
    assert simulation.dt == pytest.approx(0.8 * simulation.stable_step, rel=1e-12)
