"""Round things pressed in static steps: a paraboloid after Hertz, a ball into a block."""

import math

import numpy as np
import pytest

import tissu as ts
from contact_audit import block
from contact_static import judged, pushed

YOUNG, POISSON = 1e5, 0.3
RADIUS = 0.02
"""of the contact [m]"""
CURVATURE = 1.0
"""radius of curvature [m]"""
DELTA = RADIUS**2 / CURVATURE
"""by which the plate comes down [m]"""


def graded(edge):
    """Places from 0 to twenty radii: even up to 1.5, then each gap half as long again."""
    places = list(np.arange(0.0, 1.5 * RADIUS + edge / 2, edge))
    while places[-1] < 20 * RADIUS:
        edge *= 1.5
        places.append(places[-1] + edge)
    return np.array(places)


def quarter(x):
    """A quarter of a half-space below z = 0, whose top is a paraboloid as far as it may be met."""
    count = len(x)
    points = np.array([(a, b, -c) for a in x for b in x for c in x])
    top = points[:, 2] == 0.0
    far = np.minimum(np.hypot(*points[top, :2].T), 3 * RADIUS)
    points[top, 2] = -(far**2) / (2 * CURVATURE)
    node = np.arange(count**3).reshape(count, count, count)
    low, high = slice(None, -1), slice(1, None)
    around = ((low, low), (high, low), (high, high), (low, high))
    corners = [node[i, j, k] for k in (high, low) for i, j in around]
    cells = np.stack([c.ravel() for c in corners], axis=1)
    return ts.Mesh(points=points, cells={"hexahedron": cells})


def force_over_hertz(edges, *, gap=0.01 * DELTA, judge=pushed, **fields):
    """Force of the plate over F = 4/3 E* sqrt(R) delta^1.5, with so many edges in the radius.

    What is fixed below would have sunk there by F (1 + nu) (3 - 2 nu) / (2 pi E depth), after
    Boussinesq, which is added to delta.
    """
    x = graded(RADIUS / edges)
    down = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -DELTA)))
    held = {"xyz": ((0, 0, -x[-1]), (0, 0, 1)), "x": ((0, 0, 0), (1, 0, 0)),
            "y": ((0, 0, 0), (0, 1, 0))}  # fmt: skip
    law = ts.StVK(young=YOUNG, poisson=POISSON)
    scene = ts.Scene(
        bodies={"ball": ts.Body(mesh=quarter(x), law=law, density=1000)},
        obstacles={"plate": ts.PlaneObstacle((0, 0, gap), (0, 0, -1), motion=down)},
        contacts=[ts.Contact(("ball", "plate"), gap=gap)],
        fixed=[ts.Fixed("ball", on=ts.Plane(point=point, normal=normal), axes=axes)
               for axes, (point, normal) in held.items()],
        step=ts.Static(solver=ts.Cholesky()),
        **fields,
    )  # fmt: skip
    simulation = scene.compile()
    judge(simulation)
    force = 4 * simulation.force_on("plate").force[2]
    sunk = force * (1 + POISSON) * (3 - 2 * POISSON) / (2 * math.pi * YOUNG * x[-1])
    reduced = YOUNG / (1 - POISSON**2)
    return force / (4 / 3 * reduced * math.sqrt(CURVATURE) * (DELTA + sunk) ** 1.5)


def test_hertz():
    """Two edges in the radius of contact leave 5 %, three leave 2.5 %: the area goes by nodes."""
    coarse, fine = force_over_hertz(2), force_over_hertz(3)
    assert coarse == pytest.approx(1.0, abs=0.05)
    assert fine == pytest.approx(1.0, abs=0.025)
    assert abs(fine - 1) < abs(coarse - 1)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_ball_is_pressed_into_a_block(friction):
    """Few triangles carry it, and tilt under it; support and ball have opposite forces."""
    radius, rest = 0.02, 1e-3
    down = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -0.01)))
    law = ts.StableNeoHooke(young=5e3, poisson=0.45)
    scene = ts.Scene(
        bodies={"block": block(cells=(6, 6, 6), law=law)},
        obstacles={
            "ball": ts.SphereObstacle((0.052, 0.047, 0.1 + radius + rest), radius, motion=down)
        },
        contacts=[ts.Contact(("block", "ball"), friction=friction)],
        fixed=[ts.Fixed("block", on=ts.Plane(point=(0, 0, 0), normal=(0, 0, 1)))],
        step=ts.Static(),
    )
    simulation = scene.compile()
    last = 0.0
    for _ in range(4):
        judged(simulation, simulation.step(0.25))
        force = simulation.force_on("ball").force
        support = simulation.reactions("block").sum(axis=0)
        assert support == pytest.approx(force, abs=1e-5 * np.linalg.norm(force))
        assert force[2] > last
        last = force[2]
