"""The figure of an advice: error against the time of an update, and the front of the best."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tissu.advice.advice import Advice
    from tissu.advice.rows import Row


def front(rows: Sequence[Row]) -> list[Row]:
    """The rows than which none is both faster and more accurate (Pareto), fastest first."""
    known = [row for row in rows if row.error is not None and row.ms_per_update is not None]
    found: list[Row] = []
    for row in sorted(known, key=lambda row: (row.ms_per_update, row.error)):
        if not found or (row.error or 0.0) < (found[-1].error or 0.0):
            found.append(row)
    return found


def _time(row: Row) -> float:
    return row.ms_per_update or 0.0


def draw(advice: Advice, path: Path) -> bool:
    """Writes the figure; False, and no file, when no setting has both an error and a time."""
    rows = [row for row in advice.rows if row.error and row.ms_per_update]
    if not rows:
        return False
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.5, 5.5), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    scale, unit = (1e3, "mm") if advice.goal.is_length or not advice.largest else (0.0, "%")

    def shown(row: Row) -> float:
        return scale * (row.error or 0.0) if scale else float(row.error_percent or 0.0)

    axes.plot([_time(row) for row in rows], [shown(row) for row in rows], "o", color="0.7")
    best = [row for row in front(rows) if row.error]
    places = ([_time(row) for row in best], [shown(row) for row in best])
    axes.plot(*places, "o-", color="C0", label="none is faster and more accurate")
    for row in best:
        at = (_time(row), shown(row))
        text = f"{row.mesh}, {row.model}\n{row.step}"
        axes.annotate(text, at, (4, 4), textcoords="offset points", fontsize=6)
    own, taken = advice.rows[0], advice.best
    for row, mark, label in ((own, "s", "the scene as it is"), (taken, "*", "advised")):
        if row.error and row.ms_per_update:
            size = 16 if mark == "*" else 8
            axes.plot(_time(row), shown(row), mark, color="C3", markersize=size, label=label)
    allowed = scale * advice.goal.error if scale else 100.0 * advice.goal.error
    if advice.goal.is_length == bool(scale):
        axes.axhline(allowed, color="0.3", linewidth=0.8, linestyle="--")
    axes.axvline(1e3 / advice.goal.rate, color="0.3", linewidth=0.8, linestyle="--")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(f"time of an update [ms]; dashed: {advice.goal.rate:g} a second")
    axes.set_ylabel(f"mean error [{unit}]; dashed: {advice.goal.error_words()}")
    axes.set_title(f"{advice.name}: errors against\n{advice.reference}", fontsize=8, wrap=True)
    axes.grid(visible=True, which="both", linewidth=0.3)
    axes.legend()
    figure.savefig(path, dpi=120, format="png")
    return True
