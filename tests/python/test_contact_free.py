"""Free obstacles: rigid bodies against closed forms and conservation laws."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts

G = 9.81
GAP = 1e-5
"""m: rests and rolls on it make an error of this over a radius"""
STEPS = {
    "implicit_euler": ts.ImplicitEuler("1 ms"),
    "bdf2": ts.BDF2("1 ms"),
    "symplectic_euler": ts.SymplecticEuler("1 ms"),
}
TABLE = ts.PlaneObstacle((0, 0, 0), (0, 0, 1))


def on_table(
    thing: Any, step: Any, *, friction: float = 0.0, slope: float = 0.0, **fields: Any
) -> ts.Simulation:
    """A free thing on a plane that is tilted by an angle [rad]."""
    scene = ts.Scene(
        bodies={},
        gravity=(G * np.sin(slope), 0.0, -G * np.cos(slope)),
        obstacles={"table": TABLE, "thing": thing},
        contacts=[ts.Contact(("thing", "table"), friction=friction, gap=GAP)],
        step=step,
        **fields,
    )
    return scene.compile()


def settled(simulation: ts.Simulation, steps: int) -> None:
    """Steps that all converge and end without a crossing."""
    for _ in range(steps):
        report = simulation.step()
        assert report.converged, report
    assert len(simulation.crossings()) == 0


def ball(**fields: Any) -> ts.SphereObstacle:
    """2 cm and 100 g, resting on the plane."""
    return ts.SphereObstacle((0, 0, 0.02 + GAP), radius=0.02, mass=0.1, **fields)


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
def test_a_free_obstacle_falls(step: Any) -> None:
    """The sum of the step's own positions: g h^2 n (n + 1) / 2 of both Euler methods.

    BDF2 makes the same of its first step, and leaves out its share of the others: g t^2 / 2 to
    first order, for that first step.
    """
    thing = ts.SphereObstacle((0, 0, 0.5), radius=0.02, mass=0.1, velocity=(0.3, 0, 0))
    simulation = on_table(thing, step)
    settled(simulation, 100)
    x, y, z = simulation.rigid("thing").position
    assert x == pytest.approx(0.03, rel=1e-12) and y == 0.0
    assert 0.5 - z == pytest.approx(fallen(step), rel=1e-11)


def fallen(step: Any) -> float:
    """Way of a fall of 100 steps of 1 ms [m]."""
    if step.type != "bdf2":
        return G * 1e-6 * 100 * 101 / 2
    places, speeds = [0.0, G * 1e-6], [0.0, G * 1e-3]  # the first step is one of backward Euler
    for _ in range(99):
        speeds.append((4 * speeds[-1] - speeds[-2] + 2e-3 * G) / 3)
        places.append((4 * places[-1] - places[-2] + 2e-3 * speeds[-1]) / 3)
    return places[-1]


def test_bdf2_begins_anew_at_a_blow() -> None:
    """A ball that falls on a table neither rebounds nor sinks; beside it another one falls on.

    Its steps are those of backward Euler at the blow, in the next step, in which the ball strikes
    the end of its gap at 0.05 m/s, and in the one after that; then of BDF2 again. The other one's
    way is that of this sequence, to what the linear solver leaves.
    """
    down = ts.SphereObstacle((0, 0, 0.03), radius=0.02, mass=0.1)
    other = ts.SphereObstacle((0.1, 0, 1.0), radius=0.02, mass=0.1)
    scene = ts.Scene(
        bodies={},
        gravity=(0, 0, -G),
        obstacles={"table": TABLE, "down": down, "other": other},
        contacts=[ts.Contact(("down", "table"), gap=GAP)],
        step=ts.BDF2("1 ms"),
    )
    simulation = scene.compile()
    thing, highest = simulation.rigid("down"), 0.0
    struck = None
    for k in range(100):
        report = simulation.step()
        assert report.converged, report
        assert simulation.crossings() == []
        if struck is None and report.contacts:
            struck = k
        if struck is not None and k > struck:
            highest = max(highest, thing.velocity[2])
    assert struck == 45  # after sqrt(2 g 9.99 mm): 0.443 m/s
    # A ball that stops in its gap comes out of it by a part of a gap a step.
    assert highest < 0.1 * GAP / 1e-3
    assert thing.position[2] == pytest.approx(0.02 + GAP, abs=0.02 * GAP)
    places, speeds = [0.0], [0.0]
    for k in range(100):
        if k in (0, struck, struck + 1, struck + 2):
            speeds.append(speeds[-1] + 1e-3 * G)
            places.append(places[-1] + 1e-3 * speeds[-1])
            continue
        speeds.append((4 * speeds[-1] - speeds[-2] + 2e-3 * G) / 3)
        places.append((4 * places[-1] - places[-2] + 2e-3 * speeds[-1]) / 3)
    assert 1.0 - simulation.rigid("other").position[2] == pytest.approx(places[-1], rel=1e-7)


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
def test_it_presses_with_its_weight(step: Any) -> None:
    """Force and moment of rest; a tenth of a percent is the change that ends a step's systems."""
    simulation = on_table(ts.BoxObstacle((0, 0, GAP), (0.05, 0.04, 0.03 + GAP), mass=0.5), step)
    settled(simulation, 200)
    thing = simulation.rigid("thing")
    np.testing.assert_allclose(thing.force, (0, 0, 0.5 * G), rtol=1e-3, atol=1e-3 * 0.5 * G)
    np.testing.assert_allclose(thing.moment, 0.0, atol=1e-3 * 0.5 * G * 0.05)
    np.testing.assert_allclose(simulation.force_on("table").force, -thing.force, rtol=1e-12)
    assert abs(thing.position[2] - 0.015 - GAP) < 0.02 * GAP


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
@pytest.mark.parametrize(("friction", "slope"), [(0.5, 0.4), (0.1, 0.6)], ids=["rolls", "slides"])
def test_a_ball_rolls_or_slides_down_a_slope(step: Any, friction: float, slope: float) -> None:
    """a = 5/7 g sin(phi) from mu = 2/7 tan(phi) on, else g (sin(phi) - mu cos(phi))."""
    simulation = on_table(ball(), step, friction=friction, slope=slope)
    thing, speeds = simulation.rigid("thing"), []
    for _ in range(2):
        settled(simulation, 100)
        speeds.append((thing.velocity[0], thing.spin[1]))
    (slow, spin), (fast, faster) = speeds
    rolls = friction >= 2 / 7 * np.tan(slope)
    exact = 5 / 7 * G * np.sin(slope)
    if not rolls:
        exact = G * (np.sin(slope) - friction * np.cos(slope))
    turning = exact / 0.02 if rolls else 2.5 * friction * G * np.cos(slope) / 0.02
    # Implicit steps stop when forces change by less than a thousandth.
    tolerance = 1e-9 if step.type == "symplectic_euler" else 1e-3
    assert fast - slow == pytest.approx(0.1 * exact, rel=tolerance)
    assert faster - spin == pytest.approx(0.1 * turning, rel=2 * tolerance)


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
def test_a_block_slides_to_rest(step: Any) -> None:
    """After v0^2 / (2 mu g), but for half a step's way."""
    thing = ts.BoxObstacle((0, 0, GAP), (0.1, 0.1, 0.04), mass=0.5, velocity=(1, 0, 0))
    simulation = on_table(thing, step, friction=0.3)
    settled(simulation, 400)
    way = simulation.rigid("thing").position[0] - 0.05
    assert way == pytest.approx(1 / (0.6 * G), abs=0.6e-3)
    assert np.linalg.norm(simulation.rigid("thing").velocity) < 1e-3


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
@pytest.mark.parametrize(("slope", "tips"), [(0.30, False), (0.35, True)])
def test_a_tall_block_tips_and_does_not_slide(step: Any, slope: float, tips: bool) -> None:
    """A block three times as tall as wide: from tan(phi) = 1/3 on."""
    thing = ts.BoxObstacle((0, 0, GAP), (0.04, 0.04, 0.12), mass=0.5)
    simulation = on_table(thing, step, friction=1.0, slope=slope)
    settled(simulation, 500)
    upright = simulation.rigid("thing").rotation[2, 2]
    assert upright < 0.5 if tips else upright > 0.99


@pytest.mark.parametrize("dt", ["0.02 ms", "0.01 ms"])
def test_the_last_ball_of_a_cradle_leaves(dt: str) -> None:
    """Balls 0.1 mm apart with e = 1: momentum and energy leave with the last one."""
    places = [-0.01, *(0.0401 * i for i in range(1, 5))]
    balls = {
        f"ball {i}": ts.SphereObstacle(
            (x, 0, 0), radius=0.02, mass=0.1, velocity=(1.0 if i == 0 else 0.0, 0, 0)
        )
        for i, x in enumerate(places)
    }
    contacts = [
        ts.Contact((f"ball {i}", f"ball {i + 1}"), restitution=1.0, gap=GAP) for i in range(4)
    ]
    scene = ts.Scene(bodies={}, obstacles=balls, contacts=contacts, step=ts.SymplecticEuler(dt))
    simulation = scene.compile()
    settled(simulation, round(0.012 / float(scene.step.dt)))  # type: ignore[arg-type]
    speeds = [simulation.rigid(name).velocity[0] for name in balls]
    np.testing.assert_allclose(speeds, (0, 0, 0, 0, 1), atol=1e-9)


def soft_cube() -> ts.Body:
    """5 cm, 125 g."""
    mesh = ts.BarMesh(size=(0.05, 0.05, 0.05), cells=(3, 3, 3))
    return ts.Body(mesh=mesh, law=ts.StVK(young="50 kPa", poisson=0.3), density=1000)


def momenta(simulation: ts.Simulation, mass: np.ndarray[Any, Any], inertia: float) -> Any:
    """Linear and angular momentum about the origin of the cube and of the ball."""
    x, v = simulation.positions["cube"], simulation.velocities["cube"]
    thing = simulation.rigid("ball")
    linear = mass @ v + 0.05 * thing.velocity
    angular = (mass[:, None] * np.cross(x, v)).sum(axis=0)
    angular += 0.05 * np.cross(thing.position, thing.velocity) + inertia * thing.spin
    return linear, angular


@pytest.mark.parametrize(
    ("step", "steps"),
    [(ts.ImplicitEuler("1 ms"), 60), (ts.BDF2("1 ms"), 60), (ts.SymplecticEuler("0.05 ms"), 1200)],
    ids=["implicit_euler", "bdf2", "symplectic_euler"],
)
def test_a_collision_keeps_the_momenta(step: Any, steps: int) -> None:
    """A ball hits a free soft cube beside its middle; nothing else acts.

    Linear momentum is kept by forces that sum to zero. Both sides of a contact touch xi apart, so
    that a friction f turns them by at most f xi for as long as it acts.
    """
    thing = ts.SphereObstacle((0.025, 0.035, 0.075), radius=0.02, mass=0.05, velocity=(0.1, 0, -1))
    scene = ts.Scene(
        bodies={"cube": soft_cube()},
        obstacles={"ball": thing},
        contacts=[ts.Contact(("cube", "ball"), friction=0.3)],
        step=step,
    )
    simulation = scene.compile()
    mass = np.asarray(simulation.mass_matrix().diagonal()).reshape(-1, 3)[: 4**3, 0]
    inertia = 0.4 * 0.05 * 0.02**2
    before = momenta(simulation, mass, inertia)
    worst = 0.0
    for _ in range(steps):
        assert simulation.step().converged
        worst = max(worst, len(simulation.crossings()))
    linear, angular = momenta(simulation, mass, inertia)
    assert worst == 0
    assert simulation.rigid("ball").velocity[2] > -0.6, "it never met the cube"
    solved = 1e-12 if step.type == "symplectic_euler" else 1e-5  # of the linear solves
    np.testing.assert_allclose(linear, before[0], atol=solved * 0.05)
    gap = 0.02 * 0.05 / 3
    np.testing.assert_allclose(angular, before[1], atol=0.05 * gap + 1e-3 * 0.05 * 0.03)


def test_spin_keeps_the_angular_momentum() -> None:
    """A box without gravity, about no axis of its own: R I R^T omega is constant."""
    thing = ts.BoxObstacle((0, 0, 1), (0.06, 0.03, 1.02), mass=0.5, spin=(3, 4, 5))
    scene = ts.Scene(
        bodies={}, obstacles={"table": TABLE, "thing": thing},
        contacts=[ts.Contact(("thing", "table"))], step=ts.ImplicitEuler("1 ms"),
    )  # fmt: skip
    simulation = scene.compile()
    squares = np.array((0.06, 0.03, 0.02)) ** 2
    inertia = np.diag(0.5 / 12 * (squares.sum() - squares))

    def momentum() -> Any:
        rotation = simulation.rigid("thing").rotation
        return rotation @ inertia @ rotation.T @ simulation.rigid("thing").spin

    before = momentum()
    np.testing.assert_allclose(before, inertia @ (3, 4, 5), rtol=1e-12)
    settled(simulation, 500)
    assert abs(simulation.rigid("thing").rotation[0, 0]) < 0.99, "it did not turn"
    np.testing.assert_allclose(momentum(), before, rtol=1e-9)


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
@pytest.mark.parametrize("spin", [(0.3, 30.0, 0.2), (2.0, 1.0, 40.0)], ids=["end over end", "box"])
def test_turning_freely_neither_gains_nor_loses(step: Any, spin: tuple[float, ...]) -> None:
    """A long box near its axis of the greatest inertia: energy stays, but for what swings.

    The midpoint rule is reversible, so that its error does not add up: (h omega)^2 / 12 of the
    energy at 40 rad/s and 1 ms is 1.3e-4. Steps of BDF2 in which it turns
    by more than 1e-3 rad are those of implicit Euler.
    """
    thing = ts.BoxObstacle((0, 0, 1), (0.01, 0.012, 1.1), mass=0.1, spin=spin)
    scene = ts.Scene(
        bodies={},
        obstacles={"table": TABLE, "thing": thing},
        contacts=[ts.Contact(("thing", "table"))],
        step=step,
    )
    simulation = scene.compile()
    squares = np.array((0.01, 0.012, 0.1)) ** 2
    inertia = np.diag(0.1 / 12 * (squares.sum() - squares))

    def energy() -> float:
        rotation, omega = simulation.rigid("thing").rotation, simulation.rigid("thing").spin
        return float(omega @ rotation @ inertia @ rotation.T @ omega)

    before, found = energy(), []
    for _ in range(2000):
        simulation.step()
        found.append(energy() / before - 1.0)
    assert max(np.abs(found)) < 1e-3


@pytest.mark.parametrize("dt", ["10 ms", "2 ms"])
def test_fast_rolling_goes_on(dt: str) -> None:
    """At 200 rad/s in steps of 10 ms: two radians a step, and no slip."""
    thing = ts.SphereObstacle(
        (0, 0, 0.005 + GAP), radius=0.005, mass=0.1, velocity=(1, 0, 0), spin=(0, 200, 0)
    )
    simulation = on_table(thing, ts.ImplicitEuler(dt), friction=0.5)
    settled(simulation, 50)
    assert simulation.rigid("thing").velocity[0] == pytest.approx(1.0, rel=1e-2)
    assert 0.005 * simulation.rigid("thing").spin[1] == pytest.approx(1.0, rel=1e-2)


def test_the_force_of_a_step_in_parts_is_the_mean_over_it() -> None:
    """In every step the impulse on the ball is its change of momentum; some steps have parts."""
    thing = ts.SphereObstacle((0.025, 0.025, 0.0725), radius=0.02, mass=0.05, velocity=(0, 0, -1))
    scene = ts.Scene(
        bodies={"cube": soft_cube()},
        fixed=[ts.Fixed("cube", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        obstacles={"ball": thing},
        contacts=[ts.Contact(("cube", "ball"))],
        step=ts.ImplicitEuler("5 ms"),
    )
    simulation = scene.compile()
    ball_, parts = simulation.rigid("ball"), 0
    for _ in range(20):
        before = ball_.velocity
        report = simulation.step()
        parts = max(parts, report.substeps)
        change = 0.05 * (ball_.velocity - before) / 5e-3
        # Rows that were held back change their velocity by their way alone.
        if report.held_back == 0:
            size = max(1.0, float(np.abs(change).max()))
            np.testing.assert_allclose(ball_.force, change, atol=2e-3 * size)
    assert parts > 1


@pytest.mark.parametrize(
    "step",
    [ts.ImplicitEuler("10 ms"), ts.BDF2("10 ms"), ts.SymplecticEuler("0.2 ms")],
    ids=["implicit_euler", "bdf2", "symplectic_euler"],
)
def test_nothing_passes_a_thin_slab(step: Any) -> None:
    """A spinning box against a slab 5 mm thick, at 10 or 5 m/s: no crossing in any step."""
    mesh = ts.BarMesh(size=(0.1, 0.1, 0.005), cells=(5, 5, 1))
    slab = ts.Body(mesh=mesh, law=ts.NeoHooke(young="50 kPa", poisson=0.3), density=1000)
    speed = 5 if step.type == "symplectic_euler" else 10
    box = ts.BoxObstacle(
        (0.04, 0.04, 0.04),
        (0.07, 0.055, 0.05),
        mass=0.02,
        velocity=(0, 0, -speed),
        spin=(40, 90, 20),
    )
    scene = ts.Scene(
        bodies={"slab": slab},
        gravity=(0, 0, -G),
        fixed=[
            ts.Fixed("slab", on=ts.Plane(point, normal))
            for point, normal in (
                ((0, 0, 0), (1, 0, 0)),
                ((0, 0, 0), (0, 1, 0)),
                ((0.1, 0, 0), (1, 0, 0)),
                ((0, 0.1, 0), (0, 1, 0)),
            )
        ],
        obstacles={"box": box},
        contacts=[ts.Contact(("slab", "box"), friction=0.2)],
        step=step,
    )
    simulation = scene.compile()
    met = 0
    for _ in range(100 if step.type == "symplectic_euler" else 12):
        met += simulation.step().contacts
        assert len(simulation.crossings()) == 0
    assert met > 0
    assert simulation.rigid("box").position[2] > simulation.positions["slab"][:, 2].min()


def test_inertias_of_shapes() -> None:
    """Of a box's mesh that of the box; of a capsule that of points at random inside it."""
    from tissu.compile.obstacle import prepared_obstacle
    from tissu.compile.prepared import Findings

    def inertia(obstacle: Any) -> Any:
        ready = prepared_obstacle("thing", obstacle, Findings())
        assert ready is not None and ready.rigid is not None
        return ready.rigid.inertia, ready.origin

    low, high = (0.1, 0.2, 0.3), (0.14, 0.27, 0.32)
    size = tuple(b - a for a, b in zip(low, high, strict=True))
    bar = ts.bar_mesh(size=size, cells=(2, 3, 1))
    mesh = ts.Mesh(points=bar.points + np.array(low), cells=bar.cells)
    (box, middle), (solid, centre) = (
        inertia(ts.BoxObstacle(low, high, mass=0.3)),
        inertia(ts.MeshObstacle(mesh, mass=0.3)),
    )
    np.testing.assert_allclose(solid, box, rtol=1e-12, atol=1e-18)
    np.testing.assert_allclose(centre, middle, rtol=1e-12)

    ends, radius = np.array([(0.0, 0.0, 0.0), (0.03, 0.04, 0.0)]), 0.02
    capsule, _ = inertia(ts.CapsuleObstacle(ends, radius=radius, mass=0.3))
    random = np.random.default_rng(5)
    points = random.uniform((-0.02, -0.02, -0.02), (0.05, 0.06, 0.02), (400_000, 3))
    way = ends[1] / np.linalg.norm(ends[1])
    along = np.clip(points @ way, 0.0, 0.05)
    inside = points[np.linalg.norm(points - along[:, None] * way, axis=1) < radius]
    arms = inside - inside.mean(axis=0)
    second = 0.3 * arms.T @ arms / len(arms)
    sampled = np.trace(second) * np.eye(3) - second
    # Some 200,000 points: the spread of a second moment is about its size over their root.
    np.testing.assert_allclose(capsule, sampled, atol=6e-3 * np.trace(capsule))


def drop(threads: int = 1) -> ts.Simulation:
    """A box and a ball fall on a soft cube."""
    obstacles = {
        "box": ts.BoxObstacle((0, 0, 0.06), (0.03, 0.02, 0.075), mass=0.03, spin=(1, 2, 0)),
        "ball": ts.SphereObstacle((0.03, 0.03, 0.08), radius=0.01, mass=0.02),
    }
    return ts.Scene(
        bodies={"cube": soft_cube()},
        gravity=(0, 0, -G),
        fixed=[ts.Fixed("cube", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        obstacles=obstacles,
        contacts=[ts.Contact("all", friction=0.3)],
        step=ts.ImplicitEuler("5 ms"),
        threads=threads,
    ).compile()


def track(simulation: ts.Simulation, steps: int) -> list[bytes]:
    """Bits of the motion of both."""
    bits = []
    for _ in range(steps):
        simulation.step()
        assert len(simulation.crossings()) == 0
        for name in ("box", "ball"):
            thing = simulation.rigid(name)
            bits += [thing.position.tobytes(), thing.rotation.tobytes(), thing.spin.tobytes()]
    return bits


def test_same_bits_on_any_number_of_threads_and_after_a_checkpoint(tmp_path: Any) -> None:
    """In the middle of a collision, of all with all."""
    simulation = drop()
    whole = track(simulation, 40)
    assert len(simulation.contacts().forces) > 0
    assert track(drop(2), 40) == whole
    first = drop()
    track(first, 20)
    first.save_checkpoint(tmp_path / "middle")
    resumed = first.scene.compile(checkpoint=tmp_path / "middle")
    assert track(resumed, 20) == track(first, 20)


def test_its_motion_may_be_set() -> None:
    """Between steps, as that of a body's nodes."""
    simulation = on_table(
        ts.SphereObstacle((0, 0, 1), radius=0.01, mass=1), STEPS["implicit_euler"]
    )
    thing = simulation.rigid("thing")
    thing.velocity, thing.spin = (1, 2, 3), ("1 rad/s", 0, 0)
    np.testing.assert_array_equal(thing.velocity, (1, 2, 3))
    np.testing.assert_array_equal(thing.spin, (1, 0, 0))
    with pytest.raises(ts.ParameterError, match="velocity"):
        thing.velocity = (1, float("nan"), 0)
    assert repr(thing) == "Rigid('thing', at (0, 0, 1) m)"


REFUSED: dict[str, tuple[Any, str]] = {
    "led and free": (
        lambda: on_table(
            ball(motion=ts.Motion(times=(0, 1), displacements=((0, 0, 0), (1, 0, 0)))),
            STEPS["implicit_euler"],
        ),
        "with `motion`",
    ),
    "a plane": (
        lambda: ts.PlaneObstacle((0, 0, 0), (0, 0, 1), mass=1),
        "a plane, which has no end",
    ),
    "no mass": (
        lambda: ts.SphereObstacle((0, 0, 0), radius=1, velocity=(1, 0, 0)),
        "without a mass",
    ),
    "static": (lambda: on_table(ball(), ts.Static()), "moves no free obstacle; accepted:"),
    "midpoint": (
        lambda: on_table(ball(), ts.ImplicitMidpoint("1 ms")),
        "moves no free obstacle; accepted:",
    ),
    "no contact": (
        lambda: ts.Scene(
            bodies={}, obstacles={"thing": ball()}, step=STEPS["implicit_euler"]
        ).compile(),
        "no contacts, without which nothing moves it",
    ),
    "two led": (
        lambda: ts.Scene(
            bodies={},
            step=STEPS["implicit_euler"],
            obstacles={
                "table": TABLE,
                "thing": ball(),
                "wall": ts.BoxObstacle((0, 0, 1), (1, 1, 2)),
            },
            contacts=[ts.Contact(("wall", "table"))],
        ).compile(),
        "or give one of them a mass",
    ),
    "an open mesh": (
        lambda: on_table(
            ts.MeshObstacle(ts.bar_mesh(size=(1, 1, 0), cells=(2, 2, 0), cell="triangle"), mass=1),
            STEPS["implicit_euler"],
        ),
        "not closed",
    ),
    "leading it": (
        lambda: on_table(ball(), STEPS["implicit_euler"]).obstacle("thing").move((0, 0, 1)),
        "has a mass and moves freely",
    ),
    "a led one": (
        lambda: on_table(ball(), STEPS["implicit_euler"]).rigid("table"),
        "with a mass: thing",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused(case: str) -> None:
    """In one sentence."""
    make, words = REFUSED[case]
    with pytest.raises(ts.TissuError, match=words):
        make()


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
def test_a_slender_thing_that_turns_fast_keeps_its_energy(step: Any) -> None:
    """By half a radian a step, across its axis: the equation of the middle is solved in halves."""
    thing = ts.CapsuleObstacle(((0, 0, 9), (0.05, 0, 9)), 0.002, mass=0.01, spin=(35, 35, 0))
    simulation = on_table(thing, step.replace(dt="10 ms"))
    rigid = simulation.rigid("thing")
    for _ in range(40):
        assert simulation.step().converged
    fall = G * simulation.time
    turning = simulation.energy()["kinetic"] - 0.5 * 0.01 * float(rigid.velocity @ rigid.velocity)
    start = on_table(thing, step).energy()["kinetic"]
    assert abs(rigid.velocity[2]) == pytest.approx(fall, rel=0.02)
    assert turning == pytest.approx(start, rel=0.02)
