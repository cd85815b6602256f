"""A flat wall of triangles is met as a plane is: the edges inside it push nothing sideways."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts

STEPS = {
    "implicit_euler": ts.ImplicitEuler("1 ms"),
    "bdf2": ts.BDF2("1 ms"),
    "symplectic_euler": ts.SymplecticEuler("1 ms"),
}
PLACES = [(0.0, 0.0), (0.003, 0.001), (0.011, -0.006)]
"""on the diagonal, and beside it"""


def wall(half: float) -> ts.MeshObstacle:
    """A square of two triangles in the plane z = 0."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    cells = [ts.CellBlock("triangle", np.array([[0, 1, 2], [0, 2, 3]]))]
    return ts.MeshObstacle(mesh=ts.Mesh(points=half * corners, cells=cells))


@pytest.mark.parametrize("friction", [0.0, 0.5])
@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
def test_a_ball_that_comes_squarely_goes_squarely(
    step: Any, place: tuple[float, float], friction: float
) -> None:
    """No velocity along the wall and no spin: to round-off in explicit steps, else to what the
    linear solver leaves of 1 m/s (1e-5 of a load, in some twenty systems; 1e-6 was found, and 5e-5
    of what a spin moves the surface by). Round things have met fixed points of walls of this size,
    and the ball left sideways at 0.16 m/s.
    """
    ball = ts.SphereObstacle((*place, 0.03), radius=0.02, mass=0.1, velocity=(0, 0, -1))
    scene = ts.Scene(
        bodies={},
        obstacles={"wall": wall(0.03), "ball": ball},
        contacts=[ts.Contact(("ball", "wall"), friction=friction, gap="1 mm")],
        step=step,
    )
    simulation = scene.compile()
    thing, touched = simulation.rigid("ball"), 0
    for _ in range(60):
        report = simulation.step()
        assert report.converged, report
        touched += report.contacts
        assert simulation.crossings() == []
    assert touched > 0
    solved, turned = (1e-12, 1e-12) if step.type == "symplectic_euler" else (1e-6, 2e-4)
    assert np.abs(thing.velocity[:2]).max() < solved
    assert np.abs(thing.spin).max() < turned / 0.02
    assert thing.velocity[2] > -1e-3  # it has stopped
    assert thing.position[:2] == pytest.approx(place, abs=solved)


def on(ground: Any, **fields: Any) -> ts.Simulation:
    """A soft cube that falls on something flat, not in the middle of it."""
    mesh = ts.BarMesh(size=(0.06,) * 3, cells=(3, 3, 3), cell="hexahedron", origin=(0, 0.01, 2e-3))
    law = ts.StableNeoHooke(young=1e5, poisson=0.3)
    start = ts.Start(velocity=(0, 0, -1))
    body = ts.Body(mesh=mesh, law=law, density=1000.0, start=start)
    scene = ts.Scene(
        bodies={"cube": body},
        obstacles={"ground": ground},
        contacts=[ts.Contact(("cube", "ground"), friction=0.5, gap="0.5 mm")],
        **fields,
    )
    return scene.compile()


@pytest.mark.parametrize("method", ["auto", "barrier"])
def test_a_cube_meets_two_triangles_as_it_meets_a_plane(method: Any) -> None:
    """The same contacts, of vertices alone, and forces to where steps end.

    Those of multipliers change by less than 1e-2 then, those of a barrier are solved to 1e-6 of the
    load. The step of the impact is taken in parts, whose number may differ.
    """
    step = ts.ImplicitEuler("2 ms", solver=ts.Cholesky())
    settings = ts.ContactSettings(method=method)
    plane = on(ts.PlaneObstacle((0, 0, 0), (0, 0, 1)), step=step, contact=settings)
    triangles = on(wall(0.2), step=step, contact=settings)
    most, share = 0, 1e-4 if method == "barrier" else 2e-2
    for k in range(15):
        for simulation in (plane, triangles):
            report = simulation.step()
            assert report.converged or k == 0
            assert simulation.crossings() == []
        found = triangles.contacts()
        assert ((found.weights > 0.0).sum(axis=1) == 1).all()  # vertices alone, no two edges
        assert len(found) == len(plane.contacts())
        force = plane.force_on("cube").force
        size = max(1.0, np.abs(force).max())
        if k > 0:
            assert np.abs(triangles.force_on("cube").force - force).max() < share * size
        most = max(most, len(found))
    assert most >= 16
    moved = triangles.positions["cube"] - plane.positions["cube"]
    assert np.abs(moved).max() < 1e-5
