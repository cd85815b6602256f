"""Bodies of frames whose surface in contact is carried by positions and rotations."""

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped, weight
from contact_static import pushed
from test_contact_skin import bar
from tissu.simulation.twist import rows_of

WHOLE = ts.Frames(lever="whole")
HALF = ts.Frames(lever="half")
IMPLICIT = ("augmented", "barrier", "penalty")


def on_a_table(lever=HALF, name="auto", *, height=0.0, **fields):
    """A block of 8 cells, whose nodes are frames, with a surface of 5 x 5 x 5 quads."""
    body = block((0, 0, height), young=2e4, model=lever, viscosity=damped(20.0, 1e-4))
    given = {
        "bodies": {"block": body},
        "obstacles": {"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        "contacts": [ts.Contact(("block", "table"), friction=0.3)],
        "contact": ts.ContactSettings(
            method=name, surface_of={"block": bar((5, 5, 5), (0, 0, height))}
        ),
        "gravity": (0, 0, -GRAVITY),
        "step": ts.ImplicitEuler("5 ms"),
    }
    return ts.Scene(**(given | fields))


def colliding(
    step, name="auto", lever=HALF, friction=0.3, threads=1, speed=1.0, spin=0.0, young=1e5
):
    """Two blocks of frames that meet off centre; the left one may spin."""
    origins = {"left": (0, 0, 0), "right": (0.102, 0.031, 0.017)}
    starts = {
        "left": ts.Start(velocity=(speed, 0, 0), spin=(0, 0, spin)),
        "right": ts.Start(velocity=(-speed, 0, 0)),
    }
    return ts.Scene(
        bodies={
            body: block(at, young=young, model=lever, start=starts[body])
            for body, at in origins.items()
        },
        contacts=[ts.Contact(("left", "right"), friction=friction, gap=4e-4)],
        contact=ts.ContactSettings(
            method=name, surface_of={body: bar((5, 5, 5), at) for body, at in origins.items()}
        ),
        step=step,
        threads=threads,
    )


def momenta(simulation):
    """Momentum [kg m/s] and angular momentum about the origin [kg m2/s] of all bodies (6,)."""
    return rows_of(simulation._core).momenta()


# Where the surface is.


@pytest.mark.parametrize(("lever", "share"), [(WHOLE, 1.0), (HALF, 0.5)])
def test_a_vertex_follows_places_and_rotations(lever, share):
    """p = sum w (x + share R l), with the weights and levers of a hexahedron computed here."""
    simulation = on_a_table(lever, height=2e-3).compile()
    audited(simulation, 30)
    surface = simulation.contact_surface("block")
    mesh = simulation.meshes["block"]
    x, R = simulation.positions["block"], simulation.rotations("block")
    low, size = np.array([0, 0, 2e-3]), 0.05
    points = []
    for place in surface.rest:
        first = np.minimum(((place - low) / size).astype(int), 1)
        t = (place - low) / size - first
        sum_ = np.zeros(3)
        for corner in np.ndindex(2, 2, 2):
            node = np.argmin(np.linalg.norm(mesh.points - low - size * (first + corner), axis=1))
            w = np.prod(np.where(np.array(corner) == 1, t, 1 - t))
            sum_ += w * (x[node] + share * R[node] @ (place - mesh.points[node]))
        points.append(sum_)
    assert np.abs(surface.points - surface.rest).max() > 1e-4
    assert surface.points == pytest.approx(np.array(points), abs=1e-12)


# Forces.


@pytest.mark.parametrize("lever", [WHOLE, HALF])
@pytest.mark.parametrize("name", IMPLICIT)
def test_a_block_rests_with_its_weight(lever, name):
    simulation = on_a_table(lever, name).compile()
    audited(simulation, 160)
    force, moment = simulation.force_on("table")
    assert force == pytest.approx([0, 0, -weight()], abs=2e-3 * weight())
    # About the origin: the weight acts in the middle, 5 cm away along x and y.
    lever_arm = 0.05 * weight()
    assert moment == pytest.approx([-lever_arm, lever_arm, 0], abs=5e-3 * lever_arm)
    on_block = simulation.force_on("block")
    assert on_block.force == pytest.approx(-force, abs=1e-12 * weight())
    assert on_block.moment == pytest.approx(-moment, abs=1e-3 * lever_arm)


@pytest.mark.parametrize("name", ["impulse", "penalty"])
def test_a_block_rests_with_its_weight_in_explicit_steps(name):
    """The mean of a tenth of a second, for the response of each step swings."""
    simulation = on_a_table(HALF, name, step=ts.SymplecticEuler()).compile()
    forces = []
    while simulation.time < 0.3:
        assert simulation.step().converged
        forces.append((simulation.time, simulation.force_on("table").force[2]))
    assert simulation.crossings() == []
    late = np.mean([force for time, force in forces if time > 0.2])
    assert late == pytest.approx(-weight(), rel=1e-2)


def test_a_free_ball_rests_on_frames_that_may_touch_themselves():
    """Both weights arrive at the table; 2e-3 of them is left of the swing, and 5e-3 of the ball's
    weight, since it rocks."""
    ball = ts.SphereObstacle((0.05, 0.05, 0.1215), 0.02, mass=0.05)
    scene = on_a_table(
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1)), "ball": ball},
        contacts=[ts.Contact(("block", ("table", "ball")), friction=0.3), ts.SelfContact("block")],
    )
    simulation = scene.compile()
    audited(simulation, 80)
    light = 0.05 * GRAVITY
    assert simulation.force_on("ball").force[2] == pytest.approx(light, rel=5e-3)
    assert simulation.force_on("table").force[2] == pytest.approx(-light - weight(), rel=2e-3)


@pytest.mark.parametrize("step", [ts.BDF2, ts.ImplicitMidpoint, ts.Newmark])
def test_a_block_rests_with_its_weight_in_other_implicit_steps(step):
    """2e-3: what is left of its swing in the mean of a quarter of a second."""
    simulation = on_a_table(step=step("5 ms")).compile()
    audited(simulation, 110)
    forces = []
    for _ in range(50):
        audited(simulation, 1)
        forces.append(simulation.force_on("table").force[2])
    assert np.mean(forces) == pytest.approx(-weight(), rel=2e-3)


@pytest.mark.parametrize("name", IMPLICIT)
def test_the_weight_is_exact_in_a_static_step(name):
    """1e-6: the tolerance of Newton's method; sides on the table are held by friction."""
    held = [ts.Fixed("block", on=ts.Plane((0, 0, 0.1001), (0, 0, 1)), axes="xy")]
    law = ts.Hooke(young=2e4, poisson=0.3)
    body = block((0, 0, 1e-4), law=law, model=HALF)
    scene = on_a_table(
        bodies={"block": body}, fixed=held, step=ts.Static(load_steps=1),
        contact=ts.ContactSettings(
            method=name, surface_of={"block": bar((5, 5, 5), (0, 0, 1e-4))}
        ),
    )  # fmt: skip
    simulation = scene.compile()
    if name == "augmented":
        pushed(simulation)
    else:
        assert simulation.step().converged
    assert simulation.crossings() == []
    force = simulation.force_on("table").force[2]
    assert force == pytest.approx(-weight(), rel=1e-6)


@pytest.mark.parametrize(
    ("step", "name", "tolerance"),
    [
        (ts.ImplicitEuler("2 ms", solver=ts.Cholesky()), "augmented", 1e-11),
        (ts.ImplicitEuler("2 ms", solver=ts.Cholesky()), "barrier", 1e-11),
        (ts.ImplicitEuler("2 ms", solver=ts.Cholesky()), "penalty", 1e-11),
        (ts.BDF2("2 ms", solver=ts.Cholesky()), "augmented", 1e-11),
        (ts.ImplicitMidpoint("2 ms", solver=ts.Cholesky()), "augmented", 1e-11),
        (ts.Newmark("2 ms", solver=ts.Cholesky()), "augmented", 1e-11),
        (ts.SymplecticEuler(), "impulse", 1e-12),
        (ts.SymplecticEuler(), "penalty", 1e-12),
        (ts.SymplecticEuler(), "geometric", 1e-12),
    ],
)
def test_a_collision_keeps_momentum(step, name, tolerance):
    """Linear momentum of places alone is that of the bodies: to round-off with exact solves."""
    simulation = colliding(step, name).compile()
    touched = 0
    while simulation.time < 0.04:
        report = simulation.step()
        assert simulation.crossings() == [], report
        touched += report.contacts
        left, right = (simulation.force_on(body).force for body in ("left", "right"))
        assert left + right == pytest.approx(np.zeros(3), abs=1e-12 * np.abs(left).max() + 1e-300)
    assert touched
    assert momenta(simulation)[:3] == pytest.approx(np.zeros(3), abs=tolerance)
    assert simulation.velocities["left"][:, 0].mean() < 0.0  # thrown back


def test_a_collision_keeps_angular_momentum():
    """Without friction to the share by which normals turn in a step; with the bodies' own change,
    which grows with the step."""
    changes = []
    for dt in ("2 ms", "0.5 ms"):
        step = ts.ImplicitMidpoint(dt, solver=ts.Cholesky())
        simulation = colliding(step, friction=0.0).compile()
        before = momenta(simulation)
        most = 0.0
        while simulation.time < 0.04:
            simulation.step()
            most = max(most, np.abs(momenta(simulation) - before)[3:].max())
        changes.append(most)
    assert changes[1] < 0.5 * changes[0] < 0.02 * 0.05  # of m v b: 1 kg, 1 m/s, 5 cm


# Ways.


@pytest.mark.parametrize(
    ("name", "speed", "steps"),
    [("augmented", 3.0, 12), ("augmented", 30.0, 12), ("penalty", 30.0, 12), ("barrier", 3.0, 5)],
)
def test_nothing_passes_at_any_speed(name, speed, steps):
    """The left block spins by 0.6 rad a step; steps may be unsolved, but no surface is on the other
    side of another one."""
    step = ts.ImplicitEuler("1 ms")
    simulation = colliding(step, name, speed=speed, spin=600.0, young=1e7).compile()
    touched = 0
    for _ in range(steps):
        report = simulation.step()
        assert simulation.crossings() == [], report
        touched += report.contacts
    assert touched


def test_frames_alone_turn_a_surface_to_a_wall():
    """Frames whose places are held turn about themselves by 0.5 rad a step: the surface that they
    carry, which would be 6 cm lower without the wall, rests at it by moments of its contacts."""
    body = block(cells=(1, 1, 1), young=10.0, model=WHOLE)
    scene = on_a_table(
        bodies={"block": body},
        obstacles={"wall": ts.PlaneObstacle((0, -2e-3, 0), (0, 1, 0))},
        contacts=[ts.Contact(("block", "wall"))],
        contact=ts.ContactSettings(surface_of={"block": bar((3, 3, 3))}),
        fixed=[ts.Fixed("block", on=ts.Box(), rotations="free")],
        gravity=None,
        step=ts.ImplicitEuler("8 ms"),
    )
    simulation = scene.compile()
    rows = rows_of(simulation._core)
    rows.v[rows.turning[rows.turning >= 0]] = (0, 0, 60.0)
    lowest, touched = np.inf, 0
    for _ in range(8):
        report = simulation.step()
        assert simulation.crossings() == [], report
        lowest = min(lowest, simulation.contact_surface("block").points[:, 1].min())
        touched += report.contacts
    assert -2e-3 < lowest < -1e-3
    assert touched


def test_a_led_tool_pushes_a_surface_of_frames():
    """A ball is led 2 cm into the block at 4 m/s, and its force is felt."""
    path = ts.Motion(times=(0, 0.01), displacements=((0, 0, 0), (0, 0, -0.04)))
    scene = on_a_table(
        obstacles={
            "table": ts.PlaneObstacle((0, 0, -1e-3), (0, 0, 1)),
            "ball": ts.SphereObstacle((0.05, 0.05, 0.15), 0.03, motion=path),
        },
        contacts=[ts.Contact(("block", ("table", "ball")), friction=0.3)],
        step=ts.ImplicitEuler("2 ms"),
    )
    simulation = scene.compile()
    most = 0.0
    for _ in range(12):
        report = simulation.step()
        assert simulation.crossings() == [], report
        most = max(most, simulation.force_on("ball").force[2])
    assert most > weight()


# Bits.


@pytest.mark.parametrize("step", [ts.ImplicitEuler("2 ms"), ts.SymplecticEuler("0.1 ms")])
def test_threads_and_a_run_that_is_resumed_in_a_collision_change_no_bit(step, tmp_path):
    ends = []
    for threads in (1, 2):
        simulation = colliding(step, threads=threads).compile()
        while not len(simulation.contacts()):
            audited(simulation, 1)
        simulation.save_checkpoint(tmp_path / "middle.ckpt")
        audited(simulation, 10)
        ends.append(simulation.positions["left"].tobytes() + simulation.rotations("left").tobytes())
    again = colliding(step, threads=1).compile(checkpoint=tmp_path / "middle.ckpt")
    assert len(again.contacts())
    audited(again, 10)
    ends.append(again.positions["left"].tobytes() + again.rotations("left").tobytes())
    assert ends[0] == ends[1] == ends[2]


def test_the_picture_and_the_series_have_the_turned_surface(tmp_path):
    from tissu.output.series import Series
    from tissu.picture.draw import shape_of

    simulation = on_a_table(WHOLE, height=2e-3).compile()
    audited(simulation, 30)
    Series(simulation, tmp_path).write()
    (file,) = tmp_path.glob("*/block-surface_00000.vtu")
    wanted = simulation.contact_surface("block").points
    assert ts.read_mesh(file).points == pytest.approx(wanted)
    assert shape_of(simulation, "displacement").now == pytest.approx(wanted)


def test_the_live_view_has_the_turned_surface():
    """A frame whose place is held turns about itself: places alone would show no motion."""
    from tissu.live_view.surface import gone_of, places_of, seen_of

    body = block(cells=(1, 1, 1), young=10.0, model=WHOLE)
    simulation = on_a_table(
        bodies={"block": body},
        obstacles={"table": ts.PlaneObstacle((0, 0, -1), (0, 0, 1))},
        contact=ts.ContactSettings(surface_of={"block": bar((3, 3, 3))}),
        fixed=[ts.Fixed("block", on=ts.Box(), rotations="free")],
        gravity=None,
    ).compile()
    rows = rows_of(simulation._core)
    rows.v[rows.turning[0]] = (0, 0, 60.0)
    simulation.step()
    surface, seen = simulation.contact_surface("block"), seen_of(simulation, "block")
    gone = np.linalg.norm(surface.points - surface.rest, axis=1)
    assert gone.max() > 1e-3
    assert seen.at(simulation.positions["block"]) == pytest.approx(surface.rest)
    assert places_of(simulation, "block", seen) == pytest.approx(surface.points)
    assert gone_of(simulation, "block", seen) == pytest.approx(gone)


def test_without_a_surface_of_its_own_the_frames_themselves_meet():
    """The boundary of the cells between the frames: 9 nodes bear the weight."""
    simulation = on_a_table(contact=ts.ContactSettings()).compile()
    report = audited(simulation, 160)
    assert simulation.force_on("table").force[2] == pytest.approx(-weight(), rel=2e-3)
    assert report.contacts == 9
