"""Prints docs/measured/steps.md: how long whole steps take, and how even they are.

    python bench/steady.py [--rows TEXT] [--share 1.0] [--write]

Every row is a run of its own, from rest on. Run it on a machine that does nothing else.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from kernels import measured_at, table
from peer_work import DENSITY, GRAVITY, POISSON, SIZE, YOUNG
from section import MEASURED

import tissu as ts

PAGE = MEASURED / "steps.md"
DT = 0.01  # s
EVEN, EARLY = 1.5, 3.0
"""goals: p99 over p50, and the first step over p50"""
HEAD = f"""# Whole steps

How long does a step take, and is any step late? `python bench/steady.py --write` prints this page.
The bar is 8 x 1 x 1 m (50 MPa, nu 0.3, 1000 kg/m3, St-Venant–Kirchhoff unless the row says
otherwise). It is held at one end, and swings under its weight. The cube is that of
[scaling](scaling.md): 10 cm, 10 kPa, held at one face. The organ is that of the examples. The
solver is `auto`. A step lasts 10 ms, except where it is explicit. Times are wall times in
milliseconds:

- **first**: the first step, for which `compile` has prepared the solver;
- **p50, p99, worst**: percentiles over all steps, and the longest of them but the first;
- **p99 / p50**: goal at most {EVEN}; **first / p50**: goal at most {EARLY:.0f}.

The bar starts at rest and is undamped but for implicit Euler. Its first 20 steps take about twice
the iterations of later ones, and are among the slowest one percent of a thousand steps. The
longest steps of the cubes are early ones, whose linearised equation left more residual than it
found: Newton's method iterates them up to seven times. The cubes are stable neo-Hooke. A cube of
St-Venant–Kirchhoff as soft as these sags to half its height, where that law gives way: some of its
steps are iterated ten times, take 1.5 to 2 s for 105,456 tetrahedra, and are reported as not
converged.

"""


@dataclass(frozen=True)
class Row:
    """A run.

    Attributes:
        name: of the body.
        make: a scene of a step.
        step: of the scene.
        what: of the step, in words.
        steps: how many.
        goal: of p50 on one thread [ms]; None: there is none.
    """

    name: str
    make: Callable[[Any], ts.Scene]
    step: Any
    what: str
    steps: int
    goal: float | None = None


def bar(cells: int, cell: str = "tetra", model: str = "fem") -> Callable[[Any], ts.Scene]:
    """The bar with so many cubes across, as tetrahedra each is cut in six."""

    def made(step: Any) -> ts.Scene:
        mesh = ts.bar_mesh(size=SIZE, cells=(8 * cells, cells, cells), cell=cell)
        law: Any = ts.StVK(young=YOUNG, poisson=POISSON)
        if model == "corotational":
            law = ts.Hooke(young=YOUNG, poisson=POISSON)
        body = ts.Body(mesh=mesh, model=model, law=law, density=DENSITY)
        held = ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))
        return ts.Scene(
            bodies={"bar": body}, gravity=(0, 0, -GRAVITY), fixed=[held], step=step, duration=10.0
        )

    return made


def cube(cells: int) -> Callable[[Any], ts.Scene]:
    """The cube of bench/scale/cube.h, of a law that bears how far it sags."""

    def made(step: Any) -> ts.Scene:
        mesh = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(cells,) * 3, cell="tetra")
        law = ts.StableNeoHooke(young=10e3, poisson=0.3)
        body = ts.Body(mesh=mesh, law=law, density=1000.0)
        held = ts.Fixed("cube", on=ts.Plane((0, 0, 0), (1, 0, 0)))
        return ts.Scene(
            bodies={"cube": body}, gravity=(0, 0, -GRAVITY), fixed=[held], step=step, duration=10.0
        )

    return made


def organ(step: Any) -> ts.Scene:
    """The organ of the examples."""
    return ts.examples.organ().replace(step=step)


def rows() -> list[Row]:
    """All runs."""

    def implicit(tolerance: float) -> Any:
        return ts.ImplicitEuler(DT, solver=ts.Auto(tolerance=tolerance))

    small, large = "bar, 10,368 tetrahedra", "bar, 48,000 tetrahedra"
    default = ts.Auto().tolerance
    found = [
        *(
            Row(small, bar(6), implicit(tol), f"tolerance {tol:.0e}", 1000, goal)
            for tol, goal in ((1e-3, 4.0), (default, None), (1e-6, 6.0))
        ),
        Row(small, bar(6, model="corotational"), implicit(1e-3), "corotational, 1e-03", 1000, 4.0),
        *(
            Row(large, bar(10), implicit(tol), f"tolerance {tol:.0e}", 300, goal)
            for tol, goal in ((1e-3, 18.0), (default, None), (1e-6, 27.0))
        ),
        Row(large, bar(10, model="corotational"), implicit(1e-3), "corotational, 1e-03", 300, 18.0),
        Row("bar, 1,728 hexahedra", bar(6, "hexahedron"), implicit(1e-3), "1e-03", 1000, 5.0),
        Row("bar, 8,000 hexahedra", bar(10, "hexahedron"), implicit(1e-3), "1e-03", 300, 30.0),
        Row("organ", organ, implicit(default), "all defaults", 1000),
        Row("cube, 10,368 tetrahedra", cube(12), implicit(default), "all defaults", 1000),
        Row("cube, 105,456 tetrahedra", cube(26), implicit(default), "all defaults", 200),
        Row(large, bar(10), ts.SymplecticEuler(1e-5), "explicit", 1000, 0.5),
    ]
    return found


@dataclass(frozen=True)
class Times:
    """Of the steps of a run [ms]."""

    first: float
    p50: float
    p99: float
    worst: float


def times(row: Row, threads: int, share: float) -> Times:
    """One run."""
    simulation = row.make(row.step).replace(threads=threads).compile()
    taken = []
    for _ in range(max(20, round(share * row.steps))):
        begin = time.perf_counter()
        simulation.step()
        taken.append(1e3 * (time.perf_counter() - begin))
    p50, p99 = np.percentile(taken, (50, 99))
    return Times(taken[0], float(p50), float(p99), max(taken[1:]))


def cells(row: Row, share: float) -> Iterator[str]:
    """A row in words."""
    one, two = times(row, 1, share), times(row, 2, share)
    yield from (row.name, row.what)
    yield from (f"{ms:.3g}" for ms in (one.first, one.p50, one.p99, one.worst))
    yield f"{one.p99 / one.p50:.2f}"
    yield f"{one.first / one.p50:.1f}"
    yield "" if row.goal is None else f"{row.goal:g}: {'met' if one.p50 <= row.goal else 'missed'}"
    yield from (f"{two.p50:.3g}", f"{one.p50 / two.p50:.2f}", f"{two.p99 / two.p50:.2f}")


def page(found: list[Row], share: float) -> str:
    """The whole page."""
    lines = []
    for row in found:
        lines.append(list(cells(row, share)))
        print(" | ".join(lines[-1]), flush=True)
    head = [
        "body",
        "step",
        "first",
        "p50",
        "p99",
        "worst",
        "p99 / p50",
        "first / p50",
        "goal of p50",
    ]
    head += ["two threads, p50", "speed-up", "p99 / p50 of two"]
    return f"{HEAD}{table(head, lines)}\n\n{measured_at()}\n"


def main() -> None:
    """Prints the page, or writes it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--rows", default="", help="those whose name and step hold this text")
    parser.add_argument("--share", type=float, default=1.0, help="of the steps")
    parser.add_argument("--write", action="store_true", help="docs/measured/steps.md")
    asked = parser.parse_args()
    text = page([row for row in rows() if asked.rows in f"{row.name}, {row.what}"], asked.share)
    if asked.write:
        PAGE.write_text(text, encoding="utf-8")
    else:
        print(text)


if __name__ == "__main__":
    main()
