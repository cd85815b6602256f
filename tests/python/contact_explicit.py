"""Scenes with contact in explicit steps that several tests take."""

import tissu as ts
from contact_audit import GRAVITY

DENSITY = 1000.0
THICKNESS = 2e-3
"""Of sheets [m]; surfaces rest half of it and a gap apart."""
PER_AREA = DENSITY * THICKNESS
"""[kg/m2]"""


def flat(height, *, young=1e5, start=None, **fields):
    """A sheet of triangles, 10 cm wide: each node has its mass by its area."""
    mesh = ts.BarMesh(size=(0.1, 0.1, 0), cells=(3, 3, 0), cell="triangle", origin=(0, 0, height))
    law = ts.StVK(young=young, poisson=0.3)
    body = ts.Body(mesh=mesh, law=law, density=DENSITY, thickness=THICKNESS, start=start, **fields)
    return body


def over_a_table(body, *, step=None, contact=None, gravity=(0, 0, -GRAVITY), **fields):
    """A body over the plane z = 0."""
    return ts.Scene(
        bodies={"body": body},
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("body", "table"), **fields)],
        contact=contact,
        gravity=gravity,
        step=step or ts.SymplecticEuler(),
    )
