"""Points of contacts lie on the surface of the first of each pair, also where that is round."""

import numpy as np
import pytest

import tissu as ts

RADIUS = 0.04
TOP = 0.1  # of the block
GAP = 5e-4
START = TOP + GAP + RADIUS  # height of the axis of what is round
PUSHED = ts.Motion(times=(0, 0.05), displacements=((0, 0, 0), (0.001, 0, -0.01)))
AXIS = ((0.01, 0.04, START), (0.09, 0.05, START))


def line(model, radius=0.03):
    """A rod that lies across the block, and its law."""
    ends = np.array([(-0.02, 0.04, TOP + GAP + radius), (0.12, 0.05, TOP + GAP + radius)])
    points = np.linspace(*ends, 11)
    cells = np.stack([np.arange(10), np.arange(1, 11)], axis=1)
    return ts.Body(
        mesh=ts.Mesh(points=points, cells=(("line", cells),), thin=(1,)),
        law=ts.StVK(young=1e6, poisson=0.3),
        density=1000,
        section=ts.Round(radius=radius),
        model=model,
        start=ts.Start(velocity=(0.1, 0, -0.3)),
    )


def sheet(thickness):
    mesh = ts.BarMesh(
        size=(0.06, 0.06, 0),
        cells=(3, 3, 0),
        cell="triangle",
        origin=(0.02, 0.02, TOP + GAP + thickness / 2),
    )
    return ts.Body(
        mesh=mesh,
        law=ts.StVK(young=1e6, poisson=0.3),
        density=1000,
        thickness=thickness,
        model=ts.FEM(),
        start=ts.Start(velocity=(0.1, 0, -0.3)),
    )


def pressed(tool, friction):
    """A block that is held below, and a tool that presses on it and moves to the side.

    It steps until the tool is the first of a pair.
    """
    block = ts.Body(
        mesh=ts.BarMesh(size=(0.1, 0.1, TOP), cells=(4, 4, 4), cell="hexahedron"),
        law=ts.StableNeoHooke(young=2e4, poisson=0.4),
        density=1000,
    )
    bodies, obstacles = {"block": block}, {}
    (bodies if isinstance(tool, ts.Body) else obstacles)["tool"] = tool
    simulation = ts.Scene(
        bodies=bodies,
        obstacles=obstacles,
        contacts=[ts.Contact(("block", "tool"), friction=friction, gap=GAP)],
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        step=ts.ImplicitEuler(2e-3),
    ).compile()
    for _ in range(25):
        report = simulation.step()
        if simulation.time > 0.02 and is_first(simulation.contacts()).any():
            assert report.substeps == 1  # of several, force_on has the mean, contacts the last
            return simulation
    raise AssertionError("the tool is never the first of a pair")


def is_first(found):
    """In which contacts the tool is the first of the pair."""
    return found.pairs[:, 0] == found.surfaces.index("tool")


def moment_on_tool(simulation, origin, places, reach):
    """Of the listed forces: at their points where the tool is the first of the pair.

    Where it is the second, they act on its nodes, at `places`, or `reach` away from them.
    """
    found = simulation.contacts()
    first = is_first(found)
    moment = np.cross(found.points[first] - origin, found.forces[first]).sum(axis=0)
    shares = np.maximum(-found.weights[~first], 0.0)
    nodes = np.where(shares > 0.0, found.nodes[~first], 0)
    there = np.einsum("ik,ikj->ij", shares, places[nodes]) + reach * found.normals[~first]
    return moment - np.cross(there - origin, found.forces[~first]).sum(axis=0)


def center_of(simulation):
    """Where the middle of the obstacle is now."""
    obstacle = simulation.obstacle("tool")
    return obstacle.place_of(obstacle.origin)


def apart_from_axis(points, nodes):
    """Distance of points from the line through all these nodes."""
    along = np.diff(nodes, axis=0)
    away = points[:, None] - nodes[:-1]
    share = np.clip((away * along).sum(axis=2) / (along**2).sum(axis=1), 0.0, 1.0)
    return np.linalg.norm(away - share[:, :, None] * along, axis=2).min(axis=1)


TOOLS = {
    "ball": lambda: ts.SphereObstacle(center=(0.05, 0.04, START), radius=RADIUS, motion=PUSHED),
    "free ball": lambda: ts.SphereObstacle(
        center=(0.05, 0.04, START), radius=RADIUS, mass=0.3, velocity=(0.1, 0, -0.3)
    ),
    "capsule": lambda: ts.CapsuleObstacle(ends=AXIS, radius=RADIUS, motion=PUSHED),
    "rod of frames": lambda: line(ts.Frames()),
    "rod": lambda: line(ts.FEM()),
    "sheet": lambda: sheet(6e-3),
}


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("tool", TOOLS)
def test_forces_at_the_points_have_the_moment_on_the_first(tool, friction):
    """To round-off of sums of about a hundred products of force and place."""
    simulation = pressed(TOOLS[tool](), friction)
    force, moment = simulation.force_on("tool")
    origin, places = np.zeros(3), simulation.positions.get("tool")
    if simulation.obstacles:
        origin = center_of(simulation)
        ends = AXIS if tool == "capsule" else [simulation.obstacle("tool").origin]
        places = np.array([simulation.obstacle("tool").place_of(end) for end in ends])
    found = simulation.contacts()
    size = np.linalg.norm(found.forces, axis=1).sum() * np.abs(found.points).max()
    assert np.linalg.norm(force) > 0.0
    reach = {"rod": 0.0, "sheet": 0.0, "rod of frames": 0.03}.get(tool, RADIUS)
    expected = pytest.approx(moment, abs=1e-13 * size)
    assert moment_on_tool(simulation, origin, places, reach) == expected


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("tool", ["ball", "free ball"])
def test_points_are_on_a_ball(tool, friction):
    """To round-off of places of 10 cm."""
    simulation = pressed(TOOLS[tool](), friction)
    found = simulation.contacts()
    away = (found.points - center_of(simulation))[is_first(found)]
    assert away == pytest.approx(-RADIUS * found.normals[is_first(found)], abs=1e-15)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_points_are_on_a_rod(friction):
    """A capsule to round-off; others bend, and at nodes are nearer by less than 1 % of the radius.

    Without friction a rod without frames and a sheet have them on their surface, too.
    """
    simulation = pressed(TOOLS["capsule"](), friction)
    found = simulation.contacts()
    ends = np.array([simulation.obstacle("tool").place_of(end) for end in AXIS])
    apart = apart_from_axis(found.points[is_first(found)], ends)
    assert apart == pytest.approx(RADIUS, abs=1e-15)
    for tool in ("rod of frames",) if friction else ("rod of frames", "rod"):
        simulation = pressed(TOOLS[tool](), friction)
        found, nodes = simulation.contacts(), simulation.positions["tool"]
        apart = apart_from_axis(found.points[is_first(found)], nodes)
        assert apart == pytest.approx(0.03, rel=1e-2)


@pytest.mark.parametrize(("friction", "height"), [(0.0, 3e-3), (0.3, 0.0)])
def test_points_are_on_the_middle_of_a_sheet_with_friction_else_on_its_surface(friction, height):
    """To round-off of places of 10 cm."""
    simulation = pressed(sheet(6e-3), friction)
    found = simulation.contacts()
    at = is_first(found)
    shares = np.maximum(found.weights[at], 0.0)
    places = simulation.positions["tool"][np.where(shares > 0.0, found.nodes[at], 0)]
    middle = np.einsum("ik,ikj->ij", shares, places)
    assert found.points[at] == pytest.approx(middle - height * found.normals[at], abs=1e-15)
