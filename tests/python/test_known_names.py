"""A misspelt attribute of a handle is refused: it would be set and do nothing."""

from __future__ import annotations

from typing import Any

import pytest

import tissu as ts


@pytest.fixture(scope="module")
def simulation() -> ts.Simulation:
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1)),
        law=ts.StVK(young=5e4, poisson=0.3),
        density=1000.0,
    )
    end = ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0))
    return ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane(point=(0, 0, 0), normal=(1, 0, 0)), name="root")],
        loads=[ts.NodalLoad("bar", on=end, force=(0.0, 0.0, 1.0), name="pull")],
        obstacles={"table": ts.PlaneObstacle(point=(0, 0, -0.01), normal=(0, 0, 1))},
        contacts=[ts.Contact(("bar", "table"))],
        gravity=(0.0, 0.0, -9.81),
        step=ts.ImplicitEuler(dt=0.005),
        grabbing=True,
    ).compile()


def handle(simulation: ts.Simulation, kind: str) -> Any:
    return {
        "simulation": lambda: simulation,
        "load": lambda: simulation.load("pull"),
        "grab": lambda: simulation.grab("bar", 5, (0.2, 0.0, 0.0), 10.0),
        "lead": lambda: simulation.lead("root"),
        "obstacle": lambda: simulation.obstacle("table"),
        "parameters": lambda: simulation.parameters,
    }[kind]()


@pytest.mark.parametrize(
    ("kind", "name", "hint"),
    [
        ("simulation", "postions", "accepted"),
        ("load", "forces", "did you mean 'force'"),
        ("grab", "targt", "did you mean 'target'"),
        ("lead", "targets", "did you mean 'target'"),
        ("obstacle", "position_to", "methods only"),
        ("parameters", "gravity", "accepted"),
    ],
)
def test_an_attribute_that_is_not_there_is_refused(
    simulation: ts.Simulation, kind: str, name: str, hint: str
) -> None:
    found = handle(simulation, kind)
    with pytest.raises(ts.ParameterError, match=f"'{name}'.*{hint}"):
        setattr(found, name, (0.0, 0.0, 1.0))
    with pytest.raises(AttributeError):
        setattr(found, name, (0.0, 0.0, 1.0))


@pytest.mark.parametrize(
    ("kind", "name", "may"),
    [("simulation", "time", "none, it has methods only"), ("grab", "body", "target")],
)
def test_a_read_only_attribute_is_told_as_one(
    simulation: ts.Simulation, kind: str, name: str, may: str
) -> None:
    found = handle(simulation, kind)
    with pytest.raises(ts.ParameterError, match=f"'{name}' of a .*, which is read-only; .*{may}"):
        setattr(found, name, 0.0)
    with pytest.raises(AttributeError):
        setattr(found, name, 0.0)


def test_attributes_that_are_there_are_set(simulation: ts.Simulation) -> None:
    load = simulation.load("pull")
    load.force = (0.0, 0.0, 2.0)
    assert tuple(load.force) == (0.0, 0.0, 2.0)
    grab = simulation.grab("bar", 5, (0.2, 0.0, 0.0), 10.0)
    grab.stiffness = 20.0
    assert grab.stiffness == 20.0


def test_an_obstacle_that_is_not_there_is_named_as_one() -> None:
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1)),
        law=ts.StVK(young=5e4, poisson=0.3),
        density=1000.0,
    )
    alone = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(dt=0.005)).compile()
    with pytest.raises(ts.ParameterError, match="the scene has no contacts with obstacles"):
        alone.obstacle("table")
