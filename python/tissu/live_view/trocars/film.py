"""A trocar in a film: its port, its tool with the grip, and the force on the hand as an arrow."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.film_rigid import NONE, ONE, Placed, Shape, instrument
from tissu.live_view.trocars.drawing import (
    ABOVE,
    FORCE,
    GRIP,
    GRIP_COLOUR,
    GRIP_LENGTH,
    PORT,
    SHAFT,
    SLEEVE,
    SLEEVE_LENGTH,
    STEEL,
    tube,
)
from tissu.live_view.turned import arrow, to_axis
from tissu.trocar import kinematics

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from tissu.live_view.marks import Colour
    from tissu.live_view.trocars.live import LiveTrocar

    Floats = NDArray[np.float64]

_LEAST = 1e-4
"""m: a shorter arrow is not drawn, as on the page."""


class TrocarFilm:
    """Places the parts of one trocar, each under the same name in every moment.

    The tool is as long as its way needs: from its tip to the grip, which is above the port at the
    largest depth of the trocar's limits.
    """

    def __init__(self, live: LiveTrocar) -> None:
        """Take a trocar."""
        port = live.trocar.port
        self.live = live
        self._turn, self._at = port.frame(), np.array(port.at)
        self._length = max(float(live.joints[3]) + ABOVE, live.trocar.limits.depth + GRIP_LENGTH)
        end = self._length + GRIP_LENGTH
        points, triangles = arrow(0.03, 0.08, 0.25)
        self._shapes = {
            "port": _tube(PORT, -0.5 * SLEEVE_LENGTH, 0.5 * SLEEVE_LENGTH, SLEEVE, 0.45),
            "tool": _tube(STEEL, -self._length, -2.0 * SHAFT, SHAFT),
            "grip": _tube(GRIP_COLOUR, -end, -self._length, GRIP),
            "force": Shape(FORCE, points, triangles),
        }

    def placed(self, length: float) -> list[Placed]:
        """Everything, with an arrow of a length [m] for 1 N."""
        live, felt = self.live, self.live.felt
        inside = live.controller.tool if felt is None else felt.tool
        q = live.joints if felt is None or inside is None else felt.joints
        turn = self._turn @ kinematics.rotation(q)
        tip = self._at + self._turn @ kinematics.position(q)
        force = NONE if felt is None else length * felt.fast
        size = float(np.linalg.norm(force))
        shown = size > _LEAST
        along = to_axis(force / size) if shown else np.eye(3)
        end = tip - turn[:, 2] * (self._length + GRIP_LENGTH)
        return [
            self._part("port", self._at, self._turn),
            self._part("tool", tip, turn),
            self._part("grip", tip, turn),
            self._part("force", end, along, size * ONE if shown else NONE),
            *(
                instrument(live.simulation, name, there=name == inside)
                for name in live.trocar.tools.values()
                if name in live.simulation.scene.instruments
            ),
        ]

    def _part(self, what: str, place: Floats, turn: Floats, scale: Floats = ONE) -> Placed:
        return Placed(f"{self.live.name}: {what}", self._shapes[what], place, turn, scale)


def _tube(colour: Colour, low: float, high: float, radius: float, opacity: float = 1.0) -> Shape:
    points = tube(low, high, radius).reshape(-1, 3)
    return Shape(colour, points, np.arange(len(points)).reshape(-1, 3), opacity)
