"""Prints docs/measured/solvers.md: what every linear solver costs from 1e3 to 1e6 unknowns.

    python bench/solvers.py [--small] [--write]

Without --write the page is printed.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import tissu as ts
from tissu.picture.series_colours import series_colours

sys.path.insert(0, str(Path(__file__).resolve().parent))
from kernels import measured_at
from section import PAGE, kept

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs" / "pictures" / "solvers.png"
SIZES = (6, 14, 31, 68)
"""cubes along an edge: 1e3, 1e4, 1e5 and 1e6 unknowns"""
MOST_SECONDS = 60.0
"""a solver whose last system took a tenth of this is not tried on the next size"""
SOLVERS = {
    "jacobi": ts.ConjugateGradient(preconditioner="jacobi", iterations=20000),
    "block_jacobi": ts.ConjugateGradient(iterations=20000),
    "block_jacobi, single": ts.ConjugateGradient(precision="single", iterations=20000),
    "block_jacobi, no matrix": ts.ConjugateGradient(matrix="free", iterations=20000),
    "incomplete_cholesky": ts.ConjugateGradient(
        preconditioner="incomplete_cholesky", iterations=20000
    ),
    "incomplete_cholesky, single": ts.ConjugateGradient(
        preconditioner="incomplete_cholesky", precision="single", iterations=20000
    ),
    "stale_cholesky": ts.ConjugateGradient(preconditioner="stale_cholesky", iterations=20000),
    "multigrid": ts.ConjugateGradient(preconditioner="multigrid", iterations=20000),
    "multigrid, single": ts.ConjugateGradient(
        preconditioner="multigrid", precision="single", iterations=20000
    ),
    "cholesky": ts.Cholesky(),
}
HEAD = """# Linear solvers

How do the time and the memory of each solver grow with the number of unknowns? [The
guide](../guide/solvers.md) describes each solver and when to take it.

A cube of tetrahedra (10 kPa, nu 0.3, 10 cm) is held at its floor and bent by its weight. The
tolerance is 1e-6, on one thread. Each entry has the iterations, the time of one system, and the
bytes that the solver keeps for each unknown in addition to the matrix, which has {matrix:.0f}
bytes for each unknown if there is one. The exponent is that of the growth of the time between
the last two sizes.

"""
TAIL = """
Memory bounds these times. A product reads the matrix once, {matrix:.0f} bytes for each unknown,
or half of it in single precision. Products run at the bandwidth of the memory once the matrix
leaves the caches. Triangular solves read as much, and their rows wait for each other. The work of
a factor of a three-dimensional mesh grows as n^2, and its memory as n^(4/3).

Inertia halves the iterations of this soft cube at 10 ms. With and without inertia, their number
grows with the number of cells along the cube. The number of iterations of a multigrid does not
grow. One of its iterations costs four more products with the matrix. This pays from about ten
thousand unknowns on. Its first system, and the first one after a cut, includes finding the
aggregates.

The following changes were tried and dropped, on the bar of 10,368 and 48,000 tetrahedra with a
multigrid in single precision:

- a register of sixteen numbers for a block in single precision: within 3 % of the time, because the
  product waits for its blocks and not for its instructions;
- one step of the polynomial on every level: 40 % more iterations, within 4 % of the time;
- one step on the finest level alone: 35 % more iterations, 2 to 7 % less time, most with hexahedra;
- a fourth answer for the first guess: one iteration in eight less, the same time.

On an AMD EPYC with AVX2, whose caches hold the matrix of 48,000 tetrahedra, a product in single
precision takes 1.3 ns a block in the third-level cache as in the first: its loads bound it. Two
numbers of the vector in one load leave 1.1 ns, and are kept. Tried there and dropped: blocks
fetched 256 to 1,024 bytes ahead, -4 to +6 % of the time; eight numbers of a block in one
register, or two blocks in one, within 3 % of what is kept.

Printed by `python bench/solvers.py --write`; {machine}
"""


@dataclass(frozen=True)
class Row:
    """One measured solver."""

    solver: str
    unknowns: int
    iterations: float
    seconds: float
    bytes: float
    converged: bool


def cube(cells: int, *, static: bool, solver: object) -> ts.Scene:
    """The cube of a size."""
    law = {"young": "10 kPa", "poisson": 0.3}
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(cells, cells, cells), cell="tetra"),
        law=ts.Hooke(**law) if static else ts.StVK(**law),  # type: ignore[arg-type]
        density=1000,
    )
    step = ts.Static(solver=solver) if static else ts.ImplicitEuler("10 ms", solver=solver)  # type: ignore[arg-type]
    return ts.Scene(
        bodies={"cube": body},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("cube", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        step=step,
    )


def measured(name: str, cells: int, *, static: bool) -> tuple[Row, float]:
    """A row, and the matrix's bytes for each unknown."""
    simulation = cube(cells, static=static, solver=SOLVERS[name]).compile()
    simulation.step()
    if not static:
        simulation.clear_profile()
        simulation.step()
    profile = simulation.profile()
    rows = [row for row in profile.rows if row.effect == "linear solver"]
    seconds = sum(row.ms_per_step for row in rows) / 1e3 * profile.steps
    solves, unknowns = profile.solves, simulation.plan().unknowns
    row = Row(
        name,
        unknowns,
        solves.iterations / max(1, solves.solves),
        seconds / max(1, solves.solves),
        simulation.solver_bytes() / unknowns,
        solves.failures == 0,
    )
    return row, simulation.plan().matrix_bytes / unknowns


def study(sizes: tuple[int, ...], *, static: bool) -> tuple[list[list[Row]], float]:
    """Rows by solver, and the matrix's bytes for each unknown at the largest size."""
    found, matrix = [], 0.0
    for name in SOLVERS:
        rows: list[Row] = []
        for cells in sizes:
            if rows and rows[-1].seconds > MOST_SECONDS / 30:
                break
            if cells > 40 and name in ("cholesky", "stale_cholesky"):
                break  # a factor of a million unknowns does not fit
            row, matrix = measured(name, cells, static=static)
            print("static" if static else "inertia", row, file=sys.stderr, flush=True)
            rows.append(row)
        found.append(rows)
    return found, matrix


def exponent(rows: list[Row]) -> float:
    """Of the growth of seconds with unknowns, between the last two sizes."""
    before, last = rows[-2], rows[-1]
    return float(np.log(last.seconds / before.seconds) / np.log(last.unknowns / before.unknowns))


def table(found: list[list[Row]]) -> str:
    """Markdown."""
    sizes = sorted({row.unknowns for rows in found for row in rows})
    head = " | ".join(f"{size:,} unknowns" for size in sizes)
    lines = [f"| | {head} | exponent |", "|---|" + "---|" * (len(sizes) + 1)]
    for rows in found:
        known = {row.unknowns: row for row in rows}
        cells = [entry(known[size]) if size in known else "not run" for size in sizes]
        grown = f"{exponent(rows):.2f}" if len(rows) > 1 else ""
        lines.append(f"| {rows[0].solver} | {' | '.join(cells)} | {grown} |")
    return "\n".join(lines)


def entry(row: Row) -> str:
    """Iterations, time and bytes of one row."""
    mark = "" if row.converged else " (not to the tolerance)"
    ms = 1e3 * row.seconds
    spent = f"{ms:.3g} ms" if ms < 1e3 else f"{row.seconds:.3g} s"
    return f"{row.iterations:.0f}, {spent}, {row.bytes:.0f} B{mark}"


def picture(studies: dict[str, list[list[Row]]]) -> None:
    """Seconds against unknowns, a panel for each study."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    colours = series_colours(max(len(found) for found in studies.values()))
    figure, panels = plt.subplots(1, len(studies), figsize=(11, 4.4), sharey=True)
    for axes, (title, found) in zip(panels, studies.items(), strict=True):
        for rows, colour in zip(found, colours, strict=False):
            x, y = [r.unknowns for r in rows], [r.seconds for r in rows]
            axes.loglog(x, y, "o-", color=colour, label=rows[0].solver, markersize=5)
        axes.set_title(title)
        axes.set_xlabel("unknowns")
        axes.grid(visible=True, which="major", alpha=0.3)
    panels[0].set_ylabel("seconds for one system")
    panels[-1].legend(fontsize=8, frameon=False)
    figure.tight_layout()
    figure.savefig(PICTURE, dpi=110)


def page(sizes: tuple[int, ...]) -> tuple[str, dict[str, list[list[Row]]]]:
    """The whole page and what it was measured from."""
    inertia, matrix = study(sizes, static=False)
    still, _ = study(sizes, static=True)
    parts = [
        HEAD.format(matrix=matrix),
        "## A step of 10 ms with inertia\n\nIterations, seconds, bytes.\n\n" + table(inertia),
        "\n\n## Static, Hooke's law\n\n",
        "The times are those of the first system, with all its preparations.\n\n" + table(still),
        "\n\n![Seconds against unknowns](../pictures/solvers.png)\n",
        TAIL.format(matrix=matrix, machine=measured_at()),
    ]
    return "".join(parts), {"10 ms, with inertia": inertia, "static": still}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--small", action="store_true", help="up to 1e4 unknowns")
    parser.add_argument("--write", action="store_true", help="to its page and its picture")
    asked = parser.parse_args()
    text, studies = page(SIZES[:2] if asked.small else SIZES)
    if asked.write:
        PAGE.write_text(text + kept(), encoding="utf-8")
        picture(studies)
    else:
        print(text)
