"""What a method in time knows of earlier steps outlives the removal of cells, live and resumed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts

STEPS: dict[str, Any] = {
    "bdf2": ts.BDF2(0.002),
    "bdf2 fixed point": ts.BDF2FixedPoint(0.0005),
    "newmark": ts.Newmark(0.002),
    "midpoint": ts.ImplicitMidpoint(0.002),
    "energy-momentum": ts.EnergyMomentum(0.002),
    "euler": ts.ImplicitEuler(0.002),
    "symplectic": ts.SymplecticEuler("0.1 ms"),
}
TIP_CELL = 39  # at a corner of the tip: one of its nodes has no other cell

EDITS: dict[str, Callable[[ts.Simulation], object]] = {
    "remove_cells": lambda simulation: simulation.remove_cells(body="b", cells=[TIP_CELL]),
    "ablate": lambda simulation: simulation.ablate("b", ts.Box(min=(0.091, 0.01, 0.01))),
    "both ends": lambda simulation: simulation.ablate("b", ts.Box(max=(0.009, 0.01, None))),
}


def _scene(step: Any, method: Any = "virtual") -> ts.Scene:
    cell: Any = "hexahedron" if method == "virtual" else "tetra"
    mesh = ts.BarMesh(size=(0.1, 0.02, 0.02), cells=(10, 2, 2), cell=cell)
    body = ts.Body(mesh=mesh, law=ts.StVK(young=5e4, poisson=0.3), density=1000.0)
    return ts.Scene(
        bodies={"b": body},
        fixed=[ts.Fixed("b", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=step,
        editing=ts.Editing(room="300 %", method=method),
    )


def _swinging(scene: ts.Scene, steps: int = 20) -> ts.Simulation:
    simulation = scene.compile()
    x = simulation.positions["b"][:, 0]
    simulation.velocities["b"][:, 2] = 0.3 * (x / 0.1) ** 2
    for _ in range(steps):
        simulation.step()
    return simulation


@pytest.mark.parametrize("edit", EDITS)
@pytest.mark.parametrize("step", STEPS)
def test_a_resumed_run_has_the_same_bits(step: str, edit: str, tmp_path: Path) -> None:
    scene = _scene(STEPS[step])
    live = _swinging(scene)
    live.save_checkpoint(tmp_path / "before.ckpt")
    resumed = scene.compile(checkpoint=tmp_path / "before.ckpt")
    for simulation in (live, resumed):
        EDITS[edit](simulation)
    live.save_checkpoint(tmp_path / "after.ckpt")
    later = scene.compile(checkpoint=tmp_path / "after.ckpt")
    for _ in range(3):
        for simulation in (live, resumed, later):
            simulation.step()
        np.testing.assert_array_equal(resumed.positions["b"], live.positions["b"])
        np.testing.assert_array_equal(resumed.velocities["b"], live.velocities["b"])
        np.testing.assert_array_equal(later.positions["b"], live.positions["b"])


@pytest.mark.parametrize("written", [False, True])
def test_a_rewound_run_has_the_same_bits(written: bool) -> None:
    simulation = _swinging(_scene(STEPS["bdf2"]))
    if written:
        simulation.velocities["b"][-1] = (0.1, 0.2, 0.3)  # of the node that loses its cell
    mark, found = simulation.mark(), []
    for _ in range(2):
        simulation.rewind(mark)
        EDITS["ablate"](simulation)
        simulation.step()
        found.append(simulation.positions["b"].copy())
    np.testing.assert_array_equal(found[0], found[1])


@pytest.mark.parametrize("step", ["bdf2", "newmark", "midpoint"])
def test_what_is_far_away_does_not_feel_it_at_once(step: str) -> None:
    simulation, other = (_swinging(_scene(STEPS[step])) for _ in range(2))
    before = simulation.positions["b"].copy()
    EDITS["remove_cells"](simulation)
    simulation.step()
    other.step()
    far = before[:, 0] < 0.031
    moved = np.abs(other.positions["b"] - before)[far].max()
    apart = np.abs(simulation.positions["b"] - other.positions["b"])[far].max()
    assert apart < 1e-2 * moved


@pytest.mark.parametrize("step", STEPS)
def test_a_node_without_cells_stays_where_it_is(step: str) -> None:
    simulation = _swinging(_scene(STEPS[step]))
    EDITS["remove_cells"](simulation)
    lost = np.setdiff1d(
        np.arange(len(simulation.positions["b"])),
        np.unique(simulation.meshes["b"].cells[0].nodes),
    )
    assert len(lost) == 1
    there = simulation.positions["b"][lost].copy()
    for _ in range(3):
        simulation.step()
        np.testing.assert_allclose(simulation.positions["b"][lost], there, atol=1e-15)
    np.testing.assert_allclose(simulation.velocities["b"][lost], 0.0, atol=1e-12)
    assert not simulation.reactions("b")[lost].any()
