"""Diagrams of error against time, both logarithmic: what all of them have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def chart(width: float, height: float) -> tuple[Figure, Axes]:
    """A figure with one pair of axes, made without a display [inches]."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.add_subplot()


def logarithmic(axes: Axes) -> None:
    """Both axes in powers of ten, with plain numbers, also between where there is little of one."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
        low, high = axis.get_view_interval()
        axis.set_minor_formatter("{x:g}" if high < 20.0 * low else "")
        axis.set_tick_params(which="minor", labelsize=7)
