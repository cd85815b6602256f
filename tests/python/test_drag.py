"""simulation.drag: the point of the surface that is nearest, held by a spring."""

import numpy as np
import pytest

import tissu as ts
from tissu.simulation.drag import shares


def compiled(cell="tetra", **fields):
    bar = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(3, 3, 3), cell=cell)
    body = ts.Body(mesh=bar, law=ts.StVK(young="5 kPa", poisson=0.3), density=1000, **fields)
    return ts.Scene(
        bodies={"cube": body},
        fixed=[ts.Fixed("cube", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        step=ts.ImplicitEuler("10 ms"),
        grabbing=True,
    ).compile()


def test_the_nearest_points_of_triangles_are_nearer_than_every_other_point_of_them():
    """Against 20,000 points of each triangle, drawn evenly."""
    random = np.random.default_rng(3)
    corners = random.normal(size=(40, 3, 3))
    corners[0, 2] = corners[0, 1]  # a triangle without area
    corners[1, 2] = 0.5 * (corners[1, 0] + corners[1, 1])
    weights = random.dirichlet((0.5, 0.5, 0.5), size=20_000)
    for point in random.normal(size=(5, 3)) * 2.0:
        found = shares(corners, point)
        assert np.allclose(found.sum(axis=1), 1.0, atol=1e-12) and found.min() >= -1e-12
        nearest = np.linalg.norm(np.einsum("tk,tki->ti", found, corners) - point, axis=1)
        others = np.linalg.norm(np.einsum("wk,tki->twi", weights, corners) - point, axis=2)
        assert (nearest <= others.min(axis=1) + 1e-12).all()
        assert (others.min(axis=1) - nearest < 0.05).all()


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "tetra10", "wedge"])
def test_it_holds_the_place_and_pulls_with_nothing_at_first(cell):
    simulation = compiled(cell)
    place = np.array([0.043, 0.052, 0.1])
    grab = simulation.drag("cube", place + np.array([0, 0, 0.02]))
    assert np.abs(grab.position - place).max() < 1e-12
    assert np.abs(grab.force).max() == 0.0
    assert grab.point.weights.sum() == pytest.approx(1.0, abs=1e-12)


def test_the_stiffness_is_young_times_an_edge_or_what_is_given():
    simulation = compiled("hexahedron")
    edge = 0.1 / 3.0  # two sides of a half of a square, and its diagonal
    assert simulation.drag_stiffness("cube") == pytest.approx(5e3 * edge * (2 + 2**0.5) / 3)
    assert simulation.drag("cube", (0, 0, 0.1)).stiffness == simulation.drag_stiffness("cube")
    assert simulation.drag("cube", (0, 0, 0.1), stiffness="2 N/mm").stiffness == 2000.0


def test_a_static_pull_balances_its_reaction():
    """In equilibrium the spring's force is what the support gives back: to Newton's tolerance."""
    simulation = compiled()
    static = ts.Scene(
        bodies=simulation.scene.bodies,
        fixed=simulation.scene.fixed,
        step=ts.Static(newton=ts.Newton(tolerance=1e-10)),
        grabbing=True,
    ).compile()
    grab = static.drag("cube", (0.07, 0.06, 0.1), stiffness=20)
    grab.target = grab.position + np.array([0.02, 0, 0.03])
    static.step()
    assert np.linalg.norm(grab.force) > 0.1
    assert np.abs(static.reactions("cube").sum(axis=0) + grab.force).max() < 1e-7


def test_a_frame_is_held_with_its_offset():
    simulation = compiled("tetra", model=ts.Frames())
    for _ in range(5):
        simulation.step()
    place = simulation.positions["cube"][40] + (0.004, -0.003, 0.002)
    grab = simulation.drag("cube", place)
    assert np.abs(grab.position - place).max() < 1e-12


def test_another_simulation_is_dragged_in_the_same_way():
    one, other = compiled(), compiled(model="corotational", law_for_model="nearest")
    first = one.drag("cube", (0.05, 0.07, 0.1), stiffness=30)
    first.target = (0.06, 0.07, 0.13)
    second = other.drag_as(first)
    assert np.array_equal(second.point.nodes, first.point.nodes)
    assert np.array_equal(second.point.weights, first.point.weights)
    assert np.array_equal(second.target, first.target) and second.stiffness == 30
    fewer = ts.Scene(
        bodies={
            "cube": ts.Body(
                mesh=ts.BarMesh(size=(1, 1, 1), cells=(1, 1, 1), cell="tetra"),
                law=ts.StVK(young=1, poisson=0),
                density=1,
            )
        },
        step=ts.ImplicitEuler(0.01),
        grabbing=True,
    ).compile()
    with pytest.raises(ts.ParameterError, match="nodes here"):
        fewer.drag_as(first)


def test_it_is_refused_where_nothing_moves_or_is_allowed():
    simulation = compiled()
    with pytest.raises(ts.ParameterError, match="held or led on all axes"):
        simulation.drag("cube", (0.05, 0.05, 0.0))
    with pytest.raises(ts.ParameterError, match="accepted: cube"):
        simulation.drag("cub", (0.05, 0.05, 0.1))
    without = simulation.scene.replace(grabbing=False).compile()
    with pytest.raises(ts.ParameterError, match="grabbing: true"):
        without.drag("cube", (0.05, 0.05, 0.1))
