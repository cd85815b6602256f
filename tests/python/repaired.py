"""Bodies whose bad cells are repaired after cuts, for the tests of repairs."""

from __future__ import annotations

from typing import Any

import numpy as np

import tissu as ts
from divided import DENSITY, SIZE, bar, jittered, scene, tetrahedra

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
MASS = DENSITY * SIZE[0] * SIZE[1] * SIZE[2]
BLADES = (
    ts.Plane(point=(0.2, 0.05, 0.05), normal=(1.0, 0.4, -0.2)),
    ts.Plane(point=(0.205, 0.05, 0.05), normal=(1.0, -0.3, 0.25)),
    ts.Plane(point=(0.2, 0.05, 0.045), normal=(0.2, 0.1, 1.0)),
)
"""Three cuts through each other leave short edges and flat cells."""


def repairing(
    body: ts.Body | None = None, *, method: str = "subdivide", repair: Any = True, **changes: Any
) -> ts.Scene:
    """A scene whose cuts are repaired; `repair`: the part, or whether there is one."""
    part = (ts.Repair() if repair else None) if isinstance(repair, bool) else repair
    editing = ts.Editing(method=method, room="900 %", repair=part)
    own = bar(mesh=jittered((8, 3, 3), 3)) if body is None else body
    return scene(own, **{"editing": editing} | changes)


def free(body: ts.Body | None = None, **changes: Any) -> ts.Simulation:
    return repairing(body, **{"fixed": [], "gravity": None} | changes).compile()


def bent(simulation: ts.Simulation, curve: float = 0.1) -> ts.Simulation:
    """The bar is drawn and a little bent, and its ends are faster than its middle."""
    x, v = simulation.positions["bar"], simulation.velocities["bar"]
    rest = np.array(x)
    x[:, 0] *= 1.2
    x[:, 1] += curve * rest[:, 0] ** 2
    x[:, 0] -= 2 * curve * rest[:, 0] * (rest[:, 1] - 0.05)
    v[:] = np.cross((0.3, -1.0, 2.0), x) + 4.0 * rest[:, :1] ** 2 * (0.0, 1.0, -1.0)
    return simulation


def bits(simulation: ts.Simulation) -> tuple[bytes, ...]:
    return (
        simulation.positions["bar"].tobytes(),
        simulation.velocities["bar"].tobytes(),
        tetrahedra(simulation).tobytes(),
        np.asarray(simulation.meshes["bar"].points).tobytes(),
    )


def made(report: ts.CutReport) -> ts.Repairs:
    assert report.repairs is not None
    return report.repairs


def run(simulation: ts.Simulation, blades: Any) -> list[ts.CutReport]:
    reports = []
    for blade in blades:
        reports.append(simulation.cut("bar", blade))
        simulation.step()
    return reports
