"""Contact in implicit steps that damp nothing: the midpoint rule, Newmark's, energy-momentum.

Rest, momentum and friction of all implicit steps are in the tests of these.
"""

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped
from test_contact_balance import collision, momentum
from test_contact_rest import state, two

STEPS = (ts.ImplicitMidpoint, ts.Newmark, ts.EnergyMomentum)
SPEED = 0.05
"""Of a bar [m/s]: a strain of 0.5 % in its wave."""
PRESS = 1000.0 * 10.0 * SPEED * 0.05**2
"""rho c V A of it [N], c = sqrt(E / rho) = 10 m/s."""
GAP = 1e-4


def bar_on_a_wall(step, cells):
    """A bar of 1 m without lateral motion flies onto a wall; a wave goes along it in 0.1 s."""
    mesh = ts.BarMesh(
        size=(1, 0.05, 0.05), cells=(cells, 1, 1), cell="hexahedron", origin=(1.001 * GAP, 0, 0)
    )
    law = ts.StVK(young=1e5, poisson=0.0)
    bar = ts.Body(mesh=mesh, law=law, density=1000.0, start=ts.Start(velocity=(-SPEED, 0, 0)))
    return ts.Scene(
        bodies={"bar": bar},
        obstacles={"wall": ts.PlaneObstacle((0, 0, 0), (1, 0, 0))},
        contacts=[ts.Contact(("bar", "wall"), gap=GAP)],
        fixed=[ts.Fixed("bar", on=ts.Box(), axes="yz")],
        step=step,
    )


def bounced(step, cells):
    """Force of the wall over rho c V A at every step of 1 ms, the energy that is left, the bar."""
    simulation = bar_on_a_wall(step, cells).compile()
    start = simulation.energy()["total"]
    forces = []
    for _ in range(300):
        audited(simulation, 1)
        forces.append(-simulation.force_on("wall").force[0] / PRESS)
        assert simulation.energy()["total"] <= start * (1 + 1e-6)
    return np.array(forces), simulation.energy()["total"] / start, simulation


@pytest.mark.parametrize("cells", [25, 50])
@pytest.mark.parametrize("step", STEPS)
def test_a_bar_bounces_off_a_wall_in_one_plateau(step, cells):
    """Doyen, Ern and Piperno 2011: rho c V for 2 L / c, then it leaves with -V.

    Its face, half a cell, gives up its own motion: 1 / (2 n) of the energy. What is left of the
    cell's dispersion after the first cells is 2 %, at 50 cells 1.5 %; there is no ringing.
    """
    forces, energy, simulation = bounced(step("1 ms"), cells)
    plateau = forces[20:180]
    assert plateau.mean() == pytest.approx(1.0, abs=1e-2)
    assert np.abs(plateau - 1).max() < (0.03 if cells == 25 else 0.02)
    assert not forces[230:].any()
    assert energy == pytest.approx(1 - 0.5 / cells, abs=3e-4)
    assert simulation.velocities["bar"][:, 0].mean() == pytest.approx(SPEED, rel=1.5 / cells + 1e-2)


def test_implicit_euler_takes_a_fifth_of_the_energy_of_that_bar():
    """What the other steps are for: it loses 18 %, and 12 % of the speed."""
    _, energy, simulation = bounced(ts.ImplicitEuler("1 ms"), 50)
    assert energy < 0.85
    assert simulation.velocities["bar"][:, 0].mean() < 0.9 * SPEED


@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_energy_momentum_never_gains_energy_in_a_collision(friction):
    """Between contacts it keeps it to 1e-9, its tolerance; contacts take."""
    step = ts.EnergyMomentum("2 ms", solver=ts.Cholesky())
    simulation = collision(step, friction=friction).compile()
    start = simulation.energy()["total"]
    for _ in range(60):
        audited(simulation, 1)
        assert simulation.energy()["total"] <= start * (1 + 1e-9)
    assert simulation.energy()["total"] > 0.7 * start


def pressed(step):
    """A held block under a plate that is led down by 1 cm."""
    down = ts.Motion(times=(0, 0.5), displacements=((0, 0, 0), (0, 0, -0.01)))
    return ts.Scene(
        bodies={"block": block(young=2e4, viscosity=damped())},
        obstacles={"plate": ts.PlaneObstacle((0, 0, 0.102), (0, 0, -1), motion=down)},
        contacts=[ts.Contact(("block", "plate"), friction=0.3, gap="1 mm")],
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        gravity=(0, 0, -GRAVITY),
        step=step,
    )


@pytest.mark.parametrize("step", STEPS)
def test_a_led_plate_presses_with_the_force_of_every_method(step):
    """At rest all methods solve one equation; 1e-3: friction remembers the way."""
    found = []
    for method in (ts.ImplicitEuler, step):
        simulation = pressed(method("10 ms")).compile()
        audited(simulation, 300)
        found.append(simulation.force_on("plate").force)
        assert np.abs(simulation.velocities["block"]).max() < 1e-5
    assert found[0][2] > 10.0
    assert found[1] == pytest.approx(found[0], abs=1e-3 * found[0][2])


@pytest.mark.parametrize("step", STEPS)
def test_the_same_bits_from_a_checkpoint_and_on_two_threads(step, tmp_path):
    """In the middle of a collision with friction."""

    def made(**fields):
        return two().replace(step=step("5 ms"), **fields)

    simulation, other = made().compile(), made(threads=2).compile()
    for _ in range(50):
        for one in (simulation, other):
            one.step()
            assert one.crossings() == []
    assert np.abs(simulation.force_on("high").force).max() > 0.5
    assert state(other) == state(simulation)
    simulation.save_checkpoint(tmp_path / "middle")
    again = made().compile(checkpoint=tmp_path / "middle")
    for _ in range(20):
        simulation.step()
        again.step()
    assert state(again) == state(simulation)


@pytest.mark.parametrize("step", STEPS)
def test_momentum_goes_from_one_to_the_other_in_the_steps_that_touch(step):
    """Step by step: the change of one cube's momentum is h times the force that is reported.

    1 %: what of the forces of the last system may pull or exceed friction, and is not reported.
    """
    h = 2e-3
    simulation = collision(step(h, solver=ts.Cholesky()), friction=0.4).compile()

    def of(body):
        rows = simulation.rows(body)
        mass = simulation.mass_matrix().diagonal()[3 * rows.start : 3 * rows.stop : 3]
        return mass @ simulation.velocities[body]

    before, all_of_it = of("a"), momentum(simulation)
    for _ in range(40):
        audited(simulation, 1)
        after = of("a")
        force = simulation.force_on("a").force
        error = 1e-2 * h * np.linalg.norm(force) + 1e-12
        assert after - before == pytest.approx(h * force, abs=error)
        before = after
    assert np.abs(momentum(simulation) - all_of_it).max() <= 1e-12


@pytest.mark.parametrize("dt", ["1 ms", "5 ms"])
@pytest.mark.parametrize("step", STEPS)
def test_a_block_that_rebounds_is_not_pulled_back(step, dt):
    """The change of its momentum is h times the reported force, in the steps as it parts, too.

    A thousandth of the largest force: the tolerance of the equations, 1e-6 of some twenty times it,
    and 1e-5 in the linear ones. The plane pulled with 21 N in a step of the energy-momentum method
    whose report said that nothing acted, and a third of the rebound was lost.
    """
    body = block((0, 0, 0.0021), size=(0.1, 0.1, 0.06), law=ts.Hooke(young=2e4, poisson=0.4))
    simulation = ts.Scene(
        bodies={"block": body.replace(start=ts.Start(velocity=(0, 0, -1)))},
        obstacles={"plane": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("block", "plane"))],
        step=step(dt),
    ).compile()
    before, errors, forces = momentum(simulation), [], []
    h = simulation.scene.step.dt
    for _ in range(round(0.07 / h)):
        audited(simulation, 1)
        after = momentum(simulation)
        forces.append(simulation.force_on("block").force)
        errors.append(np.abs((after - before) / h - forces[-1]).max())
        before = after
    assert before[2] > 0.2 * 0.6  # it has left
    assert max(errors) < 1e-3 * np.abs(forces).max()


def test_energy_momentum_keeps_the_momentum_of_two_that_meet_in_parts():
    """Halves in which rows are held back or contacts do not settle count, not the last one alone.

    To the tolerance of the equation, 1e-6 of the momentum of each. It had lost a third.
    """
    law = ts.StVK(young=163e3, poisson=0.3)
    left = ts.Start(velocity=(0.8, 0, 2.465))
    right = ts.Start(velocity=(1.856, 0, -2.465))
    size = (0.05,) * 3
    bodies = {
        "a": ts.Body(
            mesh=ts.BarMesh(size=size, cells=(3,) * 3, cell="tetra"),
            law=law,
            density=768.0,
            start=left,
        ),
        "b": ts.Body(
            mesh=ts.BarMesh(
                size=size, cells=(2,) * 3, cell="hexahedron", origin=(-0.01916, -0.0276, 0.052)
            ),
            law=law,
            density=3140.0,
            start=right,
        ),
    }
    step = ts.EnergyMomentum("5 ms")
    contacts = [ts.Contact(("a", "b"))]
    simulation = ts.Scene(bodies=bodies, contacts=contacts, step=step).compile()
    start = momentum(simulation)
    for _ in range(6):
        assert simulation.step().converged
        assert np.abs(momentum(simulation) - start).max() < 1e-6
    assert simulation.crossings() == []


@pytest.mark.parametrize("cell", ["triangle", "quad"])
@pytest.mark.parametrize("step", STEPS)
def test_a_flat_sheet_that_has_come_to_rest_stays_there(step, cell):
    """The plane bears its weight to 1e-6, the tolerance of the equation relative to the weight.

    Contact cancels the weight to round-off, and an equation that is judged by what is left of both
    is never solved: steps of energy-momentum were refused down to 2 us.
    """
    mesh = ts.BarMesh(size=(0.05, 0.05, 0), cells=(3, 3, 0), cell=cell, origin=(0, 0, 0.0015))
    law = ts.StVK(young=1e6, poisson=0.3)
    simulation = ts.Scene(
        bodies={"sheet": ts.Body(mesh=mesh, law=law, density=1000.0, thickness="2 mm")},
        obstacles={"floor": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("sheet", "floor"))],
        gravity=(0, 0, -GRAVITY),
        step=step("2 ms"),
    ).compile()
    audited(simulation, 100)
    weight = 1000.0 * 0.05**2 * 0.002 * GRAVITY
    assert simulation.force_on("floor").force[2] == pytest.approx(-weight, rel=1e-6)
    assert np.abs(simulation.velocities["sheet"]).max() < 1e-6
