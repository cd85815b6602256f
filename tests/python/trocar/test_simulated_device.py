"""The simulated device: its energy, friction with its sign, encoders, motors and line."""

import numpy as np
import pytest
from ticked import AT, COUNT, EXACT, FREE, LIMIT, Driver, device, floor, hand, model, settings

import tissu as ts
from tissu import _haptic as haptic


def run(made, ticks, **changes):
    return haptic.SteppedLoop(made, settings(**changes)).run(ticks)


def balance(row):
    kinetic, potential, motor, held, friction = row["energy"].T
    return kinetic + potential - motor - held + friction


def test_energy_is_kept_without_friction():
    # Ten seconds on springs (ends without a way between them), with weight, about every axis.
    springs = {"low": AT, "high": AT, "stop_stiffness": [5.0, 5.0, 0.0, 500.0]}
    mechanism = FREE | {"gravity": [0.0, 3.0, 9.0]} | springs
    made = device(mechanism=mechanism)
    made.push(AT, [0.8, -0.6, 20.0, 0.1])
    row = run(made, 10_000, run=False)
    kinetic, potential = row["energy"][:, 0], row["energy"][:, 1]
    assert np.ptp(kinetic) > 0.2 * kinetic.max()  # it moves, and energy goes to and fro
    total = kinetic + potential
    assert np.ptp(total) <= 1e-6 * kinetic.max()


def test_what_works_on_the_tool_is_its_energy():
    # Motors against a wall, a hand with tremor that lets go, all frictions, losses and weight.
    path = [(0, 0, 0, 0.2), (0.3, 0.02, 0.01, 0.2), (0.7, -0.01, 0.03, 0.215), (1.0, 0.0, 0.0, 0.2)]
    mechanism = {"gravity": [0.0, 3.0, 9.0], "efficiency": [1.0, 1.0, 0.95, 0.7]}
    made = device(hand(path, tremor=1e-3, lets_go=0.8), mechanism=mechanism)
    loop = haptic.SteppedLoop(made, settings())
    loop.publish(floor(1, 0.205, friction=0.3, W=1e-4))
    row = loop.run(1000)
    work = np.abs(np.diff(row["energy"][:, 2:], axis=0)).sum()
    assert np.abs(row["energy"][-1, 2:]).min() > 1e-3  # motors, hand and friction all take part
    # The midpoint rule balances to the order of (h omega)^2 of the motion.
    assert np.ptp(balance(row)) <= 1e-6 * work


def test_at_rest_nothing_drifts():
    made = device(mechanism={"gravity": [0.0, 0.0, 0.0]}, line={"substeps": 2})
    row = run(made, 200_000)
    assert np.array_equal(made.joints, AT)
    assert np.array_equal(row["given_out"], np.zeros(200_000))


def test_a_hand_at_rest_holds_it_at_its_place():
    # Balanced tool, friction: the bristles hold what is below f_c, the hand's spring the rest.
    made = device(hand([(0.0, 0.01, 0.0, 0.2)]))
    row = run(made, 3000)
    assert np.abs(row["joints"][-1] - row["joints"][-500]).max() <= 1e-9


def slide(mechanism, force, rate, ticks=20):
    """Acceleration along the depth, mean of the first ticks [m/s^2], and its device."""
    made = device(mechanism=mechanism, line=EXACT)
    made.push(AT, [0.0, 0.0, 0.0, rate])
    haptic.write(made, [0.0, 0.0, 0.0, force, 0.0], enable=True)
    before = made.rates[3]
    for _ in range(ticks):
        haptic.read(made)
    return (made.rates[3] - before) / (ticks * 1e-3), made


MASS = 0.12 + 0.05


@pytest.mark.parametrize("eta", [1.0, 0.7])
def test_losses_have_the_sign_of_the_motion(eta):
    mechanism = FREE | {"efficiency": [1.0, 1.0, 1.0, eta]}
    driving, _ = slide(mechanism, 1.0, 0.1)
    driven, _ = slide(mechanism, 1.0, -0.5)
    assert driving == pytest.approx(eta * 1.0 / MASS, rel=1e-9)
    assert driven == pytest.approx(1.0 / eta / MASS, rel=1e-9)


def test_the_printed_efficiency_makes_the_hand_feel_twice_the_force():
    # Chendeb 2007 (5.8) divides by eta_T = 0.7 always. While the hand drives the motor it then
    # feels F / eta^2 = 2.04 F; ours multiplies there.
    eta, slow, v = [1.0, 1.0, 1.0, 0.7], np.full(4, 1e-3), [0.0, 0.0, 0.0, -0.5]
    ours = haptic.motor_torques(
        tau=[0, 0, 0, 1.0], v=v, slow=slow, efficiency=eta, coulomb=np.zeros(4), share=0.0
    )[3]
    mechanism = FREE | {"efficiency": eta}
    assert slide(mechanism, ours, -0.5)[0] * MASS == pytest.approx(1.0, rel=1e-9)
    assert slide(mechanism, 1.0 / 0.7, -0.5)[0] * MASS == pytest.approx(1 / 0.7**2, rel=1e-9)
    assert slide(mechanism, 1.0, -0.5)[0] * MASS == pytest.approx(1 / 0.7, rel=1e-9)


def test_steady_sliding_meets_viscous_and_coulomb_friction():
    made = device(line=EXACT)
    v = 0.1
    made.push(AT, [0.0, 0.0, 0.0, v])
    haptic.write(made, [0.0, 0.0, 0.0, 1.0 * v + 0.3, 0.0], enable=True)
    for _ in range(20):
        haptic.read(made)  # the bristles are bent after some of their length of 50 um
    before = made.rates[3]
    haptic.write(made, [0.0, 0.0, 0.0, 1.0 * before + 0.3, 0.0], enable=True)
    for _ in range(19):
        haptic.read(made)
    assert made.rates[3] == pytest.approx(before, rel=1e-6)


def test_below_coulombs_force_it_comes_back_to_its_bristles():
    made = device(line=EXACT)
    haptic.write(made, [0.0, 0.0, 0.0, 0.2, 0.0], enable=True)
    for _ in range(2000):
        haptic.write(made, [0.0, 0.0, 0.0, 0.2, 0.0], enable=True)
        haptic.read(made)
    # Dahl: F = f_c (1 - exp(-x / x_s)) on the way in; a force that comes at once carries it
    # further, by the work that is left over, and there it stays.
    way = -5e-5 * np.log(1 - 0.2 / 0.3)
    assert way * 0.9 <= made.joints[3] - 0.2 <= 10 * way
    assert abs(made.rates[3]) <= 1e-6


def test_rollers_slip_above_what_they_pass():
    held, _ = slide(FREE | {"roller_force": 3.0}, 2.0, 0.0)
    slips, tool = slide(FREE | {"roller_force": 3.0}, 4.0, 0.0)
    assert held == pytest.approx(2.0 / MASS, rel=1e-9)
    assert slips == pytest.approx(3.0 / MASS, rel=1e-3)
    _, motor = slide(FREE | {"roller_force": 3.0, "encoder_on_motor": True}, 4.0, 0.0)
    way = 0.5 * (4.0 - 3.0) / 0.05 * 0.02**2  # of the rotor past the tool
    seen = (haptic.read(motor)[1]["counts"][3] - haptic.read(tool)[1]["counts"][3]) * 1e-9
    assert seen == pytest.approx(way * 1.05**2, rel=0.03)


def test_counts_are_rounded_down_and_torques_are_steps_within_the_limits():
    made = device(q=[0.10004, -0.0501, 0.3, 0.20005], mechanism=FREE, line={"motor_lag": 0.0})
    counts = np.array(haptic.read(made)[1]["counts"][:4])
    assert np.array_equal(counts, np.floor(np.array([0.10004, -0.0501, 0.3, 0.20005]) / COUNT))
    haptic.write(made, [7.0, -7.0, 0.1001, 2.0001, 1.0], enable=True)
    haptic.read(made)
    steps = 2 * LIMIT / 4096
    expected = [6.0, -6.0, *(np.round([0.1001, 2.0001] / steps[2:]) * steps[2:])]
    assert made.motor_torque == pytest.approx(expected, rel=1e-12)


def test_motors_lag_and_commands_come_late():
    made = device(mechanism=FREE, line={"torque_bits": 0, "delay": 2e-3})
    haptic.write(made, [0.0, 0.0, 0.0, 1.0, 0.0], enable=True)
    haptic.read(made)
    haptic.read(made)
    assert made.motor_torque[3] == 0.0
    haptic.read(made)
    assert made.motor_torque[3] == pytest.approx(1 - np.exp(-2.0), rel=1e-9)


def test_the_watchdog_cuts_the_motors():
    made = device(mechanism=FREE, line=EXACT)
    haptic.write(made, [0.0, 0.0, 0.0, 1.0, 0.0], enable=True)
    torques = []
    for _ in range(30):
        haptic.read(made)
        torques.append(made.motor_torque[3])
    assert torques[19] == 1.0
    assert torques[21] == 0.0


def test_frames_are_lost_as_often_as_asked_and_the_same_ones_each_time():
    def statuses(seed):
        made = device(line={"lost": 0.3, "seed": seed, "substeps": 1})
        return [haptic.read(made)[0] for _ in range(2000)]

    first = statuses(5)
    assert first == statuses(5)
    assert first != statuses(6)


def test_a_hand_follows_its_path_and_lets_go():
    path = [(0, 0, 0, 0.2), (0.5, 0.03, 0.0, 0.22)]
    made = device(hand(path, lets_go=0.9), mechanism=FREE)
    run(made, 800)
    tip = haptic.point(made.joints, np.zeros(3))
    assert np.abs(tip - [0.03, 0.0, 0.22]).max() <= 5e-4
    run(made, 200)
    assert np.array_equal(made.hand_force, np.zeros(3))


@pytest.mark.parametrize(
    ("part", "wrong"),
    [
        ("mechanism", {"efficiency": [1.0, 1.0, 0.0, 1.0]}),
        ("mechanism", {"mass": -1.0}),
        ("line", {"period": 0.0}),
        ("line", {"lost": 1.5}),
        ("line", {"delay": 1.0}),
    ],
)
def test_a_device_that_cannot_be_is_refused(part, wrong):
    with pytest.raises(ts.ParameterError, match="Simulated device"):
        device(**{part: wrong})


def test_force_at_the_tip_is_the_contacts_force():
    # Static, over the workspace of +-45 degrees: the tip force that the commanded torques make.
    random = np.random.default_rng(8)
    for _ in range(100):
        q = np.array([*random.uniform(-0.75, 0.75, 2), 0.0, random.uniform(0.05, 0.29)])
        q = np.rint(q / COUNT) * COUNT
        n = random.normal(size=3)
        n /= np.linalg.norm(n)
        driver = Driver(settings(ramp=0.0, slew=1.0, tank_gate=False, speed_limit=1e9))
        tip = haptic.point(q, np.zeros(3))
        report = driver.at(q, model(1, q_ref=q, anchor=[tip + 1e-3 * n], normal=[n], W=1e-3))
        made = haptic.Fulcrum().force(q, report["command"][:4])
        assert np.linalg.norm(made - report["force"]) <= 1e-3 * np.linalg.norm(report["force"])


def test_a_hand_that_is_aimed_goes_as_one_along_that_path():
    """Aimed after 0.1 s at a place, which it reaches 50 ms later: the path of the other hand."""
    there = (0.004, -0.002, 0.203)
    path = hand([(0.0, 0, 0, 0.2), (0.1, 0, 0, 0.2), (0.15, *there), (0.3, *there)], smooth=False)
    one, other = device(path), device(hand([(0.0, 0, 0, 0.2)]))
    for tick in range(300):
        if tick == 100:
            other.aim(there, 0.0, 0.05)
        haptic.read(one)
        haptic.read(other)
        np.testing.assert_allclose(other.joints, one.joints, rtol=0, atol=1e-12)
    assert np.abs(other.joints - AT).max() > 1e-3
    other.follow()  # back to its own path, which stands still where it began
    for _ in range(2000):
        haptic.read(other)
    assert other.joints[3] < 0.2005 < one.joints[3]


def test_only_a_hand_that_is_there_is_aimed_at_numbers():
    with pytest.raises(ts.ParameterError, match="has no hand that could be aimed"):
        device().aim((0, 0, 0.2), 0.0, 0.05)
    held = device(hand([(0.0, 0, 0, 0.2)]))
    for tip, over in (((0, 0, np.nan), 0.05), ((0, 0, 0.2), -1.0)):
        with pytest.raises(ts.ParameterError, match="finite, the time at least 0"):
            held.aim(tip, 0.0, over)
