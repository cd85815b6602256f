"""Obstacle: obstacles are moved and turned by a gizmo, and push what is in their way."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.live_view.gizmo import Gizmo
from tissu.live_view.layers.grabs import force_text
from tissu.live_view.tools.tool import Number, Tool

if TYPE_CHECKING:
    from tissu.live_view.pointer import Pointer
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]

_OVER = 50.0
"""Simulated time in which an obstacle follows the hand [ms]."""


def _led(simulation: Simulation) -> list[str]:
    """Names of the obstacles without a mass, which may be led; trocars lead their own."""
    scene, taken = simulation.scene, tools_of_trocars(simulation)
    return [
        name
        for name in simulation.obstacles
        if scene.obstacles[name].mass is None and name not in taken
    ]


def tools_of_trocars(simulation: Simulation) -> set[str]:
    """Names of the obstacles and instruments that a trocar of the scene leads."""
    return {name for one in simulation.scene.trocars.values() for name in one.tools.values()}


class MoveObstacle(Tool):
    """Leads an obstacle of every simulation that is shown; see `Simulation.obstacle`."""

    name = "move obstacle"
    hint = "Drag an arrow or a ring of a gizmo: the obstacle goes with it, and says its force."

    on_bodies = False

    def __init__(self, simulations: Sequence[Simulation]) -> None:
        """Every obstacle has a gizmo."""
        super().__init__(simulations)
        self.numbers = [Number("follow in", "ms", _OVER, 0.0)]
        self._origins = {
            name: simulation.obstacle(name).origin
            for simulation in simulations
            for name in _led(simulation)
        }

    @classmethod
    def offered(cls, simulation: Simulation) -> bool:
        """Where bodies meet obstacles that do not move freely."""
        return bool(_led(simulation))

    def press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """A press beside the gizmos does nothing."""

    def gizmos(self, simulations: Sequence[Simulation]) -> list[Gizmo]:
        """One at the origin of each obstacle, turned as the obstacle is."""
        found = []
        for lane, simulation in enumerate(simulations):
            for name in _led(simulation):
                obstacle = simulation.obstacle(name)
                origin = self._origins[name]
                place = obstacle.place_of(origin)
                axes = [obstacle.place_of(origin + axis) - place for axis in np.eye(3)]
                found.append(Gizmo(name, lane, place, quaternion(np.stack(axes, axis=1))))
        return found

    def turn(self, simulations: Sequence[Simulation], gizmo: Gizmo) -> None:
        """Lead the obstacle to where the gizmo is, by its rotation and displacement from rest."""
        over = self.numbers[0].value
        for simulation in simulations:
            if gizmo.name not in _led(simulation):
                continue
            obstacle = simulation.obstacle(gizmo.name)
            center = self._origins[gizmo.name]
            angle = 2.0 * math.atan2(float(np.linalg.norm(gizmo.wxyz[1:])), float(gizmo.wxyz[0]))
            obstacle.move(
                gizmo.place - center,
                angle=angle - 2.0 * math.pi if angle > math.pi else angle,
                axis=gizmo.wxyz[1:] if angle else np.array([0.0, 0.0, 1.0]),
                center=center,
                over=1e-3 * over if over > 0.0 else None,
            )

    def say(self, simulations: Sequence[Simulation]) -> str:
        """The force on each obstacle that is touched; of several simulations beside each other."""
        told = []
        for name in simulations[0].obstacles:
            forces = [
                float(np.linalg.norm(simulation.force_on(name).force))
                for simulation in simulations
                if name in simulation.obstacles
            ]
            if any(forces):
                told.append(f"{name} " + " and ".join(map(force_text, forces)))
        return "; ".join(told)


def quaternion(turn: Floats) -> Floats:
    """The unit quaternion (4,) with w >= 0 of a rotation matrix (3, 3).

    The eigenvector of a symmetric matrix, well conditioned for every rotation (Bar-Itzhack, J.
    Guid. Control Dyn. 23(6), 2000).
    """
    (a, b, c), (d, e, f), (g, h, i) = turn
    four = [
        [a + e + i, h - f, c - g, d - b],
        [h - f, a - e - i, b + d, c + g],
        [c - g, b + d, e - a - i, f + h],
        [d - b, c + g, f + h, i - a - e],
    ]
    found = np.linalg.eigh(np.array(four))[1][:, -1]
    return np.asarray(found if found[0] >= 0.0 else -found)
