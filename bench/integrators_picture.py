"""The picture of docs/measured/integrators.md: errors against the step, energy against time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Energies = dict[tuple[str, int], NDArray[np.float64]]
STYLES = {
    "explicit_euler": ("C7", "x-"),
    "symplectic_euler": ("C0", "o-"),
    "rk2": ("C2", "^-"),
    "rk4": ("C4", "D-"),
    "implicit_euler": ("C3", "s-"),
    "implicit_midpoint": ("C1", "v-"),
    "newmark": ("C8", "+--"),
    "bdf2": ("C5", "P-"),
    "bdf2_fixed_point": ("k", "x:"),
}


def draw(
    path: Path,
    oscillator: dict[str, list[float]],
    counts: tuple[int, ...],
    bar: dict[str, list[float]],
    oscillator_energies: Energies,
    bar_energies: Energies,
) -> None:
    """Errors above, energies below; the oscillator on the left, the bar on the right."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, panels = pyplot.subplots(2, 2, figsize=(12.5, 9), layout="constrained")
    steps = [1 / n for n in counts]
    _errors(panels[0, 0], oscillator, steps, "oscillator, damped: error after two periods")
    panels[0, 0].set_xticks(steps, [f"T/{n}" for n in counts])
    bar_steps = [0.8 / 2**i for i in range(len(counts))]
    _errors(panels[0, 1], bar, bar_steps, "StVK bar, damped: error after 0.256 s")
    panels[0, 1].set_xticks(bar_steps, [f"{h:g} ms" for h in bar_steps])
    _energy(panels[1, 0], oscillator_energies, 50, "oscillator, undamped, h = T/50")
    _energy(panels[1, 1], bar_energies, 200, "StVK bar, undamped, h = T/200")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, frameon=False)
    figure.savefig(path, dpi=110)


def _errors(panel: Any, found: dict[str, list[float]], steps: list[float], title: str) -> None:
    for name, errors in found.items():
        colour, style = STYLES[name]
        panel.plot(steps, errors, style, color=colour, label=name, markersize=5, linewidth=1.2)
    panel.set(xscale="log", yscale="log", title=title, xlabel="step h", ylabel="relative error")
    panel.minorticks_off()
    panel.grid(True, color="0.9")
    for order, name in ((1, "implicit_euler"), (2, "bdf2"), (4, "rk4")):
        start = 2.2 * found[name][0]
        line = [start, start / (steps[0] / steps[-1]) ** order]
        panel.plot([steps[0], steps[-1]], line, color="0.6", linewidth=0.8)
        panel.annotate(
            f"order {order}",
            (steps[-1], line[1]),
            xytext=(-4, 0),
            textcoords="offset points",
            ha="right",
            va="center",
            color="0.35",
        )
    panel.set_xlim(steps[-1] / 1.45, steps[0] * 1.1)


def _energy(panel: Any, found: Energies, per_period: int, title: str) -> None:
    for (name, n), shares in found.items():
        if n != per_period:
            continue
        colour, style = STYLES[name]
        means = shares.mean(axis=1)
        time = np.arange(len(means)) + 0.5
        few = np.unique(np.geomspace(1, len(means), 14).astype(int)) - 1
        panel.plot(time, means, style[1:], color=colour, linewidth=1.2)
        panel.plot(time[few], means[few], style[0], color=colour, markersize=5)
    panel.set(title=title, xlabel="time in periods", ylabel="energy, mean over a period / start")
    panel.set(ylim=(-0.03, 1.13), xscale="log")
    panel.set_xticks((0.5, 1, 2, 5, 10, 20, 50, 100), ("½", "1", "2", "5", "10", "20", "50", "100"))
    panel.minorticks_off()
    panel.grid(True, color="0.9")
