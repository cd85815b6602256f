"""The picture of docs/measured/convergence.md: errors against the number of cells along an edge."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "convergence"))

from order import Errors
from shape_basis import LINES, ORDER, SURFACES, VOLUMES
from tissu.picture.series_colours import series_colours

Series = tuple[tuple[int, ...], list[Errors]]  # cells along an edge, and the errors for each
TITLES = (
    "displacement error [m], smooth map",
    "strain error [1], smooth map",
    "displacement error [m], trapezoids,\nquadratic field (Hooke)",
)
# Lines of the theory: order -> (cells, error) of the left end, for each panel.
SLOPES: tuple[tuple[dict[int, tuple[int, float]], ...], ...] = (
    (
        {2: (4, 4e-3), 3: (2, 9e-4)},
        {1: (4, 4.5e-2), 2: (2, 1.1e-2)},
        {2: (4, 3.2e-5), 3: (4, 1e-5)},
    ),
    (
        {2: (8, 9e-4), 3: (8, 1.8e-5)},
        {1: (8, 2e-2), 2: (8, 9e-4)},
        {2: (4, 1.6e-5), 3: (4, 5e-6)},
    ),
)


def draw(path: Path, smooth: dict[str, Series], losing: dict[str, Series]) -> None:
    """Volumes above, surfaces and lines below: displacement, strain, and the lost order."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, rows = pyplot.subplots(2, 3, figsize=(13.5, 8.2), layout="constrained")
    colours = series_colours(max(len(VOLUMES), len(SURFACES + LINES)))
    for axes, cells, slopes in zip(rows, (VOLUMES, SURFACES + LINES), SLOPES, strict=True):
        for panel, title in zip(axes, TITLES, strict=True):
            _prepare(panel, title, (2, 4, 6, 8, 12) if cells is VOLUMES else (4, 6, 8, 12, 16, 24))
        for cell, colour in zip(cells, colours, strict=False):
            for panel, field in zip(axes, ("displacement", "strain"), strict=False):
                _curve(panel, smooth[cell], field, cell, colour)
            if cell in losing:
                _curve(axes[2], losing[cell], "displacement", cell, colour)
        for panel, starts in zip(axes, slopes, strict=True):
            _slopes(panel, starts)
        axes[2].legend(
            *axes[0].get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1, 0.5)
        )
    figure.savefig(path, dpi=110)


def _prepare(panel: Any, title: str, ticks: tuple[int, ...]) -> None:
    panel.set(xscale="log", yscale="log", xlabel="cells along an edge", title=title)
    panel.set_xticks(ticks, [str(tick) for tick in ticks])
    panel.minorticks_off()
    panel.grid(True, which="major", color="0.9")


def _curve(panel: Any, series: Series, field: str, cell: str, colour: Any) -> None:
    counts, found = series
    style = "-o" if ORDER[cell] == 1 else "--s"
    values = [getattr(e, field) for e in found]
    panel.plot(counts, values, style, color=colour, label=cell, markersize=4)


def _slopes(panel: Any, starts: dict[int, tuple[int, float]]) -> None:
    """Grey lines of the orders of the theory, from (cells, error) to three times the cells."""
    for order, (cells, error) in starts.items():
        line = [error, error / 3**order]
        panel.plot([cells, 3 * cells], line, color="0.55", linewidth=1)
        middle = (1.75 * cells, error / 1.75**order)
        place = {"xytext": (5, 4), "textcoords": "offset points"}
        panel.annotate(f"order {order}", middle, color="0.35", **place)
