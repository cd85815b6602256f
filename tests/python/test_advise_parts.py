"""What an advice stands on: points in other meshes, orders of three runs, goals, samples."""

import dataclasses

import numpy as np
import pytest

import tissu as ts
from tissu.advice.goal import goal
from tissu.advice.measure import Watch, measure, watch
from tissu.advice.richardson import estimate
from tissu.mesh.places import places
from tissu.mesh.thin import with_thin

VOLUMES = [
    *("tetra", "tetra10", "hexahedron", "hexahedron20", "hexahedron27"),
    *("wedge", "wedge15", "pyramid", "pyramid13"),
]
SHEETS = ["triangle", "triangle6", "quad", "quad8", "quad9"]
SIZE = (0.4, 0.1, 0.12)


def bar(cell, cells=(5, 2, 3), size=SIZE):
    flat = 1 if cell.startswith("line") else 2 if cell in SHEETS else 3
    lengths = [length if axis < flat else 0 for axis, length in enumerate(size)]
    counts = [count if axis < flat else 0 for axis, count in enumerate(cells)]
    made = ts.bar_mesh(size=lengths, cells=counts, cell=cell)
    return with_thin(made, sheets=flat == 2, lines=flat == 1)


def points_in(mesh, count=300):
    random = np.random.default_rng(1)
    low, high = mesh.bounds
    return low + random.random((count, 3)) * (high - low)


@pytest.mark.parametrize("cell", [*VOLUMES, *SHEETS, "line", "line3"])
def test_an_affine_field_is_exact_at_any_point(cell):
    mesh, random = bar(cell), np.random.default_rng(2)
    slope, shift = random.normal(size=(3, 3)), random.normal(size=3)
    for points in (points_in(mesh), bar(cell, cells=(7, 3, 2)).points, mesh.points[::-1]):
        found = places(points, mesh).values(mesh.points @ slope.T + shift)
        assert found == pytest.approx(points @ slope.T + shift, abs=1e-12)


@pytest.mark.parametrize("cell", [c for c in VOLUMES if c[-1].isdigit() and "pyramid" not in c])
def test_a_quadratic_field_is_exact_in_cells_of_second_order(cell):
    mesh = bar(cell)
    points = points_in(mesh)

    def field(x):
        return np.stack([x[:, 0] ** 2, x[:, 1] * x[:, 2], x[:, 0] * x[:, 1]], axis=1)

    assert places(points, mesh).values(field(mesh.points)) == pytest.approx(
        field(points), abs=1e-13
    )


@pytest.mark.parametrize("cell", ["hexahedron", "tetra", "wedge"])
def test_cells_may_be_askew(cell):
    mesh = bar(cell)
    bent = mesh.points + 0.02 * np.sin(9 * mesh.points[:, [1, 2, 0]])
    askew = dataclasses.replace(mesh, points=bent)
    inside = bent[mesh.cells[0].nodes].mean(axis=1)
    slope = np.random.default_rng(3).normal(size=(3, 3))
    found = places(inside, askew).values(bent @ slope.T)
    assert found == pytest.approx(inside @ slope.T, abs=1e-12)


def test_a_point_outside_is_told():
    with pytest.raises(ts.ParameterError, match="1 point of 1"):
        places(np.array([[0.5, 0.0, 0.0]]), bar("tetra"))


@pytest.mark.parametrize("order", [0.7, 1.0, 2.0, 3.5])
@pytest.mark.parametrize("sizes", [(1, 0.5, 0.25), (1, 1 / 2, 1 / 3), (2, 1, 1 / 2, 1 / 3)])
def test_the_order_and_error_of_a_known_sequence_are_found(order, sizes):
    random = np.random.default_rng(4)
    limit, direction = random.normal(size=(2, 3, 5, 3))
    runs = [limit + direction * size**order for size in sizes]
    found = estimate(sizes, runs)
    assert found.order == pytest.approx(order, rel=1e-9)
    error = np.linalg.norm(runs[-1] - limit, axis=-1).mean()
    assert found.error == pytest.approx(error, rel=1e-8)


def test_what_shows_no_order_gives_no_estimate():
    one = np.ones((1, 2, 3))
    assert estimate([1, 0.5], [one, 2 * one]) is None  # two runs
    assert estimate([1, 0.5, 0.25], [0 * one, one, 0.5 * one]) is None  # back and forth
    assert estimate([1, 0.5, 0.25], [0 * one, one, 2 * one]) is None  # order 0
    assert estimate([1, 0.5, 0.25], [0 * one, one, 1.01 * one]) is None  # order 6.6


@pytest.mark.parametrize(
    ("written", "value", "is_length"),
    [("1%", 0.01, False), ("2 %", 0.02, False), (0.05, 0.05, False), ("0.5 mm", 5e-4, True)],
)
def test_errors_are_shares_or_lengths(written, value, is_length):
    found = goal(written, 30, dynamic=True)
    assert (found.error, found.is_length) == (pytest.approx(value), is_length)
    assert found.share_of(0.001, 0.1) == pytest.approx(
        0.001 / (value if is_length else 0.1 * value)
    )


def test_the_cost_of_an_update_is_that_of_its_steps():
    asked = goal("1%", 25, dynamic=True)  # an update brings the scene 40 ms further
    assert asked.per_update(3.0, 0.010) == pytest.approx(12.0)
    assert asked.rate_of(3.0, 0.010) == pytest.approx(1e3 / 12.0)
    assert asked.per_update(3.0, 0.080) == pytest.approx(3.0)
    assert asked.rate_of(3.0, 0.080) == pytest.approx(12.5)  # no new state sooner than a step
    static = goal("1%", 25, dynamic=False)
    assert static.rate_of(20.0, 1.0) == pytest.approx(50.0)


def falling(**changes):
    fields = {
        "bodies": {
            "bar": ts.Body(
                mesh=ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1), cell="hexahedron"),
                law=ts.Hooke(young="20 kPa", poisson=0.3),
                density=1000,
            )
        },
        "gravity": (0, 0, -10),
        "step": ts.ImplicitMidpoint("10 ms"),
        "duration": 0.3,
    }
    return ts.Scene(**{**fields, **changes})


def test_samples_stand_at_times_of_longer_steps_too_and_at_the_end():
    watched = watch(falling().compile())
    assert watched.times == pytest.approx(np.arange(0.02, 0.301, 0.02))
    assert watch(falling(duration=0.055).compile()).times == pytest.approx(
        [0.01, 0.02, 0.03, 0.04, 0.05, 0.055]
    )
    held = [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))]
    resting = falling(step=ts.Static(), duration=None, fixed=held)
    assert watch(resting.compile()).times == pytest.approx([1.0])


def test_between_two_steps_displacements_are_linear():
    scene = falling(step=ts.ImplicitMidpoint("20 ms", solver=ts.Cholesky()), duration=0.06)
    points = {"bar": np.array(scene.compile().meshes["bar"].points)}
    watched = Watch(points, {"bar": np.arange(12)}, np.array([0.02, 0.03, 0.06]))
    found = measure(scene, watched, allowance=60.0)
    fall = -0.5 * 10 * np.array([0.02, 0.02, 0.04, 0.06]) ** 2
    at = [fall[0], 0.5 * (fall[1] + fall[2]), fall[3]]
    assert found.moved[:, :, 2] == pytest.approx(np.repeat([at], 12, axis=0).T, rel=1e-9)
    assert found.steps == 3
    assert found.dt == pytest.approx(0.02)


def test_of_large_meshes_every_so_many_nodes_are_watched():
    body = falling().bodies["bar"]
    fine = body.replace(mesh=ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(39, 14, 14)))
    watched = watch(falling(bodies={"bar": fine}).compile())
    assert len(watched.points["bar"]) == 9000
    assert np.array_equal(watched.nodes["bar"], np.arange(0, 9000, 3))


def test_a_run_that_takes_too_long_is_stopped():
    scene = falling(duration=1000)
    found = measure(scene, watch(scene.compile()), allowance=1e-3)
    assert found.steps < 1000
    assert found.foreseen > 0.01
    assert "s are left for it" in found.stopped
