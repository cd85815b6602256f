"""Every kind of body on a plane: membranes, shells, sheets and volumes of frames, lines, rods."""

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, block, damped

THICK = 2e-3
"""of sheets [m]"""
SECTION = 1e-5
"""of lines [m2]"""
SHEET = ts.BarMesh(size=(0.1, 0.1, 0), cells=(4, 4, 0), cell="triangle", origin=(0, 0, 3e-3))
LAWS = {"hooke": ts.Hooke(young=2e4, poisson=0.3), "stvk": ts.StVK(young=2e4, poisson=0.3)}


def line():
    """Eight pieces of 12.5 mm."""
    x = np.linspace(0, 0.1, 9)
    nodes = np.stack([np.arange(8), np.arange(1, 9)], axis=1).astype(np.int32)
    points = np.stack([x, 0 * x, 0 * x + 4e-3], axis=1)
    return ts.Mesh(points=points, cells=(ts.CellBlock("line", nodes),))


def thin(law="stvk", **fields):
    return ts.Body(law=LAWS[law], density=1000.0, viscosity=damped(20.0, 1e-3), **fields)


HALF = ts.Frames(lever="half")
BODIES = {
    "membrane": (lambda: thin(mesh=SHEET, thickness=THICK), THICK * 0.01),
    "shell": (lambda: thin("hooke", mesh=SHEET, thickness=THICK, model="shell"), THICK * 0.01),
    "sheet of frames": (lambda: thin(mesh=SHEET, thickness=THICK, model="frames"), THICK * 0.01),
    "line": (lambda: thin(mesh=line(), section=SECTION), SECTION * 0.1),
    "rod": (lambda: thin(mesh=line(), section=SECTION, model="frames"), SECTION * 0.1),
    "frames": (
        lambda: block((0, 0, 1e-3), young=2e4, model=HALF, viscosity=damped(20.0, 1e-3)),
        1e-3,
    ),
}
"""Name -> the body, and its volume [m3]."""


@pytest.mark.parametrize("step", [ts.ImplicitEuler("5 ms"), ts.SymplecticEuler()])
@pytest.mark.parametrize("kind", BODIES)
def test_every_kind_of_body_rests_with_its_weight(kind, step):
    """At half its thickness and a gap; 5e-3: what is left of a block's swing."""
    make, volume = BODIES[kind]
    scene = ts.Scene(
        bodies={"body": make()},
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("body", "table"), friction=0.3)],
        gravity=(0, 0, -GRAVITY),
        step=step,
    )
    simulation = scene.compile()
    forces = []
    while simulation.time < 0.6:
        report = simulation.step()
        assert report.converged
        assert simulation.crossings() == []
        if simulation.time > 0.5:
            forces.append(simulation.force_on("table").force)
    weight = 1000.0 * GRAVITY * volume
    assert np.mean(forces, axis=0) == pytest.approx([0, 0, -weight], abs=5e-3 * weight)
    radius = {"line": np.sqrt(SECTION / np.pi), "rod": np.sqrt(SECTION / np.pi)}.get(
        kind, 0.0 if kind == "frames" else THICK / 2
    )
    assert simulation.positions["body"][:, 2].min() > radius
