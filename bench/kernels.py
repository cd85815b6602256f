"""What each element and law costs, against the machine's limits and two baselines.

    python bench/kernels.py [--json FILE] [--binary build/main/bench/tissu-bench] [--repetitions 3]

Runs `tissu-bench` (or reads what it wrote with `--benchmark_format=json`), prints tables in
Markdown and writes them to docs/measured/kernels.md. Times are the processor time of the fastest
repetition.
"""

from __future__ import annotations

import argparse
import datetime
import json
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tissu.cli.info import machine_line, processor

ROOT = Path(__file__).resolve().parent.parent
JOBS = ("force", "product", "assembly")
# The rows that are set against each other are measured before and after the others, so that a busy
# moment of a shared machine does not decide a ratio.
COMPARED = "^((limit|ablation|baseline)/|kernel/(tetra|hexahedron)/stvk/)"
TWO_THREADS = ", 2 threads"
FILTERS = (COMPARED, "^kernel/", "^definite/", COMPARED)


@dataclass(frozen=True)
class Row:
    """The fastest repetition of one row."""

    ns: float  # of one iteration
    counters: dict[str, float]

    @property
    def ns_per_element(self) -> float:
        """Processor time of one element [ns]."""
        return self.ns / self.counters["elements"]


def run(binary: Path, repetitions: int) -> dict[str, Any]:
    """What the benchmark binary reports in several runs, as one report."""
    benchmarks: list[Any] = []
    for rows in FILTERS:
        command = [
            str(binary),
            f"--benchmark_filter={rows}",
            "--benchmark_format=json",
            f"--benchmark_repetitions={repetitions}",
        ]
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        report = dict(json.loads(done.stdout))
        benchmarks += report["benchmarks"]
    return {**report, "benchmarks": benchmarks}


def rows_of(report: dict[str, Any]) -> dict[str, Row]:
    """The fastest repetition of every row, by name without what the library appends."""
    rows: dict[str, Row] = {}
    for entry in report["benchmarks"]:
        if entry.get("run_type") == "aggregate":
            continue
        name = re.sub(r"/(min_time:[\d.]+|repeats:\d+|real_time|\d+)(?=/|$)", "", entry["name"])
        counters = {k: float(v) for k, v in entry.items() if isinstance(v, int | float)}
        row = Row(ns=float(entry["cpu_time"]), counters=counters)
        if name not in rows or row.ns < rows[name].ns:
            rows[name] = row
    return rows


def table(head: list[str], lines: list[list[str]]) -> str:
    """A table in Markdown, numbers to the right."""
    rule = ["---"] + ["---:"] * (len(head) - 1)
    return "\n".join("| " + " | ".join(line) + " |" for line in [head, rule, *lines])


def digits(value: float) -> str:
    """Three significant digits, no exponent."""
    return f"{value:.3g}" if value < 100 else f"{value:,.0f}"


def limits_table(rows: dict[str, Row]) -> str:
    """What the machine reaches with nothing else to do."""
    lines = []
    for name, row in rows.items():
        if not name.startswith("limit/") or name.endswith(TWO_THREADS):
            continue
        unit = "GFLOP/s" if "GFLOP/s" in row.counters else "GB/s"
        both = rows.get(name + TWO_THREADS)
        rates = [f"{r.counters[unit]:.1f} {unit}" if r else "" for r in (row, both)]
        lines.append([name.removeprefix("limit/"), *rates])
    return table(["at most", "1 thread", "2 threads"], lines)


def baseline_table(rows: dict[str, Row]) -> str:
    """Ours beside the textbook's loops and the expanded mass-tensor."""
    lines = []
    for element in ("tetra", "hexahedron"):
        for job in JOBS:
            ours = rows.get(f"kernel/{element}/stvk/{job}")
            if ours is None:
                continue
            line = [f"{element}, {job}", digits(ours.ns_per_element)]
            for who in ("textbook", "expanded"):
                other = rows.get(f"baseline/{who}/{element}/stvk/{job}")
                line += (
                    [
                        digits(other.ns_per_element),
                        f"{other.ns_per_element / ours.ns_per_element:.1f}",
                    ]
                    if other
                    else ["", ""]
                )
            lines.append(line)
    head = ["StVK, ns an element", "ours", "textbook", "textbook / ours"]
    return table([*head, "expanded", "expanded / ours"], lines)


def ablation_table(rows: dict[str, Row]) -> str:
    """What the parts of the force cost, and which of them bounds it."""
    parts = {
        name.removeprefix("ablation/"): row.ns_per_element
        for name, row in rows.items()
        if name.startswith("ablation/")
    }
    lines = [[name, f"{ns:.2f}"] for name, ns in parts.items()]
    text = table(["what is done", "ns an element"], lines)
    whole = parts["constants, gather, arithmetic, scatter"]
    costs = {
        "the arithmetic": whole - parts["constants, gather, scatter"],
        "the scatter": whole - parts["constants, gather, arithmetic"],
        "the gather": parts["constants, gather"] - parts["constants"],
        "the constants": parts["constants"],
    }
    saved = ", ".join(f"{name} {100 * ns / whole:.0f} %" for name, ns in costs.items())
    largest = max(costs, key=lambda name: costs[name])
    bound = (
        f"If a part is left out, the time falls by this share: {saved}. The largest is {largest}."
    )
    return f"{text}\n\n{bound}"


def moved_of(rows: dict[str, Row]) -> tuple[float, float]:
    """What a gather and a scatter of one node take [ns], of the tetrahedra of the ablation."""
    names = ("constants", "constants, gather", "constants, gather, scatter")
    parts = [rows.get(f"ablation/{name}") for name in names]
    constants, gather, scatter = (row.ns_per_element if row else 0.0 for row in parts)
    return (gather - constants) / 4.0, (scatter - gather) / 4.0


def bound_of(row: Row, job: str, moved: tuple[float, float]) -> str:
    """The limit that a kernel is nearest to, and its share of the kernel's time."""
    gather, scatter = moved
    counters = row.counters
    nodes = counters.get("nodes/element", 0.0)
    vectors = 2.0 if job == "product" else 1.0
    moving = nodes * (vectors * gather + (0.0 if job == "assembly" else scatter))
    shares = {
        "arithmetic": counters.get("of peak", 0.0),
        "constants": counters["of bandwidth"],
        "gather, scatter": moving / row.ns_per_element,
        "writing": counters.get("of writing", 0.0),
    }
    nearest = max(shares, key=lambda name: shares[name])
    return f"{nearest} {100 * shares[nearest]:.0f} %"


def kernel_table(rows: dict[str, Row]) -> str:
    """Every element with every law."""
    lines = []
    moved = moved_of(rows)
    pairs = dict.fromkeys(
        (name.split("/")[1], name.split("/")[2]) for name in rows if name.startswith("kernel/")
    )
    for element, law in pairs:
        found = [rows[f"kernel/{element}/{law}/{job}"] for job in JOBS]
        line = [f"{element}, {law}", *(digits(row.ns_per_element) for row in found)]
        line.append(f"{1e3 / found[0].ns_per_element:.2f}")
        line += [bound_of(row, job, moved) for row, job in zip(found, JOBS, strict=True)]
        lines.append([*line, digits(found[0].counters["bytes/element"])])
    head = ["element, law", "force ns", "product ns", "assembly ns", "force M/s"]
    return table([*head, *(f"{job} nearest to" for job in JOBS), "bytes"], lines)


def product_table(rows: dict[str, Row]) -> str:
    """Tangent products of StVK by element, for figure 6.11 of faure2014."""
    found = {
        element: row
        for element in ("tetra", "pyramid", "wedge", "hexahedron")
        if (row := rows.get(f"kernel/{element}/stvk/product")) is not None
    }
    if "tetra" not in found:
        return ""
    of_tetra = found["tetra"].ns_per_element
    lines = [
        [element, digits(row.ns_per_element), f"{row.ns_per_element / of_tetra:.1f}"]
        for element, row in found.items()
    ]
    return table(["tangent product, StVK", "ns an element", "times a tetrahedron"], lines)


def definite_table(rows: dict[str, Row]) -> str:
    """Assembly as it is and projected, where both were measured."""
    lines = []
    for name, exact in rows.items():
        what = re.fullmatch(r"definite/(.+)/exact", name)
        definite = rows.get(name.removesuffix("exact") + "definite")
        if what is None or definite is None:
            continue
        times = (exact.ns_per_element, definite.ns_per_element)
        label = ", ".join(what.group(1).split("/"))
        lines.append([label, *map(digits, times), f"{times[1] / times[0]:.1f}"])
    return table(["assembly, ns an element", "exact", "definite", "definite / exact"], lines)


def commit() -> str:
    """The commit of this checkout."""
    done = subprocess.run(
        ["git", "describe", "--always", "--dirty"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout.strip() or "unknown"


def measured_at() -> str:
    """The machine, the commit and the day, as pages end."""
    return f"{machine_line()} Commit {commit()}, {datetime.date.today()}."


def machine(report: dict[str, Any]) -> str:
    """One sentence on where the numbers come from."""
    context = report["context"]
    caches = ", ".join(
        f"L{c['level']} {c['size'] // 1024} KiB"
        for c in context["caches"]
        if c["type"] != "Instruction"
    )
    return (
        f"{context.get('processor', processor())}, {context['num_cpus']} processors, {caches}; "
        f"{context['instruction set']}; {context.get('compiler', 'compiler not named')}; "
        f"commit {context.get('commit', commit())}; {context['date'][:10]}; "
        f"load {context['load_avg'][0]:.1f}."
    )


def page(report: dict[str, Any]) -> str:
    """The whole of docs/measured/kernels.md."""
    rows = rows_of(report)
    return f"""# The cost of an element

This page gives the time of a force, a tangent product and a matrix for every element and law, and
compares it with the limits of the machine. It is printed by `python bench/kernels.py`, not written
by hand. Times are processor times of the fastest repetition on one thread, for about 20,000
elements of each type with the quadrature `full`.

{machine(report)}

## The machine's limits

{limits_table(rows)}

A multiply-add counts as two operations. The triad `a = b + s c` moves three numbers of eight bytes.

## Against two baselines

{baseline_table(rows)}

How much do the vectorised kernels gain over simple code? `textbook` computes 3x3 products, E, S
and P, one element after the other, with portable flags (`bench/baseline/textbook.h`). `expanded`
is Picinbono's mass-tensor: the energy as a quartic polynomial of the displacements, with 280
constants a tetrahedron, and six that he does not count (`bench/baseline/expanded.h`). Both equal
the core's forces to round-off: `tests/cpp/bench`.

## What bounds the force of StVK on tetrahedra

{ablation_table(rows)}

The rows are those of a kernel in the benchmark, with parts left out, on the mesh in the order of
the core.

## By element, compared with figure 6.11 of Faure 2014

{product_table(rows)}

The figure of the thesis, for a graphics processor, prints no numbers. Tetrahedra are by far the
fastest there; pyramids, hexahedra and wedges follow and are alike.

## Definite matrices

{definite_table(rows)}

Every cell is squeezed to 0.6 of its height, and its matrix is more or less indefinite. Continuum
elements clamp dP/dF at every point: isotropic laws in the axes of F, others by the eigenvalues
of all nine rows. The other models clamp the matrix of each cell, or of each spring
(`docs/reference/tour.md`).

## Every element, every law

{kernel_table(rows)}

"Nearest to" names the limit that a kernel comes nearest to, and the share of the kernel's time that
the limit alone would take:

- *arithmetic*: the operations by formula (`bench/kernels/operations.h`) at the multiply-add limit;
- *constants*: reading the element's own constants ("bytes") at the triad from the level that holds
  the mesh;
- *gather, scatter*: fetching the vectors of the element's nodes and adding to them, at the time
  for a node that the parts of the tetrahedron above show; a product fetches two vectors;
- *writing*: adding the blocks of all pairs of the element's nodes to the matrix, at the triad.

A share far below 100 % means that no single limit decides: the work goes into instructions that
the formulae do not count, such as exchanges between registers, divisions, roots and logarithms,
and these wait for each other.
"""


def main() -> None:
    """Runs or reads, prints, writes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument(
        "--json", type=Path, help="what tissu-bench wrote with --benchmark_format=json"
    )
    parser.add_argument("--binary", type=Path, default=ROOT / "build/main/bench/tissu-bench")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--out", type=Path, default=ROOT / "docs/measured/kernels.md")
    arguments = parser.parse_args()
    if arguments.json is not None:
        report = dict(json.loads(arguments.json.read_text(encoding="utf-8")))
    else:
        report = run(arguments.binary, arguments.repetitions)
    text = page(report)
    print(text)
    arguments.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
