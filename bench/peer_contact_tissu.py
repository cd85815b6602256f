"""tissu on the scenes of `tissu bench contact`, for bench/contact_peers.py."""

from __future__ import annotations

import numpy as np
from peer_contact_work import GAP, Audit, Bodies, split
from peer_tissu import version
from peer_work import Facts, Work

__all__ = ["WAYS", "make", "version"]
WAYS = {"defaults": Facts("stable neo-Hooke", "all defaults: backward Euler of 10 ms, gap of 2 %")}


class Case:
    """A case of tissu.contact_cost with the work's mesh, at all defaults."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is "SCENE; SETTINGS"."""
        import tissu as ts
        from tissu.contact_cost import CASES

        setup, _ = split(way)
        bodies = Bodies(work, setup)
        gap = GAP * bodies.edge
        self._audit = Audit(bodies, setup, work.dt, thickness=(gap, gap))
        scene = CASES[way.partition("; ")[0]]().scene()
        cells = (ts.CellBlock("tetra", bodies.tetrahedra),)
        given = {
            name: body.replace(mesh=ts.Mesh(points=points, cells=cells))
            for (name, body), points in zip(scene.bodies.items(), bodies.points, strict=True)
        }
        self._simulation = scene.replace(bodies=given).compile()
        self._unsolved = 0

    def step(self) -> None:
        """10 ms."""
        self._unsolved += not self._simulation.step().converged

    def seen(self) -> list[float]:
        """As Audit.seen says."""
        up = -float(self._simulation.force_on("floor").force[2])
        touches = len(self._simulation.contacts().gaps) > 0
        return self._audit.seen(np.stack(list(self._simulation.positions.values())), touches, up)

    def unsolved(self) -> int | None:
        """Steps that did not converge."""
        return self._unsolved


def make(work: Work, way: str) -> Case:
    """The scene."""
    return Case(work, way)
