"""Steps in which contact has a potential that grows without bound as surfaces close."""

import math

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped, weight
from contact_explicit import PER_AREA, THICKNESS, flat, over_a_table
from test_contact_balance import collision, masses, momentum
from test_contact_explicit import GAP
from test_contact_friction import MU, mean_velocity, on_a_slope
from test_contact_rest import state, two

BARRIER = ts.ContactSettings(method="barrier")
LEAST = 0.1
"""Of the gap: what the barrier leaves at least between surfaces."""


def slope_of(sigma):
    """b' of b = -(sigma - 1)^2 ln sigma, as the design states it."""
    return -2 * (sigma - 1) * math.log(sigma) - (sigma - 1) ** 2 / sigma


def force_over_stiffness(height):
    """Of a vertex of a sheet over a plane, up to a factor that is the same at every height."""
    radius = 0.5 * THICKNESS
    least, far = radius + LEAST * GAP, radius + 2 * GAP
    sigma = (height**2 - least**2) / (far**2 - least**2)
    assert 0.0 < sigma < 1.0
    return -slope_of(sigma) * height


def test_a_sheet_lies_where_the_law_bears_it():
    """Each node of a membrane bears its own weight: the law's force goes with its mass.

    Newton's iteration leaves 1e-6 of the load, and what still moves after 1.5 s is damped as far.
    """
    found = []
    for gravity in (GRAVITY, 2 * GRAVITY):
        body = flat(0.0025, viscosity=damped(40.0, 0.0))
        scene = over_a_table(body, step=ts.ImplicitEuler("5 ms"), gap=GAP, contact=BARRIER)
        simulation = scene.replace(gravity=(0, 0, -gravity)).compile()
        audited(simulation, 300)
        load = PER_AREA * 0.01 * gravity
        assert simulation.force_on("table").force[2] == pytest.approx(-load, rel=1e-5)
        weights = gravity * masses(simulation, "body")
        assert np.ptp(weights) > weights.min()
        forces = [force_over_stiffness(z) for z in simulation.positions["body"][:, 2]]
        found.append(np.array(forces) / weights)
    assert np.ptp(found) / np.mean(found) < 1e-3


@pytest.mark.parametrize("step", [ts.ImplicitEuler, ts.BDF2])
def test_what_a_report_calls_converged_balances(step):
    """The change of momentum of a falling cube is its weight and the force of the table.

    Newton's iteration ends at 1e-6 of what acts on the rows; their sum adds the errors of a face.
    """
    scene = on_a_slope(0.0).replace(step=step("10 ms"), contact=BARRIER)
    simulation = scene.compile()
    mass = masses(simulation, "cube")
    pressed = 0
    before = [simulation.velocities["cube"].copy()] * 2
    for k in range(40):
        audited(simulation, 1)
        now = simulation.velocities["cube"].copy()
        change = (now - before[-1]) if step is ts.ImplicitEuler or k == 0 else (
            1.5 * now - 2.0 * before[-1] + 0.5 * before[-2]
        )  # fmt: skip
        force = mass @ change / 0.01 - np.array([0, 0, -weight()])
        # Rayleigh's stiffness damping adds no force on the body as a whole.
        assert force == pytest.approx(simulation.force_on("cube").force, abs=1e-4 * weight())
        pressed += simulation.force_on("cube").force[2] > 0.1 * weight()
        before = [before[-1], now]
    assert pressed > 10


@pytest.mark.parametrize(
    ("table", "friction"),
    [
        (
            ts.MeshObstacle(
                ts.bar_mesh(size=(0.3, 0.3, 0.1), cells=(2, 2, 1), origin=(-0.1, -0.1, -0.1))
            ),
            0.0,
        ),
        (ts.BoxObstacle((-0.1, -0.1, -0.1), (0.2, 0.2, 0)), 0.4),
    ],
    ids=["mesh", "box"],
)
def test_what_lies_over_the_edges_of_a_flat_face_rests(table, friction):
    """Nodes exactly over the edges between the triangles of a face are met by one triangle each.

    Round-off put them before one triangle, before both, or before none: the potential jumped,
    steps were repeated in parts, and in single steps the table bore 0.6 to 1.4 times the weight.
    """
    mesh = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(3, 3, 3), cell="hexahedron", origin=(0, 0, 6e-4))
    law = ts.NeoHooke(young=1e4 if friction == 0.0 else 2e4, poisson=0.3)
    body = ts.Body(mesh=mesh, law=law, density=1000.0, viscosity=damped(20.0, 1e-3))
    scene = ts.Scene(
        bodies={"cube": body},
        obstacles={"table": table},
        contacts=[ts.Contact(("cube", "table"), friction=friction, gap="0.5 mm")],
        gravity=(0, 0, -GRAVITY),
        step=ts.BDF2("10 ms"),
        contact=BARRIER,
    )
    simulation = scene.compile()
    audited(simulation, 200)
    for _ in range(60):
        audited(simulation, 1)
        # Newton's iteration ends at 1e-6 of what acts on the rows; what still swings adds as much.
        assert simulation.force_on("cube").force[2] == pytest.approx(weight(), rel=1e-4)


def test_vertices_inside_a_flat_face_push_nothing_sideways():
    """A soft block on a level floor of 800 triangles, without friction, stays where it is.

    The block sags between its nodes. Vertices of the floor pushed along the normals of its bent
    faces, and drove it with 0.1 m/s2. What remains is the round-off of the linear solves.
    """
    mesh = ts.BarMesh(
        size=(0.06, 0.06, 0.04), cells=(3, 3, 2), cell="hexahedron", origin=(-0.02, -0.0413, 6e-4)
    )
    law = ts.StableNeoHooke(young=2e5, poisson=0.3)
    body = ts.Body(mesh=mesh, law=law, density=1000.0, viscosity=damped(0.0, 0.01))
    floor = ts.bar_mesh(size=(0.4, 0.4, 0.05), cells=(20, 20, 1), origin=(-0.2, -0.2, -0.05))
    simulation = ts.Scene(
        bodies={"block": body},
        obstacles={"floor": ts.MeshObstacle(floor)},
        contacts=[ts.Contact(("block", "floor"), gap="0.5 mm")],
        gravity=(0, 0, -GRAVITY),
        step=ts.ImplicitEuler("5 ms"),
        contact=BARRIER,
    ).compile()
    audited(simulation, 60)
    assert np.abs(simulation.velocities["block"][:, :2].mean(axis=0)).max() < 1e-9
    found = simulation.contacts()
    assert np.abs(found.forces[:, :2]).max() < 1e-9 * np.abs(found.forces).max()


def test_below_its_angle_it_creeps_no_faster_than_friction_needs():
    """Friction reaches its bound at 1e-3 extents a second; 0.9 of the bound acts at 0.69 of it."""
    simulation = on_a_slope(0.9 * MU, contact=BARRIER).compile()
    audited(simulation, 100)
    extent = 0.1 * math.sqrt(3)
    expected = (1 - math.sqrt(1 - 0.9)) * 1e-3 * extent
    assert mean_velocity(simulation) == pytest.approx(expected, rel=0.05)


def test_above_its_angle_it_slides_by_coulomb_s_law():
    simulation = on_a_slope(1.1 * MU, contact=BARRIER).compile()
    audited(simulation, 50)
    before = mean_velocity(simulation)
    audited(simulation, 50)
    phi = math.atan(1.1 * MU)
    ideal = GRAVITY * (math.sin(phi) - MU * math.cos(phi))
    assert mean_velocity(simulation) - before == pytest.approx(0.5 * ideal, rel=5e-3)


@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_a_free_collision_keeps_the_linear_momentum(friction):
    """To the tolerance of Newton's iteration, 1e-6 of the momentum that changes, in 40 steps."""
    scene = collision(ts.ImplicitEuler("2 ms", solver=ts.Cholesky()), friction=friction)
    simulation = scene.replace(contact=BARRIER).compile()
    start = momentum(simulation)
    felt = 0.0
    for _ in range(40):
        audited(simulation, 1)
        force = simulation.force_on("a").force
        size = np.abs(force).max()
        assert np.abs(force + simulation.force_on("b").force).max() <= 1e-12 * max(size, 1e-12)
        felt = max(felt, size)
    assert felt > 10.0
    assert np.abs(momentum(simulation) - start).max() <= 4e-5


@pytest.mark.parametrize(("gap", "converges"), [(2e-6, True), (1e-9, False)])
def test_a_gap_above_what_is_noted_converges(gap, converges):
    """`check` notes a gap below 1e-5 of the edge: steps that do not converge there say so."""
    scene = on_a_slope(0.0, contact=BARRIER)
    scene = scene.replace(contacts=[one.replace(gap=gap) for one in scene.contacts])
    noted = any("round-off counts there" in note for note in scene.check().notes)
    assert noted != converges
    simulation = scene.compile()
    reports = []
    for _ in range(12):
        reports.append(simulation.step())
        assert simulation.crossings() == []
    assert all(report.converged for report in reports) == converges


def test_thickness_is_not_entered_at_any_speed():
    """A cube meets a fixed ball at 20 m/s in steps of 10 ms: four times its edge in a step."""
    cube = block(young=1e5, start=ts.Start(velocity=(0, 0, -20)), law=ts.StableNeoHooke(
        young=1e5, poisson=0.3))  # fmt: skip
    scene = ts.Scene(
        bodies={"cube": cube},
        obstacles={"ball": ts.SphereObstacle((0.05, 0.05, -0.1), 0.05)},
        contacts=[ts.Contact(("cube", "ball"))],
        contact=BARRIER,
        step=ts.ImplicitEuler("10 ms"),
    )
    simulation = scene.compile()
    for _ in range(6):
        simulation.step()
        assert simulation.crossings() == []
        assert simulation.overlaps() == []


def test_threads_and_a_run_that_is_resumed_change_no_bit(tmp_path):
    """Two cubes fall on each other, a table and a ball; resumed in the middle of it."""
    found = []
    for threads in (1, 2):
        scene = two(threads=threads, contact=BARRIER)
        simulation = scene.compile()
        for _ in range(16):
            simulation.step()
            assert simulation.crossings() == []
        simulation.save_checkpoint(tmp_path / "middle.ckpt")
        for _ in range(6):
            simulation.step()
        found.append(state(simulation))
    again = scene.compile(checkpoint=tmp_path / "middle.ckpt")
    for _ in range(6):
        again.step()
    assert found[0] == found[1] == state(again)


def test_steps_that_have_no_barrier_are_refused():
    scene = on_a_slope(0.0, contact=BARRIER)
    for step in (ts.ImplicitMidpoint("10 ms"), ts.SymplecticEuler()):
        with pytest.raises(
            ts.errors.SceneError, match="of the method barrier; accepted with contact"
        ):
            scene.replace(step=step).compile()
    with pytest.raises(ts.errors.SceneError, match="found false with the method barrier"):
        on_a_slope(0.0, contact=BARRIER.replace(travel=False)).compile()


@pytest.mark.parametrize("thing", ["ball", "box"])
def test_friction_of_a_rigid_body_alone_has_a_size(thing):
    """Nothing in the scene has nodes, so that the speed at which friction sticks is the body's.

    At rest the table bears the weight; Newton's iteration leaves 1e-6 of it, in steps of 2 ms.
    """
    free = {
        "ball": ts.SphereObstacle((0, 0, 0.0103), radius=0.01, mass=0.03),
        "box": ts.BoxObstacle((0, 0, 0.0003), (0.02, 0.02, 0.02), mass=0.03),
    }[thing]
    scene = ts.Scene(
        bodies={},
        gravity=(0, 0, -GRAVITY),
        obstacles={"thing": free, "table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("thing", "table"), friction=0.3, gap="0.2 mm")],
        contact=BARRIER,
        step=ts.ImplicitEuler("2 ms"),
    )
    simulation = scene.compile()
    for _ in range(60):
        assert simulation.step().converged
    assert simulation.force_on("thing").force[2] == pytest.approx(0.03 * GRAVITY, rel=1e-5)
