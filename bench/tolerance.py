"""Prints the tolerance in docs/measured/solvers.md: --write, --full for 10,000 steps.

What a tolerance of the linear solver does to the answer, beside what the time step does to it.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tissu as ts
from tissu.counted import counted

sys.path.insert(0, str(Path(__file__).resolve().parent))
from kernels import measured_at
from section import put

Floats = NDArray[np.float64]
TOLERANCES = tuple(10.0**-digits for digits in range(2, 9))
EXACT = ts.ConjugateGradient(
    tolerance=1e-12, iterations=20_000, preconditioner="incomplete_cholesky"
)
DT = 0.01
FINER = 8
MARKS, LONG = (1, 10, 100, 1000), 10_000
TEXT = """## What the tolerance costs

How much does the tolerance of the solver change the answer? The residual of each solve is at most
the tolerance times the norm of its right-hand side. The tables give the relative error after 1 to
10,000 steps of 10 ms: the difference of all displacements from those with a tolerance of 1e-12, in
the 2-norm, over the largest displacement norm so far. The row `dt` is the difference from the same
run with an eighth of the time step.

{tables}
Both errors vanish once the bar has come to rest. The stiff bar is at rest after a hundred steps.

In statics, Newton's method stops by the residual force, whatever the tolerance of its linear
systems. So the tolerance changes the number of Newton iterations, but hardly the answer.

{statics}
The default of `auto` is {default:.0e}: {reason}

Printed by `python bench/tolerance.py --write`; {machine}
"""
REASON = """its error stays a thousand times below that of the time step as long as the bodies
move, after one step as after ten thousand. Newton's method takes as many iterations as with
exact solves; with 1e-2 it may take more. A tighter tolerance is useless, since the error of the
time step is far larger, except for bodies with parts that are 1e5 times as stiff as the rest
([limits](../guide/solvers.md#limits)). A looser one saves a fifth of the iterations for each digit.
It is a good choice if an error of 3e-4 (of 1e-3 for a tolerance of 1e-3) after a thousand steps is
acceptable."""


def bar(step: Any, *, young: str, cells: tuple[int, int, int]) -> ts.Scene:
    """A bar that swings and is damped by its step alone."""
    mesh = ts.BarMesh(size=(0.4, 0.1, 0.1), cells=cells, cell="tetra")
    law = ts.StVK(young=young, poisson=0.3)
    return ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=law, density=1000)},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=step,
    )


SCENES = {
    "soft bar, 50 kPa": {"young": "50 kPa", "cells": (8, 3, 3)},
    "stiff bar, 5 MPa": {"young": "5 MPa", "cells": (8, 3, 3)},
    "finer, 500 kPa": {"young": "500 kPa", "cells": (16, 5, 5)},
}
METHODS = {"implicit Euler": ts.ImplicitEuler, "BDF2": ts.BDF2}


def path(scene: ts.Scene, marks: tuple[int, ...], parts: int = 1) -> tuple[list[Floats], float]:
    """Displacements after each of the marks, and iterations of a step."""
    simulation = scene.compile()
    found, taken = [], 0
    for number in range(1, marks[-1] + 1):
        for _ in range(parts):
            taken += simulation.step().solver_iterations
        if number in marks:
            found.append(np.array(simulation.displacements("bar")))
    return found, taken / (marks[-1] * parts)


def errors(found: list[Floats], exact: list[Floats], size: float) -> list[float]:
    """Relative ones."""
    return [float(np.linalg.norm(a - b)) / size for a, b in zip(found, exact, strict=True)]


def table(name: str, method: str, marks: tuple[int, ...]) -> str:
    """Errors of a scene under a method."""
    of, step = SCENES[name], METHODS[method]
    exact, _ = path(bar(step(DT, solver=EXACT), **of), marks)  # type: ignore[arg-type]
    size = max(float(np.linalg.norm(u)) for u in exact)
    lines = [
        f"{name}, {method}:\n",
        f"| | {' | '.join(counted(m, 'step') for m in marks)} | iterations |",
    ]
    lines.append("|---" * (len(marks) + 2) + "|")
    for tolerance in TOLERANCES:
        solver = EXACT.replace(tolerance=tolerance)
        found, taken = path(bar(step(DT, solver=solver), **of), marks)  # type: ignore[arg-type]
        cells = " | ".join(f"{e:.1e}" for e in errors(found, exact, size))
        lines.append(f"| {tolerance:.0e} | {cells} | {taken:.1f} |")
        print(lines[-1], file=sys.stderr, flush=True)
    finer, _ = path(bar(step(DT / FINER, solver=EXACT), **of), marks, parts=FINER)  # type: ignore[arg-type]
    cells = " | ".join(f"{e:.1e}" for e in errors(finer, exact, size))
    lines.append(f"| dt | {cells} | |")
    return "\n".join(lines) + "\n"


def statics() -> str:
    """Errors of the equilibrium."""
    lines = ["| | " + " | ".join(f"{name}: error, Newton, iterations" for name in SCENES) + " |"]
    lines.append("|---" * (len(SCENES) + 1) + "|")
    exact = {}
    for tolerance in (1e-12, *TOLERANCES):
        cells = []
        for name, of in SCENES.items():
            step = ts.Static(solver=EXACT.replace(tolerance=tolerance))
            simulation = bar(step, **of).compile()  # type: ignore[arg-type]
            report = simulation.step()
            moved = np.array(simulation.displacements("bar"))
            exact.setdefault(name, moved)
            error = np.linalg.norm(moved - exact[name]) / np.linalg.norm(exact[name])
            cells.append(f"{error:.1e}, {report.newton_iterations}, {report.solver_iterations}")
        lines.append(f"| {tolerance:.0e} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def section(*, full: bool) -> str:
    """The whole section."""
    tables = [table(name, "implicit Euler", MARKS) for name in SCENES]
    tables.append(table("soft bar, 50 kPa", "BDF2", MARKS))
    if full:
        tables.append(table("soft bar, 50 kPa", "implicit Euler", (*MARKS, LONG)))
    default = ts.Auto().tolerance
    return TEXT.format(
        tables="\n".join(tables),
        statics=statics(),
        default=default,
        reason=REASON,
        machine=measured_at(),
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--full", action="store_true", help="10,000 steps of the smallest as well")
    parser.add_argument("--write", action="store_true", help="to docs/measured/solvers.md")
    asked = parser.parse_args()
    text = section(full=asked.full)
    if asked.write:
        put("tolerance", text)
    else:
        print(text)
