"""Sheets of triangles whose cells a cut divides."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import shaken
from divided import EXACT, HELD

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
MASS = 0.4 * 0.1 * 1e-3 * 1000.0
SLANTED = ts.Plane(point=(0.213, 0.05, 0.0), normal=(1.0, 0.31, -0.27))


def sheet(cells: tuple[int, int, int] = (12, 4, 0), **body: Any) -> ts.Body:
    return ts.Body(
        mesh=ts.bar_mesh(size=(0.4, 0.1, 0), cells=cells, cell="triangle"),
        **{"law": ts.StVK(young=5e5, poisson=0.3), "density": 1000.0, "thickness": 1e-3} | body,
    )


def scene(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"sheet": sheet() if body is None else body},
            "fixed": [ts.Fixed("sheet", on=HELD)],
            "step": ts.ImplicitEuler(dt=0.002),
            "editing": ts.Editing(method="subdivide", room="900 %"),
        }
        | changes
    )


def triangles(simulation: ts.Simulation) -> Any:
    return np.concatenate([block.nodes for block in simulation.meshes["sheet"].body_blocks])


def areas(points: Any, cells: Any) -> Any:
    a, b, c = points[cells].swapaxes(0, 1)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


@pytest.mark.parametrize("law", [ts.StVK, ts.Hooke])
def test_random_cuts_keep_what_they_must(law: Any) -> None:
    """Of a lumped triangle the kinetic energy falls by at most rho V / 24 sum |v_b - v_a|^2."""
    divided = 0
    for seed in range(12):
        random = np.random.default_rng(seed)
        body = sheet(law=law(young=5e5, poisson=0.3))
        simulation = shaken(scene(body, fixed=[]).compile(), seed)
        for _ in range(3):
            v, cells = np.array(simulation.velocities["sheet"]), triangles(simulation)
            numbers = simulation.remaining_cells("sheet")
            of_cells = areas(simulation.meshes["sheet"].points, cells)
            before, elastic = simulation._core.totals("sheet"), simulation.energy()["elastic"]
            point = (*random.uniform((0.1, 0.02), (0.3, 0.08)), 0.0)
            normal = random.standard_normal(3) * (1, 1, 0.2)
            report = simulation.cut("sheet", ts.Plane(point=point, normal=normal))
            divided += report.cells_new
            after = simulation._core.totals("sheet")
            gone = ~np.isin(numbers, simulation.remaining_cells("sheet"))
            apart = sum(
                ((v[cells[gone, a]] - v[cells[gone, b]]) ** 2).sum(axis=1)
                for a, b in ((0, 1), (0, 2), (1, 2))
            )
            most = float((of_cells[gone] * apart).sum()) / 24
            scale = MASS * np.abs(v).max()
            assert abs(after["mass"] - before["mass"]) <= ROUND_OFF * MASS, seed
            assert abs(after["volume"] - before["volume"]) <= ROUND_OFF * MASS / 1000, seed
            assert np.abs(after["momentum"] - before["momentum"]).max() <= ROUND_OFF * scale, seed
            lost = before["kinetic"] - after["kinetic"]
            assert -ROUND_OFF * before["kinetic"] <= lost <= most + ROUND_OFF * before["kinetic"]
            assert simulation.energy()["elastic"] == pytest.approx(elastic, rel=1e-10), seed
            rest, now = simulation.meshes["sheet"].points, triangles(simulation)
            assert areas(rest, now).min() > 0.0
            edges = np.sort(
                np.concatenate([now[:, [0, 1]], now[:, [1, 2]], now[:, [0, 2]]]), axis=1
            )
            assert np.unique(edges, axis=0, return_counts=True)[1].max() <= 2, seed
            assert not report.unresolved, seed
    assert divided > 500


def test_parts_of_a_sheet_go_on_as_a_sheet_built_of_them() -> None:
    """Thickness, law, mass and supports are those of the cut sheet."""
    drawn = ts.Prescribed(
        "sheet",
        on=ts.Plane((0.4, 0, 0), (1, 0, 0)),
        times=[0, 0.04],
        displacements=[(0, 0, 0), (0.02, 0, 0.02)],
    )
    whole = scene(prescribed=[drawn], step=EXACT).compile()
    report = whole.cut("sheet", ts.Disc((0.21, 0.05, 0), (1, 0.2, 0), 0.03))
    assert report.cells_new > report.cells_gone > 0
    mesh = whole.meshes["sheet"]
    body = sheet().replace(mesh=ts.Mesh(points=mesh.points, cells=mesh.cells))
    built = scene(body, prescribed=[drawn], step=EXACT).compile()
    for _ in range(10):
        whole.step()
        built.step()
    moved = whole.displacements("sheet")
    assert np.abs(moved).max() > 1e-2
    np.testing.assert_allclose(moved, built.displacements("sheet"), rtol=0, atol=1e-9 * 0.4)


def test_a_cut_sheet_goes_on_from_a_file(tmp_path: Path) -> None:
    first = scene(gravity=(0, 0, -9.81)).compile()
    report = first.cut("sheet", SLANTED)
    assert len(report.pieces) == 2
    for _ in range(3):
        first.step()
    first.save_checkpoint(tmp_path / "cut")
    second = scene(gravity=(0, 0, -9.81)).compile(checkpoint=tmp_path / "cut")
    for simulation in (first, second):
        simulation.cut("sheet", ts.Plane((0.2, 0.052, 0), (0.1, 1, 0)))
        for _ in range(3):
            simulation.step()
    assert first.positions["sheet"].tobytes() == second.positions["sheet"].tobytes()
    assert (triangles(first) == triangles(second)).all()
