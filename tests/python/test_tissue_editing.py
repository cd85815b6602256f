"""Tissue in scenes that may be edited: the bodies that it ties are cut beside it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts

TOP = ts.Sweep([[(0.06, y, 0.0885), (0.06, y, 0.12)] for y in (-0.01, 0.11)])
"""Through the upper layer of cells of the upper block, to which no tissue is tied."""


def _scene(**fields: Any) -> ts.Scene:
    return ts.examples.scene("tissue").replace(editing=True, **fields)


def _steps(simulation: ts.Simulation, count: int) -> None:
    for _ in range(count):
        assert simulation.step().converged


def _same(a: ts.Simulation, b: ts.Simulation) -> bool:
    return all(np.array_equal(a.positions[body], b.positions[body]) for body in a.bodies)


def test_tissue_moves_in_an_editable_scene_as_without_editing() -> None:
    """Only the order of sums differs, so positions agree to the tolerance of the solver."""
    editable, plain = _scene().compile(), ts.examples.scene("tissue").compile()
    _steps(editable, 5)
    _steps(plain, 5)
    fallen = np.abs(plain.displacements("lower")).max()
    assert fallen > 1e-3
    for body in plain.bodies:
        gap = np.abs(editable.positions[body] - plain.positions[body]).max()
        assert gap < 1e-4 * fallen  # Newton's tolerance is 1e-5 of the load, and steps add up


def test_a_tied_body_is_cut_away_from_the_tissue(tmp_path: Path) -> None:
    """Mass, momentum and energy stay; a checkpoint and rewind have the same bits."""
    scene = _scene()
    simulation = scene.compile()
    _steps(simulation, 3)
    mark = simulation.mark()
    elastic = simulation.energy()["elastic"]
    report = simulation.cut("upper", TOP)
    assert report.cells_cut > 0
    assert report.faces_opened > 0
    assert report.mass_change == pytest.approx(0.0, abs=1e-14)
    assert report.momentum_change == pytest.approx(np.zeros(3), abs=1e-14)
    assert simulation.energy()["elastic"] == pytest.approx(elastic, rel=1e-12)
    _steps(simulation, 3)
    simulation.save_checkpoint(tmp_path / "cut.tissu")
    resumed = scene.compile(checkpoint=tmp_path / "cut.tissu")
    _steps(simulation, 3)
    _steps(resumed, 3)
    assert _same(simulation, resumed)
    assert np.array_equal(simulation.points("fascia"), resumed.points("fascia"))
    simulation.rewind(mark)
    again = simulation.cut("upper", TOP)
    assert (again.cells_cut, again.nodes_new) == (report.cells_cut, report.nodes_new)
    _steps(simulation, 3)
    simulation.save_checkpoint(
        tmp_path / "again.tissu"
    )  # where the solver forgets, as it did before
    _steps(simulation, 3)
    assert _same(simulation, resumed)


@pytest.mark.parametrize("edit", ["cut", "ablate", "remove"])
def test_an_edit_at_the_ties_is_refused_and_changes_nothing(edit: str) -> None:
    simulation, other = _scene().compile(), _scene().compile()
    _steps(simulation, 2)
    _steps(other, 2)
    calls: dict[str, Any] = {
        "cut": lambda: simulation.cut("lower", ts.Plane((0.05, 0.05, 0), (1, 0.1, 0))),
        "ablate": lambda: simulation.ablate("lower", ts.Sphere((0.05, 0.05, 0.08), "6.5 cm")),
        "remove": lambda: simulation.remove_cells(body="lower", cells=list(range(1, 18))),
    }
    with pytest.raises(ts.ParameterError, match='tissue "fascia" is tied to its node'):
        calls[edit]()
    _steps(simulation, 2)
    _steps(other, 2)
    assert _same(simulation, other)


@pytest.mark.parametrize("verb", ["remove_cells", "surface", "material", "quality", "origin",
                                  "born"])  # fmt: skip
def test_what_asks_for_cells_is_refused_of_tissue_in_one_sentence(verb: str) -> None:
    simulation = _scene().compile()
    with pytest.raises(ts.ParameterError, match="fascia") as refused:
        if verb == "remove_cells":
            simulation.remove_cells(body="fascia", cells=[0])
        else:
            getattr(simulation, verb)("fascia")
    assert "\n" not in str(refused.value)
