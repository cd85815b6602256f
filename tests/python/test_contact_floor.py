"""A floor of triangles is slid on as a plane is, in explicit and implicit steps."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts

GRAVITY = 9.81
SLOPE = np.radians(20)
GAP = 2e-4
METHODS = ("impulse", "penalty", "geometric")


def floor(cells: int, digits: int | None = None) -> ts.MeshObstacle:
    """Triangles in the plane z = 0, or in a tilted one whose coordinates have few digits."""
    xs, ys = np.linspace(-0.06, 0.5, cells + 1), np.linspace(-0.1013, 0.0991, cells // 3 + 1)
    points = np.array([[x, y, 0.0] for y in ys for x in xs])
    if digits is not None:
        tilted = points @ turned(0.3).T
        rounded = np.array([[float(f"{x:.{digits}g}") for x in p] for p in tilted])
        points = rounded @ turned(0.3)
    corners = [
        [a, a + 1, a + cells + 2, a + cells + 1]
        for j in range(len(ys) - 1)
        for a in range(j * (cells + 1), j * (cells + 1) + cells)
    ]
    triangles = [t for a, b, c, d in corners for t in ([a, b, c], [a, c, d])]
    mesh = ts.Mesh(points=points, cells=[ts.CellBlock("triangle", np.array(triangles))])
    return ts.MeshObstacle(mesh=mesh)


def turned(angle: float) -> np.ndarray:
    """Two rotations after each other, about x and y."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ np.array(
        [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    )


PLANE = ts.PlaneObstacle((0, 0, 0), (0, 0, 1))


def sliding(ground: Any, soft: bool, friction: float, step: Any, method: Any) -> ts.Simulation:
    """A box of 4 cm on a slope of 20 degrees along x."""
    obstacles: dict[str, Any] = {"floor": ground}
    bodies = {}
    if soft:
        mesh = ts.BarMesh(size=(0.04, 0.04, 0.02), cells=(3, 3, 2), origin=(-0.02, -0.02, GAP))
        law = ts.StableNeoHooke(young="100 kPa", poisson=0.3)
        damped = ts.Rayleigh(mass="0 1/s", stiffness="0.2 ms")
        bodies["box"] = ts.Body(mesh=mesh, law=law, density="1 g/cm^3", viscosity=damped)
    else:
        low, high = (-0.02, -0.02, GAP), (0.02, 0.02, 0.02 + GAP)
        obstacles["box"] = ts.BoxObstacle(low, high, mass=0.03)
    scene = ts.Scene(
        bodies=bodies,
        obstacles=obstacles,
        contacts=[ts.Contact(("box", "floor"), friction=friction, gap=GAP)],
        contact=ts.ContactSettings(method=method),
        gravity=(GRAVITY * np.sin(SLOPE), 0, -GRAVITY * np.cos(SLOPE)),
        step=step,
    )
    return scene.compile()


def velocity(simulation: ts.Simulation) -> float:
    """Along the slope, after 0.1 s."""
    while simulation.time < 0.1 - 1e-9:
        report = simulation.step()
        assert report.converged, report
    assert simulation.crossings() == []
    if "box" in simulation.bodies:
        masses = simulation.mass_matrix().diagonal()[::3]
        return float(masses @ simulation.velocities["box"][:, 0] / masses.sum())
    return float(simulation.rigid("box").velocity[0])


@pytest.mark.parametrize(
    ("soft", "friction"),
    [(False, 0.0), (False, 0.2), (True, 0.0)],
    ids=["rigid", "rigid with friction", "soft"],
)
@pytest.mark.parametrize("method", METHODS)
def test_a_box_slides_on_triangles_as_on_a_plane(method: str, friction: float, soft: bool) -> None:
    """The same forces, to round-off that 500 steps of a bouncing box amplify.

    Each vertex that the rim of a rigid box passed held it: it was at 12 to 77 % of the velocity
    that it has on a plane, a soft one at 96 %.
    """
    step = ts.SymplecticEuler("0.2 ms" if soft else "0.5 ms")
    on_plane = velocity(sliding(PLANE, soft, friction, step, method))
    on_floor = velocity(sliding(floor(80), soft, friction, step, method))
    assert on_floor == pytest.approx(on_plane, rel=1e-6)
    if friction == 0.0:
        assert on_floor == pytest.approx(GRAVITY * np.sin(SLOPE) * 0.1, rel=1e-6)


@pytest.mark.parametrize("digits", [7, 6])
def test_rounded_coordinates_are_a_plane_too(digits: int) -> None:
    """A tilted floor whose file has seven digits, as single precision, or six.

    Its faces are out of the plane by up to 3e-7 m, so that the box of 4 cm tilts by 1e-5.
    """
    step = ts.SymplecticEuler("0.5 ms")
    ground = floor(80, digits)
    assert 1e-9 < np.abs(ground.mesh.points[:, 2]).max() < 1e-6
    reached = velocity(sliding(ground, False, 0.0, step, "impulse"))
    assert reached == pytest.approx(GRAVITY * np.sin(SLOPE) * 0.1, rel=1e-3)


def test_a_ball_right_above_a_vertex_rests_on_it() -> None:
    """The vertex is inside the plane, and alone is nearest."""
    ground = floor(8)
    place = ground.mesh.points[np.argmin(np.abs(ground.mesh.points[:, :2]).sum(axis=1)), :2]
    scene = ts.Scene(
        bodies={},
        obstacles={
            "floor": ground,
            "ball": ts.SphereObstacle((*place, 0.01 + GAP), radius=0.01, mass=0.1),
        },
        contacts=[ts.Contact(("ball", "floor"), gap=GAP)],
        gravity=(0, 0, -GRAVITY),
        step=ts.SymplecticEuler("1 ms"),
    )
    simulation = scene.compile()
    for _ in range(50):
        assert simulation.step().converged
    assert simulation.rigid("ball").position == pytest.approx((*place, 0.01 + GAP), abs=1e-9)
    assert simulation.force_on("floor").force[2] == pytest.approx(-0.1 * GRAVITY, rel=1e-9)


def test_a_curved_floor_is_not_taken_for_a_plane() -> None:
    """A round roof of 1600 strips: a box lies on its ridge and stays.

    Neighbouring faces differ by 1e-3 rad, which rounding could have made of one plane; the ridge
    has no other vertex of the box above it.
    """
    angles = np.linspace(-0.8, 0.8, 1601)
    arc = 0.05 * np.stack([np.sin(angles), 0 * angles, np.cos(angles) - 1.0], axis=1)
    points = np.concatenate([arc + np.array([0, y, 0]) for y in (-0.03, 0.03)])
    a = np.arange(1600)
    triangles = np.concatenate(
        [np.stack([a, a + 1, a + 1602], 1), np.stack([a, a + 1602, a + 1601], 1)]
    )
    mesh = ts.Mesh(points=points, cells=[ts.CellBlock("triangle", triangles)])
    scene = ts.Scene(
        bodies={},
        obstacles={
            "floor": ts.MeshObstacle(mesh=mesh),
            "box": ts.BoxObstacle((-0.02, -0.02, GAP), (0.02, 0.02, 0.02 + GAP), mass=0.03),
        },
        contacts=[ts.Contact(("box", "floor"), gap=GAP, friction=0.5)],
        gravity=(0, 0, -GRAVITY),
        step=ts.SymplecticEuler("0.5 ms"),
    )
    simulation = scene.compile()
    held = 0
    for _ in range(40):
        report = simulation.step()
        held += report.held_back > 0
    assert held == 0
    assert simulation.rigid("box").position[2] == pytest.approx(0.01 + GAP, abs=0.1 * GAP)
    assert simulation.force_on("floor").force[2] == pytest.approx(-0.03 * GRAVITY, rel=0.05)
