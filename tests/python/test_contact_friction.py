"""Coulomb's friction: on a slope below and above its angle, and in sliding to rest."""

import math

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped

MU = 0.5


def on_a_slope(tangent, **fields):
    """A cube on a plane; gravity leans by the slope's angle, downhill along x."""
    phi = math.atan(tangent)
    return ts.Scene(
        bodies={"cube": block((0, 0, 1e-3), viscosity=damped(0.0, 0.005))},
        obstacles={"slope": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("cube", "slope"), friction=MU, gap="1 mm")],
        gravity=(GRAVITY * math.sin(phi), 0, -GRAVITY * math.cos(phi)),
        step=ts.ImplicitEuler("10 ms"),
        **fields,
    )


def mean_velocity(simulation):
    """Of the cube, along the slope [m/s]; its nodes move alike once the swing is over."""
    return simulation.velocities["cube"].mean(axis=0)[0]


def assert_accelerates_downhill(simulation, tangent):
    """By g (sin phi - mu cos phi) in the next second, within the 0.5 % of the design."""
    before = mean_velocity(simulation)
    audited(simulation, 100)
    phi = math.atan(tangent)
    expected = GRAVITY * (math.sin(phi) - MU * math.cos(phi))
    assert mean_velocity(simulation) - before == pytest.approx(expected, rel=5e-3)


def test_below_its_angle_nothing_creeps():
    """The goal of the design: 1e-6 mm/s."""
    simulation = on_a_slope(0.45).compile()
    audited(simulation, 200)
    start = simulation.positions["cube"].copy()
    audited(simulation, 100)
    assert np.abs(simulation.positions["cube"] - start).max() < 1e-9
    force = simulation.force_on("slope").force
    mass = 1.0
    phi = math.atan(0.45)
    expected = [mass * GRAVITY * math.sin(phi), 0, -mass * GRAVITY * math.cos(phi)]
    assert force == pytest.approx(expected, abs=1e-5 * GRAVITY)


def test_above_its_angle_it_slides_with_the_acceleration_of_coulomb():
    """g (sin phi - mu cos phi), within the 0.5 % of the design."""
    simulation = on_a_slope(0.55).compile()
    audited(simulation, 150)
    assert_accelerates_downhill(simulation, 0.55)
    # What the slope feels is on Coulomb's cone, node by node, to some 1e-5 of the linear solver.
    forces = simulation.contacts().forces
    normal = forces[:, 2]
    assert np.hypot(forces[:, 0], forces[:, 1]) == pytest.approx(MU * normal, rel=5e-5)


@pytest.mark.parametrize(("cell", "cells"), [("hexahedron", (4, 4, 2)), ("tetra", (5, 3, 2))])
def test_other_meshes_slide_alike(cell, cells):
    """With three systems a step these jerked, and their steps said converged."""
    mesh = ts.BarMesh(size=(0.1, 0.1, 0.05), cells=cells, cell=cell, origin=(0, 0, 1e-3))
    law = ts.StableNeoHooke(young="100 kPa", poisson=0.3)
    body = ts.Body(mesh=mesh, law=law, density=1000.0, viscosity=damped(0.0, 0.01))
    simulation = on_a_slope(0.55).replace(bodies={"cube": body}).compile()
    audited(simulation, 100)
    assert_accelerates_downhill(simulation, 0.55)


def test_too_few_systems_are_not_called_converged():
    """Pulling forces and such beyond Coulomb's disk are not contact."""
    mesh = ts.BarMesh(
        size=(0.1, 0.1, 0.05), cells=(4, 4, 2), cell="hexahedron", origin=(0, 0, 1e-3)
    )
    law = ts.StableNeoHooke(young="100 kPa", poisson=0.3)
    body = ts.Body(mesh=mesh, law=law, density=1000.0, viscosity=damped(0.0, 0.01))
    scene = on_a_slope(0.55, contact=ts.ContactSettings(iterations=1))
    simulation = scene.replace(bodies={"cube": body}).compile()
    reports = [simulation.step() for _ in range(20)]
    unsettled = [report for report in reports if not report.converged]
    assert unsettled
    assert all("contacts had not settled after 1 system" in report.message for report in unsettled)


def test_a_block_slides_to_rest():
    """v0^2 / (2 mu g), less the h v0 / 2 of implicit Euler, which brakes at the end of each step.

    0.5 %: the block shears before all of it slides.
    """
    speed, h = 1.0, 5e-4
    start = ts.Start(velocity=(speed, 0, 0))
    scene = on_a_slope(0.0).replace(
        bodies={"cube": block((0, 0, 1e-3), young=1e6, viscosity=damped(0.0, 0.002), start=start)},
        step=ts.ImplicitEuler(h),
    )
    simulation = scene.compile()
    steps = round(1.3 * speed / (MU * GRAVITY) / h)
    audited(simulation, steps)
    way = simulation.displacements("cube")[:, 0].mean()
    assert way == pytest.approx(speed**2 / (2 * MU * GRAVITY) - h * speed / 2, rel=5e-3)
    assert abs(mean_velocity(simulation)) < 1e-3
