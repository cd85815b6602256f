"""Sheets in contact with themselves, where two cuts meet."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY

THICKNESS = 2e-3
"""[m]"""


def membrane(tilt: float = 0.0) -> ts.Scene:
    """A square-celled membrane that may touch itself, turned about y at rest [rad]."""
    flat = ts.bar_mesh(size=(0.06, 0.03, 0), cells=(4, 2, 0), cell="quad")
    turn = np.array(((np.cos(tilt), 0, -np.sin(tilt)), (0, 1, 0), (np.sin(tilt), 0, np.cos(tilt))))
    mesh = ts.Mesh(points=flat.points @ turn.T, cells={b.type: b.nodes for b in flat.cells})
    body = ts.Body(
        mesh=mesh,
        law=ts.StVK(young="100 kPa", poisson=0.3),
        density=1000.0,
        thickness=THICKNESS,
        viscosity=ts.Rayleigh(stiffness=0.005),
    )
    return ts.Scene(
        bodies={"sheet": body},
        gravity=(0, 0, -GRAVITY),
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.003), (0, 0, 1))},
        contacts=[ts.Contact(("sheet", "table"), friction=0.3), ts.SelfContact("sheet")],
        editing=ts.Editing(room=8.0),
        step=ts.BDF2("5 ms"),
    )


MEETING = (
    ts.Plane((0.0288245, 0.0118314, -0.0009893), (0.1567511, -0.1869309, -0.503352)),
    ts.Plane((0.027808, 0.0143783, -0.0036591), (-1.5301358, -0.477753, -0.1957038)),
)
"""Two cuts that meet 20 um beside a diagonal of a cell, and leave a triangle as flat as that."""


def test_surfaces_do_not_cross_where_two_cuts_meet() -> None:
    """The sheet lies on the table while it is cut a second time across the first cut."""
    simulation = membrane().compile()
    for number in range(26):
        for at, blade in zip((4, 13), MEETING, strict=True):
            if number == at:
                simulation.cut("sheet", blade)
        assert simulation.step().converged
        assert simulation.crossings() == [], f"step {number + 1}"


@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_no_triangle_turns_over_where_cuts_meet(tilt: float) -> None:
    """Contact begins inside the material: all its triangles face as the sheet does."""
    normal = np.array((-np.sin(tilt), 0.0, np.cos(tilt)))
    random = np.random.default_rng(1)
    turned = 0
    for _ in range(30):
        simulation = membrane(tilt).compile()
        for _ in range(4):
            point = np.array((0.03, 0.015, 0)) + random.normal(size=3) * (9e-3, 6e-3, 0)
            point[2] = point[0] * np.tan(tilt)
            way = np.append(random.normal(size=2), 0.2 * random.normal())
            simulation.cut("sheet", ts.Plane(tuple(point), tuple(way)))
        surface = simulation.contact_surface("sheet")
        a, b, c = (surface.rest[surface.triangles[:, i]] for i in range(3))
        turned += np.count_nonzero(np.cross(b - a, c - a) @ normal <= 0)
    assert turned == 0
