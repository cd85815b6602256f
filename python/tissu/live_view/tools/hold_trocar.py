"""Hold trocar: the hand of the browser leads the tip of a trocar's tool by a gizmo."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.gizmo import Gizmo
from tissu.live_view.tools.obstacle import quaternion
from tissu.live_view.tools.tool import Tool

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from tissu.live_view.pointer import Pointer
    from tissu.live_view.trocars.trocars import LiveTrocars
    from tissu.simulation import Simulation


class HoldTrocar(Tool):
    """Leads the tip of every trocar whose hand is that of the browser."""

    name = "hold trocar"
    hint = (
        "Where the hand is that of the browser: drag an arrow of the gizmo and the hand leads the "
        "tip there; a ring turns the tool about its axis."
    )

    on_bodies = False

    def __init__(self, simulations: Sequence[Simulation], trocars: LiveTrocars) -> None:
        """Look at the trocars of the simulations."""
        super().__init__(simulations)
        self._trocars = trocars

    @classmethod
    def offered(cls, simulation: Simulation) -> bool:
        """Where a scene has trocars."""
        return bool(simulation.scene.trocars)

    def press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """A press beside the gizmos does nothing."""

    def gizmos(self, simulations: Sequence[Simulation]) -> list[Gizmo]:
        """One where the hand wants each tip, turned as the tool is."""
        found = []
        for live in self._trocars.each:
            if live.hand == "browser":
                place, turn = live.wanted_pose()
                found.append(Gizmo(live.name, live.lane, place, quaternion(turn)))
        return found

    def turn(self, simulations: Sequence[Simulation], gizmo: Gizmo) -> None:
        """Want the tip where the gizmo is, in every simulation."""
        for live in self._trocars.called(gizmo.name):
            live.want_pose(gizmo.place, rotation_of(gizmo.wxyz))


def rotation_of(wxyz: NDArray[np.float64]) -> NDArray[np.float64]:
    """The rotation matrix (3, 3) of a unit quaternion (4,)."""
    w, (x, y, z) = wxyz[0], wxyz[1:]
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross)
