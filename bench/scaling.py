"""Prints docs/measured/scaling.md: steps of a thousand elements to a million, and targets.

    python bench/scaling.py [--json FILE] [--save FILE] [--binary build/main/bench/tissu-bench]

Runs the rows limit/, solve/, scale/ and target/ of `tissu-bench` in several passes, keeps what they
gave in FILE, and writes the page; with --json it writes the page from such a file. It takes some
forty minutes, and 3 GB at a million elements.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from kernels import ROOT, digits, machine, table
from scaling_rows import Row, Rows, others, rows_of, run, threads_of
from targets import (
    MILLION,
    PARTS,
    SIZES,
    SOLVERS,
    TARGETS,
    best_solver,
    exponent,
    on_threads,
    step_row,
)


def share(row: Row, counter: str) -> str:
    """A share in percent, empty where it was not measured."""
    return f"{100 * row[counter]:.0f} %" if counter in row.counters else ""


def target_table(rows: Rows) -> str:
    """The targets, and why those are missed that are."""
    found = [target(rows) for target in TARGETS]
    words = {True: "yes", False: "**no**", None: ""}
    lines = [[t.wanted, t.measured, words[t.met]] for t in found]
    text = table(["target", "measured", "met"], lines).replace("---:", "---")
    reasons = [f"- **{t.wanted}**: {t.why}" for t in found if t.met is False]
    return "\n".join([text, "", "Missed, and what bounds it:", "", *reasons]) if reasons else text


def limit_table(rows: Rows) -> str:
    """The machine's limits on one thread and on two."""
    lines = []
    for name, row in rows.items():
        kind = name.split("/")[1]
        if not name.startswith("limit/") or kind.endswith("2 threads"):
            continue
        both = [r for n, r in rows.items() if n.startswith(f"limit/{kind}, 2 threads")]
        unit = "GFLOP/s" if "GFLOP/s" in row.counters else "GB/s"
        two = [digits(both[0][unit]), f"{both[0][unit] / row[unit]:.2f}"] if both else ["", ""]
        lines.append([f"{kind}, {unit}", digits(row[unit]), *two])
    return table(["at most", "1 thread", "2 threads", "two / one"], lines)


def part_table(rows: Rows, part: str) -> str:
    """A part by size and threads."""
    lines = []
    for size in SIZES:
        found = on_threads(rows, f"scale/{part}/{size}")
        one, two = found[1], found.get(2)
        gained = [digits(two.per_element), f"{one.ns / two.ns:.2f}"] if two else ["", ""]
        line = [f"{one['elements']:,.0f}", digits(one.per_element), *gained]
        lines.append([*line, digits(one["bytes/element"])])
    head = [f"{part}, elements", "ns an element", "2 threads", "speed-up", "bytes an element"]
    return table(head, lines)


def step_table(rows: Rows, solver: str) -> str:
    """Whole steps with a solver."""
    lines = []
    for size in SIZES:
        found = on_threads(rows, f"scale/step, {solver}/{size}")
        one, two = found[1], found.get(2)
        gained = [digits(two.step_ms), f"{one.ns / two.ns:.2f}"] if two else ["", ""]
        lines.append(
            [
                f"{one['elements']:,.0f}",
                digits(one.step_ms),
                *gained,
                digits(one.rate),
                f"{one['CG iterations']:.0f}",
                *(share(one, f"{part} share") for part in ("matrix", "preconditioner", "solve")),
                share(one, "solve of bandwidth"),
                digits(one["bytes/element"]),
                digits(one["resident bytes/element"]),
            ]
        )
    head = [f"{solver}, elements", "ms a step", "2 threads", "speed-up", "steps/s", "iterations"]
    head += ["matrix", "preconditioner", "solve", "solve of triad", "bytes an element", "resident"]
    small, large = (step_row(rows, solver, size) for size in (SIZES[1], MILLION))
    grown = exponent(small, large, lambda row: row.step_ms)
    return f"{table(head, lines)}\n\nFrom {small['elements']:,.0f} elements on: n^{grown:.2f}."


def best_table(rows: Rows) -> str:
    """The fastest solver of each size."""
    lines = []
    for size in SIZES:
        line = [f"{step_row(rows, SOLVERS[0], size)['elements']:,.0f}"]
        for threads in (1, 2):
            if f"scale/step, {SOLVERS[0]}/{size}/{threads}" not in rows:
                line += ["", ""]
                continue
            best = best_solver(rows, size, threads)
            line += [best, digits(step_row(rows, best, size, threads).step_ms)]
        lines.append(line)
    return table(["elements", "1 thread", "ms a step", "2 threads", "ms a step"], lines)


def solve_table(rows: Rows) -> str:
    """Products and preconditioners, in and out of cache."""
    lines = []
    for name, one in rows.items():
        if not name.startswith("solve/") or not name.endswith("/1"):
            continue
        _, what, precision, *_ = name.split("/")
        two = rows.get(name[:-1] + "2")
        line = [f"{what}, {precision}, {one['elements']:,.0f}", digits(one["bytes"] / 1e6)]
        line += [digits(one.ns / 1e3), share(one, "of bandwidth")]
        line += [digits(two.ns / 1e3), share(two, "of bandwidth")] if two else ["", ""]
        lines.append([*line, f"{one.ns / two.ns:.2f}" if two else ""])
    head = ["part, precision, elements", "MB", "us", "of triad", "us, 2 threads", "of triad"]
    return table([*head, "speed-up"], lines)


def rotation_table(rows: Rows) -> str:
    """Rotations alone."""
    lines = []
    for name, row in rows.items():
        if name.startswith("rotation/"):
            line = [name.removeprefix("rotation/"), f"{row.per_element:.1f}"]
            lines.append([*line, share(row, "of peak"), share(row, "of bandwidth")])
    return table(["rotation of F", "ns", "of peak", "of triad"], lines)


def load_text(reports: list[dict[str, Any]]) -> str:
    """How busy the machine was with other work."""
    used = others(reports)
    loads = [report["context"]["load_avg"][0] for report in reports]
    text = (
        f"While this ran, others used {used:.1f} of the machine's processors on average (load "
        f"{min(loads):.1f} to {max(loads):.1f}, this program's own share included)"
    )
    if used < 0.1:
        return f"{text}."
    one = (
        f"{text}: a loaded machine. Times of one thread are processor time, which leaves out when "
        "it had to wait, but not that caches and memory were shared."
    )
    if not any(threads_of(name) == 2 for name in rows_of(reports)):
        return f"{one} Two threads were not measured."
    return f"{one} Times on two threads are upper bounds, and their speed-ups lower ones."


def page(reports: list[dict[str, Any]]) -> str:
    """The whole of docs/measured/scaling.md."""
    rows = rows_of(reports)
    parts = "\n\n".join(part_table(rows, part) for part in PARTS)
    steps = "\n\n".join(step_table(rows, solver) for solver in SOLVERS)
    return f"""# Scaling

This page shows how the time and memory of a step grow with the number of elements, from a thousand
to a million. It is printed by `python bench/scaling.py`, not written by hand. Every time is that
of the fastest repetition: processor time on one thread, wall time on two.

{machine(reports[-1])}
{load_text(reports)}

## Targets

{target_table(rows)}

## The machine's limits

{limit_table(rows)}

The triad `a = b + s c` counts three numbers of eight bytes. The L2 of two threads is that of
both. A product may exceed the triad because it only reads. So may data of slightly more than 12
MB if they fit a cache, since they are compared with the limit of the memory.

## A cube of tetrahedra

A cube of 10 cm of soft tissue (10 kPa, nu 0.3, 1000 kg/m3, St-Venant–Kirchhoff) is held at one
face and bent by its weight (`bench/scale/cube.h`). It is the same cube at every size. `assembly`
is all the work that makes the matrix of a step, inertia and held nodes included. Bytes are those
that a part reads.

{parts}

## Whole steps

Steps are those of implicit Euler, 10 ms, linearised once, with conjugate gradients to 1e-6.
Three steps are timed repeatedly, beginning with the third step from rest. With a multigrid, which
keeps its levels for several steps, four steps are timed. Each repetition starts with an empty
solver. Shares are of the time of a step. "Solve of triad" is the traffic that the iterations need
(`bench/solve/traffic.h`), as a share of the triad from the level that holds it. Bytes are those of
model, matrix and solver; "resident" is the growth of the whole process.

Harder steps follow after the four steps with a multigrid: from the 8th step on (105,456 elements),
the swing takes ten Newton iterations a step with any solver.

{best_table(rows)}

{steps}

## Products and preconditioners

The matrix is that of the cube's first step. "MB" are those that a product moves, or that a
preconditioner keeps. A set-up takes the values of a matrix whose pattern it has seen.

{solve_table(rows)}

## Rotations

The table gives the time to find the rotation of a deformation gradient F on one thread, for 20,000
gradients with random rotations. "Flat" gradients take the branch by the eigenvector.

{rotation_table(rows)}
"""


def main() -> None:
    """Runs or reads, keeps, prints, writes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--json", type=Path, help="what --save kept, instead of running")
    parser.add_argument("--save", type=Path, help="where to keep what was measured")
    parser.add_argument("--binary", type=Path, default=ROOT / "build/main/bench/tissu-bench")
    parser.add_argument("--threads", type=int, default=2, choices=(1, 2), help="at most")
    parser.add_argument("--passes", type=int, default=2)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--out", type=Path, default=ROOT / "docs/measured/scaling.md")
    given = parser.parse_args()
    if given.json is not None:
        reports = json.loads(given.json.read_text(encoding="utf-8"))
    else:
        reports = run(given.binary, given.passes, given.repetitions, given.threads)
    if given.save is not None:
        given.save.write_text(json.dumps(reports), encoding="utf-8")
    text = page(reports)
    print(text)
    given.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
