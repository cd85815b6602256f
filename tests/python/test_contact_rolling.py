"""Round things in contact.

Led balls and capsules drag what they turn against, and go into nothing that is held; rods roll.
"""

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY
from tissu.simulation.twist import rows_of

MU, RADIUS = 0.4, 0.01
RESPONSES = {
    "augmented": (ts.ImplicitEuler("2 ms"), "augmented"),
    "penalty": (ts.ImplicitEuler("2 ms"), "penalty"),
    "barrier": (ts.ImplicitEuler("4 ms"), "barrier"),
    "bdf2": (ts.BDF2("2 ms"), "augmented"),
    "newmark": (ts.Newmark("1 ms"), "augmented"),
    "impulse": (ts.SymplecticEuler("auto"), "impulse"),
    "springs": (ts.SymplecticEuler("auto"), "penalty"),
    "geometric": (ts.SymplecticEuler("auto"), "geometric"),
}
EXPLICIT = ("impulse", "springs", "geometric")
KINDS = ("sphere", "capsule")
CENTER = (0.03, 0.01, 0.0202)


def round_one(kind, motion=None, center=CENTER):
    """A ball, or a capsule along y."""
    if kind == "sphere":
        return ts.SphereObstacle(center, radius=RADIUS, motion=motion)
    x, y, z = center
    return ts.CapsuleObstacle(((x, y - 0.02, z), (x, y + 0.02, z)), radius=RADIUS, motion=motion)


def turning(*, spin=0.0, speed=0.0, depth=7e-4):
    """Down in 20 ms; it turns about y [rad/s] and goes along x [m/s] all the time."""
    times = (0, 0.02, 1)
    ways = tuple((speed * t, 0, -min(1.0, t / 0.02) * depth) for t in times)
    turn = ts.Rotation(axis=(0, 1, 0), center=CENTER, angles=[spin * t for t in times])
    return ts.Motion(times=times, displacements=ways, rotation=turn if spin else None)


def on_a_block(obstacle, response="augmented", *, young=1e5, on=None, **fields):
    """A block of 6 x 2 x 1 cm, held from below, or elsewhere."""
    step, method = RESPONSES[response]
    damping = 1e-4 if response in EXPLICIT else 2e-3
    block = ts.Body(
        mesh=ts.BarMesh(size=(0.06, 0.02, 0.01), cells=(12, 4, 2), cell="hexahedron"),
        law=ts.StVK(young=young, poisson=0.3),
        density=1000.0,
        viscosity=ts.Rayleigh(mass=0.0 if damping > 1e-3 else 50.0, stiffness=damping),
    )
    bottom = ts.Plane((0, 0, 0), (0, 0, 1))
    given = {
        "bodies": {"block": block},
        "obstacles": {"roller": obstacle},
        "fixed": [ts.Fixed("block", on=on or bottom)],
        "contacts": [ts.Contact(("block", "roller"), friction=MU)],
        "contact": ts.ContactSettings(method=method),
        "step": step,
    }
    return ts.Scene(**(given | fields))


def mean_wrench(simulation, until=0.06):
    """Of the last third: force and moment on the roller, and its contacts' normal forces in all."""
    rows = []
    while simulation.time < until:
        simulation.step()
        if simulation.time < 2 * until / 3:
            continue
        found = simulation.contacts()
        normal = np.abs((found.forces * found.normals).sum(axis=1)).sum()
        rows.append((*simulation.force_on("roller"), normal))
    return [np.mean([row[i] for row in rows], axis=0) for i in range(3)]


# What turns under its contacts.


@pytest.mark.parametrize("response", RESPONSES)
@pytest.mark.parametrize("kind", KINDS)
def test_one_that_turns_on_the_spot_drags(kind, response):
    """All contacts slide: the moment about its axis is mu R times their normal forces in all."""
    simulation = on_a_block(round_one(kind, turning(spin=20.0)), response).compile()
    force, moment, normal = mean_wrench(simulation)
    assert normal > 0.05
    if response == "geometric":  # forces nothing where the surface went along in the step before
        assert -MU * RADIUS * normal <= moment[1] < -0.3 * MU * RADIUS * normal
        return
    assert moment[1] == pytest.approx(-MU * RADIUS * normal, rel=0.03)
    assert force[0] > 0.3 * normal  # its lowest point goes to -x, and the block holds it


@pytest.mark.parametrize("response", RESPONSES)
@pytest.mark.parametrize("kind", KINDS)
def test_one_that_is_drawn_sideways_feels_a_moment_about_its_middle(kind, response):
    simulation = on_a_block(round_one(kind, turning(speed=0.2)), response).compile()
    force, moment, normal = mean_wrench(simulation)
    if response == "geometric":
        assert 0.3 * MU * RADIUS * normal < moment[1] <= MU * RADIUS * normal
        return
    assert force[0] < -0.3 * normal
    assert moment[1] == pytest.approx(MU * RADIUS * normal, rel=0.03)


@pytest.mark.parametrize("response", ["augmented", "penalty", "newmark", "impulse"])
@pytest.mark.parametrize("kind", KINDS)
def test_one_that_rolls_without_slipping_feels_hardly_any_friction(kind, response):
    speed = 0.1
    rolls = round_one(kind, turning(spin=speed / RADIUS, speed=speed, depth=3e-4))
    _, moment, normal = mean_wrench(on_a_block(rolls, response, young=1e6).compile())
    assert abs(moment[1]) < 0.25 * MU * RADIUS * normal


@pytest.mark.parametrize("kind", KINDS)
def test_steps_of_many_turns_and_live_targets_are_the_same(kind):
    """Turns of 2 and 10 rad in a step slide as any other; live targets turn it as a path does."""
    moments = []
    for spin in (1000.0, 5000.0):
        simulation = on_a_block(round_one(kind, turning(spin=spin))).compile()
        _, moment, normal = mean_wrench(simulation)
        moments.append(moment[1] / (MU * RADIUS * normal))
    simulation = on_a_block(round_one(kind)).compile()
    lead = simulation.obstacle("roller")
    lead.move((0, 0, -7e-4), over="20 ms")
    while simulation.time < 0.02 - 1e-9:
        simulation.step()
    lead.move((0, 0, -7e-4), angle=20.0, axis=(0, 1, 0), center=CENTER, over=1)
    _, moment, normal = mean_wrench(simulation)
    moments.append(moment[1] / (MU * RADIUS * normal))
    assert moments == pytest.approx([-1, -1, -1], rel=0.03)


def test_a_free_block_is_driven_to_the_speed_of_the_roller():
    """On a table without friction, it ends at omega R."""
    table = ts.PlaneObstacle((0, 0, -4e-4), (0, 0, 1))
    roller = round_one("capsule", turning(spin=20.0, depth=5e-4))
    scene = on_a_block(roller, gravity=(0, 0, -GRAVITY)).replace(
        fixed=[],
        obstacles={"table": table, "roller": roller},
        contacts=[ts.Contact(("block", "roller"), friction=MU), ts.Contact(("block", "table"))],
    )
    simulation = scene.compile()
    while simulation.time < 0.1:
        simulation.step()
    assert simulation.velocities["block"][:, 0].mean() == pytest.approx(-20.0 * RADIUS, rel=0.05)


@pytest.mark.parametrize("response", ["augmented", "impulse"])
def test_a_checkpoint_and_threads_leave_its_bits(response, tmp_path):
    scene = on_a_block(round_one("capsule", turning(spin=20.0, speed=0.05)), response)
    through, other = scene.compile(), scene.replace(threads=2).compile()
    for _ in range(10):
        through.step()
        other.step()
    for simulation in (other, through):  # a checkpoint drops what the solver keeps: both take it
        simulation.save_checkpoint(tmp_path / "middle")
    resumed = scene.compile(checkpoint=tmp_path / "middle")
    for _ in range(10):
        for simulation in (through, other, resumed):
            simulation.step()
    for simulation in (other, resumed):
        assert np.array_equal(simulation.positions["block"], through.positions["block"])
        assert np.array_equal(
            simulation.force_on("roller").moment, through.force_on("roller").moment
        )


# What is held under a surface with a radius.

TOP = ts.Plane((0, 0, 0.01), (0, 0, 1))
HALF = ts.Box(min=(0.03, None, 0.01))
DOWN = ts.Motion(times=(0, 0.1), displacements=((0, 0, 0), (0, 0, -0.012)))
LYING = ts.CapsuleObstacle(
    ((-0.01, 0.01, 0.0205), (0.07, 0.01, 0.0205)), radius=RADIUS, motion=DOWN
)
STANDING = ts.CapsuleObstacle(
    ((0.03, 0.01, 0.0205), (0.03, 0.01, 0.05)), radius=RADIUS, motion=DOWN
)
PRESSED = {
    "ball": round_one("sphere", DOWN),
    "capsule across": round_one("capsule", DOWN),
    "longer capsule": LYING,
    "standing capsule": STANDING,
    "box": ts.BoxObstacle(min=(0.025, 0.005, 0.0102), max=(0.035, 0.015, 0.03), motion=DOWN),
}


@pytest.mark.parametrize("response", ["augmented", "barrier", "newmark", "impulse"])
@pytest.mark.parametrize("name", PRESSED)
def test_what_is_pressed_into_a_held_face_is_refused(name, response):
    """As soon as its surface has no room, as the box is, and not when its middle arrives."""
    simulation = on_a_block(PRESSED[name], response, on=TOP).compile()
    with pytest.raises(ts.Diverged, match="leaves no room for"):
        while simulation.time < 0.05:
            simulation.step()
            assert max((found.depth for found in simulation.overlaps()), default=0.0) < 1e-6
    assert simulation.time < 0.02


def test_a_prescribed_face_is_not_led_into_a_ball():
    up = ts.Prescribed("block", on=TOP, times=(0, 0.1), displacements=((0, 0, 0), (0, 0, 0.01)))
    simulation = on_a_block(round_one("sphere"), prescribed=[up]).compile()
    with pytest.raises(ts.Diverged, match="leaves no room"):
        while simulation.time < 0.05:
            simulation.step()
    assert simulation.time < 0.01


def test_one_that_is_drawn_from_the_free_part_to_a_held_one_is_refused():
    """It is pressed 1 mm into the free half, and refused when it comes to the held one."""
    path = ts.Motion(
        times=(0, 0.03, 0.23), displacements=((0, 0, 0), (0, 0, -1.2e-3), (0.04, 0, -1.2e-3))
    )
    ball = round_one("sphere", path, (0.015, 0.01, 0.0202))
    held = [ts.Fixed("block", on=HALF), ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))]
    simulation = on_a_block(ball, fixed=held).compile()
    with pytest.raises(ts.Diverged, match='leaves no room for "block" and "roller"'):
        while simulation.time < 0.23:
            simulation.step()
            if 0.03 < simulation.time < 0.06:
                assert simulation.force_on("roller").force[2] > 0.05
    assert 0.06 < simulation.time < 0.15


@pytest.mark.parametrize("response", ["augmented", "impulse"])
def test_one_that_slides_along_a_held_face_is_not_refused(response):
    """Within the gap there is room, and in a dent as deep as at the start."""
    along = ts.Motion(times=(0, 0.1), displacements=((0, 0, 0), (0.02, 0, 0)))
    for height in (1e-5, -1e-5):
        ball = round_one("sphere", along, (0.02, 0.01, 0.02 + height))
        simulation = on_a_block(ball, response, on=TOP).compile()
        for _ in range(20):
            simulation.step()


# Rods.


@pytest.mark.parametrize("response", [name for name in RESPONSES if name not in EXPLICIT[1:]])
def test_a_rod_of_frames_rolls_down_a_slope(response):
    """Across a slope of 10 degrees: 2/3 g sin(phi), of which friction takes a third."""
    step, method = RESPONSES[response]
    radius, slope = 0.005, np.radians(10)
    rod = ts.Body(
        mesh=ts.bar_mesh(size=(0.1, 0, 0), cells=(10, 0, 0), cell="line", origin=(0, 0, 0.0052)),
        law=ts.StVK(young=1e7, poisson=0.3),
        density=1000.0,
        section=ts.Round(radius=radius),
        model=ts.Frames(),
    )
    scene = ts.Scene(
        bodies={"rod": rod},
        obstacles={"slope": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("rod", "slope"), friction=0.5)],
        contact=ts.ContactSettings(method=method),
        gravity=(0, GRAVITY * np.sin(slope), -GRAVITY * np.cos(slope)),
        step=step,
    )
    simulation = scene.compile()
    while simulation.time < 0.1 - 1e-9:
        simulation.step()
    begun = simulation.velocities["rod"][:, 1].mean()
    at = simulation.time
    while simulation.time < 0.3 - 1e-9:
        simulation.step()
    rate = (simulation.velocities["rod"][:, 1].mean() - begun) / (simulation.time - at)
    assert rate == pytest.approx(2 / 3 * GRAVITY * np.sin(slope), rel=5e-3)
    turns = simulation.rotations("rod")
    ways = simulation.displacements("rod")[:, 1]
    slid = np.arctan2(turns[:, 2, 1], turns[:, 1, 1]) + ways / radius
    assert np.abs(np.remainder(slid + np.pi, 2 * np.pi) - np.pi).max() < 0.1


@pytest.mark.parametrize("response", ["augmented", "penalty", "newmark", "impulse"])
def test_rods_that_rub_on_each_other_keep_their_momenta(response):
    """They cross and meet, with friction of half a radius beside their middle: 4 % were lost."""
    step, method = RESPONSES[response]

    def rod(points, velocity=(0, 0, 0)):
        cells = ts.bar_mesh(size=(0.1, 0, 0), cells=(10, 0, 0), cell="line").cells
        return ts.Body(
            mesh=ts.Mesh(points=np.array(points), cells=cells),
            law=ts.StVK(young=1e6, poisson=0.3),
            density=1000.0,
            section=ts.Round(radius=0.005),
            model=ts.Frames(),
            start=ts.Start(velocity=velocity),
        )

    along = np.linspace(0, 0.1, 11)
    scene = ts.Scene(
        bodies={
            "a": rod([(x, 0, 0) for x in along], (0, 0.2, 0.5)),
            "b": rod([(0.047, y - 0.05, 0.0115) for y in along]),
        },
        contacts=[ts.Contact(("a", "b"), friction=MU)],
        contact=ts.ContactSettings(method=method),
        step=step.replace(dt="1 ms") if response != "impulse" else step,
    )
    simulation = scene.compile()
    before, most = rows_of(simulation._core).momenta(), 0.0
    while simulation.time < 0.02:
        simulation.step()
        most = max(most, np.abs(simulation.force_on("b").force[1]))
    after = rows_of(simulation._core).momenta()
    assert most > 0.05
    assert np.abs(after - before)[:3].max() < 1e-5 * np.abs(before[:3]).max()
    assert np.abs(after - before)[3:].max() < 2e-3 * np.abs(before[3:]).max()
