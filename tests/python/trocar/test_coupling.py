"""The virtual coupling: what stiffness is passive, what it shows, and how forces follow from depth."""

import numpy as np
import pytest
from ticked import AT, COUNT, STIFFNESS, Driver, floor, free_settings, model

import tissu as ts
from tissu import _haptic as haptic

VISCOUS, COULOMB = [0.03, 0.03, 1e-3, 1.0], [6e-3, 6e-3, 1e-3, 0.3]


def passive(**changes):
    fields = {"viscous": VISCOUS, "coulomb": COULOMB, "count_size": COUNT, "period": 1e-3, "delay": 0.0}
    return haptic.passive_stiffness(**(fields | changes))


def test_passive_stiffness_of_the_simulated_device():
    assert passive() == pytest.approx([48.0, 48.0, 1.6, 1600.0], rel=1e-12)
    assert passive(delay=1e-3) == pytest.approx(passive() / 3.0, rel=1e-12)
    assert passive(delay=5e-3) == pytest.approx(passive() / 11.0, rel=1e-12)
    # Large counts: Abbott and Okamura's bound is the smaller one.
    coarse = passive(count_size=[0.01, 0.01, 0.01, 1e-2], margin=1.0)
    assert coarse == pytest.approx(2 * np.array(COULOMB) / 0.01, rel=1e-12)


@pytest.mark.parametrize("wrong", [{"viscous": [0, 1, 1, 1]}, {"period": 0.0}, {"delay": -1.0}])
def test_a_device_that_has_no_passive_stiffness_is_refused(wrong):
    with pytest.raises(ts.ParameterError, match="above 0"):
        passive(**wrong)


@pytest.mark.parametrize("counts", [1, 5])
@pytest.mark.parametrize("factor", [0.5, 1.0, 1.5])
def test_zigzag_wall_gives_out_what_the_formula_says(counts, factor):
    # The tool at +-X around a depth in the wall at each tick, on a straight line between: under sample
    # and hold the wall gives out 2 X^2 K a tick, the device's viscous friction takes 4 X^2 b / T.
    period, X = 1e-3, counts * COUNT[3]
    b = 1600.0 * period / 2.0 / factor  # K = factor times Colgate's limit 2 b / T
    driver = Driver(free_settings(viscous=[0.03, 0.03, 1e-3, 10.0]))
    wall = floor(1, 0.19)
    out = []
    for k in range(40):
        out.append(driver.at([0.0, 0.0, 0.0, 0.2 + (-1) ** k * X], wall)["given_out"])
    a_tick = (out[-1] - out[-21]) / 20.0
    assert a_tick == pytest.approx(2 * X**2 * 1600.0, rel=1e-9)
    net = a_tick - 4 * X**2 * b / period
    assert net == pytest.approx(2 * X**2 * (1600.0 - 2 * b / period), abs=1e-9 * a_tick)
    assert np.sign(round(net / a_tick, 9)) == np.sign(factor - 1.0)


def spectral_radius(K, b, m, period, delay):
    """Of a mass with viscous friction on a sampled spring whose force comes after a delay.

    State: x, v and the samples that are still on the way. Between ticks the motion is exact.
    """
    whole = int(delay // period + 1e-9)
    late = delay - whole * period

    def motion(time):
        decay = np.exp(-b * time / m)
        A = np.array([[1.0, (1 - decay) * m / b], [0.0, decay]])
        push = np.array([time / b - (1 - decay) * m / b**2, (1 - decay) / b])
        return A, push

    size = 2 + whole + 1
    S = np.zeros((size, size))  # x, v, sample before, the one before it, ...
    A1, f1 = motion(late) if late > 1e-15 else (np.eye(2), np.zeros(2))
    A2, f2 = motion(period - late)
    first, second = np.zeros(size), np.zeros(size)  # samples that act before and after `late`
    sample = np.zeros(size)
    sample[0] = 1.0
    past = [sample, *(np.eye(size)[2 + i] for i in range(whole + 1))]
    second += past[whole]
    first += past[whole + 1]
    S[:2, :2] = A2 @ A1
    S[:2] += np.outer(-K * (A2 @ f1), first) + np.outer(-K * f2, second)
    S[2] = sample
    for i in range(whole):
        S[3 + i, 2 + i] = 1.0
    return np.abs(np.linalg.eigvals(S)).max()


@pytest.mark.parametrize("delay", [0.0, 1e-3, 5e-3])
def test_the_linear_loop_is_at_the_limit_of_stability(delay):
    # m = 1 kg, b T / m = 1e-3: the limit b / (T/2 + t_d) is exact to the order of b (T + t_d) / m.
    limit = passive(
        viscous=[1.0] * 4, coulomb=[1e9] * 4, count_size=[1.0] * 4, delay=delay, margin=1.0
    )[3]
    assert limit == pytest.approx(1.0 / (0.5e-3 + delay), rel=1e-12)
    assert spectral_radius(0.98 * limit, 1.0, 1.0, 1e-3, delay) < 1.0
    assert spectral_radius(1.02 * limit, 1.0, 1.0, 1e-3, delay) > 1.0


@pytest.mark.parametrize("w", [0.0, 1e-4, 0.03])
def test_one_contact_is_a_spring_in_series(w):
    random = np.random.default_rng(3)
    for _ in range(20):
        n = random.normal(size=3)
        n /= np.linalg.norm(n)
        driver = Driver(free_settings())
        G = n @ haptic.jacobian(AT, np.zeros(3))
        depth = random.uniform(1e-4, 2e-3)
        report = driver.at(AT, model(1, anchor=[np.array([0, 0, 0.2]) + depth * n], normal=[n], W=w))
        expected = depth / (w + G @ (G / STIFFNESS))
        assert report["force"] @ n == pytest.approx(expected, rel=1e-12)
        assert report["torque"] == pytest.approx(expected * G, rel=1e-11, abs=1e-13)
        assert report["stored"] == pytest.approx(0.5 * expected * depth, rel=1e-12)


def test_no_compliance_shows_more_than_the_coupling():
    # Woodbury: G^T (W + G K^-1 G^T)^-1 G <= K for any W >= 0; of W = 0 on four rows it is K itself.
    random = np.random.default_rng(4)
    for _ in range(200):
        n = int(random.integers(1, 9))
        root = random.normal(size=(3 * n, int(random.integers(1, 3 * n + 1))))
        W = root @ root.T * 10.0 ** random.uniform(-8, -2)
        l = random.uniform(-0.01, 0.01, (n, 3))
        normals = random.normal(size=(n, 3))
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        made = model(1, anchor=np.zeros((n, 3)), normal=normals, W=W, l=l)
        made.settle_compliance()
        G, _b, A = haptic.patch_of(made, haptic.Settings(), AT)
        A = A[: 3 * n, : 3 * n]
        shown = G.T @ np.linalg.lstsq(A, G, rcond=1e-13)[0]
        scaled = np.diag(STIFFNESS**-0.5) @ shown @ np.diag(STIFFNESS**-0.5)
        # Round-off of the solve, relative to K: the condition number of A times 1e-16.
        assert np.linalg.eigvalsh(0.5 * (scaled + scaled.T)).max() <= 1.0 + 1e-5
        assert np.linalg.eigvalsh(A).min() >= -1e-12 * np.abs(A).max()


def test_stops_and_contacts_together_show_no_more_than_the_coupling():
    driver = Driver(free_settings())
    end = np.array([0.0, 0.0, 0.0, 0.3])
    beyond = end + [0, 0, 0, 0.004]
    driver.at(end - [0, 0, 0, 0.001])
    only_stop = driver.at(beyond)["torque"][3]
    assert only_stop == pytest.approx(-1600.0 * 0.004, rel=1e-12)
    both = driver.at(beyond, floor(1, 0.301, q_ref=end))["torque"][3]
    assert both == pytest.approx(-1600.0 * 0.004, rel=1e-9)  # the stop is deeper: it bears all
    wall = driver.at(beyond, floor(2, 0.298, q_ref=end))["torque"][3]
    assert wall == pytest.approx(-1600.0 * 0.006, rel=1e-9)  # not 1600 * 0.010
