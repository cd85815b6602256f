"""Sliders of the numbers that may change while it runs, as the scene's parts name them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from tissu.live_view.panels.panel import Panel

if TYPE_CHECKING:
    from collections.abc import Sequence

    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session
    from tissu.simulation import Simulation
    from tissu.simulation.parameters import Parameter

_STEPS = 200


class ParametersPanel(Panel):
    """A slider for each parameter of the first simulation; it sets all that have one so named."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""
        self._session = session
        self._wished: dict[str, float] = {}
        self._now: dict[str, float] = {}
        self._sliders: dict[str, viser.GuiSliderHandle[float]] = {}
        parameters = session.runner.simulations[0].parameters.all()
        if not parameters:
            return
        session.after_reset.append(self.look)
        with gui.add_folder("Parameters", expand_by_default=False):
            for parameter in parameters:
                self._sliders[parameter.name] = self._slider(gui, parameter)
        for name, slider in self._sliders.items():
            session.on_change(slider, self._wish(name))

    def _slider(self, gui: viser.GuiApi, parameter: Parameter) -> viser.GuiSliderHandle[float]:
        low, high = span(parameter)
        step = 10.0 ** math.floor(math.log10((high - low) / _STEPS))
        unit = f" [{parameter.unit}]" if parameter.unit else ""
        return gui.add_slider(
            parameter.name.removeprefix("bodies.") + unit,
            min=low,
            max=high,
            step=step,
            initial_value=parameter.value,
            hint=parameter.name,
        )

    def _wish(self, name: str) -> Callable[[float], object]:
        """What a slider does: between two steps the latest of its values is set."""

        def change(value: float) -> None:
            waiting = name in self._wished
            self._wished[name] = float(value)
            if not waiting:
                self._session.runner.ask(lambda simulations: self._set(simulations, name))

        return change

    def _set(self, simulations: Sequence[Simulation], name: str) -> None:
        value = self._wished.pop(name)
        try:
            for simulation in simulations:
                now = {one.name: one.value for one in simulation.parameters.all()}
                if now.get(name, value) != value:
                    simulation.parameters[name] = value
        finally:
            self.look(simulations)

    def look(self, simulations: Sequence[Simulation]) -> None:
        """Note what the values are now; called in the simulations' thread."""
        self._now = {one.name: one.value for one in simulations[0].parameters.all()}

    def show(self, frame: Frame) -> None:
        """A slider whose value was refused, or reset, goes back to what holds."""
        now, self._now = self._now, {}
        for name, value in now.items():
            if name in self._sliders and name not in self._wished:
                slider: Any = self._sliders[name]
                slider.value = value


def span(parameter: Parameter) -> tuple[float, float]:
    """What a slider reaches: to three times the value, within what is accepted."""
    value, size = parameter.value, abs(parameter.value)
    reach = 3.0 * size if size > 0.0 else (20.0 if parameter.unit == "m/s^2" else 1.0)
    if parameter.unit == "m/s^2":
        reach = max(reach, 20.0)
    low, high = (0.0 if parameter.least >= 0.0 else -reach), reach
    if math.isfinite(parameter.least) and math.isfinite(parameter.most):
        low, high = (max(parameter.least, 0.0) if value >= 0.0 else parameter.least), parameter.most
    inside = 1e-2 * (high - low)  # bounds may be excluded
    low = low + inside if low <= parameter.least else low
    high = high - inside if high >= parameter.most else high
    return min(low, value), max(high, value)
