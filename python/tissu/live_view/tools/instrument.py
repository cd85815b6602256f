"""Instrument: knives and ablators are moved and turned by a gizmo, and work on their way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tissu.counted import counted
from tissu.cutting.kinds import tough_knife_of
from tissu.live_view.gizmo import Gizmo
from tissu.live_view.layers.grabs import force_text
from tissu.live_view.marks import Marks
from tissu.live_view.tools.obstacle import quaternion, tools_of_trocars
from tissu.live_view.tools.tool import Tool

if TYPE_CHECKING:
    from tissu.live_view.pointer import Pointer
    from tissu.simulation import Simulation, StepReport

COLOUR = (40, 40, 40)


class Opened(NamedTuple):
    """The area that was opened [m2], and the pieces of the body."""

    area: float
    pieces: int


class MoveInstrument(Tool):
    """Leads an instrument of every simulation that is shown; see `Simulation.instruments`."""

    name = "move instrument"
    hint = "Drag an arrow or a ring of a gizmo: the instrument goes there, and cuts on its way."

    on_bodies = False
    edits = True

    def __init__(self, simulations: Sequence[Simulation]) -> None:
        """Nothing is cut yet."""
        super().__init__(simulations)
        self._cuts: dict[str, Opened] = {}

    @classmethod
    def offered(cls, simulation: Simulation) -> bool:
        """Where an instrument has no path of its own."""
        return bool(free_instruments(simulation))

    def press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """A press beside the gizmos does nothing."""

    def gizmos(self, simulations: Sequence[Simulation]) -> list[Gizmo]:
        """One at the origin of each instrument, turned as the instrument is."""
        return [
            Gizmo(name, lane, tool.position, quaternion(tool.rotation))
            for lane, simulation in enumerate(simulations)
            for name, tool in simulation.instruments.items()
            if name in free_instruments(simulation)
        ]

    def turn(self, simulations: Sequence[Simulation], gizmo: Gizmo) -> None:
        """Lead the instrument to where the gizmo is, at the end of the next step."""
        for simulation in simulations:
            if gizmo.name in free_instruments(simulation):
                angle = 2.0 * np.arctan2(np.linalg.norm(gizmo.wxyz[1:]), gizmo.wxyz[0])
                axis = gizmo.wxyz[1:] / max(float(np.linalg.norm(gizmo.wxyz[1:])), 1e-300)
                simulation.instruments[gizmo.name].move(gizmo.place, angle * axis)

    def draw(self, simulations: Sequence[Simulation]) -> Sequence[Sequence[Marks]]:
        """The edges of all instruments."""
        found = []
        for simulation in simulations:
            edges = [tool.edge for tool in simulation.instruments.values()]
            lines = [edge[i : i + 2] for edge in edges for i in range(len(edge) - 1)]
            found.append((Marks(COLOUR, lines=np.array(lines)),) if lines else ())
        return found

    def hear(self, reports: Sequence[StepReport]) -> None:
        """What instruments cut in a step, of the first simulation."""
        for cut in reports[0].cuts:
            before = self._cuts.get(cut.body, Opened(0.0, 0))
            self._cuts[cut.body] = Opened(before.area + cut.area, len(cut.pieces))

    def forget(self) -> None:
        """The cuts were undone."""
        self._cuts.clear()

    def say(self, simulations: Sequence[Simulation]) -> str:
        """What was opened, and the force on each knife that has one, of several simulations."""
        told = [
            f"{body}: {1e4 * cut.area:.3g} cm² opened, {counted(cut.pieces, 'piece')}"
            for body, cut in self._cuts.items()
        ]
        for name, instrument in simulations[0].scene.instruments.items():
            if tough_knife_of(instrument) is None:
                continue
            forces = [float(np.linalg.norm(one.instruments[name].force)) for one in simulations]
            if any(forces):
                told.append(f"{name} " + " and ".join(map(force_text, forces)))
        return "; ".join(told)


def free_instruments(simulation: Simulation) -> list[str]:
    """The instruments that no path and no trocar leads."""
    taken = tools_of_trocars(simulation)
    return [
        name
        for name, one in simulation.scene.instruments.items()
        if one.path is None and name not in taken
    ]
