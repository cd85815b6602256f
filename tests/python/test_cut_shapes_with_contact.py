"""Stresses and strains refer to the rest shapes that cells have after a cut, with contact too.

Cuts by `snap` and repairs move nodes at rest. In a scene with contact, values at points kept the
rest shapes from before: a body at rest had 20 kPa, and tore by itself.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts

YOUNG = 8e3
SIZE = (0.1, 0.04, 0.04)
ROUND_OFF = 1e-12  # of Young's modulus
FAR = {"table": ts.PlaneObstacle((0, 0, -0.01), (0, 0, 1))}
ACROSS = ts.Plane((0.0533, 0.02, 0.02), (1, 0.3, 0.2))
WAYS = {
    "snap": ts.Editing(method="snap", room="200 %"),
    "repair": ts.Editing(method="subdivide", room="200 %", repair=ts.Repair(below=0.3)),
}


def bar(way: str, *, contact: bool, **fields: Any) -> ts.Scene:
    body = ts.Body(
        mesh=ts.BarMesh(size=SIZE, cells=(10, 4, 4)),
        law=ts.StVK(young=YOUNG, poisson=0.3),
        density=1000.0,
    )
    contacts = [ts.Contact(("bar", "table"))] if contact else []
    whole: dict[str, Any] = {
        "bodies": {"bar": body},
        "fixed": [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        "obstacles": FAR if contact else {},
        "contacts": contacts,
        "editing": WAYS[way],
        "step": ts.ImplicitEuler("10 ms"),
    }
    return ts.Scene(**{**whole, **fields})


def require_energy_of_points(simulation: ts.Simulation, body: str = "bar") -> None:
    density = simulation.field("energy_density", "points", body)
    volumes = simulation.integration_points(body).volumes
    size = YOUNG * float(np.prod(SIZE))
    whole = float(simulation.energy()["elastic"])
    assert (density * volumes).sum() == pytest.approx(whole, rel=1e-10, abs=ROUND_OFF * size)


@pytest.mark.parametrize("way", WAYS)
def test_a_bar_at_rest_has_no_stress_after_a_cut(way: str) -> None:
    simulation = bar(way, contact=True).compile()
    before = simulation.meshes["bar"].points.copy()
    simulation.cut("bar", ACROSS)
    simulation.cut("bar", ts.Plane((0.031, 0.02, 0.02), (1, -0.2, 0.3)))
    now = simulation.meshes["bar"].points[: len(before)]
    moved = np.count_nonzero((now != before).any(axis=1))
    assert moved > 5
    for _ in range(2):
        assert np.abs(simulation.field("von_mises")).max() < ROUND_OFF * YOUNG
        np.testing.assert_allclose(simulation.field("volume_ratio"), 1.0, rtol=0, atol=1e-12)
        require_energy_of_points(simulation)
        assert len(simulation.inverted_cells("bar")) == 0
        simulation.step()


@pytest.mark.parametrize("way", WAYS)
def test_a_bar_that_is_stretched_evenly_has_one_stress(way: str) -> None:
    """By 5 %, after a mark, a rewind and another cut: F S F^T / J of St-Venant-Kirchhoff."""
    simulation = bar(way, contact=True).compile()
    simulation.cut("bar", ACROSS)
    mark = simulation.mark()
    simulation.cut("bar", ts.Plane((0.07, 0, 0), (1, 0, 0)))
    simulation.rewind(mark)
    simulation.cut("bar", ts.Plane((0.081, 0, 0), (1, 0, 0)))
    simulation.positions["bar"][:, 0] *= 1.05
    require_energy_of_points(simulation)
    strain = (1.05**2 - 1.0) / 2.0
    lame, shear = YOUNG * 0.3 / (1.3 * 0.4), YOUNG / 2.6
    across = lame * strain / 1.05
    expected = np.diag([1.05 * (lame + 2.0 * shear) * strain, across, across])
    found = simulation.field("cauchy_stress", "cells", "bar")
    np.testing.assert_allclose(
        found, np.broadcast_to(expected, found.shape), rtol=0, atol=ROUND_OFF * YOUNG
    )


def test_nothing_tears_that_nothing_pulls() -> None:
    tear = ts.Tear("bar", strength="500 Pa", length="17 mm")
    simulation = bar("snap", contact=True, tear=[tear]).compile()
    simulation.cut("bar", ACROSS)
    pieces = len(simulation.pieces("bar"))
    for _ in range(3):
        simulation.step()
    assert len(simulation.pieces("bar")) == pieces
    assert np.abs(simulation.displacements("bar")).max() < 1e-15


def test_surfaces_moved_apart_at_the_start_strain_the_cells_that_they_belong_to() -> None:
    """The energy of points is that of the body, which is not at rest then."""
    cube = ts.BarMesh(size=(0.04,) * 3, cells=(2, 2, 2), cell="hexahedron")
    law = ts.StVK(young=YOUNG, poisson=0.3)
    bodies = {
        "bar": ts.Body(mesh=cube, law=law, density=1000.0),
        "other": ts.Body(mesh=cube.replace(origin=(0.0, 0.0, 0.0402)), law=law, density=1000.0),
    }
    simulation = ts.Scene(
        bodies=bodies,
        fixed=[
            ts.Fixed("bar", on=ts.Plane((0, 0, 0), (0, 0, 1))),
            ts.Fixed("other", on=ts.Plane((0, 0, 0.0802), (0, 0, 1))),
        ],
        contacts=[ts.Contact(("bar", "other"), gap="1 mm")],
        contact=ts.ContactSettings(overlap="separate"),
        step=ts.ImplicitEuler("10 ms"),
    ).compile()
    whole = sum(
        float(
            (
                simulation.field("energy_density", "points", body)
                * simulation.integration_points(body).volumes
            ).sum()
        )
        for body in bodies
    )
    assert whole == pytest.approx(float(simulation.energy()["elastic"]), rel=1e-10, abs=1e-15)
