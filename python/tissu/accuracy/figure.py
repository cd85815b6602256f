"""The diagram of a study: error against time to the result, a curve for each choice."""

from __future__ import annotations

import io
from textwrap import wrap
from typing import TYPE_CHECKING

from tissu.accuracy.front import front
from tissu.picture.chart import chart, logarithmic
from tissu.picture.series_colours import series_colours

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from tissu.accuracy.study import Study

_MARKS = "osD^vP*X<>ph"


def draw(study: Study) -> Figure | None:
    """The diagram; None where no run has both an error and a time."""
    curves: dict[str, list[tuple[float, float]]] = {}
    for run in study.runs:
        if run.counts and run.share and run.seconds:
            curves.setdefault(run.curve, []).append((1e3 * run.seconds, 100.0 * run.share))
    if not curves:
        return None
    figure, axes = chart(9.5, 5.2)
    colours = series_colours(len(curves))
    for number, (name, points) in enumerate(curves.items()):
        x, y = [point[0] for point in points], [point[1] for point in points]
        mark = _MARKS[number % len(_MARKS)]
        axes.plot(x, y, mark + "-", color=colours[number], label=name, markersize=5, linewidth=1)
    short = [run for run in study.runs if not run.counts and run.share and run.seconds]
    if short:
        x = [1e3 * (run.seconds or 0.0) for run in short]
        y = [100.0 * (run.share or 0.0) for run in short]
        axes.plot(x, y, "x", color="gray", label="tolerance not met", markersize=5)
    best = [run for run in front(study.runs) if run.share and run.seconds]
    x = [1e3 * (run.seconds or 0.0) for run in best]
    y = [100.0 * (run.share or 0.0) for run in best]
    axes.step(x, y, where="post", color="black", linewidth=2.5, alpha=0.25, label="front")
    for goal in study.case.goals:
        axes.axhline(100.0 * goal, color="black", linewidth=0.5, linestyle=":")
    logarithmic(axes)
    axes.set_xlabel("time from the scene to the result [ms]")
    axes.set_ylabel("mean error, of the largest displacement [%]")
    axes.set_title("\n".join(wrap(study.case.title, 72)), fontsize=10)
    axes.grid(visible=True, which="major", linewidth=0.3)
    figure.legend(loc="outside right upper", fontsize=7, frameon=False)
    return figure


def as_svg(figure: Figure) -> str:
    """The diagram as the text of an <svg> element."""
    text = io.StringIO()
    figure.savefig(text, format="svg")
    whole = text.getvalue()
    return whole[whole.index("<svg") :]
