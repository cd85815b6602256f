"""The tick: what it shows of the tissue, its states, its limits, and what it pays for."""

import numpy as np
import pytest
from scipy.optimize import fsolve
from ticked import (
    AT,
    COUNT,
    LIMIT,
    READY,
    REASONS,
    STATES,
    STIFFNESS,
    Driver,
    across,
    counts_of,
    device,
    floor,
    free_settings,
    hand,
    model,
    settings,
)

import tissu as ts
from tissu import _haptic as haptic


def slow_step(q_d, points, x_free, n, W):
    """The proxy, the tissue's point and the force of a slow step that sticks to the tool.

    The tool is held to q_d by the coupling, its point is where the tissue's is: seven numbers,
    with the Jacobian at the proxy.
    """
    D = np.column_stack([n, across(n), np.cross(n, across(n))])

    def rest(unknown):
        q, force = unknown[:4], unknown[4:]
        J = haptic.jacobian(q, points)
        held = STIFFNESS * (q - q_d) - J.T @ force
        gap = haptic.point(q, points) - (x_free - D @ W @ D.T @ force)
        return np.concatenate([held / STIFFNESS, gap])

    found = fsolve(rest, np.concatenate([q_d, np.zeros(3)]), xtol=1e-13)
    return found[:4], x_free - D @ W @ D.T @ found[4:], D.T @ found[4:]


@pytest.mark.parametrize("depth", [1e-3, 1e-2])
def test_a_hand_that_is_still_feels_the_slow_steps_force(depth):
    random = np.random.default_rng(11)
    for _ in range(10):
        q_d = np.array([*random.uniform(-0.4, 0.4, 2), 0.1, random.uniform(0.1, 0.25)])
        q_d = np.rint(q_d / COUNT) * COUNT
        points = random.uniform(-5e-3, 5e-3, 3)
        n = random.normal(size=3)
        n /= np.linalg.norm(n)
        root = random.normal(size=(3, 3))
        W = 1e-2 * (root @ root.T + 0.2 * np.eye(3))
        q_p, x_c, force = slow_step(q_d, points, haptic.point(q_d, points) + depth * n, n, W)
        # The tissue's point without force is x_c + W lambda: lambda is the force on the tool.
        anchor = x_c + np.column_stack([n, across(n), np.cross(n, across(n))]) @ W @ force
        made = model(
            1, q_ref=q_p, anchor=[anchor], normal=[n], W=W, points=[points], friction=100.0
        )
        driver = Driver(free_settings(tolerance=1e-14, sweeps=200))
        report = driver.at(q_d, made)
        assert np.linalg.norm(force) > 0.01
        shown = [report["force"] @ n, report["force"] @ across(n)]
        assert shown == pytest.approx(force[:2], rel=1e-9, abs=1e-9 * np.linalg.norm(force))


def test_on_coming_in_the_force_grows_from_nothing():
    driver = Driver(settings())
    torques = [driver.at(AT, floor(1, 0.1993))["torque"] for _ in range(400)]
    steps = np.abs(np.diff([np.zeros(4), *torques], axis=0)).max(axis=0)
    assert steps[3] <= 0.2 * 5.0 / 10
    assert torques[0][3] > -0.02
    # 1,600 N/m times 0.7 mm: 0.39 mJ, which the tank has above its reserve.
    assert torques[-1][3] == pytest.approx(-1.12, rel=1e-9)


def test_a_step_of_the_tissue_is_no_jump_of_the_torque():
    driver = Driver(settings(ramp=0.0))
    for _ in range(50):
        driver.at(AT, floor(1, 0.199))
    before = np.array([0, 0, 0, -1.6])
    for stamp in range(2, 60):
        report = driver.at(AT, floor(stamp, 0.199 - 0.0015 * (stamp % 2)))
        change = np.abs(report["torque"] - before)
        assert (change <= 0.2 * LIMIT * (1 + 1e-12)).all()
        before = report["torque"]


def test_the_tank_pays_for_models_that_store_more():
    # The hand is still: no dissipation. All that the model may store more is what the tank has,
    # less its reserve.
    driver = Driver(settings(ramp=0.0))
    start, paid = 1e-3, 0.5e-3
    for stamp in range(1, 40):
        report = driver.at(AT, floor(stamp, 0.2 - 1e-4 * stamp))
        assert report["stored"] + report["tank"] == pytest.approx(start, abs=1e-15)
        assert report["tank"] >= start - paid - 1e-18
        full = 0.5 * 1600.0 * (1e-4 * stamp) ** 2
        assert report["share"] == pytest.approx(min(1.0, np.sqrt(paid / full)), rel=1e-6)
    soft = driver.at(AT, floor(100, 0.2 - 5e-4))
    assert soft["stored"] == pytest.approx(2e-4, rel=1e-9)
    assert soft["tank"] == pytest.approx(8e-4, rel=1e-6)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_what_is_given_out_is_paid(friction):
    # A hand moves as it likes, models come and go: the work that the port gives out, exact under
    # sample and hold, never exceeds the tank's start plus 80 % of what the device dissipates, less
    # what is stored.
    random = np.random.default_rng(21)
    driver = Driver(settings(ramp=0.0))
    q = np.array(AT)
    tau = np.zeros(4)
    out, lost, stamp = 0.0, 0.0, 0
    for k in range(3000):
        if k % 40 == 0:
            stamp += 1
            points = np.zeros((2, 3))
            points[1, 0] = 2e-3
            made = model(
                stamp,
                q_ref=q,
                anchor=[
                    [0, 0, 0.2 + random.uniform(-2e-3, 1e-3)],
                    [2e-3, 0, 0.2 + random.uniform(-2e-3, 1e-3)],
                ],
                normal=[[0, 0, -1], [0.3, 0, -np.sqrt(1 - 0.09)]],
                friction=friction,
                W=10.0 ** random.uniform(-5, -2),
                points=points,
            )
        step = np.rint(np.array([2, 2, 0, 3]) * np.sin(0.02 * k + np.arange(4))) * COUNT
        report = driver.at(q + step, made)
        out += tau @ step
        v = report["speed"]
        lost += 1e-3 * ([0.03, 0.03, 1e-3, 1.0] @ v**2 + [6e-3, 6e-3, 1e-3, 0.3] @ np.abs(v))
        q = q + step
        tau = report["torque"]
        assert report["given_out"] == pytest.approx(out, rel=1e-9, abs=1e-12)
        if report["tank"] >= 0:
            assert out <= 1e-3 + 0.8 * lost - report["stored"] + 1e-9


def test_friction_slides_and_sticks():
    # Pressed into a plane that does not give way, then moved along it.
    driver = Driver(free_settings())
    wall = floor(1, 0.199, friction=0.3)
    driver.at(AT, wall)
    normal = 1.6
    forces = []
    for step in [1, 2, 4, 40, 80, 120, 119, 118, 70]:
        forces.append(driver.at([0.0, step * COUNT[1], 0.0, 0.2], wall)["force"])
    forces = np.array(forces)
    across_ = -forces[:, 0]
    assert forces[:, 2] == pytest.approx(np.full(9, -normal), rel=1e-9)
    assert across_[:3] == pytest.approx(1200.0 * 0.2 * COUNT[1] * np.array([1, 2, 4]), rel=1e-6)
    assert across_[3:6] == pytest.approx(np.full(3, 0.3 * normal), rel=1e-9)
    # On the way back it first sticks, and less than at the bound.
    assert (np.abs(across_[6:8]) < 0.3 * normal * 0.999).all()
    assert across_[8] == pytest.approx(-0.3 * normal, rel=1e-9)


def test_a_blade_cuts_at_its_toughness():
    driver = Driver(free_settings())
    made = model(1)
    made.set_blade(l=np.zeros(3), way=[0, 0, 1], anchor=[0, 0, 0.2], compliance=1e-3, limit=0.5)
    forces = [driver.at([0, 0, 0, 0.2 + k * 1e-4], made)["torque"][3] for k in range(30)]
    stiff = 1 / (1e-3 + 1 / 1600.0)
    assert forces[3] == pytest.approx(-stiff * 3e-4, rel=1e-9)
    assert forces[-1] == pytest.approx(-0.5, rel=1e-12)
    back = driver.at([0, 0, 0, 0.2 + 28e-4], made)["torque"][3]
    assert back == pytest.approx(-0.5 + stiff * 1e-4, rel=1e-9)


def test_states_come_in_their_order():
    ticks = haptic.Ticks(settings(tag=0, run=False))
    counts = counts_of(AT)
    assert ticks.tick(counts=counts, flags=2 | 4, tag=7)["state"] == "off"
    ticks.set(settings(tag=0))
    assert ticks.tick(counts=counts, flags=2 | 4, tag=7)["state"] == "homing"
    assert ticks.tick(counts=counts, flags=READY, tag=7)["state"] == "empty"
    assert (
        ticks.tick(counts=counts, flags=READY, tag=7)["state"] == "empty"
    )  # not a tool of the settings
    ticks.set(settings())
    assert ticks.tick(counts=counts, flags=READY, tag=8)["state"] == "empty"
    assert ticks.tick(counts=counts, flags=1 | 4, tag=7)["state"] == "empty"  # no power yet
    assert ticks.tick(counts=counts, flags=READY, tag=7)["state"] == "free"
    deep = floor(1, 0.19)
    states = [ticks.tick(counts=counts, flags=READY, tag=7, model=deep)["state"] for _ in range(3)]
    assert states[-1] == "contact"
    out = ticks.tick(counts=counts, flags=1 | 2, tag=0, model=deep)
    assert out["state"] == "empty"
    ticks.set(settings(run=False))
    off = ticks.tick(counts=counts, flags=READY, tag=7, model=deep)
    assert off["state"] == "off"
    assert not off["enable"]
    assert np.array_equal(off["command"], np.zeros(5))


def test_homing_finds_the_zero_of_its_encoders():
    made = device(q=[0.1, -0.2, 0.0, 0.2], line={"unknown_zero": True, "seed": 4})
    drive = {"homing_torque": [0.2, 0.2, 0.0, 2.0]}
    loop = haptic.SteppedLoop(made, settings(**drive))
    row = loop.run(4000)
    assert STATES[row["state"][0]] == "homing"
    assert loop.state in ("empty", "free", "contact")
    error = np.abs(row["q"][-1] - row["joints"][-1])[[0, 1, 3]]
    # It stands against springs at its ends: torque / stiffness beyond them, and two counts.
    assert (error <= np.array([0.2 / 500, 0.2 / 500, 2.0 / 5e4]) + 2 * COUNT[[0, 1, 3]]).all()
    driven = row["state"] == STATES.index("homing")
    # What drives the axes home is not paid by the tank: it is as full as at the start.
    assert row["given_out"][driven] == pytest.approx(0.0, abs=0.0)
    assert row["tank"][driven].min() == row["tank"][0] > 0.0


def test_a_hand_that_holds_the_handle_gives_no_zero():
    held = hand([[0.0, 0.02, 0.0, 0.2], [1.0, 0.02, 0.0, 0.2]])
    made = device(held, q=[0.1, -0.2, 0.0, 0.2], line={"unknown_zero": True, "seed": 4})
    loop = haptic.SteppedLoop(made, settings(homing_torque=[0.2, 0.2, 0.0, 2.0]))
    row = loop.run(4000)
    assert set(row["state"]) == {STATES.index("homing")}
    assert loop.reason == "ends_not_found"
    assert row["torque"].any()  # it goes on trying


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"period": 1 / 200}, "200 Hz; 300 Hz to 10 kHz"),
        ({"stiffness": [100.0, 48.0, 1.6, 1600.0]}, "pitch is 100; at most 60 is passive"),
        ({"slew": 0.0}, "slew"),
        ({"joint_high": [1.5, 0.7, 1e300, 0.3]}, "settings|75 degrees"),
        ({"compensation": 0.9}, "0 to 0.8"),
        ({"viscous": [0.0, 1.0, 1.0, 1.0]}, "Friction"),
    ],
)
def test_settings_that_cannot_be_are_refused(changes, words):
    with pytest.raises(ts.ParameterError, match=words):
        haptic.Ticks(settings(**changes))


def test_several_problems_are_said_at_once():
    with pytest.raises(ts.ParameterError) as error:
        haptic.Ticks(settings(period=1 / 200, slew=0.0, compensation=0.9))
    assert len(str(error.value).splitlines()) >= 3


def test_models_that_are_not_are_refused():
    with pytest.raises(ts.ParameterError, match="at most 8"):
        model(1, anchor=np.zeros((9, 3)), normal=np.tile([0.0, 0, 1], (9, 1)))
    made = model(1, anchor=[[0, 0, 0.2]], normal=[[0, 0, 2.0]])
    with pytest.raises(ts.ParameterError, match="unit vectors"):
        made.check()
    with pytest.raises(ts.ParameterError, match="positive semi-definite"):
        model(1, anchor=[[0, 0, 0.2]], normal=[[0, 0, 1.0]], W=-1.0).check()


def test_the_same_loop_gives_the_same_bits():
    def columns():
        path = [(0, 0, 0, 0.2), (0.4, 0.01, 0, 0.21)]
        made = device(hand(path, tremor=1e-4), line={"lost": 0.05, "jitter": 1e-3, "seed": 3})
        loop = haptic.SteppedLoop(made, settings(stiffness=0.5 * STIFFNESS))
        loop.publish(floor(1, 0.203, friction=0.2))
        return loop.run(600)

    first, second = columns(), columns()
    assert all(np.array_equal(first[name], second[name]) for name in first)
    assert np.abs(first["torque"]).max() > 0.1


def test_own_rotation_goes_on_where_counts_start_again():
    driver = Driver(settings(turn_counts=7200, speed_limit=1e9))
    counts = counts_of(AT)
    turns = []
    for k in range(0, 20_000, 100):
        turns.append(driver.counts([0, 0, k % 7200, counts[3], 0])["q"][2])
    assert turns == pytest.approx(np.arange(0, 20_000, 100) * COUNT[2], abs=1e-9)


def test_windowed_speed_is_that_of_a_line():
    # Exact for a straight line; of a line rounded to counts within a count over the window, and
    # never a count in a tick (0.1 m/s) as count / T would say.
    line = [0.03 * k * 1e-3 for k in range(40)]
    assert haptic.windowed_speed(line, count_size=1e-4, period=1e-3) == pytest.approx(
        0.03, rel=1e-9
    )
    rounded = [1e-4 * np.floor(x / 1e-4) for x in line]
    found = haptic.windowed_speed(rounded, count_size=1e-4, period=1e-3)
    assert abs(found - 0.03) <= 1e-4 / 31e-3
    still = [0.0, 1e-4] * 16
    assert abs(haptic.windowed_speed(still, count_size=1e-4, period=1e-3)) <= 1e-4 / 31e-3 + 1e-12
    assert REASONS[0] == "none"
