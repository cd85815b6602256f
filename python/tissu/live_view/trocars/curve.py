"""Curves of a trocar against time: forces, torques, joints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.live_view.trocars.frame import COLUMNS

if TYPE_CHECKING:
    import viser

    from tissu.live_view.session import Session

Floats = NDArray[np.float64]

_DEGREE = 180.0 / np.pi
CURVES: dict[str, tuple[tuple[str, str, float], ...]] = {
    "force [N]": (
        ("force of ticks", "on the hand", 1.0),
        ("force of steps", "of the tissue's steps", 1.0),
    ),
    "torque [mN m]": (
        ("pitch torque", "pitch", 1e3),
        ("roll torque", "roll", 1e3),
        ("rotation torque", "rotation", 1e3),
    ),
    "angle [deg]": (
        ("pitch", "pitch", _DEGREE),
        ("roll", "roll", _DEGREE),
        ("rotation", "rotation", _DEGREE),
    ),
    "depth [mm]": (("depth", "depth", 1e3),),
}
"""What can be drawn: columns of the history, what they are called, and a factor."""
_BEGINNING = np.stack([np.zeros(len(COLUMNS)), np.eye(len(COLUMNS))[0]])
"""Before the first step: a second of nothing. Without a span of time uPlot has no scale ever."""
_ROOM: Any = {
    "min": {"pad": 0.1, "soft": 0.0, "mode": 1},
    "max": {"pad": 0.1, "soft": 0.1, "mode": 1},
}
"""Of an axis: zero is on it, and what is next to nothing is not blown up."""
_COLOURS = ("#1464c8", "#d2691e", "#2e8b57")


class Curve:
    """A drawing of one of `CURVES`, of the latest seconds."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""
        self._chosen = gui.add_dropdown("curve", list(CURVES), initial_value=next(iter(CURVES)))
        self._plots: dict[str, Any] = {}
        for name in CURVES:
            self._plots[name] = gui.add_uplot(
                data_of(_BEGINNING, name),
                series=({"label": "t [s]"}, *_series(name)),
                scales={"x": {"time": False}, "y": {"range": _ROOM}},
                axes=({"size": 34}, {"label": name, "labelSize": 18, "size": 54}),
                legend={"show": True, "live": False},
                aspect=1.5,
                padding=(10, 14, 0, 0),
                visible=name == self._chosen.value,
            )
        session.on_change(self._chosen, self._choose)

    def _choose(self, word: str) -> None:
        for name, plot in self._plots.items():
            plot.visible = name == word

    def show(self, history: Floats) -> None:
        """Draw the rows of a history (k, 11)."""
        name = self._chosen.value
        if len(history) > 1:
            self._plots[name].data = data_of(history, name)


def data_of(history: Floats, name: str) -> tuple[Floats, ...]:
    """Times and the columns of a curve, each (k,)."""
    columns = [history[:, COLUMNS.index(column)] * factor for column, _, factor in CURVES[name]]
    return (history[:, 0].copy(), *columns)


def _series(name: str) -> tuple[Any, ...]:
    return tuple(
        {"label": label, "stroke": colour, "width": 1.5}
        for (_, label, _), colour in zip(CURVES[name], _COLOURS, strict=False)
    )
