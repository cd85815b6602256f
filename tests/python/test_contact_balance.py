"""What contacts give to one body they take from another: momenta, stacks, patches."""

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, between, block, damped


def masses(simulation, body):
    """Lumped mass of every node (n,) [kg]."""
    rows = simulation.rows(body)
    return simulation.mass_matrix().diagonal()[3 * rows.start : 3 * rows.stop : 3]


def momentum(simulation):
    """Of all bodies (3,) [kg m/s]."""
    return sum(masses(simulation, b) @ simulation.velocities[b] for b in simulation.bodies)


def collision(step, **fields):
    """Two cubes in free flight meet off centre; one of them spins."""
    right = ts.Start(velocity=(1, 0, 0), spin=(0, 0, 5))
    left = ts.Start(velocity=(-1, 0, 0))
    return ts.Scene(
        bodies={
            "a": block(young=1e4, start=right),
            "b": block((0.11, 0.03, 0.02), young=1e4, cells=(3, 3, 3), start=left),
        },
        contacts=[ts.Contact(("a", "b"), **fields)],
        step=step,
    )


@pytest.mark.parametrize("friction", [0.0, 0.4])
@pytest.mark.parametrize(
    "step", [ts.ImplicitEuler, ts.BDF2, ts.ImplicitMidpoint, ts.Newmark, ts.EnergyMomentum]
)
def test_a_free_collision_keeps_the_linear_momentum(step, friction):
    """To round-off with exact solves: 1e-12 of the momentum of one cube."""
    simulation = collision(step("2 ms", solver=ts.Cholesky()), friction=friction).compile()
    start = momentum(simulation)
    felt = 0.0
    for _ in range(60):
        audited(simulation, 1)
        force, moment = simulation.force_on("a")
        other = simulation.force_on("b")
        size = np.abs(force).max()
        assert np.abs(force + other.force).max() <= 1e-12 * size
        felt = max(felt, size)
        # The two ends of a force are a gap of 1 mm apart, along it but for what slides in a step.
        assert np.abs(moment + other.moment).max() <= 1e-3 * size
    assert felt > 10.0
    assert np.abs(momentum(simulation) - start).max() <= 1e-12 * 1.0
    assert simulation.velocities["a"].mean(axis=0)[0] < 0.5


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("dt", ["0.5 ms", "1 ms", "2 ms", "5 ms"])
def test_contacts_that_open_pull_nothing_back(dt, friction):
    """Each change of momentum of one of two cubes is that of the reported force, also as they part.

    1 % of the force: what of the last system's forces may be inadmissible. The floor is that of the
    linear solver, 1e-5 of the momentum of a cube, and 1e-3 of it with friction, where forces settle
    to 1 % one by one. A contact that opened used to pull, by up to 0.03 of this momentum in one
    step, and the report of this step said that nothing acted.
    """
    step = ts.ImplicitEuler(dt)
    for seed in range(6):
        turns = np.random.default_rng(seed).normal(size=(2, 3)) * 10
        right = ts.Start(velocity=(1, 0, 0), spin=tuple(turns[0]))
        left = ts.Start(velocity=(-1, 0, 0), spin=tuple(turns[1]))
        bodies = {
            "a": block(young=1e5, start=right),
            "b": block((0.11, 0.03, 0.02), young=1e5, cells=(3, 3, 3), start=left),
        }
        contacts = [ts.Contact(("a", "b"), friction=friction)]
        simulation = ts.Scene(bodies=bodies, contacts=contacts, step=step).compile()
        mass = masses(simulation, "a")
        before, most = mass @ simulation.velocities["a"], 0.0
        floor = (1e-3 if friction else 1e-5) * mass.sum()
        for _ in range(round(0.1 / step.dt)):
            simulation.step()
            after = mass @ simulation.velocities["a"]
            impulse = step.dt * simulation.force_on("a").force
            most = max(most, np.linalg.norm(impulse))
            error = np.linalg.norm(after - before - impulse)
            assert error < 1e-2 * np.linalg.norm(impulse) + floor
            before = after
        assert most > 0.01 * mass.sum()


@pytest.mark.parametrize("dt", ["4 ms", "1 ms", "0.5 ms"])
def test_bdf2_gains_no_energy_after_a_blow_in_parts(dt):
    """A soft block falls on a plane without gravity or friction: its energy can only fall.

    Linearised once, the step of the blow is taken in parts. The step after them is several times as
    long, and BDF2 would carry the blow on by r^2 / (1 + 2 r) > 1: E reached up to 3.9 times E0.
    """
    mesh = ts.BarMesh(size=(0.06, 0.06, 0.06), cells=(2, 2, 2), origin=(0, 0, 0.005))
    body = ts.Body(mesh=mesh, law=ts.StableNeoHooke(young=5e3, poisson=0.4), density=1000.0)
    simulation = ts.Scene(
        bodies={"block": body.replace(start=ts.Start(velocity=(0, 0, -0.3)))},
        obstacles={"floor": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("block", "floor"))],
        step=ts.BDF2(dt),
    ).compile()
    start = simulation.energy()["total"]
    parts = 1
    for _ in range(round(0.08 / simulation.dt)):
        report = simulation.step()
        parts = max(parts, report.substeps)
        assert report.converged
        assert simulation.energy()["total"] <= start * (1 + 1e-6)
    assert parts > 1
    assert simulation.velocities["block"].mean(axis=0)[2] > 0.0
    assert simulation.crossings() == []


EDGE = 0.05


def stack(shift, cells):
    """Five cubes of 1 MPa; every other one is shifted and has other cells.

    Of 100 kPa the tower would be as high as a column that buckles under its weight,
    (7.84 E I / (rho g A))^(1/3) = 25.5 cm.
    """
    bodies = {}
    for k in range(5):
        odd = k % 2
        bodies[f"c{k}"] = block(
            (shift * odd, shift * odd, k * (EDGE + 5e-4) + 5e-4),
            size=(EDGE,) * 3,
            cells=cells if odd else (2, 2, 2),
            young=1e6,
            viscosity=damped(5.0, 0.005),
        )
    pairs = [("c0", "table"), *((f"c{k}", f"c{k + 1}") for k in range(4))]
    return ts.Scene(
        bodies=bodies,
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(pair, friction=0.5, gap="0.5 mm") for pair in pairs],
        gravity=(0, 0, -GRAVITY),
        step=ts.ImplicitEuler("10 ms"),
    )


@pytest.mark.parametrize(("shift", "cells"), [(0.0, (2, 2, 2)), (0.007, (3, 3, 3))])
def test_each_joint_of_a_stack_carries_what_lies_above(shift, cells):
    """Within 0.1 %, and it stands: less than 1 % of an edge to a side."""
    simulation = stack(shift, cells).compile()
    audited(simulation, 100)
    weight = 1000.0 * EDGE**3 * GRAVITY
    assert simulation.force_on("table").force[2] == pytest.approx(-5 * weight, rel=1e-3)
    for k in range(4):
        joint = between(simulation, f"c{k}", f"c{k + 1}")
        assert joint[2] == pytest.approx(-(4 - k) * weight, rel=1e-3)
        assert np.abs(joint[:2]).max() <= 1e-2 * weight
    for body in simulation.bodies:
        assert np.abs(simulation.displacements(body)[:, :2].mean(axis=0)).max() < 0.01 * EDGE
