"""The figure of a comparison: error against time per step, one point for each model."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from tissu.picture.chart import chart, logarithmic
from tissu.picture.series_colours import series_colours

if TYPE_CHECKING:
    from tissu.comparison.table import Comparison


def draw(comparison: Comparison, path: Path) -> bool:
    """Writes the figure; False, and no file, when no model has both an error and a time."""
    rows = [row for row in comparison.rows if row.mean_error and row.ms_per_step]
    if not rows:
        return False
    figure, axes = chart(7.5, 5.0)
    for row, colour in zip(rows, series_colours(len(rows)), strict=True):
        assert row.mean_error is not None and row.ms_per_step is not None
        mean = 1e3 * row.mean_error
        axes.plot(row.ms_per_step, mean, "o", markersize=8, color=colour, label=row.model)
        if row.largest_error:
            ends = [mean, 1e3 * row.largest_error]
            axes.plot([row.ms_per_step] * 2, ends, "-", color=colour, linewidth=1.0)
            axes.plot(row.ms_per_step, ends[1], "_", color=colour, markersize=12)
    logarithmic(axes)
    axes.set_xlabel("time per step [ms]")
    axes.set_ylabel("distance from the reference [mm]: mean (dot), largest (bar)")
    axes.set_title(
        f"{comparison.scene}, {comparison.cells} cells\nagainst {comparison.reference}", fontsize=10
    )
    axes.grid(visible=True, which="both", linewidth=0.3)
    axes.legend()
    figure.savefig(path, dpi=120, format="png")
    return True
