"""The figure of an advice: error against the time of an update, and the front of the best."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING

from tissu.advice.rows import front
from tissu.picture.chart import chart, logarithmic

if TYPE_CHECKING:
    from tissu.advice.advice import Advice
    from tissu.advice.rows import Row


def _time(row: Row) -> float:
    return row.ms_per_update or 0.0


def _touch(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Whether two points of the figure are too near for a number at each."""
    return all(abs(a - b) < 0.1 * max(a, b) for a, b in zip(one, other, strict=True))


def draw(advice: Advice, path: Path) -> bool:
    """Writes the figure; False, and no file, when no setting has both an error and a time."""
    rows = [row for row in advice.rows if row.error and row.ms_per_update]
    if not rows:
        return False
    figure, axes = chart(8.5, 6.5)
    scale, unit = (1e3, "mm") if advice.goal.is_length or not advice.largest else (0.0, "%")

    def shown(row: Row) -> float:
        return scale * (row.error or 0.0) if scale else float(row.error_percent or 0.0)

    axes.plot([_time(row) for row in rows], [shown(row) for row in rows], "o", color="0.7")
    best = [row for row in front(rows) if row.error]
    places = ([_time(row) for row in best], [shown(row) for row in best])
    axes.plot(*places, "o-", color="C0", label="none is faster and more accurate")
    names: list[tuple[tuple[float, float], str]] = []
    for row in best:
        at = (_time(row), shown(row))
        if not names or not _touch(at, names[-1][0]):
            names.append((at, row.name))
            axes.annotate(str(len(names)), at, (4, 4), textcoords="offset points", fontsize=9)
    listed = "\n".join(f"{number} {name}" for number, (_, name) in enumerate(names, 1))
    own, taken = advice.rows[0], advice.best
    for row, mark, label in ((own, "s", "the scene as it is"), (taken, "*", "advised")):
        if row.error and row.ms_per_update:
            size = 16 if mark == "*" else 8
            axes.plot(_time(row), shown(row), mark, color="C3", markersize=size, label=label)
    allowed = scale * advice.goal.error if scale else 100.0 * advice.goal.error
    if advice.goal.is_length == bool(scale):
        axes.axhline(allowed, color="0.3", linewidth=0.8, linestyle="--")
    axes.axvline(1e3 / advice.goal.rate, color="0.3", linewidth=0.8, linestyle="--")
    logarithmic(axes)
    axes.set_xlabel(f"time of an update [ms]; dashed: {advice.goal.rate:g} a second")
    axes.set_ylabel(f"mean error [{unit}]; dashed: {advice.goal.error_words()}")
    title = f"{advice.name}: errors against {advice.reference}"
    axes.set_title("\n".join(textwrap.wrap(title, 110)), fontsize=8, loc="left")
    axes.grid(visible=True, which="both", linewidth=0.3)
    axes.legend(fontsize=8)
    figure.supxlabel(listed, fontsize=7, ha="left", x=0.08)
    figure.savefig(path, dpi=120, format="png")
    return True
