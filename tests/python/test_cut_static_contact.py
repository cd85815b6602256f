"""Cuts of bodies in static steps that contacts alone hold: as where a scene is compiled so."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, block, weight
from contact_static import TOLERANCE, pushed

GAP = 1e-3
"""[m]"""
LAYER = ts.Box(min=(-1, -1, -1), max=(1, 1, 0.03))


def _on_a_table(**fields: Any) -> ts.Simulation:
    """A cube of 1 kg in layers of 2.5 cm, which a plane alone holds, after a step."""
    simulation = ts.Scene(
        bodies={"cube": block((0, 0, GAP), cells=(4, 4, 4)), **fields.pop("bodies", {})},
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("cube", "table"), friction=0.5, gap=GAP)],
        gravity=(0, 0, -GRAVITY),
        step=ts.Static(),
        editing=True,
        **fields,
    ).compile()
    pushed(simulation)
    return simulation


def _cut(simulation: ts.Simulation) -> float:
    simulation.cut("cube", ts.Plane((0.04, 0, 0), (1, 0, 0)))
    assert len(simulation.pieces("cube")) == 2
    return 1.0


def _ablate(simulation: ts.Simulation) -> float:
    simulation.ablate("cube", ts.Sphere((0.0, 0.0, 0.1), 0.03))
    return 63 / 64


def _remove(simulation: ts.Simulation) -> float:
    simulation.remove_cells(body="cube", cells=[60, 63])
    return 62 / 64


def _lower(simulation: ts.Simulation) -> float:
    """Its lowest layer is gone: what is left falls by 2.5 cm, and rests there."""
    simulation.ablate("cube", LAYER)
    return 0.75


@pytest.mark.parametrize("change", [_cut, _ablate, _remove, _lower])
def test_the_table_carries_the_weight_that_is_left(change: Any) -> None:
    """To the step's tolerance of 1e-6, by hand; the scene without the cells is accepted, too."""
    simulation = _on_a_table()
    left = change(simulation)
    assert not any(piece.held for piece in simulation.pieces("cube"))
    for _ in range(2):
        pushed(simulation)
        force = simulation.force_on("table").force
        assert force == pytest.approx([0, 0, -left * weight()], abs=TOLERANCE * weight())


def test_what_contacts_do_not_hold_the_step_says() -> None:
    """The upper half, which has nothing under it but the lower one, which it may not touch."""
    simulation = _on_a_table()
    simulation.ablate("cube", ts.Box(min=(-1, -1, 0.027), max=(1, 1, 0.05)))
    assert len(simulation.pieces("cube")) == 2
    before = np.array(simulation.positions["cube"])
    with pytest.raises(ts.TissuError, match="neither supports nor contacts hold it"):
        simulation.step()
    assert np.array_equal(simulation.positions["cube"], before)


def test_a_body_that_meets_nothing_is_refused_as_without_contacts() -> None:
    held = ts.Fixed("bar", on=ts.Plane((1, 0, 0), (1, 0, 0)))
    bar = block((1, 0, 0), size=(0.4, 0.1, 0.1), cells=(4, 1, 1), young=1e6)
    simulation = _on_a_table(bodies={"bar": bar}, fixed=[held])
    with pytest.raises(ts.ParameterError, match="1 of 2 pieces of body 'bar' without support"):
        simulation.cut("bar", ts.Plane((1.15, 0, 0), (1, 0, 0)))
    pushed(simulation)


def test_tissue_between_bodies_that_rest_on_tables_is_severed() -> None:
    """Two cubes side by side, each on the table: neither needs the tissue between them."""
    other = block((0.11, 0, GAP), cells=(4, 4, 4))
    tissue = ts.Tissue(
        between=("cube", "other"),
        reach=0.02,
        frames=6,
        points=40,
        law=ts.StVK(young=1e4, poisson=0.3),
        density=1000,
    )
    simulation = ts.Scene(
        bodies={"cube": block((0, 0, GAP), cells=(4, 4, 4)), "other": other},
        tissue={"fascia": tissue},
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact((name, "table"), friction=0.5, gap=GAP) for name in ("cube", "other")],
        gravity=(0, 0, -GRAVITY),
        step=ts.Static(),
        editing=True,
    ).compile()
    assert simulation.cut("fascia", ts.Plane((0.105, 0, 0), (1, 0, 0))).links_severed > 0
