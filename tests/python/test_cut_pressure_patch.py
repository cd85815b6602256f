"""A following pressure on quads loads nodes after a cut as before: by their shape functions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import SOLVED, shaken
from same_ends import require_same_ends, steps

ROUND_OFF = 1e-12
"""Of sums over some hundred numbers: a few hundred times the spacing of doubles."""
PRESSURE = 200.0
SIZE = (0.12, 0.04, 0.04)
TOP = ts.Plane((0, 0, SIZE[2]), (0, 0, 1))
FLOOR = ts.Fixed("b", on=ts.Plane((0, 0, 0), (0, 0, 1)))
SOLVER_ERROR = 1e-9
"""Of the result. Newton stops at 1e-11 of the loads of all nodes (`SOLVED`). The load of one node
is a few hundredths of these, which leaves a factor of a few for the sum over the nodes."""

BETWEEN = ts.Plane((0.06, 0, 0), (1, 0, 0))
"""Exactly between cells."""
ACROSS = ts.Plane((0.057, 0, 0.01), (1.0, 0.3, 0.2))
SLIT = ts.Disc((0.06, -0.01, 0.02), (1.0, 0.2, 0.1), "37 mm")
"""From one side into the middle of the body."""


def solid(cell: Any) -> ts.Body:
    law = ts.StVK(young=2e4, poisson=0.0)
    return ts.Body(mesh=ts.bar_mesh(size=SIZE, cells=(6, 2, 2), cell=cell), law=law, density=1000.0)


def sheet() -> ts.Body:
    mesh = ts.bar_mesh(size=(0.12, 0.06, 0), cells=(12, 6, 0), cell="quad")
    law = ts.StVK(young=2e5, poisson=0.3)
    return ts.Body(mesh=mesh, law=law, density=1000.0, thickness="1 mm")


def scene(body: ts.Body, method: Any = "auto", follows: bool = True, **changes: Any) -> ts.Scene:
    on = TOP if body.thickness is None else ts.SurfaceNodes()
    return ts.Scene(
        **{
            "bodies": {"b": body},
            "loads": [ts.Pressure("b", on=on, pressure=PRESSURE, follows=follows)],
            "step": ts.ImplicitEuler("2 ms"),
            "editing": ts.Editing(method=method, room="3000 %"),
        }
        | changes
    )


def at_originals(simulation: ts.Simulation) -> Any:
    """Forces, summed over the copies of each node."""
    born = simulation.born("b")
    summed = np.zeros((born.max() + 1, 3))
    np.add.at(summed, born, simulation.forces()[simulation.rows("b")])
    return summed


@pytest.mark.parametrize(
    ("cell", "method"),
    [
        ("hexahedron", "virtual"),
        ("wedge", "virtual"),
        ("pyramid", "virtual"),
        ("tetra", "virtual"),
        ("tetra", "subdivide"),
    ],
)
def test_a_column_has_the_pressure_as_its_stress_before_and_after_a_cut_between_cells(
    cell: str, method: str
) -> None:
    """sigma_zz = -p everywhere, which the cells represent exactly."""
    static = ts.Static(solver=ts.Cholesky(), newton=SOLVED)
    simulation = scene(solid(cell), method, fixed=[FLOOR], step=static).compile()
    for cut in (False, True):
        if cut:
            assert len(simulation.cut("b", BETWEEN).pieces) == 2
        assert simulation.step().converged
        stress = simulation.field("cauchy_stress")[:, 2, 2]
        np.testing.assert_allclose(stress, -PRESSURE, rtol=SOLVER_ERROR)


def test_the_nodes_of_a_sheet_of_quads_have_the_loads_of_two_sheets_built_apart() -> None:
    """A quarter of p h^2 from each cell."""
    simulation = scene(sheet()).compile()
    simulation.cut("b", BETWEEN)
    mesh = simulation.meshes["b"]
    (cells,) = mesh.body_blocks
    expected = np.bincount(cells.nodes.ravel(), minlength=len(mesh.points)) / 4
    found = np.abs(simulation.forces()[simulation.rows("b")][:, 2]) / (PRESSURE * 1e-4)
    np.testing.assert_allclose(found, expected, rtol=0, atol=ROUND_OFF)


@pytest.mark.parametrize("body", [solid("hexahedron"), solid("wedge"), sheet()])
@pytest.mark.parametrize("blade", [BETWEEN, ACROSS, SLIT])
def test_copies_together_have_the_force_on_their_node_and_the_energy_is_the_same(
    body: ts.Body, blade: Any
) -> None:
    """Of bent quads, too: the parts of a quad make up the quad."""
    on_side = ts.Pressure(
        "b", on=ts.Plane((0, 0, 0), (0, 1, 0)), pressure=PRESSURE
    )  # quads of wedges
    changes = {"loads": [on_side]} if body.mesh.cells[0].type == "wedge" else {}
    simulation = shaken(scene(body, **changes).compile(), 5)
    before, energy = at_originals(simulation), simulation.energy()["potential"]
    assert simulation.cut("b", blade).cells_cut > 0
    size = np.abs(before).max()
    np.testing.assert_allclose(at_originals(simulation), before, rtol=0, atol=ROUND_OFF * size)
    work = PRESSURE * 0.12 * 0.06 * 0.06  # p V, of more than there is
    assert simulation.energy()["potential"] == pytest.approx(energy, abs=ROUND_OFF * work)


@pytest.mark.parametrize("body", [solid("hexahedron"), sheet()])
def test_a_following_pressure_is_at_rest_what_a_dead_one_is_after_cuts_and_removals(
    body: ts.Body,
) -> None:
    runs = [scene(body, follows=follows).compile() for follows in (True, False)]
    for simulation in runs:
        simulation.cut("b", ACROSS)
        simulation.cut("b", ts.Plane((0, 0.017, 0), (0.2, 1.0, 0.0)))
        simulation.ablate("b", ts.Box(min=(0.08, -1, -1), max=(0.1, 0.02, 1)))
    following, dead = (np.array(simulation.forces()) for simulation in runs)
    assert len(following) > 1.2 * len(body.mesh.points)
    np.testing.assert_allclose(following, dead, rtol=0, atol=ROUND_OFF * np.abs(dead).max())


def test_a_bar_cut_in_two_bends_as_two_bars_built_apart() -> None:
    """Where the whole bar has a node twice, one of the two is where the piece has it."""
    law = ts.StableNeoHooke(young=2e4, poisson=0.4)

    def built(meshes: dict[str, tuple[Any, tuple[float, ...]]]) -> ts.Simulation:
        return ts.Scene(
            bodies={
                name: ts.Body(mesh=mesh, law=law, density=1000.0)
                for name, (mesh, _) in meshes.items()
            },
            fixed=[
                ts.Fixed(name, on=ts.Plane((x, 0, 0), (1, 0, 0)))
                for name, (_, ends) in meshes.items()
                for x in ends
            ],
            loads=[ts.Pressure(name, on=TOP, pressure=150.0) for name in meshes],
            step=ts.Static(solver=ts.Cholesky(), newton=SOLVED),
            editing=True,
        ).compile()

    def bar(cells: int, origin: float = 0.0) -> Any:
        size = (0.02 * cells, 0.04, 0.04)
        return ts.bar_mesh(size=size, cells=(cells, 2, 2), cell="hexahedron", origin=(origin, 0, 0))

    whole = built({"b": (bar(5), (0.0, 0.1))})
    whole.cut("b", BETWEEN)
    apart = built({"left": (bar(3), (0.0,)), "right": (bar(2, 0.06), (0.1,))})
    for simulation in (whole, apart):
        assert simulation.step().converged
    rest, now = whole.meshes["b"].points, whole.positions["b"]
    for name in ("left", "right"):
        places, moved = apart.meshes[name].points, apart.positions[name]
        size = np.abs(moved - places).max()
        assert size > 5e-4
        for place, there in zip(places, moved, strict=True):
            here = now[np.linalg.norm(rest - place, axis=1) < 1e-9]
            assert np.linalg.norm(here - there, axis=1).min() < SOLVER_ERROR * size


def test_cut_quads_under_pressure_go_on_with_the_same_bits(tmp_path: Path) -> None:
    """On two threads, from a checkpoint, and after a cut that was taken back."""
    runs = [
        scene(solid("hexahedron"), threads=threads, fixed=[FLOOR]).compile() for threads in (1, 2)
    ]
    for simulation in runs:
        simulation.step()
        simulation.cut("b", ACROSS)
        assert simulation.step().converged
    other = ts.Plane((0.03, 0, 0), (1.0, 0.1, 0.0))
    require_same_ends(
        runs, "b", steps(2), tmp_path, strayed=lambda simulation: simulation.cut("b", other)
    )
