"""The patch solver against solvers of another kind: pivots for rows that push, projection for cones."""

from itertools import product

import numpy as np
import pytest

from tissu import _haptic as haptic


def solved(A, b, kinds, bounds, start=None, sweeps=20_000, tolerance=1e-14):
    start = np.zeros(len(b)) if start is None else start
    return haptic.solve_patch(
        A=A, b=b, kinds=kinds, bounds=bounds, start=start, sweeps=sweeps, tolerance=tolerance
    )


def by_pivots(A, b):
    """0 <= lambda _|_ b + A lambda >= 0: every set of rows that push is tried."""
    n = len(b)
    for active in product([False, True], repeat=n):
        rows = np.flatnonzero(active)
        force = np.zeros(n)
        force[rows] = np.linalg.solve(A[np.ix_(rows, rows)], -b[rows])
        if (force >= -1e-12).all() and (b + A @ force >= -1e-12).all():
            return force
    raise AssertionError("a positive definite matrix has a solution")


def random_definite(random, n, low=-5, high=-2):
    root = random.normal(size=(n, n))
    return (root @ root.T / n + 0.1 * np.eye(n)) * 10.0 ** random.uniform(low, high)


def test_rows_that_push_are_those_of_a_pivoting_solver():
    random = np.random.default_rng(1)
    for _ in range(100):
        n = int(random.integers(1, 7))
        A = random_definite(random, n)
        b = random.normal(size=n) * 1e-3
        force, _sweeps, _change = solved(A, b, ["push"] * n, [0.0] * n)
        expected = by_pivots(A, b)
        assert np.abs(force - expected).max() <= 1e-6 * max(1.0, np.abs(expected).max())


def by_projection(A, b, mu, iterations=60_000):
    """Coulomb's law as a fixed point: lambda = P(lambda - rho (g + mu |g_t| n)), P onto the cone.

    De Saxce and Feng 1998; the projection of a whole step, not of a block.
    """
    n = len(b) // 3
    rho = 0.9 / np.linalg.eigvalsh(A).max()
    force = np.zeros(3 * n)
    for _ in range(iterations):
        g = (b + A @ force).reshape(n, 3)
        g[:, 0] += mu * np.hypot(g[:, 1], g[:, 2])
        tried = force.reshape(n, 3) - rho * g
        normal, size = tried[:, 0], np.hypot(tried[:, 1], tried[:, 2])
        on_cone = (normal + mu * size) / (1 + mu**2)
        inside, polar = size <= mu * normal, mu * size <= -normal
        scale = np.where(inside, 1.0, mu * on_cone / np.maximum(size, 1e-300))
        made = np.column_stack([np.where(inside, normal, on_cone), tried[:, 1] * scale, tried[:, 2] * scale])
        made[polar] = 0.0
        new = made.ravel()
        if np.abs(new - force).max() <= 1e-13 * np.abs(new).max():
            break
        force = new
    return force


@pytest.mark.parametrize("mu", [0.1, 0.5])
def test_cones_are_those_of_a_projecting_solver(mu):
    random = np.random.default_rng(2)
    for _ in range(12):
        n = int(random.integers(1, 5))
        A = random_definite(random, 3 * n, -4, -3) + 1e-3 * np.eye(3 * n)
        b = random.normal(size=3 * n) * 1e-3
        b[::3] -= 1e-3
        force, _sweeps, _change = solved(A, b, ["cone"] * n, [mu] * n)
        expected = by_projection(A, b, mu)
        assert np.abs(force - expected).max() <= 1e-6 * np.abs(expected).max()


def test_coulombs_law_holds_in_every_contact():
    random = np.random.default_rng(5)
    stuck = slid = opened = 0
    for _ in range(200):
        n, mu = int(random.integers(1, 9)), random.uniform(0.05, 0.6)
        A = random_definite(random, 3 * n, -4, -3) + 1e-3 * np.eye(3 * n)
        b = random.normal(size=3 * n) * 1e-3
        force = solved(A, b, ["cone"] * n, [mu] * n)[0].reshape(n, 3)
        gap = (b + A @ force.ravel()).reshape(n, 3)
        size = np.abs(force).max()
        for f, g in zip(force, gap, strict=True):
            across, slip = np.hypot(*f[1:]), np.hypot(*g[1:])
            if f[0] == 0.0:
                opened += 1
                assert g[0] >= -1e-9
            elif across < mu * f[0] * (1 - 1e-9):
                stuck += 1
                assert np.abs(g).max() <= 1e-9 * 1e-3 * max(1.0, size)
            else:
                slid += 1
                assert across / f[0] == pytest.approx(mu, rel=1e-12)  # the ratio is exact
                assert f[1:] @ g[1:] == pytest.approx(-across * slip, rel=1e-6, abs=1e-12)
    assert min(stuck, slid, opened) > 10


def test_a_bounded_row_slips_at_its_bound_only():
    A, kinds = np.array([[2e-3]]), ["bounded"]
    assert solved(A, [-1e-3], kinds, [2.0])[0] == pytest.approx([0.5], rel=1e-12)
    assert solved(A, [-1e-2], kinds, [2.0])[0] == pytest.approx([2.0], rel=1e-12)
    assert solved(A, [1e-2], kinds, [2.0])[0] == pytest.approx([-2.0], rel=1e-12)


def test_a_warm_start_ends_where_a_cold_one_does():
    random = np.random.default_rng(6)
    A = random_definite(random, 12, -4, -3) + 1e-3 * np.eye(12)
    b = random.normal(size=12) * 1e-3
    cold, many, _ = solved(A, b, ["cone"] * 4, [0.3] * 4, tolerance=1e-12)
    warm, few, _ = solved(A, b, ["cone"] * 4, [0.3] * 4, start=cold, tolerance=1e-12)
    assert np.abs(cold - warm).max() <= 1e-9 * np.abs(cold).max()
    assert few < many
