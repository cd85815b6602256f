"""Which contacts of a tool the ticks are given, where they cannot have all."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tissu.trocar.touched import Touched, merged


def _place(point: Any, normal: Any, force: float) -> Touched:
    n = np.array(normal) / np.linalg.norm(normal)
    return Touched("block", np.array([7]), np.ones(1), np.array(point), n, force * n, 0.2, 0.0)


def test_contacts_become_one_only_where_they_press_the_same_way() -> None:
    """Two walls at one place stay two; near each other with one normal they are one, in balance."""
    walls = [_place((0, 0, 0), (1, 0, 1), 3.0), _place((0, 0, 0), (-1, 0, 1), 2.0)]
    assert len(merged(walls, 8)) == 2
    (one,) = merged([_place((0, 0, 0), (0, 0, 1), 3.0), _place((1e-3, 0, 0), (0, 0, 1), 1.0)], 8)
    np.testing.assert_allclose(one.force, (0, 0, 4.0), rtol=1e-15)
    np.testing.assert_allclose(one.point, (0.25e-3, 0, 0), rtol=1e-15)  # no torque is lost
    assert one.weights.sum() == pytest.approx(1.0, rel=1e-15)


def test_too_many_contacts_become_eight_with_the_same_force() -> None:
    """A hundred around a sphere: force and torque stay, as far as a contact is one point."""
    generator = np.random.default_rng(3)
    ways = generator.normal(size=(100, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    ways[:, 2] = np.abs(ways[:, 2])
    many = [_place(-0.02 * way, way, size) for way, size in zip(ways, range(1, 101), strict=True)]
    kept = merged(many, 8)
    assert len(kept) == 8
    total = np.sum([one.force for one in many], axis=0)
    np.testing.assert_allclose(np.sum([one.force for one in kept], axis=0), total, rtol=1e-12)
    for one in kept:  # each is still a push along its normal: within 3 per cent of its force
        along = one.force @ one.normal
        assert along > 0.97 * np.linalg.norm(one.force)
