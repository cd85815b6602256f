"""Penalty and impulses in explicit steps, against closed forms and conservation laws."""

import functools
import math
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, between, block, damped, weight
from contact_explicit import PER_AREA, THICKNESS, flat, over_a_table
from test_contact_balance import collision, momentum
from test_contact_friction import MU
from test_contact_rest import state, two
from test_contact_travel import BALL, thin_slab

METHODS = ("impulse", "penalty")
ALL = (*METHODS, "geometric")
STEPS = (ts.SymplecticEuler, ts.ExplicitEuler, ts.RK2, ts.RK4)
GAP = 1e-3
"""[m]"""


def method(name, **fields):
    return ts.ContactSettings(method=name, **fields)


def run(simulation, end):
    """Until a time [s]; nothing may cross at any step. The latest report."""
    while simulation.time < end:
        report = audited(simulation, 1)
    return report


def heights(simulation):
    """Of the middle of a sheet over a table, less half its thickness [m]."""
    return simulation.positions["body"][:, 2] - 0.5 * THICKNESS


# Rest.


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("name", METHODS)
def test_a_dropped_cube_rests_with_its_weight(name, step):
    """1e-3: what is left of its swing after 1.5 s; nothing is deeper than the gap, or its stop."""
    body = block((0, 0, 0.005), young=2e4, viscosity=damped(20.0, 1e-4))
    made = over_a_table(body, step=step(), friction=0.5, gap="4 mm", contact=method(name))
    simulation = made.compile()
    report = run(simulation, 1.5)
    force = simulation.force_on("table").force
    assert force == pytest.approx([0, 0, -weight()], abs=1e-3 * weight())
    assert np.abs(simulation.velocities["body"]).max() < 1e-3
    assert report.held_back == 0
    assert report.contacts == 9
    if name == "impulse":
        assert report.least_gap == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("step", [ts.SymplecticEuler, ts.RK2, ts.RK4])
def test_the_geometric_response_holds_a_cube_up_but_not_still(step):
    """Its weight in the mean of 0.2 s, within 1 %; it trembles, and lies no deeper than 1 % of xi.

    Velocities lead down and places are lifted: damping by the mass would take some of the weight.
    """
    body = block((0, 0, 0.005), young=2e4, viscosity=damped(0.0, 5e-4))
    made = over_a_table(body, step=step(), friction=0.5, gap="4 mm", contact=method("geometric"))
    simulation = made.compile()
    run(simulation, 1.0)
    forces, least = [], math.inf
    while simulation.time < 1.2:
        report = audited(simulation, 1)
        forces.append(simulation.force_on("table").force)
        least = min(least, report.least_gap)
        assert np.abs(simulation.velocities["body"]).max() < 2e-2
    assert np.mean(forces, axis=0) == pytest.approx([0, 0, -weight()], abs=1e-2 * weight())
    assert least > 0.99


LAWS = {
    # Depth from d0 = 2 gaps, where the spring bears the weight w: k depth = w, …
    "linear": lambda k, w: w / k,
    # … k1 (1 / s - 1 / d0) = w with k1 = k d0^2 / 4.
    "reciprocal": lambda k, w: 2 * GAP - 1 / (1 / (2 * GAP) + w / (k * GAP**2)),
}


@pytest.mark.parametrize("law", LAWS)
def test_a_sheet_lies_as_deep_as_the_stiffness_says(law):
    """Every node bears its area: to 1e-9 of the gap."""
    stiffness, load = 4e4, PER_AREA * GRAVITY
    made = over_a_table(
        flat(0.0025, viscosity=damped(40.0, 0.0)),
        gap=GAP,
        stiffness=stiffness,
        contact=method("penalty", penalty=law),
    )
    simulation = made.compile()
    run(simulation, 1.5)
    expected = 2 * GAP - LAWS[law](stiffness, load)
    assert heights(simulation) == pytest.approx(expected, abs=1e-9 * GAP)
    assert simulation.force_on("table").force[2] == pytest.approx(-load * 0.01, rel=1e-9)


def test_stiffness_from_the_masses_is_a_third_of_the_fastest_vibration():
    """g = omega^2 / 3 depth, omega = 2 / h of the sheet alone; both are known to 1e-4."""
    made = over_a_table(flat(0.003), gap=GAP, contact=method("penalty"))
    alone = made.replace(contacts=[], contact=None).compile()
    omega = 2 / alone.stable_step
    # k / m <= omega^2 / 3, and twice the damping 0.2 of it: h^2 w^2 + 2 h c = 4.
    simulation = made.compile()
    damping = 0.4 * omega / math.sqrt(3)
    square = 4 / 3 * omega**2
    limit = (math.sqrt(damping**2 + 4 * square) - damping) / square
    assert simulation.stable_step == pytest.approx(limit, rel=1e-3)
    run(simulation, 1.0)
    depth = 2 * GAP - heights(simulation)
    assert depth == pytest.approx(3 * GRAVITY / omega**2, rel=1e-3)


@pytest.mark.parametrize("name", METHODS)
def test_each_joint_of_a_stack_carries_what_lies_above(name):
    """In the mean over 0.3 s: the blocks hum by some g dt, which is 1e-3 m/s here."""
    bodies = {
        f"c{k}": block((0.004 * k, 0.003 * k, 0.002 + 0.053 * k), size=(0.05,) * 3,
                       cells=(2 + k % 2,) * 3, young=1e5, viscosity=damped(10.0, 1e-4))
        for k in range(3)
    }  # fmt: skip
    pairs = [("c0", "table"), ("c0", "c1"), ("c1", "c2")]
    simulation = ts.Scene(
        bodies=bodies,
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(pair, friction=0.5, gap=GAP) for pair in pairs],
        contact=method(name),
        gravity=(0, 0, -GRAVITY),
        step=ts.SymplecticEuler("2e-4 s"),
    ).compile()
    run(simulation, 0.6)
    before = {body: simulation.positions[body].mean(axis=0) for body in bodies}
    joints = np.zeros(2)
    steps = 1500
    for _ in range(steps):
        audited(simulation, 1)
        joints += [between(simulation, f"c{k}", f"c{k + 1}")[2] for k in range(2)]
    load = weight((0.05,) * 3)
    assert joints / steps == pytest.approx([-2 * load, -load], rel=5e-3)
    for body in bodies:  # it stands: half a percent of the width
        drift = simulation.positions[body].mean(axis=0) - before[body]
        assert np.abs(drift).max() < 2.5e-4


# Bounces.


@pytest.mark.parametrize("e", [0.15, 0.5, 1.0])
def test_a_damper_gives_back_its_restitution(e):
    """Schwager and Poeschel's closed form, without gravity; h omega = 2e-3 bounds the error."""
    start = ts.Start(velocity=(0, 0, -1))
    made = over_a_table(
        flat(0.006, start=start), step=ts.SymplecticEuler("2e-6 s"), gravity=None,
        gap="2 mm", restitution=e, stiffness="1e6 Pa/m", contact=method("penalty"),
    )  # fmt: skip
    simulation = made.compile()
    while simulation.time < 8e-3:
        simulation.step()
    assert simulation.velocities["body"][:, 2] == pytest.approx(e, abs=2e-3)


@pytest.mark.parametrize("e", [0.3, 0.7, 1.0])
def test_impulses_bounce_to_e_squared_of_the_height(e):
    """Each bounce forgets at most the way of a step: 2 g h / v of the height, in 1 + e^2 + …"""
    height, h = 0.02, 2e-5
    made = over_a_table(
        flat(0.002 + height), step=ts.SymplecticEuler(h), gap=GAP, restitution=e,
        contact=method("impulse"),
    )  # fmt: skip
    simulation = made.compile()
    tops, rising = [], False
    while len(tops) < 3:
        simulation.step()
        speed = simulation.velocities["body"][:, 2].mean()
        if rising and speed <= 0:
            tops.append((heights(simulation).mean() - GAP) / height)
        rising = speed > 0
    for k, top in enumerate(tops):
        low = e ** (k + 1) * math.sqrt(2 * GRAVITY * height)
        assert top == pytest.approx(e ** (2 * k + 2), rel=4 * (k + 1) * GRAVITY * h / low)
        assert top <= e ** (2 * k + 2) * (1 + GRAVITY * h / low)


# Momentum and energy.

LENGTH = {ts.SymplecticEuler: "2e-4 s", ts.RK2: "1e-4 s", ts.RK4: "2e-4 s"}
"""Of a step."""


@pytest.mark.parametrize("friction", [0.0, 0.4])
@pytest.mark.parametrize("step", LENGTH)
@pytest.mark.parametrize("name", ALL)
def test_a_free_collision_keeps_momentum_and_gains_no_energy(name, step, friction):
    """Momentum to 1e-12 of that of one cube. Energy: symplectic Euler's own swings by h omega."""
    made = collision(ts.ImplicitEuler("1 ms"), friction=friction)
    made = made.replace(step=step(LENGTH[step]), contact=method(name))
    simulation = made.compile()
    start, energy = momentum(simulation), simulation.energy()["total"]
    felt = 0.0
    while simulation.time < 0.15:
        report = audited(simulation, 1)
        assert report.held_back == 0
        force = simulation.force_on("a").force
        felt = max(felt, np.abs(force).max())
        assert np.abs(force + simulation.force_on("b").force).max() <= 1e-12 * felt
        assert simulation.energy()["total"] <= energy * (1 + 5e-3)
    assert felt > 5.0
    assert np.abs(momentum(simulation) - start).max() <= 1e-12


# Friction.


def on_a_slope(tangent, name, **fields):
    phi = math.atan(tangent)
    return over_a_table(
        block((0, 0, 1.9e-3 if name == "penalty" else 1e-3), viscosity=damped(0.0, 0.002)),
        gap=GAP, friction=MU, contact=method(name),
        gravity=(GRAVITY * math.sin(phi), 0, -GRAVITY * math.cos(phi)), **fields,
    )  # fmt: skip


def speed_of(simulation):
    return simulation.velocities["body"].mean(axis=0)[0]


@pytest.mark.parametrize("name", METHODS)
def test_below_its_angle_nothing_creeps(name):
    """1e-8 m in a second: penalty's friction holds by a spring, not by a damper."""
    simulation = on_a_slope(0.45, name).compile()
    run(simulation, 6.0)
    start = simulation.positions["body"].copy()
    run(simulation, 7.0)
    assert np.abs(simulation.positions["body"] - start).max() < 1e-8


@pytest.mark.parametrize("name", ALL)
def test_above_its_angle_it_slides_with_the_acceleration_of_coulomb(name):
    simulation = on_a_slope(0.55, name).compile()
    run(simulation, 1.5)
    speed, time = speed_of(simulation), simulation.time
    run(simulation, 2.5)
    phi = math.atan(0.55)
    expected = GRAVITY * (math.sin(phi) - MU * math.cos(phi))
    found = (speed_of(simulation) - speed) / (simulation.time - time)
    assert found == pytest.approx(expected, rel=1e-4)
    found = simulation.contacts()
    assert found.sliding.all()
    slide = np.hypot(*found.forces[:, :2].T)
    assert slide == pytest.approx(MU * found.forces[:, 2], rel=1e-6)


@pytest.mark.parametrize("name", ALL)
def test_a_block_slides_to_rest(name):
    """v0^2 / (2 mu g) less h v0 / 2 of the method; 0.5 %: it shears before all of it slides."""
    speed, h = 1.0, 2e-4
    body = block((0, 0, 1.95e-3 if name == "penalty" else 1e-3), young=1e6,
                 start=ts.Start(velocity=(speed, 0, 0)))  # fmt: skip
    made = over_a_table(
        body, step=ts.SymplecticEuler(h), gap=GAP, friction=MU, contact=method(name)
    )
    simulation = made.compile()
    run(simulation, 1.3 * speed / (MU * GRAVITY))
    way = simulation.displacements("body")[:, 0].mean()
    assert way == pytest.approx(speed**2 / (2 * MU * GRAVITY) - h * speed / 2, rel=5e-3)


@pytest.mark.parametrize("name", ALL)
def test_a_belt_takes_a_block_along(name):
    """With mu g up to the speed of the belt, and no faster. 2 %: it shears and swings at first."""
    speed, h = 0.5, 2e-4
    path = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (speed, 0, 0)))
    body = block((0, 0, 1.95e-3 if name == "penalty" else 1e-3), young=1e6,
                 viscosity=damped(0.0, 5e-4))  # fmt: skip
    made = over_a_table(
        body, step=ts.SymplecticEuler(h), gap=GAP, friction=MU, contact=method(name)
    ).replace(obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1), motion=path)})
    simulation = made.compile()
    half = 0.5 * speed / (MU * GRAVITY)
    run(simulation, half)
    assert speed_of(simulation) == pytest.approx(0.5 * speed, rel=2e-2)
    force = simulation.force_on("table").force
    assert force[0] == pytest.approx(MU * force[2], rel=1e-3)
    run(simulation, 4 * half)
    assert speed_of(simulation) == pytest.approx(speed, rel=5e-3)


@pytest.mark.parametrize("name", ALL)
def test_a_rope_of_rods_lies_on_two_bars(name):
    """Lines have a radius and no area; 20 cm of rope weigh 0.1 N."""
    mesh = ts.BarMesh(size=(0.2, 0, 0), cells=(10, 0, 0), cell="line", origin=(0, 0, 0.02))
    rope = ts.Body(
        mesh=mesh, law=ts.StVK(young=1e5, poisson=0.3), density=1000.0, section=5e-5,
        viscosity=damped(10.0, 1e-4),
    )  # fmt: skip
    bars = {
        f"bar{k}": ts.CapsuleObstacle(((x, -0.1, 0), (x, 0.1, 0)), "1 cm")
        for k, x in enumerate((0.05, 0.15))
    }
    contacts = [ts.Contact(("rope", tuple(bars)), friction=1.0, gap=GAP)]
    simulation = ts.Scene(
        bodies={"rope": rope}, obstacles=bars, contacts=contacts, contact=method(name),
        gravity=(0, 0, -GRAVITY), step=ts.SymplecticEuler("1e-4 s"),
    ).compile()  # fmt: skip
    run(simulation, 1.5)
    load = 1000.0 * 0.2 * 5e-5 * GRAVITY
    forces = [simulation.force_on(bar).force[2] for bar in bars]
    assert forces == pytest.approx([-0.5 * load] * 2, rel=2e-2)


# Nothing passes.


@pytest.mark.parametrize("step", [ts.SymplecticEuler, ts.RK2, ts.RK4])
@pytest.mark.parametrize("name", ALL)
def test_a_cube_at_100_m_per_s_does_not_pass_a_sheet(name, step):
    mesh = ts.BarMesh(size=(0.3, 0.3, 0), cells=(6, 6, 0), cell="quad", origin=(-0.1, -0.1, -0.02))
    law = ts.StableNeoHooke(young=1e6, poisson=0.3)
    sheet = ts.Body(mesh=mesh, law=ts.StVK(young=1e6, poisson=0.3), density=1000.0, thickness=0.002)
    rims = [ts.Plane(point=(x, 0, 0), normal=(1, 0, 0)) for x in (-0.1, 0.2)]
    simulation = ts.Scene(
        bodies={"sheet": sheet, "cube": block(law=law, start=ts.Start(velocity=(0, 0, -100.0)))},
        fixed=[ts.Fixed("sheet", on=rim) for rim in rims],
        contacts=[ts.Contact(("sheet", "cube"))],
        contact=method(name),
        step=step("1e-5 s"),
    ).compile()
    run(simulation, 4e-3)
    assert simulation.velocities["sheet"][:, 2].min() < -50.0
    assert simulation.velocities["cube"][:, 2].mean() > -99.9


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("speed", [10.0, 100.0])
def test_steps_that_are_too_long_for_a_ball_pass_nothing(name, speed):
    """Through a slab of 1 cm, 10 m/s and 100 m/s in steps of 0.15 ms: 0.06 and 0.6 cells."""
    made = thin_slab().replace(step=ts.SymplecticEuler("0.15 ms"), contact=method(name))
    simulation = made.compile()
    ball = simulation.obstacle("ball")
    ball.move((0, 0, -0.1), over=0.1 / speed)
    most = 0.0
    for _ in range(math.ceil(0.12 / speed / 1.5e-4)):
        simulation.step()
        assert simulation.crossings() == []
        most = max(most, ball.force[2])
    low = ball.place_of(BALL)[2] - 0.02
    under = np.hypot(*(simulation.positions["slab"][:, :2] - BALL[:2]).T) < 0.01
    assert simulation.positions["slab"][under, 2].max() < low + 0.005
    assert most > 5.0


@pytest.mark.parametrize("name", ALL)
def test_a_shell_is_folded_onto_itself(name):
    """The example, in explicit steps: its layers rest on each other, and no way is cut."""
    text = (Path(__file__).parents[2] / "examples/fold.yaml").read_text()
    for old, new in (
        ("cells: [32, 8, 0]", "cells: [16, 4, 0]"),
        ("stiffness: 10 ms", "stiffness: 0.05 ms"),
        ("{type: implicit_euler, dt: 10 ms}", "{type: symplectic_euler}"),
    ):
        assert text.count(old) == 1
        text = text.replace(old, new)
    simulation = ts.Scene.from_yaml_text(f"{text}contact: {{method: {name}}}\n").compile()
    held = 0
    while simulation.time < 1.2:
        held += audited(simulation, 1).held_back
    assert held == 0
    assert np.abs(simulation.velocities["sheet"]).max() < 0.2
    found = simulation.contacts()
    sheet = found.surfaces.index("sheet")
    assert (found.pairs == sheet).all(axis=1).sum() > 10


def test_a_stiffness_that_the_step_does_not_bear_is_taken_in_parts():
    """Two sheets of other cells: more contacts meet at a node than faces look at it."""
    meshes = [
        ts.BarMesh(size=(0.1, 0.1, 0), cells=(n, n, 0), cell="triangle", origin=(0, 0, z))
        for n, z in ((1, 0.01), (7, 0.0145))
    ]
    law = ts.StVK(young=1e4, poisson=0.3)
    start = ts.Start(velocity=(0, 0, -0.5))
    low, high = (
        ts.Body(mesh=m, law=law, density=1000.0, thickness=0.002, start=given)
        for m, given in zip(meshes, (None, start), strict=True)
    )

    def pressed(stiffness):
        return ts.Scene(
            bodies={"low": low, "high": high},
            fixed=[ts.Fixed("low", on=ts.Box(), axes="z")],
            contacts=[ts.Contact(("low", "high"), gap=GAP, stiffness=stiffness)],
            contact=method("penalty"),
            gravity=(0, 0, -GRAVITY),
            step=ts.SymplecticEuler(),
        )

    soft, hard = pressed("1e4 Pa/m").compile(), pressed("1e8 Pa/m").compile()
    assert hard.stable_step < 0.1 * soft.stable_step  # the user's stiffness is in the stable step
    energy, parts = hard.energy()["total"], 1
    while hard.time < 5e-3:
        parts = max(parts, audited(hard, 1).substeps)
        # The penalty's own energy is not counted; nothing else may come of it.
        assert hard.energy()["total"] <= energy * (1 + 1e-2)
    assert parts > 1
    assert hard.velocities["high"][:, 2].mean() > 0.1  # it bounced


# The same bits.

MIDDLE, MORE = 180, 60
"""Steps: to the middle of the second impact, and on."""


def tower(name, **fields):
    """Two cubes, a table and a ball: in the middle of a collision after 0.36 s."""
    settings = {"contact": method(name), **fields}
    return two().replace(step=ts.SymplecticEuler("2 ms"), **settings)


def go(simulation, steps):
    for _ in range(steps):
        simulation.step()
        assert simulation.crossings() == []


@functools.cache
def straight(name):
    simulation = tower(name).compile()
    go(simulation, MIDDLE)
    middle = state(simulation)
    assert np.abs(simulation.force_on("high").force).max() > 0.1 * weight()
    go(simulation, MORE)
    return middle, state(simulation)


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("threads", [2, 4])
def test_any_number_of_threads_gives_the_same_bits(name, threads):
    simulation = tower(name, threads=threads).compile()
    go(simulation, MIDDLE)
    assert state(simulation) == straight(name)[0]


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("search", ["sweep_and_prune", "grid", "octree"])
def test_every_broad_phase_gives_the_same_bits(name, search):
    simulation = tower(name, contact=method(name, broad_phase=search)).compile()
    go(simulation, MIDDLE + MORE)
    assert state(simulation) == straight(name)[1]


@pytest.mark.parametrize("name", ALL)
def test_a_checkpoint_amid_a_collision_goes_on_to_the_bit(name, tmp_path):
    simulation = tower(name).compile()
    go(simulation, MIDDLE)
    simulation.save_checkpoint(tmp_path / "middle")
    other = tower(name).compile(checkpoint=tmp_path / "middle")
    assert state(other) == straight(name)[0]
    go(other, MORE)
    go(simulation, MORE)
    assert state(other) == state(simulation) == straight(name)[1]


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("speed", [0.3, 1.0])
def test_a_landing_in_automatic_steps_gains_no_energy(seed, speed):
    """Blocks that tumble onto a plane keep to the energy that they had, within a fiftieth.

    A step of nine tenths of the stable one leaves no room for what a blow stiffens: 23 of 50 such
    landings gained energy without bound, in steps that were said to be converged. With four fifths,
    250 of 250 gained at most 1.4 %, which symplectic Euler's energy swings by in any case.
    """
    spin = np.random.default_rng(seed).normal(0, 3, 3)
    mesh = ts.bar_mesh(
        size=(0.05, 0.05, 0.05), cells=(3, 3, 3), cell="hexahedron", origin=(0, 0, 0.03)
    )
    body = ts.Body(
        mesh=mesh,
        law=ts.StableNeoHooke(young=5e4, poisson=0.4),
        density=1000,
        start=ts.Start(velocity=(0.3, 0, -speed), spin=tuple(spin)),
    )
    simulation = ts.Scene(
        bodies={"block": body},
        obstacles={"floor": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("block", "floor"), friction=0.4)],
        gravity=(0, 0, -GRAVITY),
        step=ts.SymplecticEuler(),
    ).compile()
    before = simulation.energy()["total"]
    most = before
    while simulation.time < 0.4:
        assert simulation.step().converged and simulation.crossings() == []
        most = max(most, simulation.energy()["total"])
    assert most < 1.02 * before


def test_a_stiffness_that_is_no_number_has_no_stable_step():
    """Neo-Hooke has no energy in a cell that is inside out: the cell is named."""
    mesh = ts.bar_mesh(size=(0.1, 0.05, 0.05), cells=(2, 1, 1), cell="tetra")
    body = ts.Body(mesh=mesh, law=ts.NeoHooke(young=5e3, poisson=0.4), density=1000)
    simulation = ts.Scene(bodies={"bar": body}, step=ts.SymplecticEuler()).compile()
    for _ in range(8):  # the stable step is looked at again in the ninth
        simulation.step()
    simulation.positions["bar"][0] += (0.2, 0.1, 0.1)
    with pytest.raises(ts.Diverged, match=r'is not a number: in cell .* of body "bar"'):
        simulation.step()
