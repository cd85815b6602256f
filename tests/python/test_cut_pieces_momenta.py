"""Cuts that move nodes, and repairs, give each piece back its own momentum."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from piece_momenta import momenta, pieces


@pytest.mark.parametrize(("method", "repair"), [("snap", None), ("snap", 0.3), ("subdivide", 0.3)])
@pytest.mark.parametrize("seed", range(3))
def test_a_piece_at_rest_stays_at_rest(method: str, repair: float | None, seed: int) -> None:
    """A bar in two pieces, of which one rests and one moves, is cut along both.

    The piece at rest has no velocity to change: it stays zero. It had got up to 1.5e-3 of the
    momentum of the other. Of this the cut keeps the momenta to round-off: 1e-12 of sums of a few
    hundred terms. Cells that are divided change its angular momentum a little, unless moved nodes
    give it back.
    """
    random = np.random.default_rng(seed)
    options: dict[str, Any] = {} if repair is None else {"repair": ts.Repair(below=repair)}
    mesh = ts.bar_mesh(size=(0.06, 0.03, 0.03), cells=(6, 3, 3), cell="tetra")
    law = ts.StableNeoHooke(young=1e4, poisson=0.3)
    simulation = ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=law, density=1000)},
        step=ts.ImplicitEuler("4 ms"),
        editing=ts.Editing(method=method, room=8.0, **options),
    ).compile()
    simulation.cut("bar", ts.Plane((0.03, 0, 0), (1, 0, 0)))
    _, moving = pieces(simulation, "bar")
    x, v = simulation.positions["bar"], simulation.velocities["bar"]
    v[:] = 0.0
    strained = random.normal(scale=5, size=(3, 3))
    v[moving] = (x[moving] - x[moving].mean(axis=0)) @ strained + (1, 0, 0)
    before = momenta(simulation, "bar", moving)
    normal = (0.3 * random.normal(), 1.0, 0.4 * random.normal())
    report = simulation.cut("bar", ts.Plane((0.03, 0.015 + 0.002 * random.normal(), 0.015), normal))
    assert report.nodes_moved or report.repairs
    x, v = simulation.positions["bar"], simulation.velocities["bar"]
    found = pieces(simulation, "bar")
    assert len(found) > 2
    left = np.concatenate([nodes for nodes in found if x[nodes, 0].mean() < 0.03])
    right = np.concatenate([nodes for nodes in found if x[nodes, 0].mean() >= 0.03])
    assert np.abs(v[left]).max() == 0.0
    after = momenta(simulation, "bar", right)
    assert np.linalg.norm(after[0] - before[0]) <= 1e-12 * np.linalg.norm(before[0])
    if method == "snap":
        assert np.linalg.norm(after[1] - before[1]) <= 1e-12 * np.linalg.norm(before[1])
