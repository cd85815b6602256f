"""All trocars of the simulations that are shown."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from tissu.errors import ParameterError
from tissu.live_view.layers.layer import Draw, Layer
from tissu.live_view.marks import extent
from tissu.live_view.runner import step_of
from tissu.live_view.trocars.drawing import TrocarDrawing
from tissu.live_view.trocars.film import TrocarFilm
from tissu.live_view.trocars.live import LiveTrocar

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from tissu.live_view.film_rigid import Placed
    from tissu.live_view.marks import Marks
    from tissu.live_view.trocars.frame import TrocarFrame
    from tissu.live_view.trocars.held import HandKind
    from tissu.live_view.trocars.live import Moment
    from tissu.simulation import Simulation, StepReport
_ARROW = 0.3
"""Of the extent of the bodies: the arrow of 1 N, rounded to one digit."""


class LiveTrocars:
    """They go on with the steps of their simulations, in the thread that owns these.

    Attributes:
        each: every trocar of every simulation.
        arrow: length of the arrow of 1 N [m].
        before_touch: called with the simulations where a touch has just begun.
    """

    def __init__(
        self,
        simulations: Sequence[Simulation],
        *,
        hand: HandKind = "scene",
        trust_plugins: bool = False,
    ) -> None:
        """Open their devices and switch them on.

        Raises:
            TissuError: a device is not there, does not answer, or has another controller.
            ParameterError: what `LiveTrocar` refuses.
        """
        self.each: list[LiveTrocar] = []
        self.before_touch: list[Callable[[Sequence[Simulation]], object]] = []
        self._simulations = simulations
        size = extent([mesh.points for mesh in simulations[0].meshes.values()])
        self.arrow = float(f"{_ARROW * size:.1g}")
        try:
            for lane, simulation in enumerate(simulations):
                for name in simulation.scene.trocars:
                    self.each.append(
                        LiveTrocar(simulation, name, lane, hand=hand, trust_plugins=trust_plugins)
                    )
        except BaseException:
            self.close()
            raise
        self._drawings = [TrocarDrawing(one) for one in self.each]
        self._films = [TrocarFilm(one) for one in self.each]

    @property
    def names(self) -> list[str]:
        """Of all trocars, once each."""
        return list(dict.fromkeys(one.name for one in self.each))

    def called(self, name: str) -> list[LiveTrocar]:
        """The trocar of a name in every simulation.

        Raises:
            ParameterError: no trocar has it.
        """
        found = [one for one in self.each if one.name == name]
        if not found:
            accepted = ", ".join(self.names)
            raise ParameterError(f"found the trocar '{name}'; accepted: {accepted}")
        return found

    def step(self, simulation: Simulation) -> StepReport:
        """A step of a simulation with its trocars; no other thread gets in between.

        Raises:
            BusyError: another thread is inside; nothing has happened.
            TissuError: the step failed.
        """
        if simulation is self._simulations[0]:  # all are at one time
            self._remember()
        with simulation._entry.entered("step"):  # as one: ticks are not taken twice
            here = [one for one in self.each if one.simulation is simulation]
            for one in here:
                one.before_step()
            report = simulation.step(step_of(simulation))
            for one in here:
                one.after_step()
        return report

    def _remember(self) -> None:
        if any(one.touch_begun for one in self.each):
            for call in self.before_touch:
                call(self._simulations)
            for one in self.each:
                one.touch_begun = False

    def reset(self, simulations: Sequence[Simulation]) -> None:
        """After the simulations have begun again."""
        for one in self.each:
            one.begin_again()

    def moments(self) -> list[Moment]:
        """Where all are now, to come back to."""
        return [one.moment() for one in self.each]

    def come_back(self, moments: Sequence[Moment]) -> None:
        """Go on from moments after the simulations did."""
        for one, moment in zip(self.each, moments, strict=True):
            one.come_back(moment)

    def frames(self) -> tuple[TrocarFrame, ...]:
        """All of them now."""
        return tuple(one.frame(self.arrow) for one in self.each)

    def close(self) -> None:
        """Switch all motors off."""
        for one in self.each:
            one.close()

    def points(self) -> NDArray[np.float64]:
        """Where they are, for the first view (n, 3) [m]."""
        return np.concatenate([drawing.first_points(self.arrow) for drawing in self._drawings])

    def placed(self, simulation: Simulation, lane: int) -> list[Placed]:
        """Ports, tools, instruments and forces of a lane, for a film."""
        here = [one for one in self._films if one.live.lane == lane]
        return [placed for one in here for placed in one.placed(self.arrow)]

    @property
    def layer(self) -> Layer:
        """Their marks on the page."""

        def begin(simulation: Simulation) -> Draw:
            here = [one for one in self._drawings if one.live.simulation is simulation]

            def draw() -> list[Marks]:
                return [marks for one in here for marks in one.marks(self.arrow)]

            return draw

        return Layer(
            name="trocars",
            on=True,
            offered=lambda simulation: bool(simulation.scene.trocars),
            begin=begin,
        )
