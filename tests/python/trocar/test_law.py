"""The NumPy law of a tick against the C++ tick, and against closed forms.

Forces are solved for to round-off on both sides (tolerance 1e-15), so that the two agree to 1e-12
of torques of about 1 N m, though they solve for the direction of slip in different ways.
"""

import numpy as np
import pytest
import runs

from tissu.trocar import kinematics
from tissu.trocar.model import Blade, LocalModel
from tissu.trocar.states import Reason, State, Status

TOLERANCE = 1e-12


def palpation(n):
    """Joints (n, 4) of a tool that goes in and out, turns and sweeps."""
    t = np.arange(n) * runs.PERIOD
    return np.column_stack(
        [0.1 * np.sin(3 * t), 0.2 + 0.05 * np.cos(5 * t), 0.3 * t, 0.12 + 0.004 * np.sin(20 * t)]
    )


def worst(rows):
    """Largest difference of the commands, and of the tanks; states have to be equal."""
    for command, other, report, state, tank in rows:
        assert report["state"] == state
        assert np.abs(command - other).max() <= TOLERANCE
        assert report["tank"] == pytest.approx(tank, abs=TOLERANCE)
    return max(np.abs(command).max() for command, *_ in rows)


@pytest.mark.parametrize("contacts", [1, 3, 8])
def test_law_is_the_tick_on_random_patches(contacts):
    random = np.random.default_rng(contacts)
    n = 240 if contacts < 8 else 80
    q = palpation(n)
    models = {k: runs.walls(random, q[k], contacts) for k in range(5, n, 40)}
    rows, _ = runs.both(q, models, runs.settings(ramp=0.05))
    assert worst(rows) > 0.05  # forces were felt
    assert any(report["contacts"] > 0 for _, _, report, *_ in rows)


def test_law_is_the_tick_on_a_wall_that_changes_its_stiffness():
    """A wall of 300 to 800 N/m that changes by 30 % every 40 ms, met, slid along and left."""
    n = 700
    t = np.arange(n) * runs.PERIOD
    depth = 0.1 + 0.003 * np.sin(2 * np.pi * 1.5 * t)
    q = np.column_stack([0.02 * np.sin(4 * t), 0.05 * t, 0 * t, depth])
    models = {}
    for k in range(3, n, 40):
        stiffness = 500.0 * (1.3 if (k // 40) % 2 else 0.7)
        models[k] = LocalModel.plane(
            q[k], through=(0, 0, 0.1), normal=(0, 0, -1), stiffness=stiffness, friction=0.3
        )
    rows, _ = runs.both(q, models, runs.settings(ramp=0.1, tank_start=1e-5, tank_cap=1e-4))
    worst(rows)
    assert min(report["share"] for _, _, report, *_ in rows) < 1.0  # the tank held something back


def test_law_is_the_tick_at_end_stops_limits_and_with_all_compensation():
    n = 400
    t = np.arange(n) * runs.PERIOD
    q = np.column_stack(
        [
            np.radians(45) + 0.05 * np.sin(9 * t),
            np.radians(-45) + 0.05 * np.sin(7 * t),
            0.5 * t,
            0.3 + 0.006 * np.sin(8 * t),
        ]
    )
    given = runs.settings(
        ramp=0.02,
        damping=np.array([0.01, 0.01, 1e-4, 0.5]),
        efficiency=np.array([0.8, 0.9, 0.95, 0.7]),
        compensated=np.array([6e-3, 6e-3, 1e-3, 0.3]),
        compensation=0.8,
        tool_mass=0.12,
        gravity=np.array([1.0, -2.0, 9.0]),
        force_limit=2.0,
        slew=0.005,
    )
    rows, _ = runs.both(q, {}, given)
    assert worst(rows) > 0.2
    reports = [report for _, _, report, *_ in rows]
    assert any(report["limited"] for report in reports)
    assert any(report["slewed"] for report in reports)


def test_law_is_the_tick_with_a_blade():
    n = 300
    t = np.arange(n) * runs.PERIOD
    q = np.column_stack([0 * t, 0 * t, 0 * t, 0.1 + 0.004 * np.sin(10 * t)])
    blade = Blade((0, 0, 0), (0, 0, 1), (0, 0, 0.1), compliance=1 / 400.0, limit=0.6)
    models = {k: LocalModel(joints=q[k], blade=blade) for k in (5, 120)}
    rows, _ = runs.both(q, models, runs.settings(ramp=0.05))
    worst(rows)
    # Where it cuts, its limit is felt along the tool: the toughness times the width.
    felt = [report["torque"][3] for _, _, report, *_ in rows]
    assert max(np.abs(felt)) == pytest.approx(0.6, abs=1e-9)


def test_law_is_the_tick_through_faults_of_the_device():
    """Reads that fail, another tag, a jump of counts, a tool that is out, a device that is gone."""
    n = 300
    q = palpation(n)
    q[120:, 0] += 0.2  # a jump: faster than the limit
    q[170:, 3] = 0.01  # out
    flags = np.full(n, runs.HOMED_IN, np.uint16)
    tags = np.ones(n, np.uint64)
    tags[60:63] = 9  # noise
    status = np.zeros(n, np.uint8)
    status[[30, 31, 80]] = Status.none
    status[250:256] = Status.broken
    models = {20: LocalModel.plane(q[20], through=(0, 0, 0.1), normal=(0, 0, -1), stiffness=500)}
    rows, law = runs.both(
        q, models, runs.settings(ramp=0.02), flags=flags, tags=tags, status=status
    )
    worst(rows)
    states = [State[report["state"]] for _, _, report, *_ in rows]
    assert {State.empty, State.contact, State.held, State.fault} <= set(states)
    assert law.reason is Reason.reads_failed
    assert not rows[-1][0].any()  # no torque stays on


def test_one_contact_is_its_depth_over_both_springs():
    """lambda = depth / (w + G K_c^-1 G^T), the tank apart."""
    q = np.array([0.1, -0.2, 0.3, 0.15])
    given = runs.settings(ramp=0.0, tank_gate=False, slew=1.0)
    model = LocalModel.plane(
        q, through=kinematics.position(q) - 0.001, normal=(0, 0, -1), stiffness=400
    )
    at = np.floor(q / runs.COUNTS + 1e-9) * runs.COUNTS  # as the counts say
    _, law = runs.both(np.tile(q, (6, 1)), {1: model}, given)
    G, g0 = model.rows()
    W = model.settled()
    A = W + G @ np.diag(1 / given["stiffness"]) @ G.T
    gap = g0 + G @ (at - q)
    # Without friction the tangents bear nothing, and the normal stands alone.
    assert law.forces[0] == pytest.approx(-gap[0] / A[0, 0], rel=1e-12)
    felt = law.forces[0] * G[0]
    assert law.torque == pytest.approx(felt, rel=1e-12)


def test_what_is_felt_is_never_stiffer_than_the_coupling():
    """K_c - G^T A^-1 G has no eigenvalue below zero, for any compliance (Woodbury)."""
    random = np.random.default_rng(5)
    K = runs.settings()["stiffness"]
    for contacts in (1, 2, 5, 8):
        for _ in range(20):
            model = runs.walls(random, np.array([0.3, 0.2, 0.1, 0.1]), contacts, (10.0, 1e7))
            G, _ = model.rows()
            A = model.settled() + G @ np.diag(1 / K) @ G.T
            left = np.diag(K) - G.T @ np.linalg.solve(A, G)
            scaled = left / np.sqrt(np.outer(K, K))
            assert np.linalg.eigvalsh(scaled).min() >= -1e-9  # cond(A) of 1e5 times round-off


def test_the_hand_still_feels_what_the_slow_step_computed():
    """At the proxy's joints of the slow step, ticks give its forces to 1e-9."""
    q = np.array([0.05, 0.1, 0.0, 0.12])
    K = runs.settings()["stiffness"]
    random = np.random.default_rng(2)
    model = runs.walls(random, q, 2)
    # The slow step: its own forces and proxy, with the device still at q.
    from tissu.trocar.patch import Block, Patch

    G, g0 = model.rows()
    A = model.settled() + G @ np.diag(1 / K) @ G.T
    blocks = [Block("cone", 3 * k, float(model.friction[k])) for k in range(2)]
    forces, _ = Patch(g0, A, blocks).solve(np.zeros(6), sweeps=1000, tolerance=1e-15)
    assert np.abs(forces).max() > 0.01
    at = np.floor(q / runs.COUNTS + 1e-9) * runs.COUNTS
    given = runs.settings(ramp=0.0, tank_gate=False, slew=1.0)
    slow = Patch(g0 + G @ (at - q), A, blocks).solve(np.zeros(6), sweeps=1000, tolerance=1e-15)[0]
    _, law = runs.both(np.tile(q, (5, 1)), {1: model}, given)
    assert np.abs(law.forces[:6] - slow).max() <= 1e-9
