"""What a linear tetrahedron costs as continuum element, mass-link and mass-tensor.

    python bench/models.py [--json FILE] [--binary build/main/bench/tissu-bench-models] [--passes 3]

Runs `tissu-bench-models` several times (or reads what that gave, a list of its JSON reports),
prints tables in Markdown and writes them to docs/measured/models-cost.md. Times are those of the
fastest of all repetitions of all passes, the one that a shared machine disturbed least:
processor time on one thread, time by the clock on two.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
from pathlib import Path
from typing import Any

from kernels import ROOT, digits, machine, table

JOBS = ("force", "product", "assembly")
MODELS = ("fem", "mass-link", "mass-tensor")
COUNTS = (1_000, 10_000, 100_000, 1_000_000)

Rows = dict[str, dict[str, float]]


def run(binary: Path, passes: int, repetitions: int) -> list[Any]:
    """What the benchmark binary reports in each pass."""
    command = [
        str(binary),
        "--benchmark_format=json",
        f"--benchmark_repetitions={repetitions}",
    ]
    environment = {**os.environ, "OMP_WAIT_POLICY": "active"}
    reports = []
    for _ in range(passes):
        done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)
        reports.append(json.loads(done.stdout))
    return reports


def rows_of(reports: list[Any]) -> Rows:
    """Every row with the least of its times [ns]."""
    rows: Rows = {}
    for report in reports:
        for entry in report["benchmarks"]:
            if entry.get("run_type") == "aggregate":
                continue
            name = entry["name"].split("/min_time:")[0]
            numbers = {k: float(v) for k, v in entry.items() if isinstance(v, int | float)}
            before = rows.setdefault(name, numbers)
            for time in ("real_time", "cpu_time"):
                before[time] = min(before[time], numbers[time])
            if "GB/s" in numbers:
                before["GB/s"] = max(before["GB/s"], numbers["GB/s"])
    return rows


def ns(rows: Rows, model: str, job: str, count: int, threads: int) -> float:
    """Time of one tetrahedron [ns]."""
    row = rows[f"model/{model}/{job}/{count}/{threads}"]
    return row["cpu_time" if threads == 1 else "real_time"] / row["elements"]


def time_table(rows: Rows, job: str) -> str:
    """A job of the three models, by size and threads, and how many times the continuum element."""
    lines = []
    for count in COUNTS:
        times = [ns(rows, model, job, count, 1) for model in MODELS]
        line = [f"{count:,}", digits(times[0])]
        for own in times[1:]:
            line += [digits(own), f"{own / times[0]:.2f}"]
        for own, model in zip(times, MODELS, strict=True):
            both = ns(rows, model, job, count, 2)
            line.append(digits(both) if both < own else f"({digits(both)})")
        if job == "force":
            known = f"model/expanded/force/{count}/1" in rows
            line.append(digits(ns(rows, "expanded", job, count, 1)) if known else "")
        lines.append(line)
    head = [f"{job}, ns a tetrahedron", "fem", "mass-link", "/ fem", "mass-tensor", "/ fem"]
    head += [f"{model}, 2 threads" for model in MODELS]
    return table([*head, "280 each"] if job == "force" else head, lines)


def size_table(rows: Rows) -> str:
    """What each keeps."""
    lines = []
    for model in MODELS:
        force = rows[f"model/{model}/force/{COUNTS[-1]}/1"]
        assembly = rows[f"model/{model}/assembly/{COUNTS[-1]}/1"]
        lines.append(
            [
                model,
                f"{force['published reals']:.0f}",
                digits(force["reals/element"]),
                digits(force["bytes/element"]),
                digits(assembly["bytes/element"]),
            ]
        )
    head = ["a tetrahedron of a million", "constants alone", "constants in the mesh", "bytes"]
    return table([*head, "bytes with places in the matrix"], lines)


def edit_table(rows: Rows) -> str:
    """A cell taken out of a mass-tensor."""
    lines = []
    for count in COUNTS[:-1]:
        edited, anew = rows[f"edit/edited/{count}"], rows[f"edit/anew/{count}"]
        lines.append(
            [
                f"{count:,}",
                f"{edited['computed']:,.0f} of {edited['constants']:,.0f}",
                f"{1e-6 * edited['cpu_time']:.2f}",
                f"{1e-6 * anew['cpu_time']:.2f}",
            ]
        )
    head = ["one cell is removed from", "constants summed again", "edited, ms", "made anew, ms"]
    return table(head, lines)


def conclusion(rows: Rows) -> str:
    """Which wins, from the numbers themselves."""

    def spread(model: str, job: str, threads: int = 1) -> str:
        ratios = [
            ns(rows, model, job, count, threads) / ns(rows, "fem", job, count, threads)
            for count in COUNTS
        ]
        return f"{min(ratios):.1f} to {max(ratios):.1f}"

    bandwidth = rows["limit/triad from memory/8388608"]["GB/s"]
    alone = 286 * 8 / bandwidth
    return (
        "On one thread the force of a mass-link takes "
        f"{spread('mass-link', 'force')} times that of the continuum element, its product "
        f"{spread('mass-link', 'product')} times, its matrix {spread('mass-link', 'assembly')} "
        f"times; the mass-tensor takes {spread('mass-tensor', 'force')}, "
        f"{spread('mass-tensor', 'product')} and {spread('mass-tensor', 'assembly')} times. "
        f"This machine reads {bandwidth:.0f} GB/s from memory: 280 constants and 6 of each "
        f"tetrahedron alone would take {alone:.0f} ns to read before anything is computed, "
        f"and the whole force of a continuum element takes "
        f"{ns(rows, 'fem', 'force', COUNTS[-1], 1):.0f} ns at a million."
    )


def page(reports: list[Any]) -> str:
    """The whole of docs/measured/models-cost.md."""
    rows = rows_of(reports)
    whole = sum(any("/1/min" in b["name"] for b in report["benchmarks"]) for report in reports)
    load = max(report["context"]["load_avg"][0] for report in reports)
    times = "\n\n".join(time_table(rows, job) for job in JOBS)
    return f"""# The cost of a tetrahedron in three forms

The energy of a linear tetrahedron of St-Venant–Kirchhoff can be written in three forms: as a
continuum element (`fem`, 7 constants), in the squared lengths of its edges (`mass_link`, 27
constants), and as a polynomial in its displacements (`mass_tensor`, 280 and 6 constants). This page
compares their times and memory. All three give the same forces and tangents to 1e-12
(`tests/cpp/model/edges/tetra_models_test.cpp`). For the mass-tensor this holds up to displacements
of about a cell, because its round-off grows with their cube. Printed by `bench/models.py`; run it
for your machine.
{machine(reports[0])}

Times are the fastest of {whole} passes, and {len(reports) - whole} more on two threads: processor
time on one thread, wall time on two. Other users loaded the machine at the same time (a load of up
to {load:.0f}), so figures on two threads are upper bounds. Figures in brackets exceed those of one
thread and show only that the second core was not free.

{times}

`280 each` is the same polynomial in its usual form: every tetrahedron has all constants of its own,
and tetrahedra are computed one after the other without vector instructions. Our mass-tensor keeps
the constants on the nodes, edges and faces that tetrahedra share, as Picinbono does, and computes
eight tetrahedra at a time.

{size_table(rows)}

"Constants alone" counts those of a single tetrahedron, as the papers do. Bytes include constants,
node positions and everything else that a model keeps.

## Which is the fastest

{conclusion(rows)}

For forces and products the continuum element is the fastest on today's processors, because it reads
the least and does not compute more. A force reads 7 numbers and takes about 160 operations, counted
in the source. The mass-link reads 27 numbers for about as many operations, and the mass-tensor
reads about 75 numbers for about 600 operations. While a core waits for one number from memory, it
could do dozens of operations. So a value that is cheap to recompute is better not stored.

The mass-link is close as long as its constants fit easily into the caches (2 MB for 10,000
tetrahedra), and falls behind beyond that. Its matrix needs fewer operations than that of the
continuum element. So the mass-link is ahead on small meshes; on large ones, where writing the
matrix costs more than computing it, the two are even. Stored constants never pay for the
mass-tensor. Its cost is bearable only because neighbours share constants, which brings 286 down to
about 75.

## Removed cells

{edit_table(rows)}

Only constants on the nodes, edges and faces of the removed cell are summed again. The others are
copied, because the world before the edit stays as it is. Times are processor times of the model
alone; a world also computes its matrix pattern again. A continuum element has no sums to update.
"""


def main() -> None:
    """Runs, prints and writes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path, help="reports of the binary, instead of running it")
    parser.add_argument("--save", type=Path, help="where the reports are kept")
    parser.add_argument("--binary", type=Path, default=ROOT / "build/main/bench/tissu-bench-models")
    parser.add_argument("--passes", type=int, default=3)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--output", type=Path, default=ROOT / "docs/measured/models-cost.md")
    given = parser.parse_args()
    if given.json:
        reports = json.loads(given.json.read_text(encoding="utf-8"))
    else:
        reports = run(given.binary, given.passes, given.repetitions)
    if given.save:
        given.save.write_text(json.dumps(reports), encoding="utf-8")
    text = page(reports)
    print(text)
    given.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
