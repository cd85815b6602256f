"""Cuts of Rapier's soft bodies, for bench/cutting.py: `python cutting_rapier.py WORK`.

In any Python that has rapier3d. WORK holds points (n, 3), tetrahedra (e, 4), held nodes, and blades
(k, 3, 3) [m]; each blade cuts a body of its own that has gone five steps of 10 ms. It prints a row
of JSON for each.
"""

from __future__ import annotations

import json
import sys
import time
from importlib.metadata import version

import numpy as np
import rapier3d as rp

BEFORE, AFTER = 5, 10


def milliseconds(world: rp.PhysicsWorld) -> float:
    """Of one step."""
    begun = time.perf_counter()
    world.step()
    return 1e3 * (time.perf_counter() - begun)


def main() -> None:
    """A row for each blade."""
    with np.load(sys.argv[1]) as work:
        points, tetrahedra, held, blades = (
            work[name] for name in ("points", "tetrahedra", "held", "blades")
        )
    for blade in blades:
        world = rp.PhysicsWorld(gravity=(0.0, 0.0, -9.81))
        world.integration_parameters.dt = 0.01
        body = (
            rp.SoftBodyBuilder(points)
            .cells(tetrahedra)
            .solver(rp.SoftBodySolver.FEM)
            .cell_model(rp.SoftBodyCellModel.COROTATIONAL)
            .material(rp.SoftBodyMaterial(young_modulus=5e5, poisson_ratio=0.3))
            .pinned_particles(held.tolist())
            .skin_collision(False)
            .can_sleep(False)
        )
        handle = world.add_soft_body(body)
        before = [milliseconds(world) for _ in range(BEFORE)]
        soft = world.soft_bodies[handle]
        particles = soft.num_particles
        triangle = tuple(tuple(float(x) for x in point) for point in blade)
        crossed = len(soft.crossing_elements(triangle)[1])
        begun = time.perf_counter()
        event = world.cut_soft_body(handle, triangle)
        cut = 1e3 * (time.perf_counter() - begun)
        torn = 0 if event is None else len(event.torn_cells)
        born = world.soft_bodies[handle].num_particles - particles
        after = [milliseconds(world) for _ in range(AFTER)]
        found = {
            "version": version("rapier3d"),
            "cut": cut,
            "crossed": crossed,
            "torn": torn,
            "born": int(born),
            "step": float(np.median(before)),
            "after": float(np.median(after)),
        }
        print(json.dumps(found), flush=True)


if __name__ == "__main__":
    main()
