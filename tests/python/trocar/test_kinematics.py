"""The kinematics of the trocar: differences, closed forms, and what the thesis prints."""

import numpy as np
import pytest

import tissu as ts
from tissu.trocar import kinematics as k


def states(count, seed=1, tilt=70.0):
    """Random q within a tilt [degrees], depths of 20 to 300 mm."""
    random = np.random.default_rng(seed)
    turn = np.radians(tilt)
    low, high = [-turn, -turn, -3.0, 0.02], [turn, turn, 3.0, 0.3]
    return random.uniform(low, high, (count, 4)), random


def test_jacobian_is_the_derivative_of_the_position():
    # Central differences of step e: error e^2 times third derivatives (of 1 m / rad^3, more towards
    # 70 degrees), and round-off 1e-16 / e: 1e-9 of the largest entry at e = 1e-5.
    e = 1e-5
    qs, random = states(2000)
    for q in qs:
        point = random.uniform(-0.02, 0.02, 3)
        J = k.jacobian(q, k.position(q, point))
        steps = e * np.eye(4)
        differences = np.column_stack(
            [(k.position(q + h, point) - k.position(q - h, point)) / (2 * e) for h in steps]
        )
        assert np.abs(J - differences).max() <= 2e-9 * max(1.0, np.abs(J).max())


def test_turning_is_the_angular_velocity():
    e = 1e-5
    for q in states(500)[0]:
        omega = k.turning(q)
        for axis in range(3):
            h = e * np.eye(4)[axis]
            spin = (k.rotation(q + h) - k.rotation(q - h)) / (2 * e) @ k.rotation(q).T
            found = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
            assert np.abs(found - omega[:, axis]).max() <= 4e-9  # to the fifth power of sec 70


def test_inverse_brings_back_q():
    for q in states(10_000)[0]:
        point = (0.0, 0.0, -0.1)
        back = k.inverse(k.position(q, point), k.rotation(q), point)
        assert np.abs(back - q).max() <= 1e-12


def test_rotation_is_a_rotation_along_the_axis():
    for q in states(200)[0]:
        R = k.rotation(q)
        assert np.abs(R @ R.T - np.eye(3)).max() <= 1e-15
        assert np.linalg.det(R) == pytest.approx(1.0, abs=1e-14)
        assert np.abs(R[:, 2] - k.axis(q)).max() <= 1e-15


def test_power_of_the_motors_is_that_of_the_forces():
    qs, random = states(10_000)
    for q in qs:
        x = k.position(q, random.uniform(-0.02, 0.02, 3))
        f, speed = random.uniform(-5, 5, 3), random.uniform(-1, 1, 4)
        given = f @ (k.jacobian(q, x) @ speed)
        assert k.torques(q, x, f) @ speed == pytest.approx(given, abs=1e-12)


def test_torques_of_a_force_on_the_axis_in_closed_form():
    qs, random = states(1000)
    for q in qs:
        f, (a, b, _, r) = random.uniform(-5, 5, 3), q
        n = np.sqrt(1 + np.tan(a) ** 2 + np.tan(b) ** 2)
        along = k.axis(q) @ f
        expected = [
            -(r / (np.cos(a) ** 2 * n)) * (f[1] + np.tan(a) / n * along),
            (r / (np.cos(b) ** 2 * n)) * (f[0] - np.tan(b) / n * along),
            0.0,
            along,
        ]
        assert np.abs(k.torques(q, k.position(q), f) - expected).max() <= 1e-13


@pytest.mark.parametrize(
    ("tilt", "first", "second"), [(0, 1.0, 1.0), (45, 1.155, 0.667), (70, 2.13, 0.53)]
)
def test_singular_values_and_area_of_pitch_and_roll(tilt, first, second):
    q = np.array([np.radians(tilt), np.radians(tilt), 0.4, 0.2])
    J = k.jacobian(q, k.position(q))[:, :2]
    found = np.linalg.svd(J, compute_uv=False) / q[3]
    assert found == pytest.approx([first, second], abs=5e-3)  # as printed, to three digits
    n = np.sqrt(1 + 2 * np.tan(q[0]) ** 2)
    area = np.linalg.norm(np.cross(J[:, 0], J[:, 1]))
    assert area == pytest.approx(q[3] ** 2 / (np.cos(q[0]) * np.cos(q[1])) ** 2 / n**3, rel=1e-12)


def errors_of_printed(tilt):
    """Relative error of the tip force that the printed pitch and roll torques make."""
    random, errors = np.random.default_rng(3), []
    for _ in range(4000):
        way = random.uniform(0, 2 * np.pi)
        slope = np.tan(np.radians(tilt)) * np.array([np.cos(way), np.sin(way)])
        q = np.array([-np.arctan(slope[1]), np.arctan(slope[0]), 0.0, 0.2])
        # The rollers and pitch and roll make a force at the tip; the own rotation makes none.
        J = k.jacobian(q, k.position(q))[:, [0, 1, 3]]
        f = random.normal(size=3)
        printed = np.append(k.printed_torques(q, f)[:2], k.axis(q) @ f)
        made = np.linalg.solve(J.T, printed)
        errors.append(np.linalg.norm(made - f) / np.linalg.norm(f))
    return np.array(errors)


def test_printed_torques_are_wrong_away_from_the_axis():
    """The thesis' torques (5.6, 5.10): right at rest, a third wrong in the median at 45 degrees."""
    assert errors_of_printed(0.0).max() <= 1e-12
    assert np.median(errors_of_printed(10.0)) == pytest.approx(0.013, abs=0.003)
    at_45 = errors_of_printed(45.0)
    assert np.median(at_45) == pytest.approx(0.34, abs=0.03)
    assert at_45.max() == pytest.approx(1.0, abs=0.05)


def test_printed_own_rotation_is_not_zero_for_a_force_through_the_axis():
    """5 N sideways at 0.2 m asks for 1.0 N m at 45 degrees, of a motor that has 0.2."""
    q = np.array([0.0, np.radians(45.0), 0.0, 0.2])
    sideways = 5.0 * np.array([0.0, 1.0, 0.0])
    assert abs(k.printed_torques(q, sideways)[2]) == pytest.approx(1.0, abs=0.01)
    assert abs(k.torques(q, k.position(q), sideways)[2]) <= 1e-15


def test_own_rotation_unwraps():
    turns = np.linspace(0.0, 20.0, 400)
    found = 0.0
    for angle in turns:
        found = k.unwrapped(np.arctan2(np.sin(angle), np.cos(angle)), found)
        assert found == pytest.approx(angle, abs=1e-12)


def test_a_tool_that_points_out_of_the_body_is_refused():
    with pytest.raises(ts.ParameterError, match="does not point into the body"):
        k.inverse((0.0, 0.0, 0.1), np.diag([1.0, -1.0, -1.0]))
    with pytest.raises(ts.ParameterError, match="off the tool's axis"):
        k.inverse((0.0, 0.0, 0.1), np.eye(3), (0.01, 0.0, 0.0))
