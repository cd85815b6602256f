"""What a cut costs: `python bench/cutting.py [--write]`.

Discs that cut about a hundred tetrahedra out of a bar of so many, again and again from the same
moment (`mark`, `rewind`): time of the cut, of its stages, of steps before and after, and their
iterations. Run it on a machine that does nothing else.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
from kernels import table

import tissu as ts
from tissu.cli.info import machine_line

PAGE = Path(__file__).resolve().parent.parent / "docs" / "measured" / "cutting.md"
BEGIN, END = "<!-- bench/cutting.py -->\n", "<!-- end of bench/cutting.py -->\n"
SIDES = (6, 12, 20)
"""Cells along the two short sides of a bar that is four times as long."""
CUTS = 20
STEPS = 10


def bar(side: int) -> ts.Simulation:
    """40 x 10 x 10 cm, held at one end, under its weight."""
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(4 * side, side, side), cell="tetra"),
        law=ts.StVK(young=5e5, poisson=0.3),
        density=1000,
    )
    return ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler("10 ms"),
        editing=True,
    ).compile()


def discs(side: int) -> list[ts.Disc]:
    """So wide that they meet some hundred cells, in places and directions of their own."""
    random = np.random.default_rng(3)
    radius = 2.2 * 0.1 / side
    return [
        ts.Disc(
            random.uniform((0.1, 0.03, 0.03), (0.3, 0.07, 0.07)),
            random.standard_normal(3) + np.array([2.0, 0.0, 0.0]),
            radius,
        )
        for _ in range(CUTS)
    ]


def stepped(simulation: ts.Simulation) -> tuple[float, float, float]:
    """Time of the first step and median of the next ones [ms], and mean of their iterations."""
    first = simulation.step().milliseconds
    reports = [simulation.step() for _ in range(STEPS)]
    return (
        first,
        float(np.median([report.milliseconds for report in reports])),
        float(np.mean([report.solver_iterations for report in reports])),
    )


def row(side: int) -> list[str]:
    """One bar."""
    simulation = bar(side)
    for _ in range(5):
        simulation.step()
    mark = simulation.mark()
    _, before, plain = stepped(simulation)
    cuts, cells, read, first, after, iterations = [], [], [], [], [], []
    for disc in discs(side):
        simulation.rewind(mark)
        report = simulation.cut("bar", disc)
        begun = time.perf_counter()
        simulation.surface("bar")
        read.append(1e3 * (time.perf_counter() - begun))
        cuts.append(report.milliseconds)
        cells.append(report.cells_cut)
        beginning, milliseconds, count = stepped(simulation)
        first.append(beginning)
        after.append(milliseconds)
        iterations.append(count)
    return [
        f"{24 * side**3:,}",
        f"{np.mean(cells):.0f}",
        f"{np.median(cuts):.1f}",
        f"{np.percentile(cuts, 95):.1f}",
        f"{np.median(read):.1f}",
        f"{before:.2f}",
        f"{np.median(first):.2f}",
        f"{np.median(after):.2f}",
        f"{plain:.1f}",
        f"{np.mean(iterations):.1f}",
    ]


def section() -> str:
    """The table and what it says."""
    head = ["tetrahedra", "cut", "ms, p50", "ms, p95", "surface ms", "step ms", "first after"]
    head += ["later", "iterations", "after"]
    rows = [row(side) for side in SIDES]
    return (
        "## The time of a cut\n\n"
        "The table gives the time of a cut, and of the steps after it, for meshes of several\n"
        f"sizes. A bar of StVK under its weight is cut by {CUTS} discs, each from the same state,\n"
        "with implicit Euler of 10 ms on one thread. The time of a cut includes the report with\n"
        "its pieces, but not reading the surface. The goal is 5 ms for a hundred cells of 50,000.\n"
        "The first step after a cut makes a new preconditioner.\n\n"
        + table(head, rows)
        + f"\n\nPrinted by `python bench/cutting.py --write`; {machine_line()}\n"
    )


def main() -> None:
    """Prints the section, or writes it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="to docs/measured/cutting.md")
    text = section()
    if parser.parse_args().write:
        page = PAGE.read_text(encoding="utf-8")
        before, _, rest = page.partition(BEGIN)
        PAGE.write_text(before + BEGIN + text + END + rest.partition(END)[2], encoding="utf-8")
    else:
        print(text)


if __name__ == "__main__":
    main()
