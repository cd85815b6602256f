"""The bar and the planes that bench/seed_cuts.py cuts it with."""

from __future__ import annotations

from typing import Any

import numpy as np
from carriers import SIZE, mesh

import tissu as ts
from tissu.cutting.quality import Quality

CUTS = 40

Array = np.ndarray[Any, Any]


def bar(method: str, *, depth: bool = False, repair: ts.Repair | None = None) -> ts.Simulation:
    """The jittered bar at rest, which nothing holds."""
    body = ts.Body(mesh=mesh(), law=ts.StableNeoHooke(young=5e4, poisson=0.3), density=1000)
    editing = ts.Editing(method=method, room="900 %", depth=depth, repair=repair)
    scene = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(dt=0.01), editing=editing)
    return scene.compile()


def blades() -> list[tuple[Array, Array]]:
    """Points and unit normals of planes in random directions."""
    random = np.random.default_rng(4)
    found = []
    for _ in range(CUTS):
        normal = random.standard_normal(3)
        found.append((random.uniform(0.2, 0.8, 3) * SIZE, normal / np.linalg.norm(normal)))
    return found


def bad(quality: Quality) -> int:
    """Cells of the two types of Forest."""
    return int(quality.has_short_edge.sum() + quality.is_flat.sum())
