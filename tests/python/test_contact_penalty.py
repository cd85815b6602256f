"""Springs of the method penalty in implicit and static steps, against closed forms."""

import math

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped
from contact_explicit import PER_AREA, flat, over_a_table
from contact_static import TOLERANCE, out_of_balance
from test_contact_balance import collision, momentum
from test_contact_explicit import GAP, LAWS, heights, method
from test_contact_friction import MU, on_a_slope
from test_contact_rest import state, two

STEPS = (ts.ImplicitEuler, ts.BDF2)
STIFFNESS, LOAD = 4e4, PER_AREA * GRAVITY


def lying(step, law="linear", **fields):
    """A sheet over a table whose springs bear it."""
    body = flat(0.0025, viscosity=damped(40.0, 0.0))
    return over_a_table(body, step=step, gap=GAP, contact=method("penalty", penalty=law), **fields)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("step", STEPS)
def test_a_sheet_lies_as_deep_as_the_stiffness_says(step, law):
    """Every node bears its area: to 1e-6 of the gap, since systems are solved to 1e-5 of a load."""
    simulation = lying(step("5 ms"), law, stiffness=STIFFNESS).compile()
    audited(simulation, 300)
    expected = 2 * GAP - LAWS[law](STIFFNESS, LOAD)
    assert heights(simulation) == pytest.approx(expected, abs=1e-5 * GAP)
    assert simulation.force_on("table").force[2] == pytest.approx(-LOAD * 0.01, rel=1e-5)


def test_springs_of_bodies_are_the_same_for_every_step():
    """Without `stiffness` k comes from the bodies at rest: dt and method change no depth."""
    found = []
    for step in (ts.ImplicitEuler("10 ms"), ts.ImplicitEuler("2 ms"), ts.BDF2("5 ms")):
        simulation = lying(step).compile()
        audited(simulation, 1000 if step.dt < 5e-3 else 300)
        found.append(heights(simulation))
    assert 2 * GAP - found[0].max() > 1e-3 * GAP
    for other in found[1:]:
        assert other == pytest.approx(found[0], abs=1e-5 * GAP)


@pytest.mark.parametrize("step", STEPS)
def test_a_spring_at_its_end_bears_any_load(step):
    """A hundredth of the stiffness that would bear it: the sheet lies at the last fifth."""
    simulation = lying(step("5 ms"), stiffness=0.01 * LOAD / GAP).compile()
    audited(simulation, 400)
    assert heights(simulation) == pytest.approx(0.2 * GAP, rel=1e-2)
    assert simulation.force_on("table").force[2] == pytest.approx(-LOAD * 0.01, rel=1e-3)


@pytest.mark.parametrize("e", [0.3, 0.6, 1.0])
def test_a_damper_gives_back_its_restitution(e):
    """Schwager and Poeschel's closed form, in steps of a thousandth of the spring's period.

    BDF2 meets the spring and leaves it within a step of first order: h omega / 6 is 1e-3.
    """
    omega = math.sqrt(1e6 / PER_AREA)
    start = ts.Start(velocity=(0, 0, -1))
    made = over_a_table(
        flat(0.006, start=start), step=ts.BDF2(2 * math.pi / omega / 1000),
        gravity=None, gap="2 mm", restitution=e, stiffness="1e6 Pa/m", contact=method("penalty"),
    )  # fmt: skip
    simulation = made.compile()
    while simulation.time < 12e-3:
        audited(simulation, 1)
    assert simulation.velocities["body"][:, 2] == pytest.approx(e, abs=1e-3)


@pytest.mark.parametrize("friction", [0.0, 0.4])
@pytest.mark.parametrize("step", STEPS)
def test_a_free_collision_keeps_the_linear_momentum(step, friction):
    """To 1e-12 of that of one cube; forces are opposite."""
    made = collision(step("2 ms", solver=ts.Cholesky()), friction=friction)
    simulation = made.replace(contact=method("penalty")).compile()
    start, felt = momentum(simulation), 0.0
    for _ in range(60):
        audited(simulation, 1)
        force, other = (simulation.force_on(body).force for body in ("a", "b"))
        felt = max(felt, np.abs(force).max())
        assert np.abs(force + other).max() <= 1e-12 * felt
    assert felt > 10.0
    assert np.abs(momentum(simulation) - start).max() <= 1e-12


@pytest.mark.parametrize("step", STEPS)
def test_friction_is_coulombs(step):
    """Below its angle a block does not creep; above it slides with g (sin phi - mu cos phi)."""
    settings = {"step": step("10 ms"), "contact": method("penalty")}
    simulation = on_a_slope(0.45).replace(**settings).compile()
    audited(simulation, 300)
    start = simulation.positions["cube"].copy()
    audited(simulation, 100)
    assert np.abs(simulation.positions["cube"] - start).max() < 1e-8
    simulation = on_a_slope(0.55).replace(**settings).compile()
    audited(simulation, 150)
    speed = simulation.velocities["cube"].mean(axis=0)[0]
    audited(simulation, 100)
    phi = math.atan(0.55)
    gain = simulation.velocities["cube"].mean(axis=0)[0] - speed
    assert gain == pytest.approx(GRAVITY * (math.sin(phi) - MU * math.cos(phi)), rel=1e-3)


def squeezed(**fields):
    """A block between a rough table and a smooth plate, in a static step."""
    contact = fields.pop("contact", method("penalty"))
    down = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -0.02)))
    return ts.Scene(
        bodies={"block": block(young=2e4, cells=(3, 3, 3))},
        obstacles={
            "table": ts.PlaneObstacle((0, 0, -0.001), (0, 0, 1)),
            "plate": ts.PlaneObstacle((0, 0, 0.101), (0, 0, -1), motion=down),
        },
        contacts=[
            ts.Contact(("block", "table"), friction=1.0, gap=GAP, **fields),
            ts.Contact(("block", "plate"), gap=GAP, **fields),
        ],
        contact=contact,
        step=ts.Static(),
    )


def test_static_steps_press_with_springs_that_act():
    """Each contact has the force of its own spring at its place, and all forces balance."""
    stiffness = "3e6 Pa/m"
    simulation = squeezed(stiffness=stiffness).compile()
    report = simulation.step()
    assert report.converged, report
    assert simulation.crossings() == []
    assert out_of_balance(simulation) <= 2 * max(TOLERANCE, report.residual)
    found = simulation.contacts()
    normal = np.einsum("ij,ij->i", found.forces, found.normals)
    # Springs bear the area of their node: those of the top together its 10 cm x 10 cm, and half of
    # each of the twelve faces of 11 cm2 beside it, however these are cut into triangles.
    plate = found.surfaces.index("plate")
    of = (found.pairs == plate).any(axis=1)
    depth = GAP - found.gaps[of]
    assert (depth > 0).all()
    assert (normal[of] / depth).sum() == pytest.approx(3e6 * (0.01 + 12 * 0.01 / 9 / 2), rel=1e-6)
    table, above = (simulation.force_on(name).force[2] for name in ("table", "plate"))
    assert table == pytest.approx(-above, rel=1e-5)


def test_stiffer_springs_come_to_multipliers():
    """The force between two plates: what springs give way falls as one over their stiffness."""
    exact = squeezed(contact=None).compile()
    exact.step()
    force = exact.force_on("plate").force[2]
    errors = []
    for stiffness in (3e6, 3e7):
        simulation = squeezed(stiffness=stiffness).compile()
        simulation.step()
        errors.append(simulation.force_on("plate").force[2] / force - 1)
    # They rest between one and two gaps apart, 2 mm closer together than multipliers let them.
    assert abs(errors[1] - errors[0]) > 1e-3
    assert errors[1] > errors[0]


@pytest.mark.parametrize("threads", [1, 2])
def test_the_same_bits_from_a_checkpoint(threads, tmp_path):
    """In the middle of a collision, of which a step may say that it has not settled."""
    made = two(threads=threads, contact=method("penalty", penalty="reciprocal"))
    simulation = made.compile()
    stepped(simulation, 25)
    simulation.save_checkpoint(tmp_path / "middle")
    other = two(contact=method("penalty", penalty="reciprocal")).compile(
        checkpoint=tmp_path / "middle"
    )
    stepped(simulation, 20)
    stepped(other, 20)
    assert state(other) == state(simulation)


def stepped(simulation, steps):
    for _ in range(steps):
        simulation.step()
        assert simulation.crossings() == []


def probed(stiffness):
    """A block whose bottom is held, under a ball that is as thick as two of its cells."""
    mesh = ts.BarMesh(size=(0.06, 0.06, 0.03), cells=(3, 3, 2), cell="hexahedron")
    body = ts.Body(mesh=mesh, law=ts.StableNeoHooke(young=1e6, poisson=0.3), density=1000.0)
    path = ts.Motion(times=(0, 0.1), displacements=((0, 0, 0), (0, 0, -0.5 * GAP)))
    ball = ts.SphereObstacle((0.025, 0.035, 0.05 + 2 * GAP), radius=0.02, motion=path)
    return ts.Scene(
        bodies={"block": body},
        obstacles={"ball": ball},
        contacts=[ts.Contact(("block", "ball"), gap=GAP, stiffness=stiffness)],
        contact=method("penalty"),
        fixed=[ts.Fixed(body="block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        step=ts.ImplicitEuler("5 ms"),
    )


def test_a_round_tool_before_a_face_has_the_stiffness_that_was_given():
    """The force on the ball doubles with the stiffness, as far as the block does not give way."""
    forces = []
    for stiffness in (1e4, 2e4):
        simulation = probed(stiffness).compile()
        audited(simulation, 40)
        assert len(simulation.contacts()) > 0
        forces.append(simulation.force_on("ball").force[2])
    assert forces[0] > 0.0
    assert forces[1] == pytest.approx(2.0 * forces[0], rel=2e-2)


ROPE = ts.Body(
    mesh=ts.BarMesh(size=(0.2, 0, 0), cells=(10, 0, 0), cell="line", origin=(0, 0, 0.02)),
    law=ts.StVK(young=1e5, poisson=0.3),
    density=1000.0,
    section=5e-5,
)
TABLE = ts.PlaneObstacle((0, 0, 0), (0, 0, 1))


@pytest.mark.parametrize("step", [ts.ImplicitEuler("1 ms"), ts.SymplecticEuler("0.1 ms")])
def test_a_stiffness_of_contacts_without_an_area_is_refused(step):
    """It was ignored: pascal per metre of no area give no force."""
    ball = ts.SphereObstacle((0, 0, 0.05), radius=0.01, mass=0.1)
    for thin, bodies in (("rope", {"rope": ROPE}), ("ball", {})):
        scene = ts.Scene(
            bodies=bodies,
            obstacles={"table": TABLE, **({} if bodies else {"ball": ball})},
            contacts=[ts.Contact((thin, "table"), stiffness=1e6, gap=GAP)],
            contact=method("penalty"),
            step=step,
        )
        with pytest.raises(ts.SceneError) as error:
            scene.compile()
        (text,) = error.value.problems
        assert f"found 1e+06 Pa/m for '{thin}', whose contacts with 'table' have no area" in str(
            text
        )
        left_out = scene.contacts[0].replace(stiffness=None)
        scene.replace(contacts=[left_out]).compile()
