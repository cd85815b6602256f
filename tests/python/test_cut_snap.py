"""Cuts that move nodes onto the blade: what they keep, and what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import shaken
from divided import (
    DENSITY,
    EXACT,
    SIZE,
    SLANTED,
    bar,
    fault_of_mesh,
    jittered,
    pieces_by_faces,
    qualities,
    scene,
    tetrahedra,
)
from snapped import BESIDE, free, snapping

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
MASS = DENSITY * SIZE[0] * SIZE[1] * SIZE[2]


def bent(simulation: ts.Simulation) -> ts.Simulation:
    """A smooth state: the bar is drawn and a little bent, and its ends are faster than its middle.

    The share by which moves change the energy does not depend on the amplitude of a bend alone, and
    is above 1 % on a mesh as coarse as this.
    """
    x, v = simulation.positions["bar"], simulation.velocities["bar"]
    rest = np.array(x)
    x[:, 0] *= 1.2
    x[:, 1] += 0.1 * rest[:, 0] ** 2
    x[:, 0] -= 0.2 * rest[:, 0] * (rest[:, 1] - 0.05)
    v[:] = np.cross((0.3, -1.0, 2.0), x) + 4.0 * rest[:, :1] ** 2 * (0.0, 1.0, -1.0)
    return simulation


def test_a_linear_field_and_its_energy_stay() -> None:
    """x = A X and v = B X are read without an error anywhere, so that nothing changes but X."""
    A = np.array([[1.1, 0.05, 0.0], [-0.02, 0.95, 0.04], [0.03, 0.0, 1.02]])
    B = np.array([[0.3, 1.0, 0.0], [-2.0, 0.5, 0.4], [0.3, 0.0, -0.2]])
    simulation = free(bar(mesh=jittered((8, 3, 3), 1)))
    rest = np.array(simulation.positions["bar"])
    simulation.positions["bar"][:] = rest @ A.T
    simulation.velocities["bar"][:] = rest @ B.T
    elastic = simulation.energy()["elastic"]
    report = simulation.cut("bar", ts.Plane(point=(0.21, 0.05, 0.05), normal=(1.0, 0.1, -0.05)))
    assert report.nodes_moved > 8
    assert len(report.pieces) == 2
    X = simulation.meshes["bar"].points
    np.testing.assert_allclose(simulation.positions["bar"], X @ A.T, rtol=0, atol=1e-14)
    assert simulation.energy()["elastic"] == pytest.approx(elastic, rel=1e-10)
    assert abs(report.elastic_energy_change) <= 1e-10 * elastic
    assert np.abs(report.momentum_change).max() <= ROUND_OFF * MASS
    assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * MASS * SIZE[0]


@pytest.mark.parametrize("seed", range(6))
def test_random_cuts_keep_what_they_must(seed: int) -> None:
    """Three planes through a bent, moving, jittered bar."""
    random = np.random.default_rng(seed)
    simulation = bent(free(bar(mesh=jittered((8, 3, 3), seed))))
    moved = 0
    for _ in range(3):
        before, elastic = simulation._core.totals("bar"), simulation.energy()["elastic"]
        point = random.uniform(0.3, 0.8, 3) * SIZE
        report = simulation.cut("bar", ts.Plane(point, random.standard_normal(3)))
        moved += report.nodes_moved
        after = simulation._core.totals("bar")
        assert fault_of_mesh(simulation) == ""
        assert len(report.pieces) == pieces_by_faces(simulation)
        assert after["volume"] == pytest.approx(before["volume"], rel=1e-13)
        assert after["mass"] == pytest.approx(before["mass"], rel=1e-13)
        speed = np.abs(simulation.velocities["bar"]).max()
        assert np.abs(report.momentum_change).max() <= ROUND_OFF * MASS * speed
        if report.nodes_moved:
            turned = np.abs(report.angular_momentum_change).max()
            assert turned <= ROUND_OFF * MASS * speed * SIZE[0]
        # Each of the four corners of a cell may change its energy by 1 %.
        assert abs(report.elastic_energy_change) <= 0.04 * elastic
        assert report.elastic_energy_change == pytest.approx(
            simulation.energy()["elastic"] - elastic, abs=1e-9 * elastic
        )
        X, cells = simulation.meshes["bar"].points, tetrahedra(simulation)
        assert qualities(X, cells).min() <= report.least_quality + 1e-12
    assert moved > 0


def test_moves_that_change_the_energy_are_refused() -> None:
    """Where each node moves on its own, the field between nodes is not what others interpolate."""
    simulation = free(bar((8, 3, 3)))
    calm = simulation.mark()
    assert simulation.cut("bar", BESIDE).nodes_moved > 8
    simulation.rewind(calm)
    before = shaken(simulation).energy()["elastic"]
    report = simulation.cut("bar", BESIDE)
    assert len(report.pieces) == 2
    assert report.nodes_moved < 4
    assert report.cells_new > 50
    assert abs(report.elastic_energy_change) <= 0.04 * before


def test_the_snapped_bar_is_a_bar_built_of_its_mesh() -> None:
    """The mesh of the cut bar, taken for a mesh of its own, moves alike."""
    first = snapping(bar((6, 2, 2)), step=EXACT).compile()
    report = first.cut("bar", SLANTED)
    assert report.nodes_moved
    assert report.relaid
    mesh = first.meshes["bar"]
    built = scene(bar(mesh=ts.Mesh(points=mesh.points, cells=mesh.cells)), step=EXACT).compile()
    np.testing.assert_array_equal(first.positions["bar"], mesh.points)
    for _ in range(20):
        first.step()
        built.step()
    moved = first.displacements("bar")
    assert np.abs(moved).max() > 1e-3 * SIZE[0]
    np.testing.assert_allclose(moved, built.displacements("bar"), rtol=0, atol=1e-10 * SIZE[0])


def test_it_makes_fewer_cells_than_division() -> None:
    plane = ts.Plane(point=(0.213, 0.05, 0.05), normal=(1, 0, 0))
    divided = scene(bar((8, 3, 3)), fixed=[], gravity=None).compile().cut("bar", plane)
    simulation = free(bar((8, 3, 3)))
    report = simulation.cut("bar", plane)
    assert divided.cells_new > 100
    assert report.cells_new == 0
    assert report.nodes_moved == 16
    assert len(report.pieces) == 2
    # 0.213 m from one end, in cells of 0.05 m: the nodes of the nearest layer move by 13 mm.
    assert sorted(piece.volume for piece in report.pieces) == pytest.approx(
        [1.87e-3, 2.13e-3], rel=ROUND_OFF
    )
    assert "16 nodes moved" in str(report)


def test_a_shallow_cut_opens_with_depth() -> None:
    """A blade half a cell deep: with depth the nodes below the edges on its way go to its plane."""
    reports = []
    corners = [(0.213, -1, 0.085), (0.213, 1, 0.085), (0.213, 1, 1), (0.213, -1, 1)]
    for depth in (False, True):
        editing = ts.Editing(method="snap", room="900 %", depth=depth)
        simulation = free(bar((8, 3, 3)), editing=editing)
        blade = ts.Triangles(corners, [(0, 1, 2), (0, 2, 3)])
        reports.append(simulation.cut("bar", blade))
        assert fault_of_mesh(simulation) == ""
    assert reports[1].nodes_moved > reports[0].nodes_moved
    assert reports[1].area > reports[0].area


def test_what_cannot_be_snapped_is_refused() -> None:
    cube = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="hexahedron")
    relaxing = ts.Prony(branches=[ts.PronyBranch(weight=0.5, time=0.05)])
    cases: list[tuple[dict[str, Any], str]] = [
        ({"bodies": {"bar": bar(mesh=cube)}}, "found snap for body 'bar', which has cells of type"),
        ({"bodies": {"bar": bar(viscosity=relaxing)}}, "a viscosity with a memory"),
        ({"editing": ts.Editing(depth=True)}, "depth: true and no body with method: snap"),
    ]
    for changes, words in cases:
        with pytest.raises(ts.SceneError, match=words):
            snapping(**changes).compile()


@pytest.mark.parametrize("sides", [8, 12, 24])
def test_blades_with_corners_part_the_body(sides: int) -> None:
    """A prism seven cells wide: nodes that were moved into a corner lie on both of its sides."""
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.1, 0.06, 0.02), cells=(20, 12, 4), cell="tetra"),
        law=ts.StVK(young="8 kPa", poisson=0.4),
        density=1000,
    )
    for seed in range(3):
        random = np.random.default_rng(seed)
        centre = np.array([random.uniform(0.04, 0.06), random.uniform(0.025, 0.035), 0.0])
        turn = random.uniform(0.0, 7.0) + 2.0 * np.pi * np.arange(sides) / sides
        ring = centre + 0.018 * np.column_stack([np.cos(turn), np.sin(turn), 0.0 * turn])
        next_to = (np.arange(sides) + 1) % sides
        i = np.arange(sides)
        lower = np.column_stack([i, next_to, next_to + sides])
        upper = np.column_stack([i, next_to + sides, i + sides])
        high = np.array([0.0, 0.0, 0.1])
        blade = ts.Triangles(np.vstack([ring - high, ring + high]), np.vstack([lower, upper]))
        simulation = ts.Scene(
            bodies={"bar": body},
            step=ts.ImplicitEuler("2 ms"),
            editing=ts.Editing(method="snap", room="900 %"),
        ).compile()
        report = simulation.cut("bar", blade)
        assert report.nodes_moved > 0
        assert len(report.pieces) >= 2
