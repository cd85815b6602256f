"""Bodies with cells of several dimensions that meet themselves while they are cut."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, damped
from test_cut_self_contact import GAP, THICKNESS, joint


def finned() -> ts.Mesh:
    """A block with a sheet that stands on the middle of its top, along x."""
    box = ts.bar_mesh(size=(0.2, 0.04, 0.04), cells=(10, 2, 2), cell="tetra")
    points = box.points
    foot = np.flatnonzero((abs(points[:, 1] - 0.02) < 1e-9) & (points[:, 2] > 0.04 - 1e-9))
    foot = foot[np.argsort(points[foot, 0])]
    rows, places = [foot], [points]
    for height in (0.02, 0.04):
        rows.append(len(points) + len(foot) * (len(rows) - 1) + np.arange(len(foot)))
        places.append(points[foot] + np.array((0, 0, height)))
    triangles = [
        corners
        for low, high in itertools.pairwise(rows)
        for i in range(len(foot) - 1)
        for corners in ((low[i], low[i + 1], high[i + 1]), (low[i], high[i + 1], high[i]))
    ]
    (solid,) = box.cells
    cells = {"tetra": solid.nodes, "triangle": np.array(triangles)}
    return ts.Mesh(points=np.concatenate(places), cells=cells, thin=(2,))


def test_a_block_with_a_fin_is_cut_and_nothing_crosses() -> None:
    """Blades across both, through the fin alone and along its foot, while the fin falls over."""
    body = ts.Body(
        mesh=finned(),
        law=ts.StVK(young=5e4, poisson=0.3),
        density=1000.0,
        thickness=THICKNESS,
        viscosity=damped(),
    )
    simulation = ts.Scene(
        bodies={"block": body},
        gravity=(0, -3, -3),
        contacts=[ts.SelfContact("block", friction=0.3, gap=GAP)],
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=ts.ImplicitEuler("5 ms"),
        editing=ts.Editing(room="900 %"),
    ).compile()
    for blade in (
        ts.Plane((0.11, 0, 0), (1, 0.2, 0.1)),
        ts.Disc((0.05, 0.02, 0.08), (1, 0, 0.3), 0.03),
        ts.Disc((0.09, 0.02, 0.05), (0, 0.1, 1), 0.03),
    ):
        assert simulation.cut("block", blade).cells_cut > 0
        for _ in range(20):
            simulation.step()
            assert simulation.crossings() == []


def test_a_body_with_a_skin_and_a_thread_rests_on_what_it_was_cut_from() -> None:
    """A block with a skin and a thread that stands on its bottom; its top is cut off."""
    side = 0.09
    box = ts.bar_mesh(size=(side,) * 3, cells=(3, 3, 3), cell="tetra")
    points, faces = box.points, box.surface().triangles
    front = faces[(points[faces][:, :, 0] > side - 1e-9).all(axis=1)]
    edge = np.flatnonzero((points[:, 0] < 1e-9) & (points[:, 1] < 1e-9))
    edge = edge[np.argsort(points[edge, 2])]
    (solid,) = box.cells
    cells = {
        "tetra": solid.nodes,
        "triangle": front,
        "line": np.stack([edge[:-1], edge[1:]], axis=1),
    }
    body = ts.Body(
        mesh=ts.Mesh(points=points, cells=cells, thin=(2, 1)),
        law=ts.StVK(young=2e4, poisson=0.3),
        density=1000.0,
        thickness=1e-3,
        section=2e-6,
        viscosity=damped(),
    )
    simulation = ts.Scene(
        bodies={"block": body},
        gravity=(0, 0, -GRAVITY),
        contacts=[ts.SelfContact("block", friction=0.3, gap=4e-4)],
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        step=ts.ImplicitEuler("5 ms"),
        editing=ts.Editing(room="900 %"),
    ).compile()
    report = simulation.cut("block", ts.Plane((0, 0, 0.041), (0, 0.05, 1)))
    assert simulation.crossings() == []
    (piece,) = (piece for piece in report.pieces if not piece.held)
    audited(simulation, 200)
    bears = -joint(simulation, "block")
    assert bears[2] == pytest.approx(GRAVITY * piece.mass, rel=2e-3)
