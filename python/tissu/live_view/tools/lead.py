"""Lead: held or led nodes are moved and turned by a gizmo, as one rigid piece."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.gizmo import Gizmo
from tissu.live_view.tools.tool import Number, Tool

if TYPE_CHECKING:
    from tissu.live_view.pointer import Pointer
    from tissu.simulation import Simulation

_OVER = 50.0
"""Simulated time in which nodes follow the hand [ms]: about that between two of its moves."""


class Lead(Tool):
    """Leads a support of every simulation that is shown; see `Simulation.lead`."""

    name = "lead"
    hint = "Drag an arrow or a ring of a gizmo: the held nodes go with it, as one piece."

    on_bodies = False

    def __init__(self, simulations: Sequence[Simulation]) -> None:
        """Every support that has a name has a gizmo."""
        super().__init__(simulations)
        self.numbers = [Number("follow in", "ms", _OVER, 0.0)]
        self._turned: dict[str, np.ndarray[tuple[int], np.dtype[np.float64]]] = {}

    @classmethod
    def offered(cls, simulation: Simulation) -> bool:
        """Where the scene holds or leads nodes by a name."""
        return bool(names(simulation))

    def press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """A press beside the gizmos does nothing."""

    def gizmos(self, simulations: Sequence[Simulation]) -> list[Gizmo]:
        """One in the middle of the nodes of each support."""
        found = []
        for lane, simulation in enumerate(simulations):
            for name in names(simulation):
                lead = simulation.lead(name)
                if lead.released:
                    self._turned.pop(name, None)
                turned = self._turned.get(name, np.array([1.0, 0.0, 0.0, 0.0]))
                found.append(Gizmo(name, lane, lead.positions.mean(axis=0), turned))
        return found

    def turn(self, simulations: Sequence[Simulation], gizmo: Gizmo) -> None:
        """Lead the nodes to where the gizmo is, by its rotation and displacement from rest."""
        over = self.numbers[0].value
        for simulation in simulations:
            if gizmo.name not in names(simulation):
                continue
            lead = simulation.lead(gizmo.name)
            center = simulation.meshes[lead.body].points[lead.nodes].mean(axis=0)
            angle = 2.0 * math.atan2(float(np.linalg.norm(gizmo.wxyz[1:])), float(gizmo.wxyz[0]))
            axis = gizmo.wxyz[1:] if angle else np.array([0.0, 0.0, 1.0])
            lead.move(
                gizmo.place - center,
                angle=angle - 2.0 * math.pi if angle > math.pi else angle,
                axis=axis,
                center=center,
                over=1e-3 * over if over > 0.0 else None,
            )
        self._turned[gizmo.name] = gizmo.wxyz


def names(simulation: Simulation) -> list[str]:
    """Names of the supports of bodies."""
    scene = simulation.scene
    return [
        str(support.name)
        for support in (*scene.fixed, *scene.prescribed)
        if support.name is not None and support.body in scene.bodies
    ]
