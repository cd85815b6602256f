"""Cuts by copies through a held or moved face: what was held on it stays held."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts

YOUNG, STRETCH = 2e4, 1.1
SIZE = (0.1, 0.04, 0.03)
HELD, MOVED = ts.Plane((0, 0, 0), (1, 0, 0)), ts.Plane((SIZE[0], 0, 0), (1, 0, 0))
EXACT = YOUNG * SIZE[1] * SIZE[2] * STRETCH * (STRETCH**2 - 1) / 2
"""Force [N] on the support of a bar of StVK without lateral contraction, cut lengthwise or not."""


def stretched(cell: str, *, step: ts.Step | None = None) -> ts.Simulation:
    """A bar, one end held and the other drawn out by a tenth; neither contracts."""
    static = ts.Static(solver=ts.Cholesky(), newton=ts.Newton(tolerance=1e-11, iterations=40))
    body = ts.Body(
        mesh=ts.bar_mesh(size=SIZE, cells=(5, 3, 2), cell=cell),
        law=ts.StVK(young=YOUNG, poisson=0),
        density=1000.0,
    )
    drawn = ((0, 0, 0), ((STRETCH - 1) * SIZE[0], 0, 0))
    return ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=HELD)],
        prescribed=[ts.Prescribed("bar", on=MOVED, times=(0, 1), displacements=drawn)],
        step=step or static,
        editing=ts.Editing(room=5.0),
    ).compile()


CELLS = {"tetra": 1e-9, "hexahedron": 1e-9, "hexahedron20": 1e-9, "wedge": 1e-9, "tetra10": 0.015}
"""Newton's tolerance; copies of tetra10 bend, as their shares differ along the bar."""


@pytest.mark.parametrize(("cell", "tolerance"), CELLS.items())
def test_a_cut_lengthwise_frees_nothing(cell: str, tolerance: float) -> None:
    """Both halves are stretched as the bar was, and no point of the held faces moves."""
    simulation = stretched(cell)
    report = simulation.cut("bar", ts.Plane((0, 0.0173, 0), (0, 1, 0.2)))
    assert [piece.held for piece in report.pieces] == [True, True]
    assert simulation.step().converged
    places = simulation.meshes["bar"].points[:, 0]
    force = -simulation.reactions("bar")[np.abs(places) < 1e-9, 0].sum()
    assert force == pytest.approx(EXACT, rel=tolerance)
    material = simulation.material("bar")
    rest = material.mesh.points
    moved = material.points - rest
    assert np.abs(moved[np.abs(rest[:, 0]) < 1e-9]).max() < 1e-15
    at_end = np.abs(rest[:, 0] - SIZE[0]) < 1e-9
    assert moved[at_end] == pytest.approx(
        np.broadcast_to(((STRETCH - 1) * SIZE[0], 0, 0), moved[at_end].shape), abs=1e-15
    )


def test_a_slice_between_the_nodes_of_a_held_face_is_held() -> None:
    """Two cuts through one row of cells leave a slice between them that has no node on the face."""
    simulation = stretched("hexahedron")
    for y in (0.017, 0.022):
        report = simulation.cut("bar", ts.Plane((0, y, 0), (0, 1, 0)))
    assert [piece.held for piece in report.pieces] == [True, True, True]
    thin = min(report.pieces, key=lambda piece: piece.volume)
    assert thin.volume == pytest.approx(SIZE[0] * 0.005 * SIZE[2], rel=1e-9)
    assert simulation.step().converged


def test_a_copy_whose_material_is_off_the_face_is_free() -> None:
    """Across the bar, in its first layer of cells: the other part lets go of the held face."""
    simulation = stretched("hexahedron", step=ts.ImplicitEuler("5 ms"))
    report = simulation.cut("bar", ts.Plane((0.007, 0, 0), (1, 0, 0)))
    assert len(report.pieces) == 2
    far = max(report.pieces, key=lambda piece: piece.volume)
    born, mesh = simulation.born("bar"), simulation.meshes["bar"]
    numbers = simulation.remaining_cells("bar")
    cells = mesh.volume_blocks[0].nodes[np.isin(numbers, far.cells)]
    ghosts = [node for node in np.unique(cells) if abs(mesh.points[node, 0]) < 1e-9]
    assert len(ghosts) == 12
    assert all(born[node] >= 0 for node in ghosts)
    assert simulation.free_axes()[simulation.rows("bar")][ghosts].all()


def test_edges_of_a_sheet_stay_held() -> None:
    """A membrane on a held edge is cut across this edge, between two of its nodes."""
    sheet = ts.Body(
        mesh=ts.bar_mesh(size=(0.1, 0.06, 0), cells=(5, 3, 0), cell="triangle"),
        law=ts.StVK(young=YOUNG, poisson=0),
        density=1000.0,
        thickness=1e-3,
    )
    drawn = ((0, 0, 0), (0.01, 0, 0))
    simulation = ts.Scene(
        bodies={"bar": sheet},
        fixed=[ts.Fixed("bar", on=HELD)],
        prescribed=[ts.Prescribed("bar", on=MOVED, times=(0, 1), displacements=drawn)],
        step=ts.Static(solver=ts.Cholesky(), newton=ts.Newton(tolerance=1e-11, iterations=40)),
        editing=ts.Editing(room=5.0),
    ).compile()
    assert len(simulation.cut("bar", ts.Plane((0, 0.0273, 0), (0, 1, 0))).pieces) == 2
    assert simulation.step().converged
    places = simulation.meshes["bar"].points[:, 0]
    force = -simulation.reactions("bar")[np.abs(places) < 1e-9, 0].sum()
    exact = YOUNG * 0.06 * 1e-3 * STRETCH * (STRETCH**2 - 1) / 2
    assert force == pytest.approx(exact, rel=1e-9)


def test_checkpoints_and_removed_cells_hold_the_same_copies(tmp_path: Path) -> None:
    """Edits one after the other, in one go from a checkpoint, and back at a mark."""
    simulation = stretched("hexahedron", step=ts.ImplicitEuler("5 ms", solver=ts.Cholesky()))
    simulation.cut("bar", ts.Plane((0, 0.017, 0), (0, 1, 0.1)))
    simulation.cut("bar", ts.Disc((0.0, 0.03, 0.015), (0, 0.1, 1), "2.5 cm"))
    near = simulation.meshes["bar"].points[simulation.meshes["bar"].volume_blocks[0].nodes]
    touching = np.flatnonzero((np.abs(near[:, :, 0]) < 1e-9).any(axis=1))
    simulation.remove_cells(body="bar", cells=simulation.remaining_cells("bar")[touching[::3]])
    simulation.save_checkpoint(tmp_path / "edited")
    again = simulation.scene.compile(checkpoint=tmp_path / "edited")
    assert np.array_equal(simulation.free_axes(), again.free_axes())
    mark = simulation.mark()
    ends = []
    for one in (simulation, again, simulation):
        if len(ends) == 2:
            one.rewind(mark)
        for _ in range(4):
            one.step()
        ends.append(one.positions["bar"].tobytes())
    assert len(set(ends)) == 1


def _fallen_apart(cell: Any, random: np.random.Generator, frames: bool) -> ts.Simulation:
    """A bar that stands on its lower face, after three cuts in any direction."""
    model: dict[str, Any] = {"model": ts.Frames()} if frames else {}
    simulation = ts.Scene(
        bodies={
            "bar": ts.Body(
                mesh=ts.bar_mesh(size=(0.06, 0.03, 0.03), cells=(4, 2, 2), cell=cell),
                law=ts.StVK(young=1e4, poisson=0.3),
                density=1000.0,
                **model,
            )
        },
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        step=ts.ImplicitEuler("2 ms", solver=ts.Cholesky()),
        editing=ts.Editing(room=20.0),
    ).compile()
    for _ in range(3):
        place = (random.uniform(0.005, 0.055), 0.015, 0.015)
        normal = random.standard_normal(3) * np.array([1, 0.4, 0.4])
        simulation.cut("bar", ts.Plane(place, tuple(normal)))
    return simulation


@pytest.mark.parametrize(
    ("cell", "frames"),
    [
        ("tetra", False),
        ("hexahedron", False),
        ("hexahedron", True),
        ("tetra10", False),
        ("tetra10", True),
        ("hexahedron20", False),
        ("hexahedron27", False),
        ("wedge15", False),
        ("pyramid13", False),
    ],
)
def test_pieces_without_material_on_the_support_are_free(cell: str, frames: bool) -> None:
    """Also where copies of middles of edges, faces and cells lie outside of a piece."""
    random = np.random.default_rng(11)
    loose = 0
    for _ in range(20):
        simulation = _fallen_apart(cell, random, frames)
        pieces = simulation.pieces("bar")
        surface = simulation.surface("bar")
        rest = surface.carried(simulation.meshes["bar"].points)
        on_support = (np.abs(rest[surface.triangles][:, :, 2]) < 1e-9).all(axis=1)
        simulation.step()
        reactions = np.abs(simulation.reactions("bar")).max(axis=1)
        numbers = simulation.remaining_cells("bar")
        rows = [row for block in simulation.meshes["bar"].body_blocks for row in block.nodes]
        for piece in pieces:
            own = np.isin(surface.cell, piece.cells)
            lowest = rest[surface.triangles[own]][:, :, 2].min()
            if lowest < 1e-9:  # at a point or along an edge alone both are right
                assert piece.held or not (own & on_support).any()
                continue
            assert not piece.held
            loose += 1
            cells = [
                row for number, row in zip(numbers, rows, strict=True) if number in piece.cells
            ]
            assert not reactions[np.unique(np.concatenate(cells))].any()
    assert loose >= 10
