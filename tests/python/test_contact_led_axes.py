"""Nodes that are led along some axes alone go all of their way, and through nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts

EDGE, YOUNG, DOWN = 0.05, 20e3, 0.005
BOTTOM = 1e-4
TOP = ts.Plane((0, 0, EDGE + BOTTOM), (0, 0, 1))
SIDES = [
    ts.Fixed("block", on=ts.Plane((0, 0, 0), (1, 0, 0)), axes="x"),
    ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 1, 0)), axes="y"),
]
METHODS = ["augmented", "penalty", "barrier"]


def block() -> ts.Body:
    mesh = ts.BarMesh(size=(EDGE,) * 3, cells=(3, 3, 3), cell="hexahedron", origin=(0, 0, BOTTOM))
    return ts.Body(mesh=mesh, law=ts.StVK(young=YOUNG, poisson=0.3), density=1000.0)


def pressed(method: Any, axes: Any, way: float = -DOWN, **fields: Any) -> ts.Simulation:
    led = ts.Prescribed(
        "block",
        name="plate",
        on=TOP,
        axes=axes,
        times=(0, 1),
        displacements=((0, 0, 0), (0, 0, way)),
    )
    return ts.Scene(
        bodies={"block": block()},
        fixed=SIDES,
        prescribed=[led],
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("block", "table"), gap="0.1 mm")],
        contact=ts.ContactSettings(method=method),
        step=ts.Static(**fields),
    ).compile()


def require_pressed(simulation: ts.Simulation) -> None:
    """All of the top moved, and the table carries the force of uniaxial stress, E l (l^2 - 1) / 2
    of the area, to what friction-free contacts leave of a uniform state."""
    rest = simulation.meshes["block"].points
    now = simulation.positions["block"]
    top, bottom = rest[:, 2] > EDGE, rest[:, 2] < 2 * BOTTOM
    np.testing.assert_allclose(now[top, 2], rest[top, 2] - DOWN, rtol=0, atol=1e-15)
    stretch = (now[top, 2].mean() - now[bottom, 2].mean()) / EDGE
    force = YOUNG * stretch * (stretch**2 - 1.0) / 2.0 * EDGE**2
    assert simulation.force_on("table").force[2] == pytest.approx(force, rel=1e-2)
    assert simulation.crossings() == []


@pytest.mark.parametrize("steps", [1, 4])
@pytest.mark.parametrize("method", METHODS)
def test_a_plate_that_presses_along_z_alone_goes_all_of_its_way(method: str, steps: int) -> None:
    """With the barrier, 0.11 N pressed in place of 5.3 N: 15 of 16 nodes stayed where they were."""
    simulation = pressed(method, "z", load_steps=steps)
    for report in simulation.run(1.0):
        assert report.converged, report
    require_pressed(simulation)


@pytest.mark.parametrize("method", METHODS)
def test_a_live_lead_along_z_alone_goes_all_of_its_way(method: str) -> None:
    simulation = pressed(method, "z", way=0.0)
    assert simulation.step().converged
    simulation.lead("plate").move((0, 0, -DOWN))
    assert simulation.step().converged
    require_pressed(simulation)


def towards_a_wall(step: Any, method: Any, time: float) -> ts.Simulation:
    """The end of the block is led by 2 cm along x alone, and a wall is 1 cm away."""
    out = ts.Prescribed(
        "block",
        on=ts.Plane((EDGE, 0, 0), (1, 0, 0)),
        axes="x",
        times=(0, time),
        displacements=((0, 0, 0), (0.02, 0, 0)),
    )
    return ts.Scene(
        bodies={"block": block()},
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        prescribed=[out],
        obstacles={"wall": ts.PlaneObstacle((EDGE + 0.01, 0, 0), (-1, 0, 0))},
        contacts=[ts.Contact(("block", "wall"), gap="0.1 mm")],
        contact=ts.ContactSettings(method=method),
        step=step,
    ).compile()


def test_a_node_led_along_x_into_a_wall_is_refused_in_a_static_step() -> None:
    """A barrier is finite nowhere on the other side: what is led there is said, not left behind."""
    simulation = towards_a_wall(ts.Static(), "barrier", 1.0)
    before = simulation.positions["block"].copy()
    with pytest.raises(ts.Diverged, match="held or led along one or two axes"):
        simulation.step()
    np.testing.assert_array_equal(simulation.positions["block"], before)


@pytest.mark.parametrize("method", ["augmented", "barrier"])
@pytest.mark.parametrize("step", [ts.ImplicitEuler, ts.BDF2])
def test_a_node_led_along_x_into_a_wall_is_held_back_in_steps_of_time(
    step: Any, method: str
) -> None:
    """No step leaves a crossing, and those that would need one do not converge: with the barrier
    the first of them had converged with 16."""
    simulation = towards_a_wall(step("10 ms"), method, 0.2)
    while simulation.time < 0.199:
        report = simulation.step()
        assert simulation.crossings() == [], report
        assert report.converged == (simulation.time < 0.0995), report
        assert simulation.positions["block"][:, 0].max() < EDGE + 0.01
    assert report.held_back > 0
